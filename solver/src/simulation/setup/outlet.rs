//! Open ends of the ground, where flow leaves.

use crate::math::Vec3;

/// Open ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outlet {
    /// That of a channel, at this x [m]; infinite without one.
    End(f64),
    /// The edges of a terrain, which reaches from the origin so far along x and y [m].
    Edges([f64; 2]),
}

impl Outlet {
    /// True if a place is beyond them.
    pub fn is_beyond(&self, place: &Vec3) -> bool {
        self.distance(place) < 0.0
    }

    /// Horizontal distance of a place from them [m]; negative beyond.
    pub fn distance(&self, place: &Vec3) -> f64 {
        match self {
            Self::End(end) => end - place.x,
            Self::Edges(extent) => {
                let along = |axis: usize| place[axis].min(extent[axis] - place[axis]);
                along(0).min(along(1))
            }
        }
    }
}
