//! The nearest feature against brute force, and its continuity.

use super::search::{by_search, deepest_face};
use super::{SpheroPolyhedron, mapped, mesh, solid};
use crate::shape::hull::hull_of;
use crate::shape::walk::Walk;
use crate::shape::{ConvexPolyhedron, Feature};
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;

fn point(reach: f64) -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-reach..reach).prop_map(Vector3::from)
}

/// A core of the family under a well-conditioned map.
fn core() -> impl Strategy<Value = ConvexPolyhedron> {
    (0..6_usize, prop::array::uniform9(-0.25..0.25_f64)).prop_map(|(kind, bend)| {
        let map = Matrix3::identity() + Matrix3::from_row_slice(&bend);
        mapped(mesh(kind), &map, &Vector3::zeros())
    })
}

/// Distance to a convex polyhedron by alternating projections onto its face planes (Dykstra),
/// which uses neither edges nor vertices.
fn by_projections(core: &ConvexPolyhedron, x: &Vector3<f64>) -> f64 {
    let mut place = *x;
    let mut corrections = vec![Vector3::zeros(); core.faces().len()];
    for _ in 0..4000 {
        for (face, correction) in core.faces().iter().zip(&mut corrections) {
            let from = place + *correction;
            let height = (face.normal.dot(&from) - face.offset).max(0.0);
            place = from - face.normal * height;
            *correction = from - place;
        }
    }
    (x - place).norm()
}

fn on_feature(core: &ConvexPolyhedron, feature: Feature, point: &Vector3<f64>) -> f64 {
    match feature {
        Feature::Vertex(v) => (core.vertices()[v] - point).norm(),
        Feature::Edge(e) => {
            let edge = &core.edges()[e];
            let arm = point - core.vertices()[edge.vertices[0]];
            arm.cross(&edge.direction).norm()
        }
        Feature::Face(f) => (core.faces()[f].normal.dot(point) - core.faces()[f].offset).abs(),
    }
}

proptest! {
    #[test]
    fn distance_is_the_one_projections_find(core in core(), x in point(3.0)) {
        let found = Walk::on(&core).closest(&x);
        let expected = by_projections(&core, &x);
        // Dykstra converges slowly where x sits near an edge's region: 1e-4
        // after 4000 rounds; a wrong feature is wrong by far more.
        prop_assert!((found.distance.max(0.0) - expected).abs() < 1e-4, "{found:?} {expected}");
    }

    #[test]
    fn the_answer_is_consistent(core in core(), x in point(3.0)) {
        let found = Walk::on(&core).closest(&x);
        let (_, height) = deepest_face(&core, &x);
        prop_assert_eq!(found.distance <= 0.0, height <= 0.0);
        // Rounding of coordinates of order 1.
        prop_assert!((found.normal.norm() - 1.0).abs() < 1e-12);
        prop_assert!((found.point + found.normal * found.distance - x).norm() < 1e-12);
        prop_assert!(on_feature(&core, found.feature, &found.point) < 1e-12);
        // The point belongs to the core, and the normal to its normal cone.
        for vertex in core.vertices() {
            prop_assert!(found.normal.dot(&(vertex - found.point)) < 1e-9 || height <= 0.0);
        }
        let lies_in = core.faces().iter().all(|f| f.normal.dot(&found.point) - f.offset < 1e-12);
        prop_assert!(lies_in);
    }

    #[test]
    fn distance_point_and_normal_are_continuous(core in core(), x in point(2.0), step in point(1e-6)) {
        let (a, b) = (Walk::on(&core).closest(&x), Walk::on(&core).closest(&(x + step)));
        let moved = step.norm();
        // A distance and a projection onto a convex set are 1-Lipschitz; the
        // normal turns by no more than the step over the distance. 1e-12: rounding.
        prop_assert!((a.distance - b.distance).abs() <= moved + 1e-12);
        if a.distance > 1e-3 && b.distance > 1e-3 {
            prop_assert!((a.point - b.point).norm() <= moved + 1e-12);
            prop_assert!((a.normal - b.normal).norm() <= 2.0 * moved / a.distance + 1e-9);
        }
    }

    #[test]
    fn a_walk_ends_where_a_search_does(
        places in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 4..24),
        flatten in 0.05..1.0_f64,
        x in point(2.0),
    ) {
        let squeezed = |p: &[f64; 3]| Vector3::new(p[0], flatten * p[1], flatten * flatten * p[2]);
        let places: Vec<_> = places.iter().map(squeezed).collect();
        let Ok(core) = hull_of(&places) else { return Ok(()) };
        let walk = Walk::on(&core);
        // Around the solid, and on the bisectors between the regions of features.
        let centre = places.iter().sum::<Vector3<f64>>() / places.len() as f64;
        let beside = core.vertices().iter().flat_map(|v| [v * 1.2, v + (x - v) * 1e-3, (v + x) / 2.0]);
        for x in beside.chain([x, centre]) {
            let (found, expected) = (walk.closest(&x), by_search(&core, &x));
            prop_assert!((found.distance - expected.distance).abs() < 1e-14, "{found:?} {expected:?}");
            if expected.distance > 0.0 {
                prop_assert!((found.point - expected.point).norm() < 1e-7, "{found:?} {expected:?}");
            }
        }
    }

    #[test]
    fn the_closed_form_of_a_box_is_the_general_way(
        sides in prop::array::uniform3(0.5..2.0_f64),
        x in point(2.0),
        snap in prop::array::uniform3(0..4_u8),
    ) {
        let body = SpheroPolyhedron::cuboid(sides, 0.1).unwrap();
        // Now and then a coordinate exactly on a face, the centre or the surface.
        let corner = body.core_vertices()[7];
        let x = Vector3::from_fn(|axis, _| match snap[axis] {
            0 => corner[axis],
            1 => -corner[axis],
            _ => x[axis],
        });
        let (fast, general) = (body.closest_feature(&x), by_search(solid(&body), &x));
        prop_assert!((fast.distance - general.distance).abs() < 1e-14);
        if fast.distance > 0.0 {
            prop_assert!((fast.point - general.point).norm() < 1e-14);
            prop_assert!((fast.normal - general.normal).norm() < 1e-9);
            prop_assert!(on_feature(solid(&body), fast.feature, &fast.point) < 1e-14);
        }
    }
}

#[test]
fn every_feature_of_the_cube_answers_by_its_own_name() {
    let cube = SpheroPolyhedron::cube(2.0, 0.1).unwrap();
    let centre = |vertices: &[usize]| {
        let sum: Vector3<f64> = vertices.iter().map(|&v| cube.core_vertices()[v]).sum();
        sum / vertices.len() as f64
    };
    for vertex in 0..8 {
        let found = cube.closest_feature(&(centre(&[vertex]) * 1.5));
        assert_eq!(found.feature, Feature::Vertex(vertex));
    }
    for (index, edge) in cube.edges().enumerate() {
        let found = cube.closest_feature(&(centre(&edge.vertices) * 1.5));
        assert_eq!(found.feature, Feature::Edge(index));
    }
    for (index, face) in cube.faces().iter().enumerate() {
        for scale in [0.5, 1.0, 1.5] {
            let found = cube.closest_feature(&(centre(&face.vertices) * scale));
            assert_eq!(found.feature, Feature::Face(index));
            assert_eq!(found.normal, face.normal);
        }
    }
}

#[test]
fn points_on_the_surface_and_at_the_centre_have_a_normal() {
    let cube = SpheroPolyhedron::cube(2.0, 0.1).unwrap();
    let corner = cube.core_vertices()[7];
    for x in [
        corner,
        Vector3::zeros(),
        corner + Vector3::repeat(1e-200),
        Vector3::new(0.9, 0.0, 0.0),
    ] {
        for found in [cube.closest_feature(&x), by_search(solid(&cube), &x)] {
            assert_eq!(found.normal.norm(), 1.0, "{x}");
            assert!(found.distance.is_finite());
        }
    }
}
