//! Displacement, speed and submergence of the bodies against time (the first two are
//! the source paper's figure 7).

mod line;
mod notes;
mod numbers;
mod panel;
mod table;
mod track;

use super::canvas::{Area, FAINT_INK, INK, PictureError, bold, paint, px, text};
use super::format::title;
use super::style::Styles;
use panel::{Place, TIME_AXIS};
use scree_solver::record::{Outcome, Sample};
use scree_solver::scenario::Scenario;
use table::Table;
use track::Quantity;

/// Width of the picture [px].
const WIDTH: f64 = 840.0;
/// Height of one panel without the time axis [px].
const PANEL: f64 = 238.0;
/// Height of title and subtitle [px].
const HEADER: f64 = 50.0;
/// Right of the panels [px]; with a column of numbers.
const MARGIN: f64 = 22.0;
const NUMBERS_MARGIN: f64 = 48.0;

/// Net horizontal displacement [m] and speed [m/s] of every free body's centre and, if
/// there is a flow, the submerged share of its height, against time [s],
/// in panels over one time axis. Onset, peak and rest of a body alone are marked and written at its
/// curves; those of several are in a table, and a number names each curve. Returns an SVG
/// document.
///
/// Values come from `outcome`, curves from `samples`; either may be empty.
///
/// # Errors
/// The drawing library fails.
pub fn motion(
    scenario: &Scenario,
    samples: &[Sample],
    outcome: &Outcome,
) -> Result<String, PictureError> {
    let styles = Styles::of(scenario, samples);
    let tracks = track::of_free_bodies(scenario, samples, outcome, &styles);
    let table = Table::of(&tracks);
    let top = HEADER + table.height();
    let last = samples.last().map_or(0.0, |sample| sample.time_s);
    // An axis needs a length, even for a run of duration 0.
    let ends = [last, scenario.duration_s, 1.0];
    let end_s = ends.into_iter().find(|end| *end > 0.0).unwrap_or(1.0);
    let shown = Quantity::of(scenario);
    let numbered = styles.are_numbered();
    let place = |row: usize| {
        let has_time_axis = row + 1 == shown.len();
        let time_axis = if has_time_axis { TIME_AXIS } else { 0.0 };
        Place {
            top: top + PANEL * row as f64,
            size: (WIDTH, PANEL + time_axis),
            margin: if numbered { NUMBERS_MARGIN } else { MARGIN },
            end_s,
            has_time_axis,
        }
    };
    let height = top + PANEL * shown.len() as f64 + TIME_AXIS + 4.0;
    paint((WIDTH, height), |sheet| {
        draw_header(sheet, scenario)?;
        table.draw(sheet, HEADER)?;
        for (row, quantity) in shown.iter().enumerate() {
            panel::draw(sheet, place(row), *quantity, &tracks, numbered)?;
        }
        Ok(())
    })
}

fn draw_header(sheet: &Area<'_>, scenario: &Scenario) -> Result<(), PictureError> {
    let left = px(16.0);
    let headline = title(&scenario.title, "Untitled scenario");
    sheet.draw_text(&headline, &bold(15.0, &INK), (left, px(12.0)))?;
    let subtitle = if scenario.flow.is_some() {
        "Net horizontal displacement and speed of each body's centre, and how deep it is in the flow"
    } else {
        "Net horizontal displacement and speed of each body's centre"
    };
    sheet.draw_text(subtitle, &text(12.0, &FAINT_INK), (left, px(33.0)))?;
    Ok(())
}
