//! Numbers of bodies.

use super::{Extent, Point};
use crate::pictures::canvas::{Area, PictureError, bold, px, width};
use crate::pictures::style::Style;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Radius of a badge [px].
pub(in crate::pictures) const RADIUS: f64 = 8.0;

/// A body's number in a disc of its colour.
#[derive(Debug, Clone, Copy)]
pub(in crate::pictures) struct Badge {
    pub(in crate::pictures) body: usize,
    pub(in crate::pictures) style: Style,
    pub(in crate::pictures) centre: Point,
}

impl Badge {
    /// Extent of a badge around a centre.
    pub(in crate::pictures) fn extent(centre: Point) -> Extent {
        Extent::around(centre, (2.0 * RADIUS, 2.0 * RADIUS))
    }

    /// Draws disc and number.
    pub(in crate::pictures) fn draw(&self, sheet: &Area<'_>) -> Result<(), PictureError> {
        let at = (px(self.centre.0), px(self.centre.1));
        let disc = |radius: f64, color: RGBColor| Circle::new(at, width(radius), color.filled());
        sheet.draw(&disc(RADIUS + 1.0, WHITE))?;
        sheet.draw(&disc(RADIUS, self.style.color))?;
        if self.style.is_double() {
            let ring = WHITE.stroke_width(width(0.8));
            sheet.draw(&Circle::new(at, width(RADIUS - 1.1), ring))?;
        }
        let size_px = if self.body < 100 { 10.0 } else { 8.0 };
        draw_number(sheet, self.body, self.style, self.centre, size_px)
    }
}

/// Draws a body's number around this centre, on its colour.
pub(in crate::pictures) fn draw_number(
    sheet: &Area<'_>,
    body: usize,
    style: Style,
    centre: Point,
    size_px: f64,
) -> Result<(), PictureError> {
    let ink = style.ink();
    let style = bold(size_px, &ink).pos(Pos::new(HPos::Center, VPos::Center));
    // The middle of a line of text is that of its small letters; digits are taller.
    let middle = centre.1 + 0.09 * size_px;
    sheet.draw_text(&body.to_string(), &style, (px(centre.0), px(middle)))?;
    Ok(())
}
