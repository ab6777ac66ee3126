//! Conditions under which vertices and loops form a convex solid.

use super::error::ShapeError;
use super::face::{Face, sides};
use nalgebra::Vector3;

/// Lengths below this fraction of the solid's size count as zero: far above
/// the rounding of f64 coordinates (1e-16), far below any feature that matters.
const NO_LENGTH: f64 = 1e-9;
/// Distance of a face's vertex from its plane that is allowed, over the size. A vertex that
/// stands for two nearer to each other than the smallest feature is in the planes of one only,
/// and a little off those of the other: up to 5e-9 in boulders drawn at random.
const FLATNESS: f64 = 1e-8;
/// Distance of a vertex behind a face that it is not part of, as a fraction of the solid's
/// size. Much less than the flatness, so that a vertex whose coordinates are ambiguous may be
/// part of a face or not.
const BEHIND: f64 = 1e-12;

/// Indices exist, loops have no repetitions, and coordinates are finite.
pub(super) fn loops(vertices: &[Vector3<f64>], loops: &[Vec<usize>]) -> Result<(), ShapeError> {
    if vertices.len() < 4 || loops.len() < 4 {
        return Err(ShapeError::TooFew {
            vertices: vertices.len(),
            faces: loops.len(),
        });
    }
    if let Some(vertex) = vertices
        .iter()
        .position(|v| !v.iter().all(|c| c.is_finite()))
    {
        return Err(ShapeError::NotFinite { vertex });
    }
    match loops.iter().position(|l| !is_loop(l, vertices.len())) {
        Some(face) => Err(ShapeError::BadLoop { face }),
        None => Ok(()),
    }
}

fn is_loop(vertex_loop: &[usize], vertices: usize) -> bool {
    let mut sorted = vertex_loop.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    vertex_loop.len() >= 3
        && sorted.len() == vertex_loop.len()
        && sorted.last().is_some_and(|&largest| largest < vertices)
}

/// Euler's formula for a surface topologically equal to a sphere.
pub(super) fn euler(vertices: usize, edges: usize, faces: usize) -> Result<(), ShapeError> {
    if vertices + faces == edges + 2 {
        Ok(())
    } else {
        Err(ShapeError::NotABall {
            vertices,
            edges,
            faces,
        })
    }
}

/// Every face is a flat convex polygon with all other vertices behind it.
pub(super) fn convex(vertices: &[Vector3<f64>], faces: &[Face]) -> Result<(), ShapeError> {
    let size = extent(vertices);
    for (index, face) in faces.iter().enumerate() {
        if !is_flat_and_convex(vertices, face, size) {
            return Err(ShapeError::BadFace { face: index });
        }
        let in_front = |v: &usize| face.normal.dot(&vertices[*v]) - face.offset > -BEHIND * size;
        let stranger = (0..vertices.len())
            .filter(|v| !face.vertices.contains(v))
            .find(in_front);
        if let Some(vertex) = stranger {
            return Err(ShapeError::NotConvex {
                face: index,
                vertex,
            });
        }
    }
    Ok(())
}

/// Largest distance of a vertex from the first one [m].
pub(super) fn extent(vertices: &[Vector3<f64>]) -> f64 {
    vertices
        .iter()
        .map(|v| (v - vertices[0]).norm())
        .fold(0.0, f64::max)
}

/// True if no vertex is off the plane, and every other vertex of the face strictly to the left
/// of every side.
fn is_flat_and_convex(vertices: &[Vector3<f64>], face: &Face, size: f64) -> bool {
    let height = |v: usize| (face.normal.dot(&vertices[v]) - face.offset).abs();
    let flat = |&v: &usize| height(v) <= FLATNESS * size;
    let tolerance = NO_LENGTH * size;
    let left_of_side = |(a, b): (usize, usize)| {
        let side = vertices[b] - vertices[a];
        let inward = face.normal.cross(&side);
        let reach = tolerance * side.norm();
        side.norm() > tolerance
            && face
                .vertices
                .iter()
                .filter(|&&v| v != a && v != b)
                .all(|&v| inward.dot(&(vertices[v] - vertices[a])) > reach)
    };
    face.normal != Vector3::zeros()
        && face.vertices.iter().all(flat)
        && sides(&face.vertices).all(left_of_side)
}
