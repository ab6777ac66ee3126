//! The walls as bodies and points meet them: planes, and the surface of a terrain.

use crate::bed::{Bed, HeightField, PlacedSolid, Plane};
use crate::math::Vec3;

/// Walls that bodies and points can touch.
#[derive(Debug, Clone, Copy)]
pub struct RigidWalls<'a> {
    /// Planes.
    pub planes: &'a [Plane],
    /// Surface of a terrain, if the ground is one.
    pub terrain: Option<&'a HeightField>,
}

/// Planes of the walls at a place: those that are planes, and the one that touches the terrain
/// there.
#[derive(Debug, Clone, Copy)]
pub struct PlanesAt<'a> {
    planes: &'a [Plane],
    tangent: Option<Plane>,
}

impl<'a> RigidWalls<'a> {
    /// Walls that are planes.
    pub fn planar(planes: &'a [Plane]) -> Self {
        Self {
            planes,
            terrain: None,
        }
    }

    /// Planes at a place.
    pub fn planes_at(&self, place: &Vec3) -> PlanesAt<'a> {
        PlanesAt {
            planes: self.planes,
            tangent: self.terrain.map(|ground| ground.tangent(place.x, place.y)),
        }
    }

    /// Planes that may carry a body: of a terrain the one that touches it where the body does.
    pub fn planes_under(&self, solid: &PlacedSolid) -> PlanesAt<'a> {
        PlanesAt {
            planes: self.planes,
            tangent: self.terrain.and_then(|ground| ground.plane_under(solid)),
        }
    }
}

impl PlanesAt<'_> {
    /// Visits them.
    pub fn iter(&self) -> impl Iterator<Item = &Plane> {
        self.planes.iter().chain(&self.tangent)
    }
}
