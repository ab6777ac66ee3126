//! Steiner's formulas for a convex polyhedron dilated by a sphere.

use super::face::{Face, sides};
use super::polyhedron::{ConvexPolyhedron, Edge};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Volume of the dilated polyhedron [m³].
pub(super) fn volume(core: &ConvexPolyhedron, radius: f64) -> f64 {
    let faces = core.faces().iter();
    let surface: f64 = faces.clone().map(|face| face_area(core, face)).sum();
    let inside: f64 = faces
        .map(|face| face_area(core, face) * face.offset / 3.0)
        .sum();
    let bend: f64 = core
        .edges()
        .iter()
        .map(|edge| edge.length * (PI - edge.interior_dihedral))
        .sum();
    inside + surface * radius + bend * radius.powi(2) / 2.0 + 4.0 / 3.0 * PI * radius.powi(3)
}

/// Its surface [m²], the volume's derivative by the radius.
pub(super) fn surface(core: &ConvexPolyhedron, radius: f64) -> f64 {
    let flats: f64 = core.faces().iter().map(|face| face_area(core, face)).sum();
    let bend = |edge: &Edge| edge.length * (PI - edge.interior_dihedral);
    let bent: f64 = core.edges().iter().map(bend).sum();
    flats + bent * radius + 4.0 * PI * radius.powi(2)
}

/// Area of a face [m²].
fn face_area(core: &ConvexPolyhedron, face: &Face) -> f64 {
    let corner = |v: usize| core.vertices()[v];
    let fan: Vector3<f64> = sides(&face.vertices)
        .map(|(a, b)| corner(a).cross(&corner(b)))
        .sum();
    fan.dot(&face.normal) / 2.0
}
