//! Faces of a convex polyhedron.

use nalgebra::Vector3;

/// A flat face of a convex polyhedron.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Outward unit normal n.
    pub normal: Vector3<f64>,
    /// Distance of the plane from the origin along the normal [m]: n·x = offset.
    pub offset: f64,
    /// Vertices, counter-clockwise seen from outside.
    pub vertices: Vec<usize>,
    /// Edges: number k runs between loop vertices k and k + 1.
    pub edges: Vec<usize>,
}

/// Consecutive pairs of a loop, the last one closing it.
pub(super) fn sides(vertex_loop: &[usize]) -> impl Iterator<Item = (usize, usize)> + '_ {
    let next = vertex_loop.iter().cycle().skip(1);
    vertex_loop.iter().copied().zip(next.copied())
}
