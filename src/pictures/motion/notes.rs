//! Texts at the marks of a curve, where no curve passes.

use super::line::Line;
use crate::pictures::canvas::{Area, FAINT_INK, INK, PictureError, px, text};
use crate::pictures::labels::{Cell, Extent, Grid, Leader, Point, text_width};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Size of the texts [px].
const SIZE: f64 = 11.5;
/// Width of a mark [px].
const MARK: f64 = 9.0;
/// From a mark to a text that needs a line to it [px].
const FAR: f64 = 18.0;
/// Between a text and whatever is next to it [px].
const MARGIN: f64 = 3.0;

/// A text at its place.
#[derive(Debug)]
pub(super) struct PlacedNote {
    text: String,
    extent: Extent,
    leader: Leader,
}

/// The texts of a line's marks at the nearest free places to them; without those for which there
/// is none.
pub(super) fn place(line: &Line, grid: &mut Grid) -> Vec<PlacedNote> {
    for (mark, _) in &line.marks {
        grid.cover(Extent::around(*mark, (MARK, MARK)));
    }
    let marks = line.marks.iter();
    marks
        .filter_map(|(mark, text)| PlacedNote::at(*mark, text, grid))
        .collect()
}

impl PlacedNote {
    fn at(mark: Point, text: &str, grid: &mut Grid) -> Option<Self> {
        let size = (text_width(text, SIZE), SIZE * 1.15);
        let free = |cell| cell == Cell::Free;
        let field = grid.field().with_margin(-MARGIN);
        let extent = Leader::places(mark, f64::INFINITY)
            .map(|place| beside(mark, place, size).moved_into(field))
            .find(|extent| grid.all(extent.with_margin(MARGIN), free))?;
        grid.cover(extent.with_margin(MARGIN));
        Some(Self {
            text: text.to_owned(),
            leader: Leader {
                from: mark,
                to: extent.nearest(mark),
            },
            extent,
        })
    }

    /// Draws the text, with a line to its mark if that is not next to it.
    pub(super) fn draw(&self, sheet: &Area<'_>) -> Result<(), PictureError> {
        let Extent {
            left,
            top,
            right,
            bottom,
        } = self.extent;
        let backing = [(px(left), px(top)), (px(right), px(bottom))];
        sheet.draw(&Rectangle::new(backing, WHITE.filled()))?;
        let (x, y) = (
            self.leader.to.0 - self.leader.from.0,
            self.leader.to.1 - self.leader.from.1,
        );
        if x.hypot(y) > FAR {
            self.leader.shortened(2.0).draw(sheet, FAINT_INK)?;
        }
        // Set against the side of the mark: the text may be narrower than its extent.
        let (side, x) = match self.leader.from.0 {
            mark if mark <= left => (HPos::Left, left),
            mark if mark >= right => (HPos::Right, right),
            _ => (HPos::Center, (left + right) / 2.0),
        };
        let style = text(SIZE, &INK).pos(Pos::new(side, VPos::Center));
        sheet.draw_text(&self.text, &style, (px(x), px((top + bottom) / 2.0)))?;
        Ok(())
    }
}

/// Extent of a text whose side or corner that faces a point is at a place beside it.
fn beside(point: Point, place: Point, (width, height): (f64, f64)) -> Extent {
    // The text stands on the side of the place away from the point; nearly above or below it is
    // centred on the place.
    let towards = |offset: f64, length: f64| (offset / 8.0).clamp(-1.0, 1.0) * length / 2.0;
    let (x, y) = (place.0 - point.0, place.1 - point.1);
    Extent::around(
        (place.0 + towards(x, width), place.1 + towards(y, height)),
        (width, height),
    )
}
