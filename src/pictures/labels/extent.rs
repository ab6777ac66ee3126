//! Extents of labels.

/// A place on the sheet (x, y) [px], y downwards.
pub(in crate::pictures) type Point = (f64, f64);

/// An upright rectangle on the sheet [px].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::pictures) struct Extent {
    pub(in crate::pictures) left: f64,
    pub(in crate::pictures) top: f64,
    pub(in crate::pictures) right: f64,
    pub(in crate::pictures) bottom: f64,
}

impl Extent {
    /// The extent of this size around a centre.
    pub(in crate::pictures) fn around(centre: Point, (width, height): (f64, f64)) -> Self {
        Self {
            left: centre.0 - width / 2.0,
            top: centre.1 - height / 2.0,
            right: centre.0 + width / 2.0,
            bottom: centre.1 + height / 2.0,
        }
    }

    /// The extent of points; none of none.
    pub(in crate::pictures) fn of(points: &[Point]) -> Option<Self> {
        let around = |at: &Point| Self::around(*at, (0.0, 0.0));
        points.iter().map(around).reduce(|all, one| Self {
            left: all.left.min(one.left),
            top: all.top.min(one.top),
            right: all.right.max(one.right),
            bottom: all.bottom.max(one.bottom),
        })
    }

    /// The same with a margin on every side.
    pub(in crate::pictures) fn with_margin(self, margin: f64) -> Self {
        Self {
            left: self.left - margin,
            top: self.top - margin,
            right: self.right + margin,
            bottom: self.bottom + margin,
        }
    }

    /// The same, moved by as little as puts it into a field, if it fits.
    pub(in crate::pictures) fn moved_into(self, field: Self) -> Self {
        let into = |low: f64, high: f64, least: f64, most: f64| {
            (least - low).max(0.0) + (most - high).min(0.0)
        };
        let x = into(self.left, self.right, field.left, field.right);
        let y = into(self.top, self.bottom, field.top, field.bottom);
        Self {
            left: self.left + x,
            top: self.top + y,
            right: self.right + x,
            bottom: self.bottom + y,
        }
    }

    /// The point of it nearest to another point.
    pub(in crate::pictures) fn nearest(&self, to: Point) -> Point {
        (
            to.0.clamp(self.left, self.right),
            to.1.clamp(self.top, self.bottom),
        )
    }
}
