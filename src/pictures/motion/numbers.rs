//! Numbers of the curves of a panel.
//!
//! Where most curves end alike, a number stands in its curve, which is interrupted there, where no
//! other curve is near; else beside its curve, at a line to it; else in the right margin, at a line
//! to its end. Where their ends differ, all stand in the margin.

use super::line::Line;
use crate::pictures::labels::{Badge, Cell, Extent, Grid, Leader, Point, RADIUS};

/// Between two badges, and between a badge and a curve [px].
const GAP: f64 = 2.0;
/// Distance from other curves that is enough [px].
const ENOUGH: f64 = 12.0;
/// From the field's right edge to the middle of the badges in the margin [px].
const ASIDE: f64 = 30.0;
/// Longest line from a badge to its curve within the field [px].
const FARTHEST: f64 = 66.0;
/// Longest way along a curve between two places that are tried [px].
const STEP: f64 = 4.0;

/// A badge, and the line to its curve if it does not stand in it.
#[derive(Debug)]
pub(super) struct Number {
    pub(super) badge: Badge,
    pub(super) leader: Option<Leader>,
}

/// Numbers at the ends of all curves that have colours of their own.
pub(super) fn at_ends(lines: &[Line], field: Extent) -> Vec<Number> {
    in_margin(named(lines), field)
}

/// Curves that have colours of their own.
fn named(lines: &[Line]) -> Vec<&Line> {
    lines.iter().filter(|line| !line.style.is_grey()).collect()
}

/// Numbers in all curves that have colours of their own, or near them.
pub(super) fn in_curves(lines: &[Line], grid: &mut Grid, field: Extent) -> Vec<Number> {
    let mut named = named(lines);
    // First those with the least choice.
    named.sort_by_cached_key(|line| in_curve(line, grid).count());
    let mut numbers = Vec::new();
    let mut left_over = Vec::new();
    for line in named {
        let best = in_curve(line, grid).max_by(|a, b| a.1.total_cmp(&b.1));
        let number = match best {
            Some((centre, _)) => Some(Number {
                badge: badge(line, centre),
                leader: None,
            }),
            None => beside_curve(line, grid),
        };
        match number {
            Some(number) => {
                grid.cover(extent(number.badge.centre));
                numbers.push(number);
            }
            None => left_over.push(line),
        }
    }
    numbers.extend(in_margin(left_over, field));
    numbers
}

fn badge(line: &Line, centre: Point) -> Badge {
    Badge {
        body: line.body,
        style: line.style,
        centre,
    }
}

fn extent(centre: Point) -> Extent {
    Badge::extent(centre).with_margin(GAP)
}

/// Places in the curve at which no other curve touches the badge, with the distance to the
/// nearest other curve or label [px], as far as that matters.
fn in_curve(line: &Line, grid: &Grid) -> impl Iterator<Item = (Point, f64)> {
    let own = |cell| matches!(cell, Cell::Free) || cell == Cell::Of(line.body);
    places_along(&line.points).filter_map(move |at| {
        let room = |distance: &f64| grid.all(extent(at).with_margin(*distance), own);
        let distances = [ENOUGH, ENOUGH / 2.0, 0.0];
        distances.into_iter().find(room).map(|room| (at, room))
    })
}

/// A place beside the curve, with a line to a point of it that is no other curve's.
fn beside_curve(line: &Line, grid: &Grid) -> Option<Number> {
    let own = |cell| matches!(cell, Cell::Free) || cell == Cell::Of(line.body);
    let free = |cell| cell == Cell::Free;
    let apart =
        |distance: f64| move |at: &Point| grid.all(Extent::around(*at, (distance, distance)), own);
    let found = |distance: f64| {
        places_along(&line.points)
            .filter(apart(distance))
            .find_map(|from| {
                let clear = |to: &Point| {
                    grid.all(extent(*to), free)
                        && Leader { from, to: *to }.is_clear(grid, line.body)
                };
                let to = Leader::places(from, FARTHEST).find(clear)?;
                Some(Leader { from, to })
            })
    };
    // The farther from other curves the line ends, the clearer it is.
    let leader = [8.0, 4.0].into_iter().find_map(found)?;
    Some(Number {
        badge: badge(line, leader.to),
        leader: Some(leader.shortened(RADIUS)),
    })
}

/// Places in a column right of the field, in the order of the curves' ends.
fn in_margin(mut lines: Vec<&Line>, field: Extent) -> Vec<Number> {
    let end = |line: &Line| line.points.last().copied();
    lines.retain(|line| end(line).is_some());
    lines.sort_by(|a, b| {
        let (a, b) = (end(a).unwrap_or_default(), end(b).unwrap_or_default());
        a.1.total_cmp(&b.1)
    });
    let heights: Vec<f64> = lines.iter().filter_map(|line| Some(end(line)?.1)).collect();
    let heights = spread(
        &heights,
        2.0 * RADIUS + GAP,
        (field.top + RADIUS, field.bottom - RADIUS),
    );
    let placed = lines.into_iter().zip(heights);
    placed
        .filter_map(|(line, height)| {
            // To the left side of its badge: it passes by the others.
            let leader = Leader {
                from: end(line)?,
                to: (field.right + ASIDE - RADIUS, height),
            };
            Some(Number {
                badge: badge(line, (field.right + ASIDE, height)),
                leader: Some(leader),
            })
        })
        .collect()
}

/// Increasing heights moved apart to this pitch, each as little as possible in the mean square,
/// and into bounds if there is space.
fn spread(heights: &[f64], pitch: f64, (top, bottom): (f64, f64)) -> Vec<f64> {
    // Less their share of the pitches the heights only have to increase: neighbours that do not
    // are pooled in groups of the same height, their mean.
    let mut groups: Vec<(f64, usize)> = Vec::new();
    for (index, height) in heights.iter().enumerate() {
        let mut group = (height - index as f64 * pitch, 1);
        while let Some((above, size)) = groups.pop_if(|above| above.0 > group.0) {
            let total = above * size as f64 + group.0 * group.1 as f64;
            group = (total / (size + group.1) as f64, size + group.1);
        }
        groups.push(group);
    }
    let last = heights.len().saturating_sub(1) as f64;
    let lowest = (bottom - last * pitch).max(top);
    let reduced = groups
        .into_iter()
        .flat_map(|(height, size)| std::iter::repeat_n(height.clamp(top, lowest), size));
    reduced
        .enumerate()
        .map(|(index, height)| height + index as f64 * pitch)
        .collect()
}

/// Points of a curve, and points between them where they are far apart; the last first.
fn places_along(points: &[Point]) -> impl Iterator<Item = Point> {
    points.windows(2).rev().flat_map(|ends| {
        let (from, to) = (ends[0], ends[1]);
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let parts = (x.hypot(y) / STEP).ceil().max(1.0) as u32;
        (0..parts).rev().map(move |part| {
            let share = f64::from(part) / f64::from(parts);
            (from.0 + share * x, from.1 + share * y)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_are_moved_apart_and_keep_their_order() {
        let bounds = (0.0, 100.0);
        assert_eq!(spread(&[10.0, 50.0], 15.0, bounds), [10.0, 50.0]);
        let around = spread(&[50.0, 50.0, 50.0, 90.0], 10.0, bounds);
        assert_eq!(around, [40.0, 50.0, 60.0, 90.0]);
        assert_eq!(spread(&[100.0, 100.0], 15.0, bounds), [85.0, 100.0]);
        assert_eq!(spread(&[0.0, 0.0, 3.0], 15.0, bounds), [0.0, 15.0, 30.0]);
    }
}
