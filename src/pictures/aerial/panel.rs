//! One panel of the aerial view.

use super::instants::Instant;
use super::layout::{AXIS, LEFT, Layout};
use super::{HAIRLINE, bodies, draw_numbered, stroke};
use crate::pictures::canvas::{Area, FAINT_INK, INK, PictureError, Plane, bold, px, text};
use crate::pictures::format::{significant, tick};
use crate::pictures::labels::{Extent, Grid, Point};
use crate::pictures::palette::ColorScale;
use crate::pictures::style::Styles;
use crate::pictures::surface;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use scree_solver::record::{FlowSnapshot, Sample};
use scree_solver::scenario::Scenario;
use scree_solver::shape::SpheroPolyhedron;
use std::ops::Range;

/// Background of the inclined part; the floor stays white.
const INCLINE: RGBColor = RGBColor(240, 241, 243);
/// Radius of a dot in sides of its square: neighbours overlap a little.
const DOT_RADIUS_BINS: f64 = 0.85;

/// Scene, common to all panels.
#[derive(Debug)]
pub(super) struct Scene<'a> {
    pub scenario: &'a Scenario,
    samples: &'a [Sample],
    shapes: Vec<SpheroPolyhedron>,
    pub styles: Styles,
}

impl<'a> Scene<'a> {
    pub(super) fn new(scenario: &'a Scenario, samples: &'a [Sample]) -> Self {
        let bodies = 0..scenario.bodies.len();
        Self {
            scenario,
            samples,
            shapes: bodies.map(|body| scenario.shape_of(body)).collect(),
            styles: Styles::of(scenario, samples),
        }
    }

    /// Part of the channel [m] in which flow or bodies are at any time, with the foot
    /// of the incline and a margin.
    pub(super) fn extent(&self, instants: &[Instant<'_>]) -> Range<f64> {
        let [whole, across] = self.scenario.extents();
        let flow = instants
            .iter()
            .filter_map(|i| i.snapshot)
            .flat_map(|s| &s.position_m);
        let flow = flow.map(|position| f64::from(position[0]));
        let bodies = self
            .samples
            .iter()
            .flat_map(|sample| self.body_extents(sample));
        let seen = |x: &f64| x.is_finite() && *x >= whole.start && *x <= whole.end;
        // The foot of a channel's incline is always seen.
        let foot = self.scenario.channel().map(|_| 0.0);
        let seen = || flow.clone().chain(bodies.clone()).chain(foot).filter(seen);
        let low = seen().reduce(f64::min).unwrap_or(whole.start);
        let high = seen().reduce(f64::max).unwrap_or(whole.end);
        // Never narrower than a few channel widths, to show the surroundings.
        let width: f64 = across.end - across.start;
        let least = (3.0 * width).min(whole.end - whole.start);
        let margin = (0.03 * (high - low)).max((least - (high - low)) / 2.0);
        let beyond = 0.01 * (whole.end - whole.start);
        (low - margin).max(whole.start - beyond)..(high + margin).min(whole.end + beyond)
    }

    /// Width of the narrowest of several bodies [m]; none if none has a number.
    pub(super) fn narrowest_numbered_m(&self) -> Option<f64> {
        let widths = self
            .shapes
            .iter()
            .map(|shape| 2.0 * shape.inscribed_radius());
        let numbered = self.styles.are_numbered();
        widths.filter(|_| numbered).min_by(f64::total_cmp)
    }

    /// Extents of bodies at both sides of their centres.
    fn body_extents(&self, sample: &'a Sample) -> impl Iterator<Item = f64> + Clone {
        let bodies = self.shapes.iter().zip(&sample.bodies);
        bodies.flat_map(|(shape, state)| {
            let reach = shape.bounding_radius();
            [state.position_m[0] - reach, state.position_m[0] + reach]
        })
    }

    /// Draws the panel of this index into the sheet.
    pub(super) fn draw(
        &self,
        sheet: &Area<'_>,
        layout: &Layout,
        index: usize,
        instant: &Instant<'_>,
        (speeds, bin_m): (&ColorScale, f64),
    ) -> Result<(), PictureError> {
        self.draw_caption(sheet, layout, index, instant)?;
        let plane = axes(sheet, layout, index)?;
        self.draw_ground(&plane, layout)?;
        if let Some(snapshot) = instant.snapshot {
            let [_, across] = self.scenario.extents();
            draw_flow(&plane, layout, snapshot, (speeds, bin_m), &across)?;
        }
        self.draw_channel(&plane, layout)?;
        if let Some(sample) = instant.sample {
            let field = layout.field(index);
            let on_sheet = |x: f64, y: f64| layout.on_sheet(index, (x, y));
            self.draw_bodies(sheet, field, sample, on_sheet)?;
        }
        Ok(())
    }

    fn draw_caption(
        &self,
        sheet: &Area<'_>,
        layout: &Layout,
        index: usize,
        instant: &Instant<'_>,
    ) -> Result<(), PictureError> {
        let (left, top) = layout.corner(index);
        let base = top - 4.0;
        let time = format!("t = {:.2} s", instant.time_s);
        let style = bold(11.5, &INK).pos(Pos::new(HPos::Left, VPos::Bottom));
        sheet.draw_text(&time, &style, (px(left), px(base)))?;
        let channel = self.scenario.channel();
        let degrees = channel.map_or(0.0, |channel| channel.inclination_deg);
        if index > 0 || degrees <= 0.0 {
            return Ok(());
        }
        let foot = left - layout.x.start * layout.px_per_m;
        let style = text(11.0, &FAINT_INK).pos(Pos::new(HPos::Center, VPos::Bottom));
        // Clear of the time to its left.
        let at = (px(foot.max(left + 150.0)), px(base));
        let label = format!("foot of the {}° incline", significant(degrees, 2));
        sheet.draw_text(&label, &style, at)?;
        Ok(())
    }

    fn draw_ground(&self, plane: &Plane<'_>, layout: &Layout) -> Result<(), PictureError> {
        let Some(channel) = self.scenario.channel() else {
            return Ok(());
        };
        let half = channel.width_m / 2.0;
        let from = (-channel.incline_length_m).max(layout.x.start);
        if channel.inclination_deg > 0.0 && from < 0.0 {
            let ground = [(from, -half), (0.0, half)];
            plane.draw(&Rectangle::new(ground, INCLINE.filled()))?;
        }
        Ok(())
    }

    /// Draws the side walls, the back wall, the open end and the foot of the incline.
    fn draw_channel(&self, plane: &Plane<'_>, layout: &Layout) -> Result<(), PictureError> {
        let Some(channel) = self.scenario.channel() else {
            return Ok(());
        };
        let half = channel.width_m / 2.0;
        let back = -channel.incline_length_m;
        let (from, to) = (
            back.max(layout.x.start),
            channel.runout_length_m.min(layout.x.end),
        );
        let wall = INK.stroke_width(stroke(1.2));
        for y in [-half, half] {
            plane.draw(&PathElement::new([(from, y), (to, y)], wall))?;
        }
        if back >= layout.x.start {
            plane.draw(&PathElement::new([(back, -half), (back, half)], wall))?;
        }
        let dashed = |x: f64, color: RGBColor| {
            let line = [(x, -half), (x, half)];
            let style = color.stroke_width(stroke(1.0));
            DashedPathElement::new(line, px(4.0), px(3.0), style)
        };
        if channel.runout_length_m <= layout.x.end {
            plane.draw(&dashed(channel.runout_length_m, FAINT_INK))?;
        }
        if channel.inclination_deg > 0.0 {
            plane.draw(&dashed(0.0, INK))?;
        }
        Ok(())
    }

    fn draw_bodies(
        &self,
        sheet: &Area<'_>,
        field: Extent,
        sample: usize,
        on_sheet: impl Fn(f64, f64) -> Point,
    ) -> Result<(), PictureError> {
        let states = &self.samples[sample].bodies;
        let seen = bodies::from_above(&self.shapes, states, &self.styles, &on_sheet);
        let mut grid = Grid::over(field);
        for body in &seen {
            let trail = self.trail(body.index, sample, &on_sheet);
            if !body.style.is_grey() {
                bodies::draw_trail(sheet, &trail, body.style)?;
                grid.trace(&trail, body.index);
            }
        }
        draw_numbered(sheet, &seen, grid, &self.styles)
    }

    /// The path of a body's centre so far.
    fn trail(&self, body: usize, last: usize, on_sheet: impl Fn(f64, f64) -> Point) -> Vec<Point> {
        let states = self.samples[..=last]
            .iter()
            .filter_map(|sample| sample.bodies.get(body));
        let way = states.map(|state| (state.position_m[0], state.position_m[1]));
        let mut way: Vec<Point> = way.filter(|p| (p.0 + p.1).is_finite()).collect();
        way.dedup();
        way.into_iter().map(|(x, y)| on_sheet(x, y)).collect()
    }
}

/// The panel's axes, with numbers only at the outer panels.
fn axes<'a>(sheet: &Area<'a>, layout: &Layout, index: usize) -> Result<Plane<'a>, PictureError> {
    let ((x, y), (width, height)) = (layout.corner(index), layout.strip());
    let left = if layout.is_first_of_row(index) {
        LEFT - 20.0
    } else {
        0.0
    };
    let below = if layout.is_last_of_column(index) {
        AXIS - 16.0
    } else {
        0.0
    };
    let corner = (px(x - left), px(y));
    let area = sheet
        .clone()
        .shrink(corner, (px(width + left), px(height + below)));
    let mut panel = ChartBuilder::on(&area)
        .set_label_area_size(LabelAreaPosition::Left, px(left))
        .set_label_area_size(LabelAreaPosition::Bottom, px(below))
        .build_cartesian_2d(layout.x.clone(), layout.y.clone())?;
    let numbers_across = ((height / 22.0) as usize).clamp(2, 7);
    let numbers_along = ((width / 75.0) as usize).clamp(2, 12);
    panel
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(HAIRLINE.stroke_width(stroke(0.6)))
        .axis_style(TRANSPARENT)
        .x_labels(numbers_along)
        .y_labels(numbers_across)
        .set_all_tick_mark_size(px(3.0))
        .x_label_formatter(&|x| tick(*x, layout.x.end - layout.x.start))
        .y_label_formatter(&|y| tick(*y, layout.y.end - layout.y.start))
        .label_style(text(10.5, &INK))
        .draw()?;
    Ok(panel.plotting_area().clone())
}

fn draw_flow(
    plane: &Plane<'_>,
    layout: &Layout,
    snapshot: &FlowSnapshot,
    (speeds, bin_m): (&ColorScale, f64),
    across: &Range<f64>,
) -> Result<(), PictureError> {
    let radius_m = DOT_RADIUS_BINS * bin_m;
    let radius = stroke(radius_m * layout.px_per_m);
    // A dot stands for a square, which ends at the wall.
    let inside = 0.5 * (across.end - across.start - 2.0 * radius_m).max(0.0);
    let middle = 0.5 * (across.start + across.end);
    for dot in surface::seen_from_above(snapshot, &layout.x, bin_m) {
        let color = speeds.color(dot.speed_m_s);
        let at = (dot.at[0], dot.at[1].clamp(middle - inside, middle + inside));
        plane.draw(&Circle::new(at, radius, color.filled()))?;
    }
    Ok(())
}
