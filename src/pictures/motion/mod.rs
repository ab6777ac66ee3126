//! Displacement, speed and submergence of the bodies against time (the first two are
//! the source paper's figure 7).

mod track;

use super::canvas::{
    Area, FAINT_INK, HAIRLINE, INK, PictureError, Plane, bold, paint, px, text, width as stroke,
};
use super::format::{round_up, title};
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use scree_solver::record::{Outcome, Sample};
use scree_solver::scenario::Scenario;
use track::{Note, Placement, Quantity, Track};

/// Width of the picture [px].
const WIDTH: f64 = 840.0;
/// Height of one panel with its axis [px].
const PANEL: f64 = 268.0;
/// Height of title and subtitle [px].
const HEADER: f64 = 54.0;
/// Height of one line of the list of bodies [px].
const LINE: f64 = 17.0;
/// Largest number of bodies described in words above the panels; more are only drawn.
const LISTED: usize = 8;

/// Net horizontal displacement [m] and speed [m/s] of every free body's centre and, if
/// there is a flow, the submerged share of its height, against time [s],
/// in panels over one time axis, with onset, peak and rest marked and their values
/// written out. Returns an SVG document.
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
    let tracks = track::of_free_bodies(scenario, samples, outcome);
    let listed = list_of_bodies(&tracks);
    let top = HEADER + LINE * listed.len() as f64;
    let last = samples.last().map_or(0.0, |sample| sample.time_s);
    // An axis needs a length, even for a run of duration 0.
    let ends = [last, scenario.duration_s, 1.0];
    let end_s = ends.into_iter().find(|end| *end > 0.0).unwrap_or(1.0);
    let shown = Quantity::of(scenario);
    paint((WIDTH, top + PANEL * shown.len() as f64), |sheet| {
        draw_header(sheet, scenario, &listed)?;
        for (row, quantity) in shown.into_iter().enumerate() {
            let upper = px(top + PANEL * row as f64);
            let area = sheet.clone().shrink((0, upper), (px(WIDTH), px(PANEL)));
            draw_panel(&area, quantity, &tracks, end_s)?;
        }
        Ok(())
    })
}

/// One line per body; none if there is only one, whose values are written at its curve.
fn list_of_bodies(tracks: &[Track<'_>]) -> Vec<(String, RGBColor)> {
    if tracks.len() < 2 {
        return Vec::new();
    }
    let listed = tracks.iter().take(LISTED);
    let mut lines: Vec<_> = listed.map(|t| (t.in_words(), t.color)).collect();
    if tracks.len() > LISTED {
        lines.push((format!("and {} more", tracks.len() - LISTED), FAINT_INK));
    }
    lines
}

fn draw_header(
    sheet: &Area<'_>,
    scenario: &Scenario,
    listed: &[(String, RGBColor)],
) -> Result<(), PictureError> {
    let left = px(16.0);
    let headline = title(&scenario.title, "Untitled scenario");
    sheet.draw_text(&headline, &bold(15.0, &INK), (left, px(12.0)))?;
    let subtitle = if scenario.flow.is_some() {
        "Net horizontal displacement and speed of each body's centre, and how deep it is in the flow"
    } else {
        "Net horizontal displacement and speed of each body's centre"
    };
    sheet.draw_text(subtitle, &text(12.0, &FAINT_INK), (left, px(33.0)))?;
    for (row, (line, color)) in listed.iter().enumerate() {
        let y = HEADER + LINE * row as f64;
        let bullet = Circle::new((px(21.0), px(y + 5.0)), stroke(4.0), color.filled());
        sheet.draw(&bullet)?;
        sheet.draw_text(line, &text(11.5, &INK), (px(32.0), px(y)))?;
    }
    Ok(())
}

fn draw_panel(
    area: &Area<'_>,
    quantity: Quantity,
    tracks: &[Track<'_>],
    end_s: f64,
) -> Result<(), PictureError> {
    let largest = (tracks.iter().map(|t| t.largest(quantity))).fold(0.0, f64::max);
    let top = match quantity {
        // Space for the texts above the curves.
        Quantity::Displacement | Quantity::Speed => round_up(largest * 1.12),
        Quantity::Submergence => 1.0,
    };
    let mut panel = ChartBuilder::on(area)
        .margin_top(px(8.0))
        .margin_right(px(22.0))
        .margin_left(px(10.0))
        .set_label_area_size(LabelAreaPosition::Left, px(58.0))
        .set_label_area_size(LabelAreaPosition::Bottom, px(44.0))
        .build_cartesian_2d(0.0..end_s, 0.0..top)?;
    panel
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(HAIRLINE.stroke_width(stroke(0.8)))
        .axis_style(INK.stroke_width(stroke(0.9)))
        .x_labels(9)
        .y_labels(6)
        .label_style(text(11.0, &INK))
        .axis_desc_style(text(12.0, &INK))
        .set_all_tick_mark_size(px(4.0))
        .x_desc("time [s]")
        .y_desc(quantity.axis_title())
        .draw()?;
    for track in tracks {
        let line = track.curve(quantity).iter().copied();
        panel.draw_series(LineSeries::new(line, track.color.stroke_width(stroke(1.8))))?;
    }
    for track in tracks {
        for note in track.notes(quantity) {
            draw_note(
                panel.plotting_area(),
                &note,
                track.color,
                (end_s, top),
                tracks.len() == 1,
            )?;
        }
    }
    Ok(())
}

/// Draws a dot on the curve, with its text near it if there is only one body.
fn draw_note(
    plane: &Plane<'_>,
    note: &Note,
    color: RGBColor,
    (end_s, top): (f64, f64),
    with_text: bool,
) -> Result<(), PictureError> {
    if with_text {
        draw_note_text(plane, note, (end_s, top))?;
    }
    plane.draw(&Circle::new(note.at, stroke(4.6), WHITE.filled()))?;
    plane.draw(&Circle::new(note.at, stroke(3.4), color.filled()))?;
    Ok(())
}

fn draw_note_text(
    plane: &Plane<'_>,
    note: &Note,
    (end_s, top): (f64, f64),
) -> Result<(), PictureError> {
    let (aside, above, vertical) = match note.placement {
        Placement::Above | Placement::Beyond => (0.0, 9.0, VPos::Bottom),
        Placement::Head => (7.0, 0.0, VPos::Top),
    };
    let mut anchor = note.at;
    if note.placement == Placement::Head {
        anchor.1 = top;
        let line = [note.at, anchor].into_iter();
        let style = FAINT_INK.stroke_width(stroke(0.9));
        plane.draw(&DashedPathElement::new(line, px(4.0), px(3.0), style))?;
    }
    // Placed on the side with more space, or away from the curve.
    let room = match note.placement {
        Placement::Above | Placement::Head => 0.62,
        Placement::Beyond => 0.8,
    };
    let rightwards = note.at.0 < room * end_s;
    let (side, aside) = if rightwards {
        (HPos::Left, aside)
    } else {
        (HPos::Right, -aside)
    };
    let (x, y) = plane.map_coordinate(&anchor);
    let base = plane.get_base_pixel();
    let at = (x + px(aside) - base.0, y - px(above) - base.1);
    let style = text(11.5, &INK).pos(Pos::new(side, vertical));
    plane
        .strip_coord_spec()
        .draw(&Text::new(note.text.as_str(), at, style))?;
    Ok(())
}
