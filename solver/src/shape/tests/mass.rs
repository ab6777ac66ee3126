//! Volume and inertia of rounded solids.

use super::{SpheroPolyhedron, mapped, mesh, prism, pyramid, rounded, solid, tetrahedron};
use crate::shape::moments::Moments;
use crate::shape::{ConvexPolyhedron, RegularSolid, SharpPolyhedron};
use nalgebra::{Matrix3, Rotation3, Vector3};
use std::f64::consts::PI;

/// Radius [m], V/L³ and I/(ρL⁵/6) of a cube of 40 mm, to five decimals: V from Steiner's
/// formula a³ + 6a²r + 3πar² + 4πr³/3 with a = L − 2r, I from the same parts.
const TABLE: [(f64, f64, f64); 3] = [
    (0.004, 0.97559, 0.94807),
    (0.002, 0.99373, 0.98603),
    (0.001, 0.99841, 0.99638),
];
/// Half a unit of the table's last decimal.
const TABLE_ROUNDING: f64 = 5e-6;

#[test]
fn the_cube_has_the_tabulated_volume_and_inertia() {
    let side: f64 = 0.04;
    for (radius, volume, inertia) in TABLE {
        let cube = SpheroPolyhedron::cube(side, radius).unwrap();
        assert!((cube.volume() / side.powi(3) - volume).abs() < TABLE_ROUNDING);
        let scaled = cube.unit_inertia() * (6.0 / side.powi(5));
        let expected = Matrix3::from_diagonal_element(inertia);
        assert!((scaled - expected).amax() < TABLE_ROUNDING, "{scaled}");
    }
}

#[test]
fn a_cube_rounded_almost_to_nothing_is_a_sphere() {
    let cube = SpheroPolyhedron::cube(2.0, 1.0 - 1e-9).unwrap();
    // The core's 1e-9 m change either figure by a few 1e-9.
    assert!((cube.volume() - 4.0 / 3.0 * PI).abs() < 1e-7);
    let sphere = Matrix3::from_diagonal_element(8.0 / 15.0 * PI);
    assert!((cube.unit_inertia() - sphere).amax() < 1e-7);
}

#[test]
fn a_sharp_box_has_the_textbook_inertia() {
    let [a, b, c] = [0.1, 0.2, 0.3];
    let block = SpheroPolyhedron::cuboid([a, b, c], 1e-9).unwrap();
    let volume = a * b * c;
    let diagonal = Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) * (volume / 12.0);
    // A radius of 1e-9 on sides of 0.1 changes the figures by less than 1e-12.
    let expected = Matrix3::from_diagonal(&diagonal);
    assert!((block.unit_inertia() - expected).amax() < 1e-9 * expected.amax());
    assert!((block.volume() - volume).abs() < 1e-9 * volume);
}

#[test]
fn two_formulas_give_the_same_volume() {
    for kind in 0..6 {
        let body = rounded(mesh(kind), 0.3);
        let moments = Moments::of_dilated(solid(&body), 0.3);
        // Angle defects against dihedrals: rounding only.
        assert!((moments.volume - body.volume()).abs() < 1e-12 * body.volume());
    }
}

/// Moments by midpoint quadrature, which uses the solid only as "no farther than r from the
/// core": rows along z, whose ends are found by bisection, over a grid of `count`² midpoints in
/// x and y.
fn by_quadrature(body: &SpheroPolyhedron, count: u32) -> (f64, Vector3<f64>, Matrix3<f64>) {
    let reach = body.bounding_radius();
    let step = 2.0 * reach / f64::from(count);
    let (mut volume, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
    for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
        let x = (f64::from(i) + 0.5) * step - reach;
        let y = (f64::from(j) + 0.5) * step - reach;
        let Some((low, high)) = row(body, x, y, reach) else {
            continue;
        };
        let weight = (high - low) * step * step;
        let middle = Vector3::new(x, y, (low + high) / 2.0);
        volume += weight;
        first += middle * weight;
        second += middle * middle.transpose() * weight;
        second[(2, 2)] += weight * (high - low).powi(2) / 12.0;
    }
    (volume, first, second)
}

/// Places where the line (x, y, ·) enters and leaves the rounded solid.
fn row(body: &SpheroPolyhedron, x: f64, y: f64, reach: f64) -> Option<(f64, f64)> {
    let depth =
        |z: f64| body.closest_feature(&Vector3::new(x, y, z)).distance - body.sphero_radius();
    // The distance is convex along a line: ternary search finds its minimum.
    let (mut low, mut high) = (-reach, reach);
    for _ in 0..60 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if depth(a) < depth(b) {
            high = b;
        } else {
            low = a;
        }
    }
    let lowest = (low + high) / 2.0;
    let crossing = |outer: f64| {
        let (mut inner, mut outer) = (lowest, outer);
        for _ in 0..40 {
            let middle = (inner + outer) / 2.0;
            if depth(middle) < 0.0 {
                inner = middle;
            } else {
                outer = middle;
            }
        }
        inner
    };
    (depth(lowest) < 0.0).then(|| (crossing(-reach), crossing(reach)))
}

#[test]
fn quadrature_agrees_for_solids_without_symmetry() {
    let skew = Matrix3::new(0.9, 0.2, 0.0, -0.1, 0.7, 0.3, 0.1, 0.0, 0.8);
    for (mesh, radius) in [(tetrahedron(), 0.4), (pyramid(5), 0.2), (prism(3), 0.15)] {
        let core = mapped(mesh, &skew, &Vector3::zeros());
        let body = SpheroPolyhedron::from_core(core, radius).unwrap();
        let (volume, first, second) = by_quadrature(&body, 150);
        let inertia = Matrix3::from_diagonal_element(second.trace()) - second;
        let (scale, size) = (body.unit_inertia().amax(), body.bounding_radius());
        // Midpoint rule on 150² rows of a solid with a vertical rim: the error
        // of an area so sampled is of order (1/150)^1.5 = 5e-4.
        assert!((volume / body.volume() - 1.0).abs() < 1e-3);
        assert!(first.amax() / (body.volume() * size) < 1e-3, "{first}");
        assert!((inertia - body.unit_inertia()).amax() < 1e-3 * scale);
    }
}

#[test]
fn mass_properties_move_and_turn_with_the_core() {
    let shift = Vector3::new(30.0, -20.0, 10.0);
    let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
    for kind in 0..6 {
        let still = rounded(mesh(kind), 0.2);
        let core = mapped(mesh(kind), turn.matrix(), &shift);
        let moved = SpheroPolyhedron::from_core(core, 0.2).unwrap();
        let turned = turn.matrix() * still.unit_inertia() * turn.matrix().transpose();
        // Coordinates near 37 m carry 1e-14 m of rounding on a 1 m solid.
        assert!((moved.unit_inertia() - turned).amax() < 1e-11);
        for (a, b) in still.core_vertices().iter().zip(moved.core_vertices()) {
            assert!((turn * a - b).norm() < 1e-12);
        }
    }
}

#[test]
fn the_general_way_gives_the_cube() {
    let cube = SpheroPolyhedron::cube(0.04, 0.002).unwrap();
    let vertices = cube.core_vertices().to_vec();
    let loops = cube.faces().iter().map(|f| f.vertices.clone()).collect();
    let core = ConvexPolyhedron::new(vertices, loops).unwrap();
    let general = SpheroPolyhedron::from_core(core, 0.002).unwrap();
    // Recentring costs one rounding of the coordinates.
    assert!(
        (general.unit_inertia() - cube.unit_inertia()).amax() < 1e-12 * cube.unit_inertia().amax()
    );
    assert!((general.bounding_radius() - cube.bounding_radius()).abs() < 1e-15);
}

#[test]
fn reach_of_the_cube() {
    let cube = SpheroPolyhedron::cube(0.04, 0.002).unwrap();
    assert!((cube.extent_along(&Vector3::x()) - 0.02).abs() < 1e-16);
    assert!((cube.extent_along(&-Vector3::z()) - 0.02).abs() < 1e-16);
    let corner = 0.018 * 3_f64.sqrt() + 0.002;
    assert!((cube.bounding_radius() - corner).abs() < 1e-16);
    let diagonal = Vector3::repeat(1.0).normalize();
    assert!((cube.extent_along(&diagonal) - corner).abs() < 1e-16);
}

/// Textbook volume over a³, surface over a² and dihedral angle of regular solids.
fn textbook(solid: RegularSolid) -> [f64; 3] {
    let (root2, root3, root5) = (2_f64.sqrt(), 3_f64.sqrt(), 5_f64.sqrt());
    match solid {
        RegularSolid::Tetrahedron => [root2 / 12.0, root3, (1.0 / 3.0_f64).acos()],
        RegularSolid::Cube => [1.0, 6.0, PI / 2.0],
        RegularSolid::Octahedron => [root2 / 3.0, 2.0 * root3, (-1.0 / 3.0_f64).acos()],
        RegularSolid::Dodecahedron => [
            (15.0 + 7.0 * root5) / 4.0,
            3.0 * (25.0 + 10.0 * root5).sqrt(),
            (-1.0 / root5).acos(),
        ],
        RegularSolid::Icosahedron => [
            5.0 / 12.0 * (3.0 + root5),
            5.0 * root3,
            (-root5 / 3.0).acos(),
        ],
    }
}

#[test]
fn regular_solids_have_the_textbook_volume_and_are_isotropic() {
    let (edge, share) = (0.04, 0.3);
    for solid in RegularSolid::ALL {
        let sharp = SharpPolyhedron::regular(solid, edge).unwrap();
        let radius = share * sharp.inradius();
        let body = sharp.rounded(radius).unwrap();
        // The core is the same solid, smaller by the radius.
        let a = edge * (1.0 - share);
        let [volume, surface, angle] = textbook(solid);
        let edges = body.edges().count() as f64;
        let expected = volume * a.powi(3)
            + surface * a.powi(2) * radius
            + edges * a * (PI - angle) * radius.powi(2) / 2.0
            + 4.0 / 3.0 * PI * radius.powi(3);
        assert!((body.volume() / expected - 1.0).abs() < 1e-12, "{solid:?}");
        let inertia = body.unit_inertia();
        let isotropic = Matrix3::from_diagonal_element(inertia.m11);
        assert!(
            (inertia - isotropic).amax() < 1e-12 * inertia.m11,
            "{solid:?}"
        );
    }
}
