//! A bed given by a height map: a terrain (docs/method.md, section 14).
//!
//! Columns of nodes cross it along the vertical. As in a bed of planes, slope and friction of a
//! column are averaged with the transfer's kernel, so that the flow does not feel where the nodes
//! lie on the map.

use super::{
    Bed, BedAtNode, Facet, Intersection, Lid, MOST_SURFACES, Plane, SplineSurface, Surface, Way,
    nodes_of,
};
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::raster::Raster;
use nalgebra::UnitQuaternion;
use std::borrow::Cow;
use std::sync::Arc;

mod cliffs;
mod columns;
mod near;
mod nearest;
mod tiles;

use columns::Column;
pub use near::{GroundFeature, GroundPlace, NearGround, PlacedSolid};
use tiles::{Terrain, Tiles};

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
    /// Parts that the flow's grid has come to.
    tiles: Option<Tiles>,
}

impl HeightField {
    /// Ground with this surface.
    pub fn new(surface: Arc<SplineSurface>, friction: TerrainFriction) -> Self {
        Self {
            surface,
            friction,
            tiles: None,
        }
    }

    /// Ground as bed of a flow on a lattice.
    pub fn under(self, lattice: &Lattice) -> Self {
        Self {
            tiles: Some(Tiles::of(lattice, self.surface.extent())),
            ..self
        }
    }

    /// Its surface.
    pub fn surface(&self) -> &SplineSurface {
        &self.surface
    }

    /// Height of a place [m] above the plane that touches the surface straight below it [m], and that
    /// plane's unit normal.
    pub fn over_touching(&self, place: &Vec3) -> (f64, Vec3) {
        let facet = self.surface.at(place.x, place.y);
        let normal = upward(facet.slope);
        ((place.z - facet.elevation) * normal.z, normal)
    }

    /// Plane above the places of a block's points within a step, and of its nodes.
    pub fn lid_over(&self, block: [i32; 2], lattice: &Lattice) -> Lid {
        let terrain = self.terrain();
        let known = (self.tiles.as_ref()).and_then(|tiles| tiles.lid(block, &terrain));
        known.unwrap_or_else(|| terrain.lid(block, lattice))
    }

    /// The column of nodes with these indices.
    fn column(&self, across: [i32; 2], lattice: &Lattice) -> Cow<'_, Column> {
        let terrain = self.terrain();
        let known = (self.tiles.as_ref()).and_then(|tiles| tiles.column(across, &terrain));
        known.map_or_else(
            || Cow::Owned(terrain.column(across, lattice)),
            Cow::Borrowed,
        )
    }

    fn terrain(&self) -> Terrain<'_> {
        Terrain {
            surface: &self.surface,
            friction: &self.friction,
        }
    }
}

/// Unit normal of a surface with this slope.
fn upward(slope: [f64; 2]) -> Vec3 {
    let up = Vec3::new(-slope[0], -slope[1], 1.0);
    up * (1.0 / up.norm())
}

impl Bed for HeightField {
    fn elevation(&self, x: f64, y: f64) -> f64 {
        self.surface.elevation(x, y)
    }

    fn tangent(&self, x: f64, y: f64) -> Plane {
        let facet = self.surface.at(x, y);
        let normal = upward(facet.slope);
        Plane {
            name: NAME,
            normal,
            offset: normal.dot(&Vec3::new(x, y, facet.elevation)),
            flow_friction: self.friction.at(x, y),
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

    fn share_above(&self, index: [i32; 3], lattice: &Lattice) -> f64 {
        self.at_node(index, lattice).share_above
    }

    fn intersection(&self, way: Way, across: [i32; 2], lattice: &Lattice) -> Option<Intersection> {
        match way {
            Way::Horizontal => None,
            Way::Vertical => self.column(across, lattice).intersection,
        }
    }

    fn at_node(&self, index: [i32; 3], lattice: &Lattice) -> BedAtNode {
        let column = self.column([index[0], index[1]], lattice);
        let node = lattice.position(index);
        BedAtNode {
            covers: column.covers(&node),
            share_above: column.share_above(node.z),
            horizontal: None,
            vertical: column.intersection,
        }
    }

    fn surface_in(&self, way: Way, across: [i32; 2], lattice: &Lattice) -> Option<Surface> {
        (way == Way::Vertical).then(|| self.column(across, lattice).surface)
    }

    fn surfaces_over(
        &self,
        index: [i32; 3],
        lattice: &Lattice,
    ) -> [Option<Surface>; MOST_SURFACES] {
        let column = self.column([index[0], index[1]], lattice);
        let in_column = |at: Intersection| at.first - index[2] <= at.deepest;
        match column.intersection {
            _ if !column.covers(&lattice.position(index)) => [None; MOST_SURFACES],
            Some(at) if in_column(at) => [Some(column.surface), None, None],
            _ => self.surfaces_round(index, lattice),
        }
    }

    fn covers(&self, index: [i32; 3], lattice: &Lattice) -> bool {
        self.at_node(index, lattice).covers
    }

    fn is_near_block(&self, block: [i32; 3], lattice: &Lattice, margin: f64) -> bool {
        let lid = self.lid_over([block[0], block[1]], lattice);
        let (low, high) = nodes_of(block, lattice);
        // Along the vertical a margin is longer than along the normal.
        lid.height_of_box(&low, &high) <= margin * 1f64.hypot(lid.steepest)
    }

    fn is_near_node(&self, index: [i32; 3], lattice: &Lattice, margin: f64) -> bool {
        let column = self.column([index[0], index[1]], lattice);
        let height = lattice.position(index).z - column.facet.elevation;
        height * column.surface.normal.z <= margin
    }
}

#[cfg(test)]
mod tests;
