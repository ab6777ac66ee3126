//! Sound solids are accepted, and have their volume: those that were refused, and many drawn at
//! random.

use super::drawn::Draw;
use super::steiner::{planes, rounded_volume};
use crate::shape::half_spaces::HalfSpaces;
use crate::shape::sharp::THINNEST;
use crate::shape::{SharpPolyhedron, SpheroPolyhedron};
use nalgebra::{Rotation3, Vector3};
use std::f64::consts::TAU;

/// Solids drawn in the suite. A hundred thousand take half a minute.
const DRAWN: u64 = 2000;
/// Relative difference of the volumes: features of 1e-5 of the size are left out, and planes within
/// 1e-5 rad are one.
const TOLERANCE: f64 = 1e-3;

fn typed(points: &[[f64; 3]], decimals: i32) -> Vec<Vector3<f64>> {
    let unit = 10_f64.powi(decimals);
    let typed = |point: &[f64; 3]| Vector3::from(point.map(|c| (c * unit).round() / unit));
    points.iter().map(typed).collect()
}

/// The solid rounded by a share of its inradius, checked against the volume found another way.
fn checked(points: &[Vector3<f64>], share: f64, name: &str) -> SpheroPolyhedron {
    let sharp = SharpPolyhedron::hull_of(points).unwrap_or_else(|e| panic!("{name}: {e}"));
    let radius = share * sharp.inradius();
    let body = sharp
        .rounded(radius)
        .unwrap_or_else(|error| panic!("{name}, {share} of the inradius: {error}"));
    let from_first: Vec<_> = points.iter().map(|p| p - points[0]).collect();
    let expected = rounded_volume(&from_first, radius);
    let off = body.volume() / expected - 1.0;
    assert!(off.abs() < TOLERANCE, "{name}, {share}: {off}");
    body
}

fn at_many_radii(points: &[Vector3<f64>], name: &str) {
    for step in 1..200 {
        checked(points, f64::from(step) / 200.0, name);
    }
    for share in [1e-6, 0.001, 0.999, 0.9999] {
        checked(points, share, name);
    }
}

/// The hull's volume, found another way.
fn sharp_volume(points: &[Vector3<f64>]) -> f64 {
    let from_first: Vec<_> = points.iter().map(|p| p - points[0]).collect();
    rounded_volume(&from_first, 0.0)
}

#[test]
fn cones_typed_with_four_decimals() {
    for sides in 25..=31 {
        let angle = |k: usize| TAU * k as f64 / sides as f64;
        let mut points: Vec<_> = (0..sides)
            .map(|k| [angle(k).cos(), angle(k).sin(), 0.0])
            .collect();
        points.push([0.0, 0.0, 5.0]);
        let points = typed(&points, 4);
        let sharp = SharpPolyhedron::hull_of(&points).unwrap();
        // A default sphero radius.
        checked(&points, 0.1, "cone");
        checked(&points, 0.0816 / sharp.inradius(), "cone");
        at_many_radii(&points, "cone");
    }
}

#[test]
fn facets_nearly_in_one_plane() {
    // Two facets 7.6e-5 rad apart, on a wedge of six points.
    let lift = 7.6e-5 / 2.0;
    let points = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.1, 0.2, 0.9 + lift],
        [0.8, 0.7, 0.9],
    ];
    at_many_radii(&points.map(Vector3::from), "wedge");
    let roof = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 0.0, 1.0],
        [0.0, 1.0, 1.0],
        [0.7, 0.7, 0.4 + 7.6e-5],
    ];
    at_many_radii(&roof.map(Vector3::from), "roof");
}

#[test]
fn a_turned_lattice_typed_to_five_decimals() {
    let nodes = [
        [0., 0., 0.],
        [1., 0., 0.],
        [1., 1., 0.],
        [0., 2., 0.],
        [0., 0., 1.],
        [1., 1., 1.],
        [0., 2., 1.],
    ];
    for seed in 0..30 {
        let turn = Rotation3::from_euler_angles(f64::from(seed), 0.3 * f64::from(seed), 1.0);
        let turned: Vec<[f64; 3]> = (nodes.iter())
            .map(|node| (turn * Vector3::from(*node)).into())
            .collect();
        let points = typed(&turned, 5);
        for share in [0.001, 0.01, 0.05, 0.2, 0.5, 0.9, 0.99, 0.999] {
            checked(&points, share, "lattice");
        }
    }
}

#[test]
fn cubes_with_bent_faces() {
    let bent = [
        [2.998, 2.997, -0.000266],
        [2.997, -0.000407, 2.997],
        [2.997, 2.997, 0.0],
        [2.997, 2.997, 2.997],
        [2.997, 0.000258, -6.2e-05],
        [-0.000453, 2.996, -0.000194],
        [0.00057, 0.000226, -9.4e-05],
        [-3.3e-05, 2.997, 2.996],
    ];
    at_many_radii(&bent.map(Vector3::from), "bent by 1 mm");
    for seed in 0..20 {
        let mut draw = Draw(seed);
        let corner = |k: usize| {
            Vector3::from_fn(|axis, _| (k >> axis & 1) as f64 + draw.between(-1e-6, 1e-6))
        };
        let points: Vec<_> = (0..8).map(corner).collect();
        for share in [0.001, 0.05, 0.3, 0.7, 0.95, 0.99, 0.999] {
            let body = checked(&points, share, "bent by 1 µm");
            assert_eq!(body.faces().len(), 6, "one face of each side");
        }
    }
}

// As the radius vanishes the volume is that of the hull.
#[test]
fn a_small_radius_leaves_the_hull() {
    let cone = [[1., 0., 0.], [-1., 1., 0.], [-1., -1., 0.], [0., 0., 3.]].map(Vector3::from);
    // Base of 2 by 2 over 2, height 3.
    assert!((sharp_volume(&cone) - 2.0).abs() < 1e-11);
    let body = checked(&cone, 1e-4, "tetrahedron");
    // Rounding an edge takes away of the order of r².
    assert!((body.volume() - 2.0).abs() < 1e-5, "{}", body.volume());
}

// A thin core keeps its features: a plate at nearly half its thickness.
#[test]
fn plates_can_be_rounded_almost_to_half_their_thickness() {
    for thickness in [0.1, 0.01, 0.001] {
        let corner = |k: usize| {
            Vector3::new(f64::from(k as u8 & 1), f64::from(k as u8 >> 1 & 1), 0.0)
                + Vector3::z() * (thickness * (k >> 2) as f64)
        };
        let points: Vec<_> = (0..8).map(corner).collect();
        for share in [0.9, 0.99, 0.999] {
            let body = checked(&points, share, "plate");
            assert_eq!(body.faces().len(), 6, "{thickness}, {share}");
        }
    }
}

/// True if the points enclose a ball worth the name: another solver's planes, and a crude centre.
fn is_sound(points: &[Vector3<f64>]) -> bool {
    let centre = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let planes = planes(points);
    let room = planes.iter().map(|(n, offset)| offset - n.dot(&centre));
    let size = crate::shape::check::extent(points);
    planes.len() >= 4 && room.fold(f64::INFINITY, f64::min) > 1e-4 * size
}

#[test]
fn sound_solids_drawn_at_random_are_accepted() {
    let mut sound = 0;
    for seed in 0..DRAWN {
        let mut draw = Draw(seed << 20);
        let (kind, points) = draw.solid();
        if is_sound(&points) {
            checked(&points, draw.share(), &format!("{kind}, seed {seed}"));
            checked_thin(&points, &format!("{kind}, seed {seed}"));
            sound += 1;
        }
    }
    assert!(sound > DRAWN * 9 / 10, "{sound}");
}

/// The core may be as thin as the refusal of a thinner one says.
fn checked_thin(points: &[Vector3<f64>], name: &str) {
    let sharp = SharpPolyhedron::hull_of(points).unwrap();
    let body = sharp.rounded(sharp.inradius() - THINNEST / 2.0 * sharp.diameter());
    assert!(body.is_ok(), "{name}: {body:?}");
}

#[test]
fn a_core_within_rounding_of_nothing_is_refused_for_that() {
    let cube: Vec<_> = (0..8)
        .map(|k| Vector3::from_fn(|axis, _| f64::from(k >> axis & 1)))
        .collect();
    let within = HalfSpaces::round(&cube).unwrap();
    assert!(within.eroded(0.5 - 1e-6).is_ok());
    let refused = SharpPolyhedron::hull_of(&cube)
        .unwrap()
        .rounded(0.5 - 1e-15);
    let error = refused.unwrap_err().to_string();
    assert!(error.contains("too thin"), "{error}");
}
