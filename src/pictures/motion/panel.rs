//! One panel of the motion picture.

use super::line::{self, Line};
use super::notes::{self, PlacedNote};
use super::numbers::{self, Number};
use super::track::{Quantity, Track};
use crate::pictures::canvas::{
    Area, HAIRLINE, INK, PictureError, from_device, px, text, width as stroke,
};
use crate::pictures::format::{round_up, tick};
use crate::pictures::labels::{Extent, Grid};
use plotters::prelude::*;

/// Height of the time axis' numbers and title [px].
pub(super) const TIME_AXIS: f64 = 44.0;

/// Place of a panel in the picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Upper edge [px].
    pub top: f64,
    /// Size, with the time axis if it is here [px].
    pub size: (f64, f64),
    /// Right of the field [px].
    pub margin: f64,
    /// End of the time axis [s].
    pub end_s: f64,
    /// True if the time axis has its numbers and title here.
    pub has_time_axis: bool,
}

/// Places of the numbers of curves.
#[derive(Debug, Clone, Copy)]
enum Numbering {
    /// Right of the ends, which differ.
    AtEnds,
    /// In the curves where these differ, as most end alike.
    InCurves,
}

/// Draws axes, curves, and their numbers or notes.
pub(super) fn draw(
    sheet: &Area<'_>,
    place: Place,
    quantity: Quantity,
    tracks: &[Track<'_>],
    numbered: bool,
) -> Result<(), PictureError> {
    let largest = (tracks.iter().map(|t| t.largest(quantity))).fold(0.0, f64::max);
    let top = match quantity {
        // Space for the labels above the curves.
        Quantity::Displacement | Quantity::Speed => round_up(largest * 1.12),
        Quantity::Submergence => 1.0,
    };
    let field = draw_axes(sheet, place, quantity, top)?;
    let on_sheet = |(time_s, value): (f64, f64)| {
        (
            field.left + time_s / place.end_s * (field.right - field.left),
            field.bottom - value / top * (field.bottom - field.top),
        )
    };
    let on_sheet = |track: &Track<'_>| Line {
        body: track.body,
        style: track.style,
        points: line::thinned(track.curve(quantity).iter().map(|point| on_sheet(*point))),
        marks: match tracks {
            [only] => (only.notes(quantity).into_iter())
                .map(|note| (on_sheet(note.at), note.text))
                .collect(),
            _ => Vec::new(),
        },
    };
    let lines: Vec<Line> = tracks.iter().map(on_sheet).collect();
    let numbering = numbered.then_some(match quantity {
        Quantity::Displacement => Numbering::AtEnds,
        Quantity::Speed | Quantity::Submergence => Numbering::InCurves,
    });
    draw_lines(sheet, &lines, field, numbering)
}

fn draw_lines(
    sheet: &Area<'_>,
    lines: &[Line],
    field: Extent,
    numbering: Option<Numbering>,
) -> Result<(), PictureError> {
    let mut grid = Grid::over(field);
    for line in lines {
        grid.trace(&line.points, line.body);
    }
    let notes: Vec<PlacedNote> = lines
        .iter()
        .flat_map(|line| notes::place(line, &mut grid))
        .collect();
    let numbers = match numbering {
        Some(Numbering::InCurves) => numbers::in_curves(lines, &mut grid, field),
        Some(Numbering::AtEnds) => numbers::at_ends(lines, field),
        None => Vec::new(),
    };
    let (grey, own): (Vec<&Line>, Vec<&Line>) = lines.iter().partition(|l| l.style.is_grey());
    for line in grey.into_iter().chain(own) {
        let number = numbers.iter().find(|number| number.badge.body == line.body);
        line.draw(sheet, number.map(|number| number.badge))?;
    }
    for Number { badge, leader } in &numbers {
        if let Some(leader) = leader {
            leader.draw(sheet, badge.style.color)?;
        }
    }
    notes.iter().try_for_each(|note| note.draw(sheet))?;
    numbers
        .iter()
        .try_for_each(|number| number.badge.draw(sheet))
}

/// Draws the axes, and returns the field between them.
fn draw_axes(
    sheet: &Area<'_>,
    place: Place,
    quantity: Quantity,
    top: f64,
) -> Result<Extent, PictureError> {
    let (width, height) = place.size;
    let area = sheet
        .clone()
        .shrink((0, px(place.top)), (px(width), px(height)));
    let time_axis = if place.has_time_axis { TIME_AXIS } else { 0.0 };
    let mut panel = ChartBuilder::on(&area)
        .margin_top(px(18.0))
        .margin_right(px(place.margin))
        .margin_left(px(10.0))
        .set_label_area_size(LabelAreaPosition::Left, px(58.0))
        .set_label_area_size(LabelAreaPosition::Bottom, px(time_axis))
        .build_cartesian_2d(0.0..place.end_s, 0.0..top)?;
    panel
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(HAIRLINE.stroke_width(stroke(0.8)))
        .axis_style(INK.stroke_width(stroke(0.9)))
        .x_labels(9)
        .y_labels(6)
        .x_label_formatter(&|value| tick(*value, place.end_s))
        .y_label_formatter(&|value| tick(*value, top))
        .label_style(text(11.0, &INK))
        .axis_desc_style(text(12.0, &INK))
        .set_all_tick_mark_size(px(4.0))
        .x_desc("time [s]")
        .y_desc(quantity.axis_title())
        .draw()?;
    let (across, down) = panel.plotting_area().get_pixel_range();
    let floor = [(across.start, down.end), (across.end, down.end)];
    sheet.draw(&PathElement::new(floor, INK.stroke_width(stroke(0.9))))?;
    Ok(Extent {
        left: from_device(across.start),
        top: from_device(down.start),
        right: from_device(across.end),
        bottom: from_device(down.end),
    })
}
