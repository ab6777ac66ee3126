//! Flow and bodies seen from above (the source paper's figure 6).

pub(super) mod bodies;
mod instants;
mod layout;
mod numbers;
mod panel;

use super::canvas::width as stroke;
use super::canvas::{Area, FAINT_INK, HAIRLINE, INK, PictureError, bold, paint, px, text};
use super::format::{plain, title};
use super::labels::Grid;
use super::palette::ColorScale;
use super::style::Styles;
use super::surface;
use bodies::SeenBody;
pub use instants::shown_instants;
use layout::Layout;
use panel::Scene;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use scree_solver::record::{FlowSnapshot, Sample};
use scree_solver::scenario::Scenario;

/// Dots in the whole picture: enough to see the flow, few enough for a page.
const DOT_BUDGET: usize = 7_500;
/// Smallest side of the squares, each of which is shown as one dot [px].
const FINEST_BIN_PX: f64 = 2.6;
/// Largest side for a coarse flow [px]: larger dots would hide detail.
const COARSEST_BIN_PX: f64 = 12.0;
/// Mean number of points in a square: with fewer, many squares of a
/// coarse flow stay empty and the background shows through.
const POINTS_PER_DOT: usize = 2;
/// Size of the colour bar [px].
const BAR: (f64, f64) = (180.0, 9.0);

/// Flow and bodies seen from above at about six instants: the flow's surface as
/// dots coloured by speed [m/s], each body's outline and the trail of its
/// centre, the channel and the foot of the incline, x downstream and y across
/// [m] on equal scales. Returns an SVG document.
///
/// The instants are those of `snapshots`, or of `samples` if there is no flow;
/// of more than six, those that are spread most evenly over time and the bodies' travel.
///
/// # Panics
/// If the scenario was not made by the parser.
///
/// # Errors
/// The drawing library fails.
pub fn aerial_view(
    scenario: &Scenario,
    samples: &[Sample],
    snapshots: &[FlowSnapshot],
) -> Result<String, PictureError> {
    let instants = instants::choose(samples, snapshots);
    let shown: Vec<_> = instants.iter().filter_map(|i| i.snapshot).collect();
    let speeds = ColorScale::covering(&shown);
    let scene = Scene::new(scenario, samples);
    let layout = Layout::of(&scene, &instants);
    let bin_m = bin_within_budget(&layout, &shown);
    paint((layout::WIDTH, layout.height()), |sheet| {
        draw_header(sheet, scenario, &scene.styles)?;
        if !shown.is_empty() {
            draw_color_bar(sheet, "speed of the flow [m/s]", &speeds)?;
        }
        for (index, instant) in instants.iter().enumerate() {
            scene.draw(sheet, &layout, index, instant, (&speeds, bin_m))?;
        }
        draw_axis_titles(sheet, &layout)?;
        match scene.styles.meaning_of_grey() {
            Some(meaning) => draw_footnote(sheet, &layout, meaning),
            None => Ok(()),
        }
    })
}

/// The smallest squares [m] for which the picture stays within its number of dots and the
/// points are dense enough to leave no gaps.
fn bin_within_budget(layout: &Layout, shown: &[&FlowSnapshot]) -> f64 {
    let points: usize = shown.iter().map(|snapshot| snapshot.position_m.len()).sum();
    let most = DOT_BUDGET.min(points / POINTS_PER_DOT);
    let dots = |bin_m: f64| -> usize {
        let visible = |s: &&FlowSnapshot| surface::seen_from_above(s, &layout.x, bin_m).len();
        shown.iter().map(visible).sum()
    };
    let mut bin_px = FINEST_BIN_PX;
    while bin_px < COARSEST_BIN_PX && dots(bin_px / layout.px_per_m) > most {
        bin_px *= 1.1;
    }
    bin_px / layout.px_per_m
}

fn draw_header(sheet: &Area<'_>, scenario: &Scenario, styles: &Styles) -> Result<(), PictureError> {
    let left = px(16.0);
    let headline = title(&scenario.title, "Untitled scenario");
    sheet.draw_text(&headline, &bold(15.0, &INK), (left, px(12.0)))?;
    let subtitle = if styles.are_numbered() {
        "Seen from above: flow, bodies with their numbers, and trails"
    } else {
        "Seen from above: surface of the flow, bodies and their trails"
    };
    sheet.draw_text(subtitle, &text(12.0, &FAINT_INK), (left, px(33.0)))?;
    Ok(())
}

/// Draws a line in the lower right corner.
fn draw_footnote(sheet: &Area<'_>, layout: &Layout, line: &str) -> Result<(), PictureError> {
    let style = text(11.0, &FAINT_INK).pos(Pos::new(HPos::Right, VPos::Bottom));
    let at = (layout::WIDTH - layout::RIGHT, layout.height() - 6.0);
    sheet.draw_text(line, &style, (px(at.0), px(at.1)))?;
    Ok(())
}

/// Draws bodies over their trails, which the grid has already, and their numbers if they have any.
pub(super) fn draw_numbered(
    sheet: &Area<'_>,
    seen: &[SeenBody],
    mut grid: Grid,
    styles: &Styles,
) -> Result<(), PictureError> {
    for body in seen {
        body.draw(sheet)?;
        grid.fill(&body.outline, body.index);
    }
    if !styles.are_numbered() {
        return Ok(());
    }
    let places = numbers::place(seen, &mut grid);
    places.iter().try_for_each(|number| number.draw(sheet))
}

/// Draws the scale of a quantity of this name, to the right of the subtitle.
pub(super) fn draw_color_bar(
    sheet: &Area<'_>,
    name: &str,
    scale: &ColorScale,
) -> Result<(), PictureError> {
    // The label at its end is wider than the tick above it.
    let left = layout::WIDTH - layout::RIGHT - BAR.0 - 8.0;
    let top = 38.0;
    let steps = 90;
    let step = BAR.0 / f64::from(steps);
    for index in 0..steps {
        let share = (f64::from(index) + 0.5) / f64::from(steps);
        let color = scale.color(share * scale.top);
        let from = (px(left + step * f64::from(index)), px(top));
        // Drawn to the end of the bar, and covered by those that follow: no gaps.
        let to = (px(left + BAR.0), px(top + BAR.1));
        sheet.draw(&Rectangle::new([from, to], color.filled()))?;
    }
    let beside = text(11.0, &INK).pos(Pos::new(HPos::Right, VPos::Center));
    let middle = px(top + BAR.1 / 2.0);
    sheet.draw_text(name, &beside, (px(left - 10.0), middle))?;
    for share in [0.0, 0.5, 1.0] {
        let capped = if share == 1.0 && scale.exceeded {
            "≥ "
        } else {
            ""
        };
        let label = format!("{capped}{}", plain(share * scale.top));
        let x = left + share * BAR.0;
        let tick = [(px(x), px(top + BAR.1)), (px(x), px(top + BAR.1 + 3.0))];
        sheet.draw(&PathElement::new(tick, FAINT_INK.stroke_width(stroke(0.8))))?;
        let below = text(10.5, &INK).pos(Pos::new(HPos::Center, VPos::Top));
        sheet.draw_text(&label, &below, (px(x), px(top + BAR.1 + 4.0)))?;
    }
    Ok(())
}

fn draw_axis_titles(sheet: &Area<'_>, layout: &Layout) -> Result<(), PictureError> {
    let (left, right) = layout.horizontal_extent();
    let below = text(12.0, &INK).pos(Pos::new(HPos::Center, VPos::Bottom));
    let bottom = px(layout.height() - 6.0);
    sheet.draw_text(
        "x downstream [m]",
        &below,
        (px((left + right) / 2.0), bottom),
    )?;
    let (top, foot) = layout.vertical_extent();
    let upright = text(12.0, &INK)
        .transform(FontTransform::Rotate270)
        .pos(Pos::new(HPos::Center, VPos::Top));
    sheet.draw_text("y across [m]", &upright, (px(8.0), px((top + foot) / 2.0)))?;
    Ok(())
}
