//! Hillshade of the height map with the flow in colour, as an image.

use super::field::Field;
use crate::pictures::canvas::{Backing, Image, PictureError};
use crate::pictures::palette::ColorScale;
use plotters::style::RGBColor;
use scree_solver::raster::Raster;

/// Most pixels along a side: a file of some 100 kB.
const MOST_PIXELS: usize = 480;
/// Direction towards the light: from the north-west, 45° high, as is usual on maps.
const LIGHT: [f64; 3] = [-0.5, 0.5, std::f64::consts::FRAC_1_SQRT_2];
/// Steps of grey, and of colour: few pack well, and more can't be told apart.
const GREYS: f64 = 24.0;
const COLORS: f64 = 24.0;
/// Least share of the scale that is shown: single points that fly ahead make less.
const LEAST: f64 = 0.01;
/// Share of a colour over the hillshade.
const OPACITY: f64 = 0.72;

/// Hillshade and map of the flow, behind all lines.
#[derive(Debug)]
pub(super) struct Backdrop<'a> {
    pub height: &'a Raster,
    /// Largest flow height [m].
    pub flow: Option<&'a Raster>,
    pub scale: ColorScale,
}

impl Backdrop<'_> {
    /// The part of it that a field shows, with pixels of one or several cells of the height map.
    pub(super) fn image(&self, field: &Field) -> Result<Backing, PictureError> {
        let cell = self.height.cell_size;
        let longest = (field.east.end - field.east.start).max(field.north.end - field.north.start);
        let cells = (longest / cell / MOST_PIXELS as f64).ceil().max(1.0);
        let side = cells * cell;
        let below = |along: f64, edge: f64| edge + ((along - edge) / side).floor() * side;
        let west = below(field.east.start, self.height.west);
        let south = below(field.north.start, self.height.south);
        let columns = ((field.east.end - west) / side).ceil().max(1.0) as u32;
        let rows = ((field.north.end - south) / side).ceil().max(1.0) as u32;
        let mut pixels = Vec::with_capacity(3 * columns as usize * rows as usize);
        for row in (0..rows).rev() {
            let north = south + (f64::from(row) + 0.5) * side;
            for column in 0..columns {
                let east = west + (f64::from(column) + 0.5) * side;
                let RGBColor(red, green, blue) = self.color([east, north], side);
                pixels.extend([red, green, blue]);
            }
        }
        let image = Image {
            pixels: &pixels,
            count: (columns, rows),
            corner: field.on_sheet([west, south + f64::from(rows) * side]),
            pixel: side * field.px_per_m,
        };
        Backing::of(&image, field.extent())
    }

    /// Least flow height that is shown [m].
    pub(super) fn least(&self) -> f64 {
        LEAST * self.scale.top
    }

    fn color(&self, [east, north]: [f64; 2], side: f64) -> RGBColor {
        let shade = self.shade([east, north], side);
        let grey = (shade * GREYS).round() / GREYS;
        let ground = 70.0 + 178.0 * grey;
        let flow = self.flow.map(|flow| flow.at_cell(east, north));
        let Some(flow) = flow.filter(|flow| *flow >= self.least()) else {
            return RGBColor(ground as u8, ground as u8, ground as u8);
        };
        let step = self.scale.top / COLORS;
        let RGBColor(red, green, blue) = self.scale.color((flow / step).ceil() * step);
        let over = |channel: u8| (OPACITY * f64::from(channel) + (1.0 - OPACITY) * ground) as u8;
        RGBColor(over(red), over(green), over(blue))
    }

    /// Share of the light that the ground takes in at a place, 0..1.
    fn shade(&self, [east, north]: [f64; 2], side: f64) -> f64 {
        let height = |along: f64, across: f64| self.height.nearest(east + along, north + across);
        let slope_east = (height(side, 0.0) - height(-side, 0.0)) / (2.0 * side);
        let slope_north = (height(0.0, side) - height(0.0, -side)) / (2.0 * side);
        let [to_east, to_north, up] = LIGHT;
        let towards = up - slope_east * to_east - slope_north * to_north;
        (towards / (1.0 + slope_east.powi(2) + slope_north.powi(2)).sqrt()).clamp(0.0, 1.0)
    }
}
