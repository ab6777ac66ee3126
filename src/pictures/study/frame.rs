//! A field with axes, and the heads of the pictures.

use crate::pictures::canvas::{
    Area, FAINT_INK, HAIRLINE, INK, PictureError, bold, px, text, width as stroke,
};
use crate::pictures::format::{round_up, tick, title};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// Draws the title and a line below it.
pub(super) fn head(sheet: &Area<'_>, name: &str, line: &str) -> Result<(), PictureError> {
    let headline = title(name, "Untitled study");
    sheet.draw_text(&headline, &bold(15.0, &INK), (px(16.0), px(12.0)))?;
    sheet.draw_text(line, &text(12.0, &FAINT_INK), (px(16.0), px(33.0)))?;
    Ok(())
}

/// A rectangle of the sheet [px] that shows ranges of two quantities.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Frame {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) x: Range<f64>,
    pub(super) y: Range<f64>,
}

impl Frame {
    /// Place on the sheet [px] of values of the two quantities.
    pub(super) fn at(&self, x: f64, y: f64) -> (f64, f64) {
        let share = |value: f64, range: &Range<f64>| (value - range.start) / length(range);
        (
            self.left + share(x, &self.x) * self.width,
            self.top + (1.0 - share(y, &self.y)) * self.height,
        )
    }

    /// The same in device units.
    pub(super) fn device(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        let (x, y) = self.at(x, y);
        (px(x), px(y))
    }

    /// True if values are within.
    pub(super) fn shows(&self, x: f64, y: f64) -> bool {
        self.x.contains(&x) && self.y.contains(&y)
    }

    /// Draws its edge and lines at round values along x, and along y.
    pub(super) fn draw(
        &self,
        sheet: &Area<'_>,
        (along_x, along_y): (usize, usize),
    ) -> Result<(), PictureError> {
        for value in round_values(&self.x, along_x) {
            let (x, bottom) = self.at(value, self.y.start);
            line(sheet, ((x, self.top), (x, bottom)), (&HAIRLINE, 0.8))?;
        }
        for value in round_values(&self.y, along_y) {
            let (left, y) = self.at(self.x.start, value);
            line(sheet, ((left, y), (left + self.width, y)), (&HAIRLINE, 0.8))?;
        }
        let (right, bottom) = (self.left + self.width, self.top + self.height);
        line(sheet, ((self.left, bottom), (right, bottom)), (&INK, 0.9))?;
        line(
            sheet,
            ((self.left, self.top), (self.left, bottom)),
            (&INK, 0.9),
        )
    }

    /// Draws numbers at round values below.
    pub(super) fn numbers_below(&self, sheet: &Area<'_>, count: usize) -> Result<(), PictureError> {
        let style = text(11.0, &INK).pos(Pos::new(HPos::Center, VPos::Top));
        for value in round_values(&self.x, count) {
            let (x, bottom) = self.at(value, self.y.start);
            let number = tick(value, length(&self.x));
            sheet.draw_text(&number, &style, (px(x), px(bottom + 5.0)))?;
        }
        Ok(())
    }

    /// Draws numbers at round values to the left.
    pub(super) fn numbers_left(&self, sheet: &Area<'_>, count: usize) -> Result<(), PictureError> {
        let style = text(11.0, &INK).pos(Pos::new(HPos::Right, VPos::Center));
        for value in round_values(&self.y, count) {
            let (left, y) = self.at(self.x.start, value);
            let number = tick(value, length(&self.y));
            sheet.draw_text(&number, &style, (px(left - 6.0), px(y)))?;
        }
        Ok(())
    }
}

/// Draws a line between two places [px], of this colour and width [px].
pub(super) fn line(
    sheet: &Area<'_>,
    (from, to): ((f64, f64), (f64, f64)),
    (color, width_px): (&RGBColor, f64),
) -> Result<(), PictureError> {
    let ends = [(px(from.0), px(from.1)), (px(to.0), px(to.1))];
    sheet.draw(&PathElement::new(
        ends,
        color.stroke_width(stroke(width_px)),
    ))?;
    Ok(())
}

/// A range of finite values with a margin of this share of its length; a unit round a single
/// value.
pub(super) fn range(values: impl Iterator<Item = f64> + Clone, margin: f64) -> Range<f64> {
    let finite = values.filter(|value| value.is_finite());
    let low = finite.clone().fold(f64::INFINITY, f64::min);
    let high = finite.fold(f64::NEG_INFINITY, f64::max);
    if low > high {
        return 0.0..1.0;
    }
    let least = 1e-9 + 1e-6 * low.abs().max(high.abs());
    if high - low < least {
        return low - 0.5..high + 0.5;
    }
    let beyond = margin * (high - low);
    low - beyond..high + beyond
}

pub(super) fn length(range: &Range<f64>) -> f64 {
    range.end - range.start
}

/// About `count` round values in a range.
fn round_values(range: &Range<f64>, count: usize) -> Vec<f64> {
    let step = round_up(length(range) / (count.max(1) as f64 + 0.5));
    let first = (range.start / step).ceil();
    let values = (0..=2 * count).map(|place| (first + place as f64) * step);
    values.take_while(|value| *value <= range.end).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_at_lines_are_round_and_within() {
        let values = round_values(&(-0.13..0.52), 5);
        let expected = [-0.0, 0.15, 0.3, 0.45];
        assert_eq!(values.len(), expected.len(), "{values:?}");
        for (value, expected) in values.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-12, "{values:?}");
        }
    }

    #[test]
    fn ranges_hold_their_values_and_have_a_length() {
        assert_eq!(range([1.0, f64::NAN, 3.0].into_iter(), 0.5), 0.0..4.0);
        assert_eq!(range([2.0].into_iter(), 0.1), 1.5..2.5);
        assert_eq!(range(std::iter::empty(), 0.1), 0.0..1.0);
    }
}
