//! Lines from a label to what it names.

use super::{Cell, Grid, Point};
use crate::pictures::canvas::{Area, PictureError, px, width};
use plotters::prelude::*;
use std::f64::consts::TAU;

/// Distances of a label from its point [px], tried in this order.
const DISTANCES: [f64; 11] = [
    14.0, 19.0, 25.0, 32.0, 41.0, 52.0, 66.0, 85.0, 110.0, 140.0, 180.0,
];

/// Directions tried at each distance.
const DIRECTIONS: u32 = 16;

/// A line from the point that a label names to the label.
#[derive(Debug, Clone, Copy)]
pub(in crate::pictures) struct Leader {
    pub(in crate::pictures) from: Point,
    pub(in crate::pictures) to: Point,
}

impl Leader {
    /// Places around a point at most this far from it, the nearest first, and at each distance
    /// those to the right and above first.
    pub(in crate::pictures) fn places(from: Point, farthest: f64) -> impl Iterator<Item = Point> {
        let near = move |distance: &f64| *distance <= farthest;
        DISTANCES
            .into_iter()
            .filter(near)
            .flat_map(move |distance| {
                (0..DIRECTIONS).map(move |turn| {
                    // 0, 1, −1, 2, −2, ... parts of a turn from the upper right.
                    let parts =
                        f64::from(turn.div_ceil(2)) * if turn % 2 == 0 { -1.0 } else { 1.0 };
                    let angle = TAU * (0.125 + parts / f64::from(DIRECTIONS));
                    (
                        from.0 + distance * angle.cos(),
                        from.1 - distance * angle.sin(),
                    )
                })
            })
    }

    /// True if the line crosses no label and no other body than this.
    pub(in crate::pictures) fn is_clear(&self, grid: &Grid, body: usize) -> bool {
        let clear = |cell| matches!(cell, Cell::Free) || cell == Cell::Of(body);
        grid.all_along(self.from, self.to, clear)
    }

    /// The same line, which ends this far before its end.
    pub(in crate::pictures) fn shortened(self, by: f64) -> Self {
        let (x, y) = (self.to.0 - self.from.0, self.to.1 - self.from.1);
        let share = (1.0 - by / x.hypot(y)).max(0.0);
        Self {
            from: self.from,
            to: (self.from.0 + share * x, self.from.1 + share * y),
        }
    }

    /// Draws the line with a dot at its point; with a white edge to be visible on any colour.
    pub(in crate::pictures) fn draw(
        &self,
        sheet: &Area<'_>,
        color: RGBColor,
    ) -> Result<(), PictureError> {
        let [from, to] = [self.from, self.to].map(|(x, y)| (px(x), px(y)));
        for (line, dot, color) in [(2.6, 2.6, WHITE), (1.0, 1.8, color)] {
            let style = color.stroke_width(width(line));
            sheet.draw(&PathElement::new([from, to], style))?;
            sheet.draw(&Circle::new(from, width(dot), color.filled()))?;
        }
        Ok(())
    }
}
