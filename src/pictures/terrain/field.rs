//! The field of the picture: the part of the terrain it shows, with coordinates at its edges.

use super::{HEADER, LEFT, RIGHT, TALLEST, WIDTH};
use crate::pictures::canvas::{Area, FAINT_INK, INK, PictureError, px, text, width as stroke};
use crate::pictures::format::round_up;
use crate::pictures::labels::{Extent, Point};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use scree_solver::raster::Raster;
use std::ops::Range;

/// Margin round what is to be seen, as a share of its extent.
const MARGIN: f64 = 0.12;
/// Least cells of the height map along each side.
const FEWEST_CELLS: f64 = 12.0;
/// Most that one side is longer than the other.
const LONGEST: f64 = 3.0;
/// Steps on a track that can't be seen [px].
const SMALL_STEP: f64 = 0.5;

/// A rectangle of the sheet that shows a part of the terrain.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    /// Eastings shown [m].
    pub east: Range<f64>,
    /// Northings shown [m].
    pub north: Range<f64>,
    /// Upper left corner on the sheet [px].
    pub corner: Point,
    /// Width and height on the sheet [px].
    pub size: (f64, f64),
    pub px_per_m: f64,
}

impl Field {
    /// The field that shows these places of a height map; all of it if there are none.
    pub(super) fn showing(places: &[[f64; 2]], height: &Raster) -> Self {
        let whole = [height.west..height.east(), height.south..height.north()];
        let mut shown = [0, 1].map(|axis| {
            let along = places.iter().map(|place| place[axis]);
            let along = along.filter(|along| along.is_finite());
            let low = along.clone().reduce(f64::min).unwrap_or(whole[axis].start);
            let high = along.reduce(f64::max).unwrap_or(whole[axis].end);
            let beyond = MARGIN * (high - low);
            low - beyond..high + beyond
        });
        let longest = length(&shown[0]).max(length(&shown[1]));
        let least = (longest / LONGEST).max(FEWEST_CELLS * height.cell_size);
        for (shown, whole) in shown.iter_mut().zip(&whole) {
            let beyond = 0.5 * (least - length(shown)).max(0.0);
            *shown = (shown.start - beyond).max(whole.start)..(shown.end + beyond).min(whole.end);
        }
        let [east, north] = shown;
        let room = WIDTH - LEFT - RIGHT;
        let px_per_m = (room / length(&east)).min(TALLEST / length(&north));
        let size = (length(&east) * px_per_m, length(&north) * px_per_m);
        Self {
            corner: (LEFT + 0.5 * (room - size.0), HEADER),
            size,
            px_per_m,
            east,
            north,
        }
    }

    /// Place on the sheet [px] of an easting and a northing [m].
    pub(super) fn on_sheet(&self, [east, north]: [f64; 2]) -> Point {
        (
            self.corner.0 + (east - self.east.start) * self.px_per_m,
            self.corner.1 + (self.north.end - north) * self.px_per_m,
        )
    }

    /// Its extent on the sheet.
    pub(super) fn extent(&self) -> Extent {
        Extent {
            left: self.corner.0,
            top: self.corner.1,
            right: self.corner.0 + self.size.0,
            bottom: self.corner.1 + self.size.1,
        }
    }

    /// Draws its edge, coordinates at round values, and what they are.
    pub(super) fn draw_axes(
        &self,
        sheet: &Area<'_>,
        epsg: Option<u32>,
    ) -> Result<(), PictureError> {
        let Extent {
            left,
            top,
            right,
            bottom,
        } = self.extent();
        let edge = [
            (left, top),
            (right, top),
            (right, bottom),
            (left, bottom),
            (left, top),
        ];
        let edge = edge.map(|(x, y)| (px(x), px(y)));
        sheet.draw(&PathElement::new(edge, INK.stroke_width(stroke(0.9))))?;
        let tick = FAINT_INK.stroke_width(stroke(0.8));
        let below = text(10.5, &INK).pos(Pos::new(HPos::Center, VPos::Top));
        for (value, label) in coordinates(&self.east, (self.size.0 / 95.0) as usize) {
            let x = px(self.on_sheet([value, self.north.start]).0);
            sheet.draw(&PathElement::new(
                [(x, px(bottom)), (x, px(bottom + 4.0))],
                tick,
            ))?;
            sheet.draw_text(&label, &below, (x, px(bottom + 6.0)))?;
        }
        let beside = text(10.5, &INK).pos(Pos::new(HPos::Right, VPos::Center));
        for (value, label) in coordinates(&self.north, (self.size.1 / 60.0) as usize) {
            let y = px(self.on_sheet([self.east.start, value]).1);
            sheet.draw(&PathElement::new(
                [(px(left - 4.0), y), (px(left), y)],
                tick,
            ))?;
            sheet.draw_text(&label, &beside, (px(left - 6.0), y))?;
        }
        let system = epsg.map_or(String::new(), |epsg| format!(", EPSG:{epsg}"));
        let title = format!("easting and northing [m]{system}; north is up");
        let middle = (px(0.5 * (left + right)), px(bottom + 21.0));
        sheet.draw_text(
            &title,
            &text(11.5, &INK).pos(Pos::new(HPos::Center, VPos::Top)),
            middle,
        )?;
        Ok(())
    }

    /// Draws a bar of a round length into the lower left corner.
    pub(super) fn draw_scale_bar(&self, sheet: &Area<'_>) -> Result<(), PictureError> {
        let length_m = round_up(0.12 * length(&self.east));
        let Extent { left, bottom, .. } = self.extent();
        let (from, to) = (left + 14.0, left + 14.0 + length_m * self.px_per_m);
        let label = format!("{} m", whole_or_parts(length_m, length_m));
        let back = [
            (px(from - 7.0), px(bottom - 34.0)),
            (px(to + 7.0), px(bottom - 7.0)),
        ];
        sheet.draw(&Rectangle::new(back, WHITE.mix(0.75).filled()))?;
        let bar = [(px(from), px(bottom - 17.0)), (px(to), px(bottom - 13.0))];
        sheet.draw(&Rectangle::new(bar, INK.filled()))?;
        let above = text(10.5, &INK).pos(Pos::new(HPos::Center, VPos::Bottom));
        sheet.draw_text(&label, &above, (px(0.5 * (from + to)), px(bottom - 19.0)))?;
        Ok(())
    }
}

/// Places of the cells that have at least this value [m].
pub(super) fn places_with(raster: &Raster, least: f64) -> impl Iterator<Item = [f64; 2]> {
    let valued = raster.values.iter().enumerate();
    let valued = valued.filter(move |(_, value)| **value >= least);
    valued.map(|(index, _)| raster.centre(index % raster.columns, index / raster.columns))
}

/// A track on the sheet without steps that can't be seen.
pub(super) fn without_small_steps(track: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::new();
    for at in track.filter(|(x, y)| x.is_finite() && y.is_finite()) {
        let far = |last: &Point| (at.0 - last.0).hypot(at.1 - last.1) >= SMALL_STEP;
        if kept.last().is_none_or(far) {
            kept.push(at);
        }
    }
    kept
}

/// About `count` round values in a range, with their labels.
fn coordinates(range: &Range<f64>, count: usize) -> Vec<(f64, String)> {
    let step = round_up(length(range) / (count.max(2) as f64));
    let first = (range.start / step).ceil();
    let values = (0..=2 * count.max(2)).map(|place| (first + place as f64) * step);
    let values = values.take_while(|value| *value <= range.end);
    values
        .map(|value| (value, whole_or_parts(value, step)))
        .collect()
}

/// A number with as many decimals as its step has.
fn whole_or_parts(value: f64, step: f64) -> String {
    let decimals = (1.0 - step.log10().floor()).clamp(0.0, 6.0) as usize;
    let text = format!("{value:.decimals$}");
    if !text.contains('.') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn length(range: &Range<f64>) -> f64 {
    range.end - range.start
}
