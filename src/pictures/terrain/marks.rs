//! Outlines on the terrain, and what they mean.

use super::LEFT;
use crate::pictures::canvas::{Area, FAINT_INK, INK, PictureError, px, text, width as stroke};
use crate::pictures::labels::Point;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Colour of the outline of the deposit.
const DEPOSIT: RGBColor = RGBColor(214, 40, 40);

/// Draws the outline of a release.
pub(super) fn draw_release(sheet: &Area<'_>, ring: &[Point]) -> Result<(), PictureError> {
    let path: Vec<_> = device(ring).collect();
    sheet.draw(&PathElement::new(
        path.clone(),
        WHITE.stroke_width(stroke(2.6)),
    ))?;
    let style = INK.stroke_width(stroke(1.3));
    sheet.draw(&DashedPathElement::new(path, px(5.0), px(3.0), style))?;
    Ok(())
}

/// Draws the outline of the deposit.
pub(super) fn draw_deposit(sheet: &Area<'_>, ring: &[Point]) -> Result<(), PictureError> {
    let path: Vec<_> = device(ring).collect();
    sheet.draw(&PathElement::new(path, DEPOSIT.stroke_width(stroke(1.2))))?;
    Ok(())
}

fn device(ring: &[Point]) -> impl Iterator<Item = (i32, i32)> {
    ring.iter().map(|(x, y)| (px(*x), px(*y)))
}

/// Draws the legend of the outlines at this height [px].
pub(super) fn draw_legend(
    sheet: &Area<'_>,
    y: f64,
    meaning_of_grey: Option<&str>,
) -> Result<(), PictureError> {
    let style = text(11.0, &INK).pos(Pos::new(HPos::Left, VPos::Center));
    let sample = |left: f64| [(left, y), (left + 24.0, y)];
    draw_release(sheet, &sample(LEFT))?;
    sheet.draw_text("release", &style, (px(LEFT + 30.0), px(y)))?;
    draw_deposit(sheet, &sample(LEFT + 92.0))?;
    sheet.draw_text("deposit", &style, (px(LEFT + 122.0), px(y)))?;
    let about = "bodies at the end, with their tracks";
    let about = meaning_of_grey.map_or(about.to_owned(), |grey| format!("{about}; {grey}"));
    let faint = text(11.0, &FAINT_INK).pos(Pos::new(HPos::Left, VPos::Center));
    sheet.draw_text(&about, &faint, (px(LEFT + 190.0), px(y)))?;
    Ok(())
}
