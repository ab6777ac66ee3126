//! A shape before it is rounded: its size, and the hull of a polyhedron, which takes milliseconds
//! and is made once.

use super::shape::Shape;
use crate::shape::{RegularSolid, ShapeError, SharpPolyhedron, SpheroPolyhedron};
use nalgebra::Vector3;

/// A shape that is sound, with what its rounding needs.
#[derive(Debug, Clone)]
pub(super) struct SharpShape {
    shape: Shape,
    form: Form,
    size: Size,
}

#[derive(Debug, Clone)]
enum Form {
    Cuboid { sides_m: [f64; 3] },
    Hull(SharpPolyhedron),
    Ball { radius_m: f64 },
    Capsule { radius_m: f64, length_m: f64 },
}

/// Size of a shape; of a cube both are its side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Size {
    /// Diameter of the largest ball inside [m].
    pub(super) thickness_m: f64,
    /// Longest side of a box, or of the box round a ball or capsule; of other shapes the largest
    /// distance of two places [m]. A body whose centre is this far from a plane is clear of it.
    pub(super) length_m: f64,
}

impl SharpShape {
    /// The shape, if it encloses a volume.
    pub(super) fn of(shape: Shape) -> Result<Self, ShapeError> {
        let of_cuboid = |sides_m| (Form::Cuboid { sides_m }, Size::of_box(sides_m));
        let of_hull = |hull: SharpPolyhedron| {
            let size = Size::of_hull(&hull);
            (Form::Hull(hull), size)
        };
        let (form, size) = match &shape {
            Shape::Cube { side_m } => of_cuboid([*side_m; 3]),
            Shape::Box { sides_m } => of_cuboid(*sides_m),
            Shape::Regular {
                solid: solid @ RegularSolid::Cube,
                size_m,
            } => {
                let size = Size::of_hull(&SharpPolyhedron::regular(*solid, *size_m)?);
                let sides_m = [*size_m; 3];
                (Form::Cuboid { sides_m }, size)
            }
            Shape::Regular { solid, size_m } => of_hull(SharpPolyhedron::regular(*solid, *size_m)?),
            Shape::Polyhedron { vertices_m } => {
                let vertices: Vec<_> = vertices_m.iter().copied().map(Vector3::from).collect();
                of_hull(SharpPolyhedron::hull_of(&vertices)?)
            }
            &Shape::Ball { radius_m } => {
                let size = Size::of_box([2.0 * radius_m; 3]);
                (Form::Ball { radius_m }, size)
            }
            &Shape::Capsule { radius_m, length_m } => {
                let thickness_m = 2.0 * radius_m;
                let size = Size::of_box([length_m, thickness_m, thickness_m]);
                (Form::Capsule { radius_m, length_m }, size)
            }
        };
        Ok(Self { shape, form, size })
    }

    pub(super) fn shape(&self) -> &Shape {
        &self.shape
    }

    pub(super) fn size(&self) -> Size {
        self.size
    }

    /// The solid, rounded with a radius [m]; a ball and a capsule with their own.
    pub(super) fn rounded(&self, sphero_radius_m: f64) -> Result<SpheroPolyhedron, ShapeError> {
        match &self.form {
            Form::Cuboid { sides_m } => SpheroPolyhedron::cuboid(*sides_m, sphero_radius_m),
            Form::Hull(hull) => hull.rounded(sphero_radius_m),
            Form::Ball { radius_m } => SpheroPolyhedron::ball(*radius_m),
            Form::Capsule { radius_m, length_m } => SpheroPolyhedron::capsule(*radius_m, *length_m),
        }
    }
}

impl Size {
    fn of_box(sides_m: [f64; 3]) -> Self {
        Self {
            thickness_m: sides_m.into_iter().fold(f64::INFINITY, f64::min),
            length_m: sides_m.into_iter().fold(0.0, f64::max),
        }
    }

    fn of_hull(hull: &SharpPolyhedron) -> Self {
        Self {
            thickness_m: 2.0 * hull.inradius(),
            length_m: hull.diameter(),
        }
    }
}
