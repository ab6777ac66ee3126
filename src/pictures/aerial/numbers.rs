//! Numbers of the bodies in a panel.
//!
//! A number stands on its body where that is seen, in the largest size that fits; else in a badge
//! beside it, at a line to it. A body that is hidden has none, and a grey one has no badge.

use super::bodies::SeenBody;
use crate::pictures::canvas::{Area, PictureError};
use crate::pictures::labels::{
    Badge, Cell, Extent, Grid, Leader, Point, RADIUS, draw_number, text_width,
};

/// Sizes of a number [px], the largest first.
const SIZES: [f64; 4] = [11.5, 10.0, 9.0, 8.0];
/// Height of digits in parts of their size.
const DIGIT_HEIGHT: f64 = 0.75;
/// Around a number, and around a badge [px].
const MARGIN: f64 = 0.8;
const BADGE_MARGIN: f64 = 1.5;
/// Longest line from a badge to its body [px].
const FARTHEST: f64 = 66.0;
/// Cells in which a body must be seen to have a badge.
const LEAST_SEEN: usize = 6;

/// A body's number at its place.
#[derive(Debug)]
pub(super) enum Number<'a> {
    /// On the body.
    On {
        body: &'a SeenBody,
        centre: Point,
        size_px: f64,
    },
    /// Beside it.
    Beside { badge: Badge, leader: Leader },
}

/// Numbers of the bodies, which the grid shows as they are seen.
pub(super) fn place<'a>(seen: &'a [SeenBody], grid: &mut Grid) -> Vec<Number<'a>> {
    let (on, rest): (Vec<_>, Vec<_>) = seen
        .iter()
        .map(|body| (body, on_body(body, grid)))
        .partition(|(_, number)| number.is_some());
    let mut numbers: Vec<Number<'a>> = on.into_iter().filter_map(|(_, number)| number).collect();
    for number in &numbers {
        if let Number::On {
            body,
            centre,
            size_px,
        } = number
        {
            grid.cover(extent(body.index, *centre, *size_px));
        }
    }
    for (body, _) in rest {
        let Some((badge, leader)) = beside_body(body, grid) else {
            continue;
        };
        grid.cover(Badge::extent(badge.centre).with_margin(BADGE_MARGIN));
        numbers.push(Number::Beside { badge, leader });
    }
    numbers
}

/// The number in the part of the body that is seen, as close to its middle as possible.
fn on_body<'a>(body: &'a SeenBody, grid: &Grid) -> Option<Number<'a>> {
    let cells: Vec<Point> = grid.seen(body.index).collect();
    let middle = middle(cells.iter().copied());
    let way = |at: &Point| (at.0 - middle.0).hypot(at.1 - middle.1);
    let mut places: Vec<Point> = std::iter::once(middle).chain(cells).collect();
    places.sort_by(|a, b| way(a).total_cmp(&way(b)));
    let own = |cell| cell == Cell::Of(body.index);
    SIZES.into_iter().find_map(|size_px| {
        let fits = |at: &&Point| grid.all(extent(body.index, **at, size_px), own);
        Some(Number::On {
            body,
            centre: *places.iter().find(fits)?,
            size_px,
        })
    })
}

/// A badge in a free place near the body, else near the middle of its trail.
fn beside_body(body: &SeenBody, grid: &Grid) -> Option<(Badge, Leader)> {
    let cells: Vec<Point> = grid.seen(body.index).collect();
    if body.style.is_grey() || cells.len() < LEAST_SEEN {
        return None;
    }
    let nearest = |middle: Point| {
        let way = |at: &Point| (at.0 - middle.0).hypot(at.1 - middle.1);
        let cells = cells.iter().copied();
        cells.min_by(|a, b| way(a).total_cmp(&way(b)))
    };
    let free = |cell| cell == Cell::Free;
    let place = |from: Point| {
        let clear = |to: &Point| {
            let extent = Badge::extent(*to).with_margin(BADGE_MARGIN);
            let unlabelled = |cell| cell != Cell::Label;
            grid.all(extent, free) && grid.all_along(from, *to, unlabelled)
        };
        Some((from, Leader::places(from, FARTHEST).find(clear)?))
    };
    let middles = [
        middle(body.outline.iter().copied()),
        middle(cells.iter().copied()),
    ];
    let (from, to) = middles
        .into_iter()
        .find_map(|middle| place(nearest(middle)?))?;
    let badge = Badge {
        body: body.index,
        style: body.style,
        centre: to,
    };
    Some((badge, Leader { from, to }.shortened(RADIUS)))
}

/// Extent of a number of this size around a centre.
fn extent(body: usize, centre: Point, size_px: f64) -> Extent {
    let width = text_width(&body.to_string(), size_px);
    Extent::around(centre, (width, DIGIT_HEIGHT * size_px)).with_margin(MARGIN)
}

fn middle(points: impl ExactSizeIterator<Item = Point> + Clone) -> Point {
    let count = points.len() as f64;
    let sum = points.fold((0.0, 0.0), |sum, at| (sum.0 + at.0, sum.1 + at.1));
    (sum.0 / count, sum.1 / count)
}

impl Number<'_> {
    pub(super) fn draw(&self, sheet: &Area<'_>) -> Result<(), PictureError> {
        match self {
            Self::On {
                body,
                centre,
                size_px,
            } => draw_number(sheet, body.index, body.style, *centre, *size_px),
            Self::Beside { badge, leader } => {
                leader.draw(sheet, badge.style.color)?;
                badge.draw(sheet)
            }
        }
    }
}
