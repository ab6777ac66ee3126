//! A curve on the sheet.

use crate::pictures::canvas::{Area, PictureError, px, width as stroke};
use crate::pictures::labels::{Badge, Point, RADIUS};
use crate::pictures::style::Style;
use plotters::prelude::*;

/// Width of a curve [px].
const SINGLE: f64 = 1.8;
/// Width of a double curve, and of the white within it [px].
const DOUBLE: (f64, f64) = (3.2, 1.2);
/// Width of a grey curve [px].
const GREY: f64 = 1.0;
/// Radius of a mark [px].
const MARK: f64 = 3.4;
/// Points nearer to the one before than this are left out [px].
const FINEST: f64 = 0.4;
/// Between a curve and the badge that stands in it [px].
const GAP: f64 = 1.5;

/// Curve of one body.
#[derive(Debug)]
pub(super) struct Line {
    pub body: usize,
    pub style: Style,
    pub points: Vec<Point>,
    /// Marked points, with their texts.
    pub marks: Vec<(Point, String)>,
}

impl Line {
    /// Draws the curve and its marks, with a gap for a badge.
    pub(super) fn draw(&self, sheet: &Area<'_>, badge: Option<Badge>) -> Result<(), PictureError> {
        let parts = match badge {
            Some(badge) => around(&self.points, badge.centre, RADIUS + GAP),
            None => vec![self.points.clone()],
        };
        for part in parts {
            let path: Vec<_> = part.into_iter().map(|(x, y)| (px(x), px(y))).collect();
            let draw = |width: f64, color: RGBColor| {
                let style = color.stroke_width(stroke(width));
                sheet.draw(&PathElement::new(path.clone(), style))
            };
            if self.style.is_grey() {
                draw(GREY, self.style.color)?;
            } else if self.style.is_double() {
                draw(DOUBLE.0, self.style.color)?;
                draw(DOUBLE.1, WHITE)?;
            } else {
                draw(SINGLE, self.style.color)?;
            }
        }
        for ((x, y), _) in &self.marks {
            let at = (px(*x), px(*y));
            sheet.draw(&Circle::new(at, stroke(MARK + 1.2), WHITE.filled()))?;
            sheet.draw(&Circle::new(at, stroke(MARK), self.style.color.filled()))?;
        }
        Ok(())
    }
}

/// Points that can be told apart, the last of them included.
pub(super) fn thinned(points: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::new();
    let mut skipped = None;
    for point in points {
        let apart = |last: &Point| (point.0 - last.0).hypot(point.1 - last.1) >= FINEST;
        if kept.last().is_none_or(apart) {
            kept.push(point);
            skipped = None;
        } else {
            skipped = Some(point);
        }
    }
    kept.extend(skipped);
    kept
}

/// The parts of a curve outside a disc.
fn around(points: &[Point], centre: Point, radius: f64) -> Vec<Vec<Point>> {
    let mut parts = vec![Vec::new()];
    for ends in points.windows(2) {
        let (from, to) = (ends[0], ends[1]);
        let at = |share: f64| {
            (
                from.0 + share * (to.0 - from.0),
                from.1 + share * (to.1 - from.1),
            )
        };
        let Some((entry, exit)) = within(from, to, centre, radius) else {
            extend(&mut parts, &[from, to]);
            continue;
        };
        if entry > 0.0 {
            extend(&mut parts, &[from, at(entry)]);
        }
        parts.push(Vec::new());
        if exit < 1.0 {
            extend(&mut parts, &[at(exit), to]);
        }
    }
    parts.retain(|part| !part.is_empty());
    parts
}

/// Adds a segment to the last part, whose end it continues.
fn extend(parts: &mut [Vec<Point>], segment: &[Point; 2]) {
    if let Some(part) = parts.last_mut() {
        let known = usize::from(!part.is_empty());
        part.extend(&segment[known..]);
    }
}

/// Shares of a segment at which it enters and leaves a disc; none if it stays outside.
fn within(from: Point, to: Point, centre: Point, radius: f64) -> Option<(f64, f64)> {
    let (x, y) = (to.0 - from.0, to.1 - from.1);
    let (u, v) = (from.0 - centre.0, from.1 - centre.1);
    // |from + share (to − from) − centre|² = radius².
    let (a, half_b, c) = (
        x * x + y * y,
        u * x + v * y,
        u * u + v * v - radius * radius,
    );
    let root = (half_b * half_b - a * c).sqrt();
    if a == 0.0 || root.is_nan() {
        return None;
    }
    let (entry, exit) = ((-half_b - root) / a, (-half_b + root) / a);
    (entry < 1.0 && exit > 0.0).then_some((entry, exit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_interrupted_where_its_badge_stands() {
        let curve = [(0.0, 0.0), (10.0, 0.0), (11.0, 0.0), (30.0, 0.0)];
        let parts = around(&curve, (11.0, 0.0), 3.0);
        assert_eq!(
            parts,
            [vec![(0.0, 0.0), (8.0, 0.0)], vec![(14.0, 0.0), (30.0, 0.0)]]
        );
        assert_eq!(around(&curve, (11.0, 5.0), 3.0), [curve.to_vec()]);
        assert!(around(&curve[1..3], (11.0, 0.0), 3.0).is_empty());
    }

    #[test]
    fn the_last_point_is_never_left_out() {
        let points = [(0.0, 0.0), (0.1, 0.0), (1.0, 0.0), (1.1, 0.0)];
        let kept = thinned(points.into_iter());
        assert_eq!(kept, [(0.0, 0.0), (1.0, 0.0), (1.1, 0.0)]);
    }
}
