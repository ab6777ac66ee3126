//! Boxes in which points are searched for.

use crate::grid::{BlockKey, first_node};
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::rigid::Body;

/// An axis-aligned box round a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Around {
    low: Vec3,
    high: Vec3,
}

impl Around {
    /// The box of a body, `reach` wider on every side.
    pub fn body(body: &Body, reach: f64) -> Self {
        let extent = |direction: Vec3| body.shape.extent_along(&body.to_body(&direction));
        let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
        let up = Vec3::from(axes.map(extent));
        let down = Vec3::from(axes.map(|axis| extent(-axis)));
        let reach = Vec3::repeat(reach);
        Self {
            low: body.state.position - down - reach,
            high: body.state.position + up + reach,
        }
    }

    /// The box round a vertical column of this radius [m], of infinite height.
    pub fn column(centre: Vec3, radius: f64) -> Self {
        let half = Vec3::new(radius, radius, f64::INFINITY);
        Self {
            low: centre - half,
            high: centre + half,
        }
    }

    /// The box extended to infinity across the channel.
    pub fn all_across(mut self) -> Self {
        (self.low.y, self.high.y) = (f64::NEG_INFINITY, f64::INFINITY);
        self
    }

    /// Its mirror image in the plane y = 0.
    pub fn mirrored(mut self) -> Self {
        (self.low.y, self.high.y) = (-self.high.y, -self.low.y);
        self
    }

    /// The box moved across the channel by this much [m].
    pub fn shifted(mut self, across: f64) -> Self {
        self.low.y += across;
        self.high.y += across;
        self
    }

    /// True if a place is in it.
    pub fn holds(&self, x: &Vec3) -> bool {
        (0..3).all(|axis| self.low[axis] <= x[axis] && x[axis] <= self.high[axis])
    }

    /// True if it meets the box of a block of points.
    pub fn meets(&self, lattice: &Lattice, block: &BlockKey) -> bool {
        let first = lattice.position(first_node(*block));
        let last = lattice.position(first_node(block.map(|k| k + 1)));
        (0..3).all(|axis| {
            // A point's lowest node is up to one and a half cells below it.
            let h = lattice.spacing[axis];
            self.low[axis] <= last[axis] + 0.5 * h && first[axis] + 0.5 * h <= self.high[axis]
        })
    }
}
