//! A run on a terrain seen from above: where the flow went, and where bodies came to rest.

mod backdrop;
mod field;
mod marks;

use super::aerial::{bodies, draw_color_bar, draw_numbered};
use super::canvas::{Area, FAINT_INK, INK, PictureError, bold, paint_over, px, text};
use super::format::title;
use super::labels::{Grid, Point};
use super::palette::ColorScale;
use super::style::Styles;
use crate::results::terrain::{FlowOutlines, released_areas};
use backdrop::Backdrop;
use field::Field;
use scree_solver::raster::Raster;
use scree_solver::record::{FlowMaps, MapQuantity, Sample};
use scree_solver::scenario::{Scenario, Terrain};

/// Width of the picture, and what is beside its field [px].
const WIDTH: f64 = 840.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 20.0;
/// Above and below the field [px].
const HEADER: f64 = 72.0;
const FOOTER: f64 = 66.0;
/// Most height of the field [px].
const TALLEST: f64 = 720.0;
/// Radius of the mark of a body that would be too small to be seen [px].
const SMALLEST_BODY: f64 = 4.0;
/// Corners of that mark.
const CORNERS: u32 = 12;

/// Maps of the flow that the picture shows.
#[derive(Debug)]
pub struct MapsSeen {
    /// Largest flow height [m].
    pub flow_height_max: Raster,
    /// Outlines of the flow.
    pub outlines: FlowOutlines,
}

impl MapsSeen {
    /// Those of a run.
    pub fn of(maps: &FlowMaps) -> Self {
        Self {
            flow_height_max: maps.raster(MapQuantity::FlowHeightMax),
            outlines: FlowOutlines::of(maps),
        }
    }
}

/// The terrain as a hillshade, the largest flow height in colour, outlines of releases and deposit,
/// and the bodies at the end with their tracks, north up, in the coordinates of the height map.
/// Returns an SVG document.
///
/// # Panics
/// If the scenario was not made by the parser, with its maps, or is in a channel.
///
/// # Errors
/// The drawing library fails.
pub fn terrain_view(
    scenario: &Scenario,
    samples: &[Sample],
    maps: Option<&MapsSeen>,
) -> Result<String, PictureError> {
    let terrain = scenario.terrain().expect("the scenario has a terrain");
    let view = View::of(scenario, terrain, samples, maps);
    let backdrop = view.backdrop.image(&view.field)?;
    paint_over((WIDTH, view.height()), &backdrop, |sheet| view.draw(sheet))
}

/// All that the picture shows.
struct View<'a> {
    scenario: &'a Scenario,
    terrain: &'a Terrain,
    samples: &'a [Sample],
    releases: Vec<Vec<Vec<[f64; 2]>>>,
    deposit: Vec<Vec<Vec<[f64; 2]>>>,
    backdrop: Backdrop<'a>,
    field: Field,
    styles: Styles,
}

impl<'a> View<'a> {
    fn of(
        scenario: &'a Scenario,
        terrain: &'a Terrain,
        samples: &'a [Sample],
        maps: Option<&'a MapsSeen>,
    ) -> Self {
        let releases = released_areas(scenario, terrain).concat();
        let origin = terrain.origin();
        let centres = samples.iter().flat_map(|sample| &sample.bodies);
        let centres =
            centres.map(|body| [origin.x + body.position_m[0], origin.y + body.position_m[1]]);
        let corners = releases.iter().flatten().flatten().copied();
        let backdrop = Backdrop {
            height: terrain.height(),
            flow: maps.map(|maps| &maps.flow_height_max),
            scale: ColorScale::of(maps.map_or(&[], |maps| &maps.flow_height_max.values)),
        };
        let least = backdrop.least();
        let flow = backdrop.flow.into_iter();
        let flow = flow.flat_map(|flow| field::places_with(flow, least));
        let seen: Vec<[f64; 2]> = centres.chain(corners).chain(flow).collect();
        Self {
            scenario,
            terrain,
            samples,
            releases,
            deposit: maps.map(|maps| maps.outlines.deposit()).unwrap_or_default(),
            backdrop,
            field: Field::showing(&seen, terrain.height()),
            styles: Styles::of(scenario, samples),
        }
    }

    fn height(&self) -> f64 {
        HEADER + self.field.size.1 + FOOTER
    }

    fn draw(&self, sheet: &Area<'_>) -> Result<(), PictureError> {
        self.draw_header(sheet)?;
        self.field.draw_axes(sheet, self.terrain.height().epsg)?;
        for ring in self.deposit.iter().flatten() {
            marks::draw_deposit(sheet, &self.on_sheet(ring))?;
        }
        for ring in self.releases.iter().flatten() {
            marks::draw_release(sheet, &self.on_sheet(ring))?;
        }
        self.draw_bodies(sheet)?;
        self.field.draw_scale_bar(sheet)?;
        let meaning = self.styles.meaning_of_grey();
        marks::draw_legend(sheet, self.height() - 12.0, meaning)
    }

    fn draw_header(&self, sheet: &Area<'_>) -> Result<(), PictureError> {
        let left = px(16.0);
        let headline = title(&self.scenario.title, "Untitled scenario");
        sheet.draw_text(&headline, &bold(15.0, &INK), (left, px(12.0)))?;
        let subtitle = "Seen from above: reach of the flow, bodies at the end";
        sheet.draw_text(subtitle, &text(12.0, &FAINT_INK), (left, px(33.0)))?;
        if self.backdrop.flow.is_none() {
            return Ok(());
        }
        draw_color_bar(sheet, "largest flow height [m]", &self.backdrop.scale)
    }

    fn on_sheet(&self, ring: &[[f64; 2]]) -> Vec<Point> {
        ring.iter()
            .map(|place| self.field.on_sheet(*place))
            .collect()
    }

    fn draw_bodies(&self, sheet: &Area<'_>) -> Result<(), PictureError> {
        let Some(last) = self.samples.last() else {
            return Ok(());
        };
        let origin = self.terrain.origin();
        let on_sheet = |x: f64, y: f64| self.field.on_sheet([origin.x + x, origin.y + y]);
        let bodies = 0..self.scenario.bodies.len();
        let shapes: Vec<_> = bodies.map(|body| self.scenario.shape_of(body)).collect();
        let mut seen = bodies::from_above(&shapes, &last.bodies, &self.styles, on_sheet);
        let mut grid = Grid::over(self.field.extent());
        for body in &mut seen {
            let track = self
                .samples
                .iter()
                .filter_map(|sample| sample.bodies.get(body.index));
            let track = track.map(|state| on_sheet(state.position_m[0], state.position_m[1]));
            let track = field::without_small_steps(track);
            bodies::draw_trail(sheet, &track, body.style)?;
            grid.trace(&track, body.index);
            let [x, y, _] = last.bodies[body.index].position_m;
            let radius = shapes[body.index].bounding_radius();
            if radius * self.field.px_per_m < SMALLEST_BODY {
                body.outline = circle(on_sheet(x, y));
            }
        }
        draw_numbered(sheet, &seen, grid, &self.styles)
    }
}

fn circle((x, y): Point) -> Vec<Point> {
    let corners = (0..CORNERS).map(|corner| {
        let (sine, cosine) =
            (std::f64::consts::TAU * f64::from(corner) / f64::from(CORNERS)).sin_cos();
        (x + SMALLEST_BODY * cosine, y + SMALLEST_BODY * sine)
    });
    corners.collect()
}

#[cfg(test)]
mod tests;
