//! The nearest feature of a core by exhaustive search.

use crate::shape::closest::{Closest, Feature, on_face, outside};
use crate::shape::polyhedron::ConvexPolyhedron;
use nalgebra::Vector3;

/// The face whose plane x is farthest in front of (or least behind), and that distance.
pub(super) fn deepest_face(core: &ConvexPolyhedron, x: &Vector3<f64>) -> (usize, f64) {
    core.faces()
        .iter()
        .map(|face| face.normal.dot(x) - face.offset)
        .enumerate()
        .fold((0, f64::NEG_INFINITY), |best, next| {
            if next.1 > best.1 { next } else { best }
        })
}

/// Nearest feature by exhaustive search. Outside, the nearest point lies on a face visible from
/// x: either x is above that face, or the point is on one of its edges.
pub(super) fn by_search(core: &ConvexPolyhedron, x: &Vector3<f64>) -> Closest {
    let (deepest, height) = deepest_face(core, x);
    if height <= 0.0 || is_above(core, deepest, x) {
        return above(core, deepest, x, height);
    }
    let mut best = (f64::INFINITY, Feature::Vertex(0), Vector3::zeros());
    for (index, face) in core.faces().iter().enumerate() {
        let height = face.normal.dot(x) - face.offset;
        if height <= 0.0 {
            continue;
        }
        if is_above(core, index, x) {
            return above(core, index, x, height);
        }
        for &edge in &face.edges {
            let (feature, point) = on_edge(core, edge, x);
            let squared = (x - point).norm_squared();
            if squared < best.0 {
                best = (squared, feature, point);
            }
        }
    }
    let (_, feature, point) = best;
    outside(feature, point, x, &core.faces()[deepest].normal)
}

/// True if the foot of x on the face's plane lies within the face.
fn is_above(core: &ConvexPolyhedron, face: usize, x: &Vector3<f64>) -> bool {
    let face = &core.faces()[face];
    let corner = |k: usize| core.vertices()[face.vertices[k]];
    let count = face.vertices.len();
    (0..count).all(|k| {
        let side = corner((k + 1) % count) - corner(k);
        face.normal.cross(&side).dot(&(x - corner(k))) >= 0.0
    })
}

/// Nearest point of an edge; beyond an end, the vertex there.
fn on_edge(core: &ConvexPolyhedron, index: usize, x: &Vector3<f64>) -> (Feature, Vector3<f64>) {
    let edge = &core.edges()[index];
    let [start, end] = edge.vertices;
    let start_point = core.vertices()[start];
    let along = (x - start_point).dot(&edge.direction);
    if along <= 0.0 {
        (Feature::Vertex(start), start_point)
    } else if along >= edge.length {
        (Feature::Vertex(end), core.vertices()[end])
    } else {
        (Feature::Edge(index), start_point + edge.direction * along)
    }
}

fn above(core: &ConvexPolyhedron, face: usize, x: &Vector3<f64>, height: f64) -> Closest {
    on_face(face, &core.faces()[face].normal, x, height)
}
