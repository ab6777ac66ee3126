//! Tests of the geometry, and shared solids.

mod closest;
mod drawn;
mod hull;
mod mass;
mod principal;
mod round;
mod search;
mod separation;
mod sound;
mod steiner;
mod validity;

use super::{ConvexPolyhedron, SpheroPolyhedron};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

type Mesh = (Vec<Vector3<f64>>, Vec<Vec<usize>>);

fn tetrahedron() -> Mesh {
    let vertices = [[1., 1., 1.], [1., -1., -1.], [-1., 1., -1.], [-1., -1., 1.]];
    let loops = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    (
        vertices.map(Vector3::from).to_vec(),
        loops.map(Vec::from).to_vec(),
    )
}

/// A right prism of height 1 over a regular polygon of radius 1.
fn prism(sides: usize) -> Mesh {
    let ring = |z: f64| {
        (0..sides).map(move |k| {
            let angle = TAU * k as f64 / sides as f64;
            Vector3::new(angle.cos(), angle.sin(), z)
        })
    };
    let wall = |k: usize| {
        let next = (k + 1) % sides;
        vec![k, next, sides + next, sides + k]
    };
    let mut loops = vec![(0..sides).rev().collect(), (sides..2 * sides).collect()];
    loops.extend((0..sides).map(wall));
    (ring(-0.5).chain(ring(0.5)).collect(), loops)
}

/// A pyramid of height 1.5 over a regular polygon: its centre has no special position.
fn pyramid(sides: usize) -> Mesh {
    let (mut vertices, _) = prism(sides);
    vertices.truncate(sides);
    vertices.push(Vector3::new(0.2, 0.1, 1.0));
    let mut loops: Vec<Vec<usize>> = vec![(0..sides).rev().collect()];
    loops.extend((0..sides).map(|k| vec![k, (k + 1) % sides, sides]));
    (vertices, loops)
}

/// The solid under an affine map; it stays convex, and its loops keep their sense if the map
/// has a positive determinant.
fn mapped((vertices, loops): Mesh, map: &Matrix3<f64>, shift: &Vector3<f64>) -> ConvexPolyhedron {
    let vertices = vertices.iter().map(|v| map * v + shift).collect();
    ConvexPolyhedron::new(vertices, loops).expect("an affine image of a convex solid")
}

fn rounded(mesh: Mesh, radius: f64) -> SpheroPolyhedron {
    let core = mapped(mesh, &Matrix3::identity(), &Vector3::zeros());
    SpheroPolyhedron::from_core(core, radius).expect("a positive radius")
}

/// The core of a body that has a volume.
fn solid(body: &SpheroPolyhedron) -> &ConvexPolyhedron {
    body.core.solid().expect("its core has a volume")
}

/// One of a family of solids, by number.
fn mesh(kind: usize) -> Mesh {
    match kind % 6 {
        0 => tetrahedron(),
        1 => prism(3),
        2 => prism(4),
        3 => prism(7),
        4 => pyramid(4),
        _ => pyramid(6),
    }
}
