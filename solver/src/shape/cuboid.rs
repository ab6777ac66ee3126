//! Boxes aligned with the body axes: construction, and the nearest feature in
//! closed form.

use super::closest::{Closest, Feature, outside};
use super::error::ShapeError;
use super::polyhedron::ConvexPolyhedron;
use nalgebra::Vector3;

/// Side of the box on which a point is beyond it, per axis: −1, 0 (within) or 1.
type Beyond = [i8; 3];

/// A core box centred on the origin, and its nearest feature for each combination of sides on
/// which a point can be beyond it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cuboid {
    half: Vector3<f64>,
    /// Nearest features by [`region`]; the entry of the inside is never read.
    features: [Feature; 27],
}

impl Cuboid {
    /// The box with these half sides [m] as a polyhedron, and in closed form.
    pub(super) fn new(half: Vector3<f64>) -> Result<(ConvexPolyhedron, Self), ShapeError> {
        let vertices = (0..8).map(|vertex| corner(&half, vertex)).collect();
        let core = ConvexPolyhedron::new(vertices, face_loops())?;
        let features = feature_table(&core);
        Ok((core, Self { half, features }))
    }

    /// Nearest feature of the box.
    pub(super) fn closest(&self, x: &Vector3<f64>) -> Closest {
        let nearest = (x.abs() - self.half).imax();
        let mut face: Beyond = [0; 3];
        face[nearest] = if x[nearest] < 0.0 { -1 } else { 1 };
        let normal = Vector3::from_fn(|axis, _| f64::from(face[axis]));
        let point = Vector3::from_fn(|axis, _| x[axis].clamp(-self.half[axis], self.half[axis]));
        let beyond: Beyond = std::array::from_fn(|axis| side(x[axis] - point[axis]));
        if beyond != [0; 3] {
            return outside(self.features[region(beyond)], point, x, &normal);
        }
        let distance = x[nearest].abs() - self.half[nearest];
        Closest {
            feature: self.features[region(face)],
            point: x - normal * distance,
            normal,
            distance,
        }
    }
}

fn side(excess: f64) -> i8 {
    i8::from(excess > 0.0) - i8::from(excess < 0.0)
}

/// Number of a combination of sides, 0 … 26.
fn region(beyond: Beyond) -> usize {
    beyond.iter().fold(0, |number, &side| {
        3 * number + usize::from((side + 1).unsigned_abs())
    })
}

/// Corner 0 … 7: bit k set means the positive side of axis k.
fn corner(half: &Vector3<f64>, vertex: usize) -> Vector3<f64> {
    Vector3::from_fn(|axis, _| {
        if vertex >> axis & 1 == 1 {
            half[axis]
        } else {
            -half[axis]
        }
    })
}

/// −x, +x, −y, +y, −z, +z, each counter-clockwise seen from outside.
fn face_loops() -> Vec<Vec<usize>> {
    vec![
        vec![0, 4, 6, 2],
        vec![1, 3, 7, 5],
        vec![0, 1, 5, 4],
        vec![2, 6, 7, 3],
        vec![0, 2, 3, 1],
        vec![4, 5, 7, 6],
    ]
}

/// Table of the features, by the sides that their vertices share.
fn feature_table(core: &ConvexPolyhedron) -> [Feature; 27] {
    let mut table = [Feature::Vertex(0); 27];
    let mut enter = |vertices: &[usize], feature| {
        let shared: Beyond = std::array::from_fn(|axis| {
            let sides = vertices.iter().map(|&v| side(core.vertices()[v][axis]));
            let sum: i8 = sides.sum();
            sum / i8::try_from(vertices.len()).unwrap_or(i8::MAX)
        });
        table[region(shared)] = feature;
    };
    for vertex in 0..core.vertices().len() {
        enter(&[vertex], Feature::Vertex(vertex));
    }
    for (index, edge) in core.edges().iter().enumerate() {
        enter(&edge.vertices, Feature::Edge(index));
    }
    for (index, face) in core.faces().iter().enumerate() {
        enter(&face.vertices, Feature::Face(index));
    }
    table
}
