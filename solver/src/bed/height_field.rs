//! A bed given by a height map: a terrain (docs/method.md, section 14).
//!
//! Columns of nodes cross it along the vertical. As in a bed of planes, slope and friction of a
//! column are averaged with the transfer's kernel, so that the flow does not feel where the nodes
//! lie on the map.

use super::{Bed, Intersection, Plane, SplineSurface, Surface, Way};
use crate::kernel::{Lattice, share_above};
use crate::math::Vec3;
use crate::raster::Raster;
use nalgebra::UnitQuaternion;
use std::sync::Arc;

mod columns;
mod near;

use columns::{Column, Columns};
pub use near::{GroundFeature, GroundPlace, NearGround, PlacedSolid};

/// Name of the terrain in messages.
const NAME: &str = "terrain";

/// Coulomb friction between flow and terrain.
#[derive(Debug, Clone, PartialEq)]
pub enum TerrainFriction {
    /// The same everywhere.
    Constant(f64),
    /// A value for each cell of a map.
    PerCell {
        /// The map.
        map: Arc<Raster>,
        /// Easting and northing of the surface's origin [m].
        origin: [f64; 2],
    },
}

impl TerrainFriction {
    /// Friction at (x, y) [m]: that of the cell, beyond the raster that of the nearest.
    fn at(&self, x: f64, y: f64) -> f64 {
        match self {
            Self::Constant(friction) => *friction,
            Self::PerCell { map, origin } => map.nearest(origin[0] + x, origin[1] + y),
        }
    }
}

/// Ground with one elevation for every place: a smooth surface through a height map.
#[derive(Debug)]
pub struct HeightField {
    surface: Arc<SplineSurface>,
    friction: TerrainFriction,
    /// Columns of the grid, found when the flow first comes there.
    columns: Option<Columns>,
}

impl HeightField {
    /// Ground with this surface.
    pub fn new(surface: Arc<SplineSurface>, friction: TerrainFriction) -> Self {
        Self {
            surface,
            friction,
            columns: None,
        }
    }

    /// The same as bed of a flow on a lattice.
    pub fn under(self, lattice: &Lattice) -> Self {
        Self {
            columns: Some(Columns::of(lattice, self.surface.extent())),
            ..self
        }
    }

    /// Its surface.
    pub fn surface(&self) -> &SplineSurface {
        &self.surface
    }

    /// Plane that touches the surface nearest to a place [m], by two steps of Newton's method from
    /// the place under it; exact on a plane.
    pub fn nearest_plane(&self, place: &Vec3) -> Plane {
        let mut plane = self.touching(place.x, place.y);
        for _ in 0..2 {
            let foot = place - plane.normal * plane.height(place);
            plane = self.touching(foot.x, foot.y);
        }
        plane
    }

    /// Plane that touches the surface at (x, y), without friction.
    fn touching(&self, x: f64, y: f64) -> Plane {
        let facet = self.surface.at(x, y);
        let normal = upward(facet.slope);
        Plane {
            name: NAME,
            normal,
            offset: normal.dot(&Vec3::new(x, y, facet.elevation)),
            flow_friction: 0.0,
        }
    }

    fn column(&self, across: [i32; 2], lattice: &Lattice) -> Column {
        let compute = || Column::over(&self.surface, &self.friction, across, lattice);
        match &self.columns {
            Some(columns) => columns.at(across, |across| {
                Column::over(&self.surface, &self.friction, across, lattice)
            }),
            None => compute(),
        }
    }

    /// The column of nodes nearest to a place, which lies on it.
    fn column_of(&self, x: &Vec3, spacing: &Vec3) -> Option<Column> {
        let columns = self.columns.as_ref()?;
        debug_assert_eq!(columns.lattice.spacing, *spacing);
        let lattice = &columns.lattice;
        let index = |axis: usize| ((x[axis] - lattice.origin[axis]) / spacing[axis]).round() as i32;
        Some(self.column([index(0), index(1)], lattice))
    }
}

/// Unit normal of a surface with this slope.
fn upward(slope: [f64; 2]) -> Vec3 {
    Vec3::new(-slope[0], -slope[1], 1.0).normalize()
}

impl Bed for HeightField {
    fn elevation(&self, x: f64, y: f64) -> f64 {
        self.surface.elevation(x, y)
    }

    fn tangent(&self, x: f64, y: f64) -> Plane {
        Plane {
            flow_friction: self.friction.at(x, y),
            ..self.touching(x, y)
        }
    }

    fn tilt(&self, x: f64, y: f64) -> UnitQuaternion<f64> {
        let normal = self.normal(x, y);
        UnitQuaternion::rotation_between(&Vec3::z(), &normal).unwrap_or_default()
    }

    fn planes(&self) -> &[Plane] {
        &[]
    }

    fn height_field(&self) -> Option<&HeightField> {
        Some(self)
    }

    fn share_above(&self, x: &Vec3, spacing: &Vec3) -> f64 {
        let Some(column) = self.column_of(x, spacing) else {
            return 1.0;
        };
        let normal = upward(column.slope);
        // The kernel is as wide along a slant as along its axes.
        let width = normal.component_mul(spacing).norm();
        share_above((x.z - column.mean_elevation) * normal.z / width)
    }

    fn intersection(&self, way: Way, across: [i32; 2], lattice: &Lattice) -> Option<Intersection> {
        if way == Way::Horizontal {
            return None;
        }
        let elevation = self.column(across, lattice).elevation;
        let cells = (elevation - lattice.origin.z) / lattice.spacing.z;
        Some(Intersection::at(cells))
    }

    fn surface_in(&self, way: Way, across: [i32; 2], lattice: &Lattice) -> Option<Surface> {
        (way == Way::Vertical).then(|| self.column(across, lattice).surface())
    }

    fn surfaces_over(&self, index: [i32; 3], lattice: &Lattice) -> [Option<Surface>; 2] {
        let over = || self.column([index[0], index[1]], lattice).surface();
        [self.covers(index, lattice).then(over), None]
    }

    fn covers(&self, index: [i32; 3], lattice: &Lattice) -> bool {
        let column = self.column([index[0], index[1]], lattice);
        let x = lattice.position(index);
        x.z - column.elevation <= super::rounding(&x)
    }

    fn is_near(&self, low: &Vec3, high: &Vec3, margin: f64) -> bool {
        if low == high {
            let facet = self.surface.at(low.x, low.y);
            return (low.z - facet.elevation) * upward(facet.slope).z <= margin;
        }
        let (highest, steepest) = self.surface.bounds([low.x, low.y], [high.x, high.y]);
        low.z - highest <= margin * 1f64.hypot(steepest)
    }
}

#[cfg(test)]
mod tests;
