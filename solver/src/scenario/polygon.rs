//! Polygons: their area, the places that they hold, sides that touch, and the shares of squares
//! that they cover.

use super::area_rows::{NOTHING, Window};

/// Distance below which sides touch, over the extent of their polygon: rounding of the coordinates
/// of maps.
const TOUCHING: f64 = 1e-9;

/// A straight line from one place to another.
type Side = [[f64; 2]; 2];

/// Area of a polygon [m²], positive if its corners go round anticlockwise.
pub(super) fn area(corners: &[[f64; 2]]) -> f64 {
    // From the first corner on: coordinates of maps are large.
    let Some(&[x, y]) = corners.first() else {
        return 0.0;
    };
    let twice = sides(corners).map(|[a, b]| (a[0] - x) * (b[1] - y) - (b[0] - x) * (a[1] - y));
    0.5 * twice.sum::<f64>()
}

/// Centre of gravity of a polygon; its first corner if it has no area.
pub(super) fn centroid(corners: &[[f64; 2]]) -> Option<[f64; 2]> {
    let &first = corners.first()?;
    let from_first = |of: [f64; 2], axis: usize| of[axis] - first[axis];
    let six_areas = 6.0 * area(corners);
    let along = |axis: usize| {
        let moments = sides(corners).map(|[a, b]| {
            let cross = from_first(a, 0) * from_first(b, 1) - from_first(b, 0) * from_first(a, 1);
            (from_first(a, axis) + from_first(b, axis)) * cross
        });
        let from = moments.sum::<f64>() / six_areas;
        first[axis] + if from.is_finite() { from } else { 0.0 }
    };
    Some([along(0), along(1)])
}

/// True if a polygon holds a place: an odd number of its sides lies east of it.
pub(super) fn holds(corners: &[[f64; 2]], x: f64, y: f64) -> bool {
    let crossed = sides(corners).filter(|[a, b]| {
        let spans = (a[1] > y) != (b[1] > y);
        spans && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    });
    crossed.count() % 2 == 1
}

/// Number of squares of this side [m] that the sides of a polygon come to, at most.
pub(super) fn squares_along(corners: &[[f64; 2]], spacing: f64) -> f64 {
    let along = |[a, b]: Side| (a[0] - b[0]).abs() + (a[1] - b[1]).abs();
    sides(corners).map(|side| along(side) / spacing + 1.0).sum()
}

fn sides(corners: &[[f64; 2]]) -> impl Iterator<Item = Side> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| [*a, *b])
}

/// Two sides of a polygon that cross or touch other than from one to the next, by the indices of
/// their first corners. A last corner that repeats the first closes the polygon.
pub(super) fn touching(corners: &[[f64; 2]]) -> Option<[usize; 2]> {
    let corners = without_closing(corners);
    let sides: Vec<_> = sides(corners).collect();
    let apart = TOUCHING * extent(corners);
    let mut pairs = (0..sides.len()).flat_map(|a| (a + 1..sides.len()).map(move |b| [a, b]));
    let touch = |[a, b]: [usize; 2]| {
        if b == a + 1 {
            folds(sides[a], sides[b], apart)
        } else if a == 0 && b + 1 == sides.len() {
            folds(sides[b], sides[a], apart)
        } else {
            meet(sides[a], sides[b], apart)
        }
    };
    pairs.find(|pair| touch(*pair))
}

/// Corners of a polygon without a last one that repeats the first.
fn without_closing(corners: &[[f64; 2]]) -> &[[f64; 2]] {
    match corners {
        [first, others @ .., last] if !others.is_empty() && first == last => {
            &corners[..corners.len() - 1]
        }
        _ => corners,
    }
}

/// Larger side of the box around places [m].
fn extent(places: &[[f64; 2]]) -> f64 {
    let along = |axis: usize| {
        let values = places.iter().map(|place| place[axis]);
        let (low, high) = (
            values.clone().fold(f64::INFINITY, f64::min),
            values.fold(f64::NEG_INFINITY, f64::max),
        );
        high - low
    };
    along(0).max(along(1))
}

/// True if a side goes back on the one before, or one of both has no length.
fn folds(before: Side, after: Side, apart: f64) -> bool {
    distance(after[1], before) <= apart || distance(before[0], after) <= apart
}

/// True if two sides cross or touch.
fn meet(one: Side, other: Side, apart: f64) -> bool {
    let beside = (0..2).any(|axis| {
        let range = |side: Side| {
            let [a, b] = side.map(|end| end[axis]);
            (a.min(b), a.max(b))
        };
        let ((a, b), (c, d)) = (range(one), range(other));
        b + apart < c || d + apart < a
    });
    !beside
        && (cross(one, other)
            || other.iter().any(|end| distance(*end, one) <= apart)
            || one.iter().any(|end| distance(*end, other) <= apart))
}

fn cross([a, b]: Side, [c, d]: Side) -> bool {
    let left = |from: [f64; 2], to: [f64; 2], of: [f64; 2]| {
        (to[0] - from[0]) * (of[1] - from[1]) - (to[1] - from[1]) * (of[0] - from[0])
    };
    let apart = |one: f64, other: f64| one * other < 0.0;
    apart(left(a, b, c), left(a, b, d)) && apart(left(c, d, a), left(c, d, b))
}

/// Distance of a place from a side.
fn distance(place: [f64; 2], [from, to]: Side) -> f64 {
    let minus = |a: [f64; 2], b: [f64; 2]| [a[0] - b[0], a[1] - b[1]];
    let (along, arm) = (minus(to, from), minus(place, from));
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let square = dot(along, along);
    let share = if square > 0.0 {
        (dot(arm, along) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    f64::hypot(arm[0] - share * along[0], arm[1] - share * along[1])
}

/// Calls with the share of each square of a row that a polygon covers, row by row from the south.
///
/// A side covers, or uncovers if it goes the other way, all that lies east of it.
pub(super) fn each_row_covered(
    corners: &[[f64; 2]],
    window: &Window,
    mut of_row: impl FnMut(i64, &mut [f64]),
) {
    let way = -area(corners).signum();
    let lowest = |side: &Side| side[0][1].min(side[1][1]);
    let highest = |side: &Side| side[0][1].max(side[1][1]);
    let mut ahead: Vec<Side> = sides(corners)
        .map(|side| side.map(|end| window.in_squares(end)))
        .collect();
    ahead.sort_by(|one, other| lowest(other).total_cmp(&lowest(one)));
    let (mut reached, mut shares) = (Vec::new(), vec![0.0; window.count[0] + 1]);
    for (south, row) in window.rows() {
        while let Some(side) = ahead.pop_if(|side| lowest(side) < south + 1.0) {
            reached.push(side);
        }
        reached.retain(|side| highest(side) > south);
        shares.fill(0.0);
        for side in &reached {
            cover_east_of(between(*side, south, south + 1.0), way, &mut shares);
        }
        sum_up(&mut shares);
        of_row(row, &mut shares[..window.count[0]]);
    }
}

/// Part of a side between two heights.
fn between(side: Side, south: f64, north: f64) -> Side {
    let [a, b] = side;
    side.map(|end| {
        let y = end[1].clamp(south, north);
        if y == end[1] {
            return end;
        }
        [a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]), y]
    })
}

/// Adds what lies east of a side within its row: to each square the difference to its western
/// neighbour.
fn cover_east_of([a, b]: Side, way: f64, shares: &mut [f64]) {
    let height = way * (b[1] - a[1]);
    let count = shares.len() - 1;
    let (west, east) = (a[0].min(b[0]), a[0].max(b[0]));
    if west < 0.0 {
        // West of the first square: all of it is covered.
        let part = if east > 0.0 {
            -west / (east - west)
        } else {
            1.0
        };
        shares[0] += height * part;
    }
    if east < 0.0 {
        return;
    }
    let (from, to) = (west.max(0.0), east.min(count as f64));
    let first = from as usize;
    for square in first..(to.ceil() as usize).max(first + 1).min(count) {
        let [low, high] = [from.max(square as f64), to.min(square as f64 + 1.0)];
        let part = if east > west {
            height * (high - low) / (east - west)
        } else {
            height
        };
        let uncovered = (0.5 * (low + high) - square as f64).clamp(0.0, 1.0);
        shares[square] += part * (1.0 - uncovered);
        shares[square + 1] += part * uncovered;
    }
}

/// Turns differences between neighbours into shares.
fn sum_up(shares: &mut [f64]) {
    let mut sum = 0.0;
    for share in shares {
        sum += *share;
        *share = if sum > NOTHING { sum } else { 0.0 };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[1.0, 1.0], [3.0, 1.0], [3.0, 4.0], [1.0, 4.0]];

    #[test]
    fn a_polygon_has_an_area_and_a_centre() {
        let clockwise: Vec<_> = SQUARE.into_iter().rev().collect();
        assert_eq!(area(&clockwise), -6.0);
        for corners in [SQUARE.to_vec(), clockwise] {
            assert_eq!(centroid(&corners), Some([2.0, 2.5]));
        }
    }

    #[test]
    fn sides_apart_are_accepted() {
        assert_eq!(touching(&SQUARE), None);
        let closed = [SQUARE.as_slice(), &SQUARE[..1]].concat();
        assert_eq!(touching(&closed), None);
        let sliver = [[10.0, 10.3], [14.0, 10.3], [14.0, 10.3001]];
        assert_eq!(touching(&sliver), None);
        // A corner that goes straight on.
        let straight = [[1.0, 1.0], [2.0, 1.0], [3.0, 1.0], [3.0, 4.0], [1.0, 4.0]];
        assert_eq!(touching(&straight), None);
    }

    #[test]
    fn sides_that_cross_or_touch_are_found() {
        let bow = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
        assert_eq!(touching(&bow), Some([0, 2]));
        // Two triangles that have a corner in common.
        let pair = [
            [1.0, 1.0],
            [0.0, 2.0],
            [0.0, 0.0],
            [1.0, 1.0],
            [2.0, 0.0],
            [2.0, 2.0],
        ];
        assert_eq!(touching(&pair), Some([0, 2]));
        let twice = [SQUARE, SQUARE].concat();
        assert!(touching(&twice).is_some());
        let corner_on_side = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]];
        assert_eq!(touching(&corner_on_side), Some([0, 2]));
        let repeated = [[0.0, 0.0], [4.0, 0.0], [4.0, 0.0], [4.0, 4.0]];
        assert_eq!(touching(&repeated), Some([0, 1]));
        let back = [[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [2.0, 4.0]];
        assert_eq!(touching(&back), Some([0, 1]));
        let spike_at_the_start = [[6.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 4.0], [2.0, 0.0]];
        assert!(touching(&spike_at_the_start).is_some());
        assert!(touching(&[[0.0, 0.0], [1.0, 1.0], [0.0, 0.0]]).is_some());
    }

    /// Shares covered of a window, row by row.
    fn covered(corners: &[[f64; 2]], window: &Window) -> Vec<Vec<f64>> {
        let mut rows = Vec::new();
        each_row_covered(corners, window, |_, shares| rows.push(shares.to_vec()));
        rows
    }

    #[test]
    fn squares_are_covered_by_their_shares() {
        let window = Window::around([[0.0, 0.0], [2.0, 2.0]], 1.0);
        let triangle = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]];
        let expected = vec![vec![0.5, 1.0], vec![0.0, 0.5]];
        assert_eq!(covered(&triangle, &window), expected);
        let clockwise: Vec<_> = triangle.into_iter().rev().collect();
        assert_eq!(covered(&clockwise, &window), expected);
        let inner = [[0.5, 0.25], [1.25, 0.25], [1.25, 0.5], [0.5, 0.5]];
        let expected = vec![vec![0.125, 0.0625], vec![0.0, 0.0]];
        assert_eq!(covered(&inner, &window), expected);
    }

    #[test]
    fn what_lies_beyond_a_window_is_left_out() {
        let window = Window::around([[1.0, 1.0], [3.0, 2.0]], 1.0);
        let triangle = [[-2.0, 0.0], [5.0, 0.0], [5.0, 7.0]];
        assert_eq!(covered(&triangle, &window), vec![vec![1.0, 1.0]]);
        let steep = [[1.0, 0.0], [9.0, 0.0], [9.0, 8.0]];
        assert_eq!(covered(&steep, &window), vec![vec![0.0, 0.5]]);
        let west = [[-3.0, 0.0], [0.5, 0.0], [0.5, 8.0]];
        assert_eq!(covered(&west, &window), vec![vec![0.0, 0.0]]);
    }
}
