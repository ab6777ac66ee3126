//! Scatter matrix: each quantity of interest against each input.

use super::frame::{Frame, head, range};
use crate::pictures::canvas::{Area, INK, PictureError, paint, px, text, width as stroke};
use crate::pictures::palette::body_color;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Size of a panel, and the gap between two [px].
const PANEL: (f64, f64) = (190.0, 130.0);
const GAP: f64 = 18.0;
/// Around the panels [px].
const LEFT: f64 = 96.0;
const TOP: f64 = 64.0;
const RIGHT: f64 = 20.0;
const BOTTOM: f64 = 48.0;
/// Most inputs that are shown.
const MOST_INPUTS: usize = 6;
/// A column of a table of members: its name and a value of each, NaN where there is none.
pub type Column = (String, Vec<f64>);

/// Panels of quantities (rows) against inputs (columns), a dot for each member; quantities that do
/// not vary are left out.
///
/// # Errors
/// The drawing library fails.
pub fn scatter_matrix(
    name: &str,
    inputs: &[Column],
    quantities: &[Column],
) -> Result<String, PictureError> {
    let columns = &inputs[..inputs.len().min(MOST_INPUTS)];
    let rows: Vec<&Column> = quantities.iter().filter(|column| varies(column)).collect();
    let width = LEFT + columns.len() as f64 * (PANEL.0 + GAP) - GAP + RIGHT;
    let height = TOP + rows.len() as f64 * (PANEL.1 + GAP) - GAP + BOTTOM;
    paint((width.max(360.0), height.max(160.0)), |sheet| {
        let members = inputs.first().map_or(0, |(_, values)| values.len());
        let line = format!("Quantities against inputs: {members} members");
        head(sheet, name, &line)?;
        for (row, (quantity, values)) in rows.iter().enumerate() {
            for (column, (input, along)) in columns.iter().enumerate() {
                let frame = Frame {
                    left: LEFT + column as f64 * (PANEL.0 + GAP),
                    top: TOP + row as f64 * (PANEL.1 + GAP),
                    width: PANEL.0,
                    height: PANEL.1,
                    x: range(along.iter().copied(), 0.05),
                    y: range(values.iter().copied(), 0.05),
                };
                draw_panel(sheet, &frame, (along, values))?;
                if column == 0 {
                    frame.numbers_left(sheet, 4)?;
                    draw_name_left(sheet, &frame, quantity)?;
                }
                if row + 1 == rows.len() {
                    frame.numbers_below(sheet, 3)?;
                    draw_name_below(sheet, &frame, input)?;
                }
            }
        }
        Ok(())
    })
}

fn varies((_, values): &Column) -> bool {
    let finite = values.iter().filter(|value| value.is_finite());
    let low = finite.clone().copied().fold(f64::INFINITY, f64::min);
    let high = finite.copied().fold(f64::NEG_INFINITY, f64::max);
    high > low + 1e-9
}

fn draw_panel(
    sheet: &Area<'_>,
    frame: &Frame,
    (x, y): (&[f64], &[f64]),
) -> Result<(), PictureError> {
    frame.draw(sheet, (3, 4))?;
    for (x, y) in x.iter().zip(y).filter(|(x, y)| (*x + *y).is_finite()) {
        let dot = body_color(1).mix(0.5).filled();
        sheet.draw(&Circle::new(frame.device([*x, *y]), stroke(1.6), dot))?;
    }
    Ok(())
}

fn draw_name_below(sheet: &Area<'_>, frame: &Frame, name: &str) -> Result<(), PictureError> {
    let style = text(10.5, &INK).pos(Pos::new(HPos::Center, VPos::Top));
    let at = (
        frame.left + 0.5 * frame.width,
        frame.top + frame.height + 22.0,
    );
    sheet.draw_text(name, &style, (px(at.0), px(at.1)))?;
    Ok(())
}

fn draw_name_left(sheet: &Area<'_>, frame: &Frame, name: &str) -> Result<(), PictureError> {
    let style = text(10.5, &INK)
        .transform(FontTransform::Rotate270)
        .pos(Pos::new(HPos::Center, VPos::Top));
    let middle = frame.top + 0.5 * frame.height;
    sheet.draw_text(name, &style, (px(10.0), px(middle)))?;
    Ok(())
}
