//! Distances between two cores.

use super::search::by_search;
use super::{SpheroPolyhedron, mapped, mesh, solid};
use crate::shape::separation;
use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_4;

/// Core of side 1.
fn unit_cube() -> SpheroPolyhedron {
    SpheroPolyhedron::cube(1.2, 0.1).unwrap()
}

fn pose(x: f64, y: f64, z: f64, turn: UnitQuaternion<f64>) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::new(x, y, z), turn)
}

fn about(axis: Vector3<f64>, angle: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(axis * angle)
}

#[test]
fn known_configurations_of_two_cubes() {
    let cube = unit_cube();
    let half_diagonal = 0.5_f64.sqrt();
    let origin = Isometry3::identity();
    let level = UnitQuaternion::identity();
    let on_edge = about(Vector3::y(), FRAC_PI_4);
    let crossed = about(Vector3::x(), FRAC_PI_4);
    let on_corner = UnitQuaternion::rotation_between(&Vector3::repeat(1.0), &Vector3::z()).unwrap();
    let cases = [
        ("face to face", origin, pose(1.5, 0.0, 0.0, level), 0.5),
        (
            "edge to edge, parallel",
            origin,
            pose(2.0, 2.0, 0.3, level),
            2_f64.sqrt(),
        ),
        (
            "vertex to vertex",
            origin,
            pose(2.0, 2.0, 2.0, level),
            3_f64.sqrt(),
        ),
        (
            "edge over face",
            origin,
            pose(0.0, 0.0, 2.0, on_edge),
            1.5 - half_diagonal,
        ),
        (
            "vertex over face",
            origin,
            pose(0.1, 0.0, 2.0, on_corner),
            1.5 - 0.75_f64.sqrt(),
        ),
        (
            "crossed edges",
            pose(0.0, 0.0, 0.0, crossed),
            pose(0.0, 0.0, 2.0, on_edge),
            2.0 - 2.0 * half_diagonal,
        ),
        ("touching", origin, pose(1.0, 0.2, 0.1, level), 0.0),
        (
            "overlapping faces",
            origin,
            pose(0.9, 0.0, 0.0, level),
            -0.1,
        ),
        (
            "crossed edges, overlapping",
            pose(0.0, 0.0, 0.0, crossed),
            pose(0.0, 0.0, 1.3, on_edge),
            1.3 - 2.0 * half_diagonal,
        ),
        ("one in the other", origin, origin, -1.0),
    ];
    for (name, pose_a, pose_b, expected) in cases {
        let found = separation(&cube, &pose_a, &cube, &pose_b);
        // Rounding of coordinates of order 1.
        assert!(
            (found - expected).abs() < 1e-14,
            "{name}: {found} instead of {expected}"
        );
    }
}

fn body() -> impl Strategy<Value = SpheroPolyhedron> {
    (0..6_usize, prop::array::uniform9(-0.25..0.25_f64)).prop_map(|(kind, bend)| {
        let map = Matrix3::identity() + Matrix3::from_row_slice(&bend);
        let core = mapped(mesh(kind), &map, &Vector3::zeros());
        SpheroPolyhedron::from_core(core, 0.1).unwrap()
    })
}

fn placement() -> impl Strategy<Value = Isometry3<f64>> {
    (
        prop::array::uniform3(-2.5..2.5_f64),
        prop::array::uniform3(-3.0..3.0_f64),
    )
        .prop_map(|(place, turn)| Isometry3::new(Vector3::from(place), Vector3::from(turn)))
}

/// Distance by alternating projections onto the two solids.
fn by_projections(
    a: &SpheroPolyhedron,
    pose_a: &Isometry3<f64>,
    b: &SpheroPolyhedron,
    pose_b: &Isometry3<f64>,
) -> f64 {
    let project = |body: &SpheroPolyhedron, pose: &Isometry3<f64>, x: Vector3<f64>| {
        let found = by_search(solid(body), &pose.inverse_transform_point(&x.into()).coords);
        if found.distance <= 0.0 {
            x
        } else {
            pose.transform_point(&found.point.into()).coords
        }
    };
    let (mut on_a, mut on_b) = (Vector3::zeros(), Vector3::zeros());
    for _ in 0..20_000 {
        on_a = project(a, pose_a, on_b);
        on_b = project(b, pose_b, on_a);
    }
    (on_a - on_b).norm()
}

proptest! {
    #[test]
    fn distance_is_the_one_projections_find(a in body(), b in body(), pose_b in placement()) {
        let origin = Isometry3::identity();
        let found = separation(&a, &origin, &b, &pose_b);
        let expected = by_projections(&a, &origin, &b, &pose_b);
        // Alternating projections converge like 1/rounds where two surfaces are nearly parallel,
        // and like its root where they just touch.
        prop_assert!((found.max(0.0) - expected).abs() < 1e-2 * (1.0 - found.clamp(0.0, 0.99)), "{found} {expected}");
    }

    #[test]
    fn distance_is_symmetric_and_moves_with_both(a in body(), b in body(), pose_a in placement(), pose_b in placement(), motion in placement()) {
        let found = separation(&a, &pose_a, &b, &pose_b);
        let swapped = separation(&b, &pose_b, &a, &pose_a);
        let carried = separation(&a, &(motion * pose_a), &b, &(motion * pose_b));
        // Edges parallel to 1e-12 may or may not take part; otherwise rounding.
        prop_assert!((found - swapped).abs() < 1e-9 && (found - carried).abs() < 1e-9);
    }
}
