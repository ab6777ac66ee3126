//! The bed: the ground under flow and bodies. All that places, holds, guards or draws something
//! asks it for heights and normals, and knows neither inclination nor slope break.

use crate::grid::{BLOCK, first_node};
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::method::METHOD;
use nalgebra::UnitQuaternion;
use std::fmt::Debug;

mod height_field;
mod planar;
mod spline_surface;

pub use height_field::{
    GroundFeature, GroundPlace, HeightField, NearGround, PlacedSolid, TerrainFriction,
};
pub use planar::PlanarBed;
pub use spline_surface::{Facet, Lid, SplineSurface};

/// A plane surface; its normal points to the side of the flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Name in messages.
    pub name: &'static str,
    /// Unit normal to the side of the flow.
    pub normal: Vec3,
    /// normal · x of its places [m].
    pub offset: f64,
    /// Coulomb friction of the flow.
    pub flow_friction: f64,
}

impl Plane {
    /// Height of a place above the plane [m]; negative behind it.
    pub fn height(&self, x: &Vec3) -> f64 {
        self.normal.dot(x) - self.offset
    }

    /// Least height above the plane [m] of the box between these corners.
    pub fn height_of_box(&self, low: &Vec3, high: &Vec3) -> f64 {
        let lowest = |normal, low, high| if normal > 0.0 { low } else { high };
        self.height(&self.normal.zip_zip_map(low, high, lowest))
    }

    /// Elevation [m] of the centre of a body above (x, y) that reaches so far [m] against the
    /// normal and touches the plane.
    pub fn lowest_centre(&self, reach: f64, x: f64, y: f64) -> f64 {
        (reach + self.offset - x * self.normal.x - y * self.normal.y) / self.normal.z
    }
}

/// Surface that stops inflow and applies Coulomb friction to nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Unit normal out of the bed.
    pub normal: Vec3,
    /// Coulomb friction of the flow.
    pub friction: f64,
}

/// Surfaces that act on a node alone, at most: those of a corner.
pub const MOST_SURFACES: usize = 3;

/// Directions of the columns of nodes through a bed: along the axis closest to its normal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Way {
    /// Along x, on a steep bed. These come first, so that the floor has the last word.
    Horizontal,
    /// Along z.
    Vertical,
}

impl Way {
    /// Its axis.
    pub fn axis(self) -> usize {
        match self {
            Self::Horizontal => 0,
            Self::Vertical => 2,
        }
    }

    /// Direction of the columns through a bed with this normal.
    pub fn through(normal: &Vec3) -> Self {
        if normal.x.abs() > METHOD.boundary.steep * normal.z {
            Self::Horizontal
        } else {
            Self::Vertical
        }
    }
}

/// Intersection of a column of nodes with the bed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Intersection {
    /// Its distance behind the first node above the bed [node distances].
    pub gap: f64,
    /// Index of that node along the column.
    pub first: i32,
    /// Nodes behind the first up to which this intersection acts: a deeper one has mass only from
    /// beside a cliff.
    pub deepest: i32,
}

impl Intersection {
    /// Intersection so many node distances from node 0.
    fn at(cells: f64) -> Self {
        // A node on the bed up to rounding is above it.
        let first = (cells - 1e-9 * (1.0 + cells.abs())).ceil();
        Self {
            gap: (first - cells).max(0.0),
            first: first as i32,
            deepest: i32::MAX,
        }
    }

    /// The same for so many nodes behind the first at most.
    fn up_to(self, deepest: i32) -> Self {
        Self { deepest, ..self }
    }
}

/// The bed as a node meets it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BedAtNode {
    /// True if surfaces of the bed are on or above the node.
    pub covers: bool,
    /// Share of the node's kernel above it.
    pub share_above: f64,
    /// Intersection with the horizontal column of the node.
    pub horizontal: Option<Intersection>,
    /// Intersection with the vertical column of the node.
    pub vertical: Option<Intersection>,
}

impl BedAtNode {
    /// Intersections with the columns of a node, in the order in which they act.
    pub fn intersections(&self) -> impl Iterator<Item = (Way, Intersection)> {
        let all = [
            (Way::Horizontal, self.horizontal),
            (Way::Vertical, self.vertical),
        ];
        all.into_iter().filter_map(|(way, of)| Some((way, of?)))
    }
}

/// Height of a node above the bed [m] up to which it belongs to it.
fn rounding(x: &Vec3) -> f64 {
    1e-9 * (1.0 + x.norm())
}

/// The first and the last node of a block [m].
fn nodes_of(block: [i32; 3], lattice: &Lattice) -> (Vec3, Vec3) {
    let first = first_node(block);
    let last = first.map(|along| along + BLOCK as i32 - 1);
    (lattice.position(first), lattice.position(last))
}

/// The ground under flow and bodies: one elevation for every place in the plane.
pub trait Bed: Debug + Send + Sync {
    /// Elevation at (x, y) [m].
    fn elevation(&self, x: f64, y: f64) -> f64;

    /// Plane that touches it at (x, y).
    fn tangent(&self, x: f64, y: f64) -> Plane;

    /// Rotation that lays a horizontal body flat on it at (x, y), without a turn about the normal.
    fn tilt(&self, x: f64, y: f64) -> UnitQuaternion<f64>;

    /// Planes of which it is the upper envelope, as bodies and points meet it; none if it is no
    /// bed of planes.
    fn planes(&self) -> &[Plane];

    /// Its surface as bodies and points meet it, if it is a terrain.
    fn height_field(&self) -> Option<&HeightField> {
        None
    }

    /// Share of a node's kernel above it (its available volume).
    fn share_above(&self, index: [i32; 3], lattice: &Lattice) -> f64;

    /// Intersection with the column of nodes in this direction, by its indices across it; `None`
    /// if the bed has no columns of this direction.
    fn intersection(&self, way: Way, across: [i32; 2], lattice: &Lattice) -> Option<Intersection>;

    /// The bed at that intersection, averaged with the transfer's kernel.
    fn surface_in(&self, way: Way, across: [i32; 2], lattice: &Lattice) -> Option<Surface>;

    /// Surfaces that a node is on or below and that act on it alone, in the order in which they act.
    fn surfaces_over(&self, index: [i32; 3], lattice: &Lattice)
    -> [Option<Surface>; MOST_SURFACES];

    /// True if there are such surfaces.
    fn covers(&self, index: [i32; 3], lattice: &Lattice) -> bool;

    /// The bed as a node meets it.
    fn at_node(&self, index: [i32; 3], lattice: &Lattice) -> BedAtNode {
        let [i, j, k] = index;
        BedAtNode {
            covers: self.covers(index, lattice),
            share_above: self.share_above(index, lattice),
            horizontal: self.intersection(Way::Horizontal, [j, k], lattice),
            vertical: self.intersection(Way::Vertical, [i, j], lattice),
        }
    }

    /// Unit normal at (x, y).
    fn normal(&self, x: f64, y: f64) -> Vec3 {
        self.tangent(x, y).normal
    }

    /// True if it may come nearer than `margin` [m] to a node of a block.
    fn is_near_block(&self, block: [i32; 3], lattice: &Lattice, margin: f64) -> bool {
        let (low, high) = nodes_of(block, lattice);
        let is_near = |plane: &Plane| plane.height_of_box(&low, &high) <= margin;
        self.planes().iter().any(is_near)
    }

    /// True if it comes nearer than `margin` [m] to a node.
    fn is_near_node(&self, index: [i32; 3], lattice: &Lattice, margin: f64) -> bool {
        let x = lattice.position(index);
        self.planes().iter().any(|plane| plane.height(&x) <= margin)
    }
}
