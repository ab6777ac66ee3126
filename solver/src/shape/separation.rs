//! Distance between two cores.

use super::SpheroPolyhedron;
use super::core::{Core, CoreEdge, PARALLEL};
use nalgebra::{Isometry3, Point3, Vector3};

/// Distance between the cores of two bodies [m], each given in its own frame and placed by its
/// pose; zero or negative (minus the depth) when they overlap. Exact for convex cores: the
/// nearest pair is a vertex and a face, or two edges (a core without faces brings its vertices
/// and its edge); and two of them overlap exactly if no face normal and no cross product of two
/// edges separates them. Two cores without volume only meet, at the distance 0. For the rounded
/// surfaces subtract both sphero radii.
pub fn separation(
    a: &SpheroPolyhedron,
    pose_a: &Isometry3<f64>,
    b: &SpheroPolyhedron,
    pose_b: &Isometry3<f64>,
) -> f64 {
    let b_in_a = pose_a.inv_mul(pose_b);
    let neither_has_volume = a.faces().is_empty() && b.faces().is_empty();
    if neither_has_volume {
        return nearest(a, b, &b_in_a);
    }
    let gap = widest_gap(&a.core, &b.core, &b_in_a);
    if gap <= 0.0 {
        gap
    } else {
        nearest(a, b, &b_in_a)
    }
}

/// Distance of cores that are known to be apart, at less cost.
pub fn distance_apart(
    a: &SpheroPolyhedron,
    pose_a: &Isometry3<f64>,
    b: &SpheroPolyhedron,
    pose_b: &Isometry3<f64>,
) -> f64 {
    nearest(a, b, &pose_a.inv_mul(pose_b))
}

/// Distance of the nearest features of two cores that are apart.
fn nearest(a: &SpheroPolyhedron, b: &SpheroPolyhedron, b_in_a: &Isometry3<f64>) -> f64 {
    vertex_distance(a, b, b_in_a)
        .min(vertex_distance(b, a, &b_in_a.inverse()))
        .min(edge_distance(&a.core, &b.core, b_in_a))
}

/// Largest gap between the projections of `a` and `b` on any separating direction.
fn widest_gap(a: &Core, b: &Core, b_in_a: &Isometry3<f64>) -> f64 {
    let b_vertices = moved(b, b_in_a);
    let normals_of_a = a.faces().iter().map(|face| face.normal);
    let normals_of_b = b.faces().iter().map(|face| -(b_in_a * face.normal));
    let crosses = a.edges().flat_map(|edge_a| {
        let cross = move |edge_b: CoreEdge| edge_a.direction.cross(&(b_in_a * edge_b.direction));
        b.edges().map(cross)
    });
    let crosses = crosses
        .filter_map(|cross| cross.try_normalize(PARALLEL))
        .flat_map(|direction| [direction, -direction]);
    normals_of_a
        .chain(normals_of_b)
        .chain(crosses)
        .map(|direction| gap_along(a.vertices(), &b_vertices, &direction))
        .fold(f64::NEG_INFINITY, f64::max)
}

/// Distance in a direction from the end of `a` to the beginning of `b`.
fn gap_along(a: &[Vector3<f64>], b: &[Vector3<f64>], direction: &Vector3<f64>) -> f64 {
    let end = |v: &Vector3<f64>| v.dot(direction);
    let end_of_a = a.iter().map(end).fold(f64::NEG_INFINITY, f64::max);
    let start_of_b = b.iter().map(end).fold(f64::INFINITY, f64::min);
    start_of_b - end_of_a
}

/// Vertices of a core in another frame.
fn moved(core: &Core, pose: &Isometry3<f64>) -> Vec<Vector3<f64>> {
    core.vertices()
        .iter()
        .map(|v| (pose * Point3::from(*v)).coords)
        .collect()
}

/// Nearest vertex of `b` to the core of `a`.
fn vertex_distance(a: &SpheroPolyhedron, b: &SpheroPolyhedron, b_in_a: &Isometry3<f64>) -> f64 {
    moved(&b.core, b_in_a)
        .iter()
        .map(|vertex| a.closest_feature(vertex).distance)
        .fold(f64::INFINITY, f64::min)
}

/// Nearest pair of edges.
fn edge_distance(a: &Core, b: &Core, b_in_a: &Isometry3<f64>) -> f64 {
    let b_vertices = moved(b, b_in_a);
    let mut nearest = f64::INFINITY;
    for edge_a in a.edges() {
        let segment_a = edge_a.vertices.map(|v| a.vertices()[v]);
        for edge_b in b.edges() {
            let segment_b = edge_b.vertices.map(|v| b_vertices[v]);
            nearest = nearest.min(segment_distance(segment_a, segment_b));
        }
    }
    nearest
}

/// Distance between two segments where both nearest points are interior; infinite otherwise
/// (then a vertex is nearest, and is found elsewhere).
fn segment_distance(a: [Vector3<f64>; 2], b: [Vector3<f64>; 2]) -> f64 {
    let (along_a, along_b, apart) = (a[1] - a[0], b[1] - b[0], b[0] - a[0]);
    let normal = along_a.cross(&along_b);
    let squared = normal.norm_squared();
    let scale = along_a.norm_squared() * along_b.norm_squared();
    if squared <= PARALLEL * PARALLEL * scale {
        return f64::INFINITY;
    }
    let place_on_a = apart.cross(&along_b).dot(&normal) / squared;
    let place_on_b = apart.cross(&along_a).dot(&normal) / squared;
    let interior = 0.0..=1.0;
    if interior.contains(&place_on_a) && interior.contains(&place_on_b) {
        apart.dot(&normal).abs() / squared.sqrt()
    } else {
        f64::INFINITY
    }
}
