//! The feature of a core nearest to a point.

use super::polyhedron::ConvexPolyhedron;
use nalgebra::Vector3;

/// Gaps [m] whose squares are lost to underflow have no direction to speak of.
const NO_DIRECTION: f64 = 1e-150;

/// A vertex, edge or face of a core, by its index.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Feature {
    /// Index into `core_vertices`.
    Vertex(usize),
    /// Index into `edges`.
    Edge(usize),
    /// Index into `faces`.
    Face(usize),
}

/// What of a core is nearest to a point x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// The feature nearest to x; inside, the nearest face.
    pub feature: Feature,
    /// The nearest point of the core's surface [m].
    pub point: Vector3<f64>,
    /// Unit vector from the core to x; inside or on it, the nearest face's normal.
    pub normal: Vector3<f64>,
    /// Distance of x from the core's surface [m]; negative inside.
    pub distance: f64,
}

/// The face whose plane x is farthest in front of (or least behind), and how far.
pub(super) fn deepest_face(core: &ConvexPolyhedron, x: &Vector3<f64>) -> (usize, f64) {
    core.faces()
        .iter()
        .map(|face| face.normal.dot(x) - face.offset)
        .enumerate()
        .fold((0, f64::NEG_INFINITY), |best, next| {
            if next.1 > best.1 { next } else { best }
        })
}

/// Nearest feature of any convex core. Outside, the nearest point lies on a
/// face that looks at x: either x is above that face, or the point is on one of
/// its edges.
pub(super) fn general(core: &ConvexPolyhedron, x: &Vector3<f64>) -> Closest {
    let (deepest, height) = deepest_face(core, x);
    if height <= 0.0 || is_above(core, deepest, x) {
        return on_face(core, deepest, x, height);
    }
    let mut best = (f64::INFINITY, Feature::Vertex(0), Vector3::zeros());
    for (index, face) in core.faces().iter().enumerate() {
        let height = face.normal.dot(x) - face.offset;
        if height <= 0.0 {
            continue;
        }
        if is_above(core, index, x) {
            return on_face(core, index, x, height);
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

/// The answer for a point off the core; `fallback` serves where x is so close
/// that the difference has no direction.
pub(super) fn outside(
    feature: Feature,
    point: Vector3<f64>,
    x: &Vector3<f64>,
    fallback: &Vector3<f64>,
) -> Closest {
    let gap = x - point;
    let distance = gap.norm();
    let normal = if distance > NO_DIRECTION {
        gap / distance
    } else {
        *fallback
    };
    Closest {
        feature,
        point,
        normal,
        distance,
    }
}

fn on_face(core: &ConvexPolyhedron, face: usize, x: &Vector3<f64>, height: f64) -> Closest {
    let normal = core.faces()[face].normal;
    Closest {
        feature: Feature::Face(face),
        point: x - normal * height,
        normal,
        distance: height,
    }
}

/// The foot of x on the face's plane lies within the face.
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
