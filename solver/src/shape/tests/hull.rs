//! Hulls of points, the largest ball in them, and their cores after rounding.

use super::{mapped, mesh};
use crate::shape::half_spaces::HalfSpaces;
use crate::shape::hull::hull_of as hull;
use crate::shape::{ConvexPolyhedron, RegularSolid, ShapeError, SharpPolyhedron, SpheroPolyhedron};
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

fn counts(solid: &ConvexPolyhedron) -> [usize; 3] {
    [
        solid.vertices().len(),
        solid.edges().len(),
        solid.faces().len(),
    ]
}

fn core_counts(body: &SpheroPolyhedron) -> [usize; 3] {
    [
        body.core_vertices().len(),
        body.edges().count(),
        body.faces().len(),
    ]
}

fn cloud(most: usize) -> impl Strategy<Value = Vec<Vector3<f64>>> {
    prop::collection::vec(
        prop::array::uniform3(-1.0..1.0_f64).prop_map(Vector3::from),
        4..most,
    )
}

/// Boulders: places on a ball, squeezed and moved.
fn boulder(most: usize) -> impl Strategy<Value = Vec<Vector3<f64>>> {
    let place = prop::array::uniform3(-1.0..1.0_f64)
        .prop_map(Vector3::from)
        .prop_filter("a direction", |v| v.norm() > 0.1)
        .prop_map(|v| v.normalize().component_mul(&Vector3::new(1.0, 0.7, 0.5)));
    (
        prop::collection::vec(place, 8..most),
        prop::array::uniform3(-5.0..5.0_f64),
    )
        .prop_map(|(places, shift)| places.iter().map(|p| p + Vector3::from(shift)).collect())
}

#[test]
fn regular_solids_have_their_features_and_inradii() {
    // Inradius over edge, in closed form.
    let root5 = 5_f64.sqrt();
    let expected = [
        (RegularSolid::Tetrahedron, [4, 6, 4], 6_f64.sqrt() / 12.0),
        (RegularSolid::Cube, [8, 12, 6], 0.5),
        (RegularSolid::Octahedron, [6, 12, 8], 6_f64.sqrt() / 6.0),
        (
            RegularSolid::Dodecahedron,
            [20, 30, 12],
            0.5 * (2.5 + 1.1 * root5).sqrt(),
        ),
        (
            RegularSolid::Icosahedron,
            [12, 30, 20],
            (3.0 + root5) * 3_f64.sqrt() / 12.0,
        ),
    ];
    for (solid, features, inradius) in expected {
        let edge = 0.04;
        let sharp = SharpPolyhedron::regular(solid, edge).unwrap();
        assert!(
            (sharp.inradius() - inradius * edge).abs() < 1e-14,
            "{solid:?}"
        );
        let polyhedron = hull(&solid.lying(edge).unwrap()).unwrap();
        assert_eq!(counts(&polyhedron), features, "{solid:?}");
        for e in polyhedron.edges() {
            assert!((e.length - edge).abs() < 1e-15, "{solid:?}");
        }
        // It lies on a face, with an edge along y.
        let lowest = polyhedron
            .faces()
            .iter()
            .find(|face| face.normal.z < -1.0 + 1e-14);
        let across = |edge: &usize| polyhedron.edges()[*edge].direction.y.abs() > 1.0 - 1e-14;
        assert!(
            lowest.expect("a lowest face").edges.iter().any(across),
            "{solid:?}"
        );
        // Rounded, it keeps its features and its flats.
        let body = sharp.rounded(0.3 * sharp.inradius()).unwrap();
        assert_eq!(core_counts(&body), features, "{solid:?}");
        for face in polyhedron.faces() {
            let reach = body.extent_along(&face.normal);
            assert!((reach - sharp.inradius()).abs() < 1e-14, "{solid:?}");
        }
    }
}

// Least width of sharp regular solids with edges of 1, in closed form: of the
// tetrahedron between two edges, of the others between two faces.
#[test]
fn least_widths() {
    let [core, radius] = [0.7, 0.3];
    for solid in RegularSolid::ALL {
        let sharp = SharpPolyhedron::regular(solid, 1.0).unwrap();
        let body = sharp.rounded(radius * sharp.inradius()).unwrap();
        let sharp_width = match solid {
            RegularSolid::Tetrahedron => 0.5_f64.sqrt(),
            _ => 2.0 * sharp.inradius(),
        };
        let expected = core * sharp_width + 2.0 * radius * sharp.inradius();
        assert!((body.least_width() - expected).abs() < 1e-12, "{solid:?}");
    }
    let plate = SpheroPolyhedron::cuboid([0.05, 0.01, 0.03], 0.001).unwrap();
    assert!((plate.least_width() - 0.01).abs() < 1e-16);
}

#[test]
fn projected_areas_and_surfaces() {
    // For a cube that of the bounding ball, for a needle half of its surface.
    let cube = SpheroPolyhedron::cube(0.04, 0.002).unwrap();
    let ball = std::f64::consts::PI * cube.bounding_radius().powi(2);
    assert_eq!(cube.largest_projected_area(), ball);
    let needle = SpheroPolyhedron::cuboid([0.5, 0.02, 0.02], 1e-9).unwrap();
    let surface = 4.0 * 0.5 * 0.02 + 2.0 * 0.02 * 0.02;
    assert!((needle.largest_projected_area() / (0.5 * surface) - 1.0).abs() < 1e-6);
    // Twelve rounded edges and a ball's worth of corners join the faces.
    let distance = 0.01;
    let edges = std::f64::consts::FRAC_PI_2 * distance * 4.0 * (0.5 + 0.02 + 0.02);
    let corners = 4.0 * std::f64::consts::PI * distance * distance;
    let around = needle.surface_at(distance);
    assert!((around / (surface + edges + corners) - 1.0).abs() < 1e-6);
}

#[test]
fn a_hulled_box_is_the_box() {
    let sides = [0.02, 0.03, 0.05];
    let points: Vec<_> = (0..8)
        .map(|k| Vector3::from_fn(|axis, _| sides[axis] * f64::from(k >> axis & 1) - 3.0))
        .collect();
    let sharp = SharpPolyhedron::hull_of(&points).unwrap();
    // Coordinates of 3 m are rounded to 4e-16.
    assert!((sharp.inradius() - 0.01).abs() < 1e-15);
    let body = sharp.rounded(0.002).unwrap();
    let expected = SpheroPolyhedron::cuboid(sides, 0.002).unwrap();
    assert!((body.volume() / expected.volume() - 1.0).abs() < 1e-12);
    let off = body.unit_inertia() - expected.unit_inertia();
    assert!(off.amax() < 1e-12 * expected.unit_inertia().amax());
}

#[test]
fn points_that_don_t_matter_are_left_out() {
    let cube: Vec<_> = RegularSolid::Cube.vertices(2.0);
    let mut points = vec![
        Vector3::zeros(),
        Vector3::new(1.0, 0.0, 0.0),
        Vector3::new(1.0, 1.0, 0.3),
        Vector3::new(1.0, 1.0, 1.0),
        Vector3::new(1.0 - 1e-7, 1.0, 1.0),
    ];
    points.extend(cube);
    assert_eq!(counts(&hull(&points).unwrap()), [8, 12, 6]);
}

#[test]
fn points_that_enclose_nothing_are_refused() {
    let flat: Vec<_> = (0..9)
        .map(|k| Vector3::new(f64::from(k % 3), f64::from(k / 3), 0.5))
        .collect();
    let line: Vec<_> = (0..9).map(|k| Vector3::repeat(f64::from(k))).collect();
    for points in [
        flat,
        line,
        vec![Vector3::x(); 12],
        vec![Vector3::x()],
        vec![],
    ] {
        let refused = SharpPolyhedron::hull_of(&points);
        assert!(
            matches!(refused, Err(ShapeError::TooFew { .. })),
            "{refused:?}"
        );
    }
    let infinite = [Vector3::x(), Vector3::y() / 0.0];
    let refused = SharpPolyhedron::hull_of(&infinite);
    assert_eq!(refused, Err(ShapeError::NotFinite { vertex: 1 }));
}

// Solids typed with so many digits that their faces are flat, or not, or hard to tell: each
// must become some closed solid of nearly the same volume.
#[test]
fn typed_coordinates_never_tear_the_surface() {
    let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
    // A cuboctahedron has squares, and four faces at every vertex.
    let cuboctahedron: Vec<_> = [[0., 1., 1.], [1., 0., 1.], [1., 1., 0.]]
        .into_iter()
        .flat_map(|[x, y, z]| {
            let sign = |k: i32| if k == 0 { 1.0 } else { -1.0 };
            (0..8).map(move |k| Vector3::new(x * sign(k & 1), y * sign(k & 2), z * sign(k & 4)))
        })
        .collect();
    let solids = [
        cuboctahedron,
        RegularSolid::Dodecahedron.vertices(1.0),
        RegularSolid::Icosahedron.vertices(1.0),
    ];
    for solid in &solids {
        let turned: Vec<_> = solid.iter().map(|v| turn * v).collect();
        let exact = SharpPolyhedron::hull_of(&turned).unwrap();
        let exact = exact.rounded(0.1).unwrap();
        for digits in 2..17 {
            let scale = 10_f64.powi(digits);
            let typed: Vec<_> = turned
                .iter()
                .map(|v| v.map(|c| (c * scale).round() / scale))
                .collect();
            let sharp = SharpPolyhedron::hull_of(&typed).unwrap();

            for radius in [0.01, 0.1, 0.3] {
                let body = sharp
                    .rounded(radius)
                    .unwrap_or_else(|error| panic!("{digits} digits: {error}"));
                if radius == 0.1 {
                    let off = body.volume() / exact.volume() - 1.0;
                    assert!(off.abs() < 10.0 / scale + 1e-4, "{digits} digits: {off}");
                }
            }
        }
    }
}

#[test]
fn rounding_can_swallow_features() {
    // A cube with one vertex cut off: with a large radius the core is a whole cube.
    let mut points: Vec<_> = RegularSolid::Cube.vertices(2.0);
    points.retain(|v| v.min() < 0.0);
    let cut = 0.3;
    points.extend([
        Vector3::new(1.0 - cut, 1.0, 1.0),
        Vector3::new(1.0, 1.0 - cut, 1.0),
        Vector3::new(1.0, 1.0, 1.0 - cut),
    ]);
    let sharp = SharpPolyhedron::hull_of(&points).unwrap();
    let little = sharp.rounded(0.05).unwrap();
    assert_eq!(core_counts(&little), [10, 15, 7]);
    // The cut's plane, moved in by r, is out of the cube's reach for √3 (1 − r) < √3 − cut/√3 − r:
    // r > cut / (3 − √3) = 0.2366.
    assert_eq!(core_counts(&sharp.rounded(0.23).unwrap()), [10, 15, 7]);
    assert_eq!(core_counts(&sharp.rounded(0.24).unwrap()), [8, 12, 6]);
}

#[test]
fn a_radius_from_the_inradius_on_is_refused() {
    let sharp = SharpPolyhedron::regular(RegularSolid::Octahedron, 1.0).unwrap();
    let inradius = sharp.inradius();
    for radius in [inradius, 2.0 * inradius] {
        let refused = sharp.rounded(radius);
        assert_eq!(
            refused,
            Err(ShapeError::RadiusNotBelowInradius {
                radius_m: radius,
                inradius_m: inradius
            })
        );
    }
    assert!(sharp.rounded(0.999 * inradius).is_ok());
    assert!(sharp.rounded(0.0).is_err());
    assert!(matches!(
        sharp.rounded(inradius * (1.0 - 1e-12)),
        Err(ShapeError::NoCore { .. })
    ));
}

/// Boulders drawn at random that were refused: a vertex stands for two places that are nearer to
/// each other than the smallest feature. Per line the sphero radius over the inradius, and places.
const NARROW: &str = include_str!("narrow_boulders.txt");

#[test]
fn a_boulder_with_a_feature_at_the_limit_can_be_rounded() {
    for line in NARROW.lines() {
        let mut numbers = line.split([' ', ',']).map(|n| n.parse().unwrap());
        let share: f64 = numbers.next().unwrap();
        let numbers: Vec<f64> = numbers.collect();
        let points: Vec<_> = numbers.chunks(3).map(Vector3::from_column_slice).collect();
        let sharp = SharpPolyhedron::hull_of(&points).unwrap();
        let body = sharp.rounded(share * sharp.inradius());
        assert!(body.is_ok(), "{share}: {body:?}");
    }
}

proptest! {
    #[test]
    fn a_hull_holds_its_points_and_no_more(points in cloud(24)) {
        // Four places may be nearly in a plane; then there may be no solid.
        let Ok(solid) = hull(&points) else { return Ok(()) };
        for face in solid.faces() {
            for point in &points {
                // Features of 1e-5 are dropped.
                prop_assert!(face.normal.dot(point) - face.offset < 3e-5);
            }
        }
        for vertex in solid.vertices() {
            prop_assert!(points.contains(vertex));
        }
    }

    #[test]
    fn the_hull_of_a_solid_is_the_solid(kind in 0..6_usize, bend in prop::array::uniform9(-0.25..0.25_f64)) {
        let solid = mapped(mesh(kind), &(Matrix3::identity() + Matrix3::from_row_slice(&bend)), &Vector3::zeros());
        let found = hull(solid.vertices()).unwrap();
        prop_assert_eq!(counts(&found), counts(&solid));
        for face in found.faces() {
            let same = |f: &&crate::shape::Face| (f.normal - face.normal).norm() < 1e-12;
            prop_assert!(solid.faces().iter().any(|f| same(&f)));
        }
    }

    // The flats stay where they were, unless they vanish; and the ball fits.
    #[test]
    fn a_rounded_boulder_fills_its_outline(points in boulder(20), share in 0.02..0.95_f64) {
        let sharp = SharpPolyhedron::hull_of(&points).unwrap();
        let outline = hull(&points).unwrap();
        let radius = share * sharp.inradius();
        let body = sharp.rounded(radius).unwrap();
        // Position of the body's origin in the outline, from three flats.
        let mut kept = Vec::new();
        for face in body.faces() {
            let same = outline.faces().iter().find(|f| (f.normal - face.normal).norm() < 1e-6);
            if let Some(flat) = same {
                kept.push((face.normal, flat.offset - body.extent_along(&face.normal)));
            }
        }
        prop_assert!(kept.len() >= 4);
        let (mut normals, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for (normal, offset) in &kept {
            normals += normal * normal.transpose();
            right += normal * *offset;
        }
        let origin = normals.try_inverse().unwrap() * right;
        for face in outline.faces() {
            let reach = face.normal.dot(&origin) + body.extent_along(&face.normal);
            // A feature of the core may be missing up to 1e-5 of the size, 2.
            prop_assert!(reach <= face.offset + 4e-5, "{} {}", reach, face.offset);
        }
        for (normal, offset) in kept {
            prop_assert!((normal.dot(&origin) - offset).abs() < 4e-5);
        }
    }

    // No plane normal to any two edges, or parallel to a face, is closer to its opposite.
    #[test]
    fn the_least_width_is_the_least_of_all(points in boulder(14), share in 0.02..0.95_f64) {
        let sharp = SharpPolyhedron::hull_of(&points).unwrap();
        let body = sharp.rounded(share * sharp.inradius()).unwrap();
        let edges: Vec<_> = body.edges().map(|edge| edge.direction).collect();
        let crosses = edges.iter().flat_map(|a| edges.iter().map(move |b| a.cross(b)));
        let least = (crosses.filter_map(|cross| cross.try_normalize(1e-9)))
            .chain(body.faces().iter().map(|face| face.normal))
            .map(|along| body.extent_along(&along) + body.extent_along(&-along))
            .fold(f64::INFINITY, f64::min);
        prop_assert!((body.least_width() / least - 1.0).abs() < 1e-12);
    }

    // Moved in by a little less than the inradius the faces leave a solid, by a little more they
    // don't.
    #[test]
    fn the_inradius_is_the_largest(points in boulder(16)) {
        let within = HalfSpaces::round(&points).unwrap();
        let inradius = within.inradius();
        prop_assert!(within.eroded(0.999 * inradius).is_ok());
        prop_assert!(within.eroded(1.000_001 * inradius).is_err());
    }
}
