//! Cores without volume: balls and capsules.

use crate::shape::{Feature, RegularSolid, SharpPolyhedron, SpheroPolyhedron, distance_apart};
use crate::shape::{ShapeError, separation};
use nalgebra::{Isometry3, Matrix3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use std::f64::consts::PI;

fn capsule(radius: f64, length: f64) -> SpheroPolyhedron {
    SpheroPolyhedron::capsule(radius, length).expect("it is longer than its ends")
}

fn ball(radius: f64) -> SpheroPolyhedron {
    SpheroPolyhedron::ball(radius).expect("a positive radius")
}

/// ∫ y² dV and ∫ x² dV of a capsule by slices across the axis.
fn by_slices(radius: f64, length: f64) -> [f64; 3] {
    const SLICES: usize = 1_000_000;
    let step = length / SLICES as f64;
    let half = 0.5 * length - radius;
    let slice = |k: usize| {
        let x = (k as f64 + 0.5) * step - 0.5 * length;
        let beyond = (x.abs() - half).max(0.0);
        let square = radius * radius - beyond * beyond;
        let area = PI * square * step;
        [area, area * x * x, area * square / 4.0]
    };
    (0..SLICES).map(slice).fold([0.0; 3], |sum, slice| {
        std::array::from_fn(|k| sum[k] + slice[k])
    })
}

fn near(a: f64, b: f64, share: f64) -> bool {
    (a / b - 1.0).abs() < share
}

#[test]
fn a_ball_has_its_textbook_properties() {
    let radius = 0.37_f64;
    let body = ball(radius);
    let volume = 4.0 / 3.0 * PI * radius.powi(3);
    assert!(near(body.volume(), volume, 1e-15));
    assert!(near(body.surface_at(0.0), 4.0 * PI * radius.powi(2), 1e-15));
    assert!(near(
        body.surface_at(0.1),
        4.0 * PI * 0.47_f64.powi(2),
        1e-15
    ));
    let inertia = Matrix3::from_diagonal_element(0.4 * volume * radius.powi(2));
    assert!((body.unit_inertia() - inertia).norm() < 1e-15 * inertia.norm());
    assert_eq!(body.bounding_radius(), radius);
    assert_eq!(body.least_width(), 2.0 * radius);
    assert_eq!(body.inscribed_radius(), radius);
    // A push across a place of the surface meets 2/7 of the mass.
    assert!(near(body.turning_compliance(), 2.5, 1e-14));
    assert!(near(
        body.largest_projected_area(),
        PI * radius.powi(2),
        1e-15
    ));
    assert_eq!(body.faces().len() + body.edges().count(), 0);
}

#[test]
fn a_capsule_has_the_properties_of_its_slices() {
    for (radius, length) in [(0.2, 1.3), (0.1, 0.2001), (0.01, 1.0)] {
        let body = capsule(radius, length);
        let [volume, along, across] = by_slices(radius, length);
        assert!(
            near(body.volume(), volume, 1e-9),
            "{}",
            body.volume() / volume
        );
        let cylinder = PI * radius.powi(2) * (length - 2.0 * radius);
        assert!(near(
            body.volume(),
            cylinder + 4.0 / 3.0 * PI * radius.powi(3),
            1e-14
        ));
        assert!(near(
            body.surface_at(0.0),
            2.0 * PI * radius * length,
            1e-14
        ));
        let inertia = body.unit_inertia();
        assert!(near(inertia[(0, 0)], 2.0 * across, 1e-9));
        assert!(near(inertia[(1, 1)], along + across, 1e-9));
        assert_eq!(inertia[(1, 1)], inertia[(2, 2)]);
        assert_eq!(
            body.bounding_radius(),
            0.5 * (length - 2.0 * radius) + radius
        );
        assert_eq!(body.least_width(), 2.0 * radius);
        assert_eq!(body.extent_along(&Vector3::x()), body.bounding_radius());
        assert_eq!(body.extent_along(&Vector3::y()), radius);
    }
}

#[test]
fn lengths_that_make_no_capsule_are_errors() {
    let refused = |radius, length| SpheroPolyhedron::capsule(radius, length).unwrap_err();
    assert!(matches!(refused(0.1, 0.2), ShapeError::NotPositive { .. }));
    assert!(matches!(refused(0.0, 0.2), ShapeError::NotPositive { .. }));
    assert!(matches!(
        refused(0.1, f64::NAN),
        ShapeError::NotPositive { .. }
    ));
    assert!(SpheroPolyhedron::ball(f64::INFINITY).is_err());
}

// On the axis every direction across is as near; the documented one is +z.
#[test]
fn at_the_centre_and_on_the_axis_the_normal_is_up() {
    let found = ball(0.3).closest_feature(&Vector3::zeros());
    assert_eq!((found.feature, found.distance), (Feature::Vertex(0), 0.0));
    assert_eq!(
        (found.point, found.normal),
        (Vector3::zeros(), Vector3::z())
    );
    let body = capsule(0.1, 1.0);
    for x in [-0.4, -0.1, 0.0, 0.4] {
        let found = body.closest_feature(&Vector3::new(x, 0.0, 0.0));
        assert_eq!((found.distance, found.normal), (0.0, Vector3::z()));
        assert_eq!(found.feature, Feature::Edge(0));
    }
    let found = body.closest_feature(&(Vector3::x() * -0.6));
    assert_eq!(
        (found.feature, found.normal),
        (Feature::Vertex(0), -Vector3::x())
    );
    assert!((found.distance - 0.2).abs() < 1e-15);
}

fn place() -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-1.5..1.5_f64).prop_map(Vector3::from)
}

fn pose() -> impl Strategy<Value = Isometry3<f64>> {
    (place(), place()).prop_map(|(shift, turn)| Isometry3::new(shift, turn * 2.0))
}

/// Distance of two segments by a search over one of them, whose distance from the other is convex.
fn by_golden_section(
    ends: [Vector3<f64>; 2],
    other: &SpheroPolyhedron,
    pose: &Isometry3<f64>,
) -> f64 {
    let distance = |share: f64| {
        let x = ends[0] + (ends[1] - ends[0]) * share;
        let x = pose.inverse_transform_point(&x.into()).coords;
        other.closest_feature(&x).distance
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if distance(a) < distance(b) {
            high = b;
        } else {
            low = a;
        }
    }
    distance(0.5 * (low + high))
}

/// A ball, a capsule, a cube or a tetrahedron.
fn body(kind: usize) -> SpheroPolyhedron {
    match kind {
        0 => ball(0.1),
        1 => capsule(0.1, 1.1),
        2 => SpheroPolyhedron::cube(0.8, 0.1).expect("a cube"),
        _ => SharpPolyhedron::regular(RegularSolid::Tetrahedron, 1.0)
            .and_then(|sharp| sharp.rounded(0.1))
            .expect("a solid"),
    }
}

proptest! {
    // No place of the surface turns more easily than the stated one.
    #[test]
    fn no_place_of_a_capsule_turns_more_easily(
        radius in 0.05..0.5_f64, more in 1e-6..2.0_f64, share in -1.0..1.0_f64, angle in 0.0..1.6_f64,
    ) {
        let body = capsule(radius, 2.0 * radius + more);
        let inverse = body.unit_inertia().try_inverse().unwrap();
        let compliance = |c: Vector3<f64>| {
            let cross = c.cross_matrix();
            body.volume() * (cross * inverse * cross.transpose()).symmetric_eigenvalues().max()
        };
        let end = Vector3::new(0.5 * more + radius * angle.cos(), radius * angle.sin(), 0.0);
        let side = Vector3::new(0.5 * more * share, radius, 0.0);
        let most = body.turning_compliance() * (1.0 + 1e-12);
        prop_assert!(compliance(end) <= most && compliance(side) <= most);
    }

    #[test]
    fn nearest_places_of_a_capsule_are_the_nearest(x in place()) {
        let body = capsule(0.1, 1.1);
        let found = body.closest_feature(&x);
        let places = (0..=1000).map(|k| Vector3::x() * (f64::from(k) / 1000.0 - 0.5) * 0.9);
        let sampled = places.map(|p| (x - p).norm()).fold(f64::INFINITY, f64::min);
        prop_assert!(found.distance <= sampled && sampled < found.distance + 1e-3);
        prop_assert!((found.point + found.normal * found.distance - x).norm() < 1e-14);
        prop_assert!((found.normal.norm() - 1.0).abs() < 1e-14);
    }

    // The axis of a capsule against any core: its distance is that of its nearest place.
    #[test]
    fn cores_without_volume_are_as_far_from_others_as_their_nearest_places(
        kind in 0_usize..4, at in pose(), other_at in pose(),
    ) {
        let (first, second) = (capsule(0.1, 1.1), body(kind));
        let ends = [-0.45, 0.45].map(|x| (at * nalgebra::Point3::new(x, 0.0, 0.0)).coords);
        let searched = by_golden_section(ends, &second, &other_at);
        let found = separation(&first, &at, &second, &other_at);
        let turned_round = separation(&second, &other_at, &first, &at);
        prop_assert!((found - turned_round).abs() < 1e-9);
        if searched > 1e-6 {
            prop_assert!((found - searched).abs() < 1e-7, "{found} {searched}");
            prop_assert!((distance_apart(&first, &at, &second, &other_at) - found).abs() < 1e-12);
        } else {
            prop_assert!(found < 1e-6, "{found} {searched}");
        }
        let centre = ball(0.1);
        let found = separation(&centre, &at, &second, &other_at);
        let x = other_at.inverse_transform_point(&at.translation.vector.into()).coords;
        let distance = second.closest_feature(&x).distance;
        prop_assert!((found - distance).abs() < 1e-9, "{found} {distance}");
    }

    // Seen end on or askew, it is as wide as its core and its ends.
    #[test]
    fn a_capsule_reaches_as_far_as_its_farther_end(direction in place(), turn in place()) {
        prop_assume!(direction.norm() > 1e-3);
        let body = capsule(0.1, 1.1);
        let turned = UnitQuaternion::new(turn).inverse_transform_vector(&direction.normalize());
        let exact = 0.45 * turned.x.abs() + 0.1;
        prop_assert!((body.extent_along(&turned) - exact).abs() < 1e-14);
    }
}
