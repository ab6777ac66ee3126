//! The feature of a core nearest to a point.

use nalgebra::Vector3;

/// Gap [m] whose square is lost to underflow, so that it has no defined direction.
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

/// Feature of a core nearest to a point x.
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

/// The result for a point outside the core; `fallback` is used where x is so close that the
/// difference has no direction.
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

/// The result for a point above a face, or inside the core below it.
pub(super) fn on_face(
    face: usize,
    normal: &Vector3<f64>,
    x: &Vector3<f64>,
    height: f64,
) -> Closest {
    Closest {
        feature: Feature::Face(face),
        point: x - normal * height,
        normal: *normal,
        distance: height,
    }
}
