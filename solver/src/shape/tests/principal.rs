use crate::shape::{PrincipalInertia, SpheroPolyhedron};
use nalgebra::{Matrix3, Rotation3, Vector3};
use std::f64::consts::PI;

/// Moments of a sphero-box about its middle for density 1, from equation 14 evaluated for three
/// lengths: core, prisms, quarter cylinders and ball sectors.
fn sphero_box_moments([a, b, c]: [f64; 3], r: f64) -> [f64; 3] {
    // ∫ x² dV of the solid with the core a × b × c, x along a.
    let second = |a: f64, b: f64, c: f64| {
        let core = a.powi(3) * b * c / 12.0;
        let prisms_across = a.powi(3) / 12.0 * 2.0 * r * (b + c);
        let cap = |x: f64| (0.5 * a + x).powi(3) / 3.0;
        let prisms_along = 2.0 * b * c * (cap(r) - cap(0.0));
        let cylinder_along = PI * r * r * a.powi(3) / 12.0;
        // A half disc's first and second moments over its area: 4r/3π and r²/4.
        let off = 0.25 * a * a + a * 4.0 * r / (3.0 * PI) + 0.25 * r * r;
        let cylinders_across = PI * r * r * (b + c) * off;
        // A half ball's: 3r/8 and r²/5.
        let balls = 4.0 / 3.0 * PI * r.powi(3) * (0.25 * a * a + 0.375 * a * r + 0.2 * r * r);
        core + prisms_across + prisms_along + cylinder_along + cylinders_across + balls
    };
    let [x, y, z] = [second(a, b, c), second(b, c, a), second(c, a, b)];
    [y + z, z + x, x + y]
}

// The box's longest side is along z, its shortest along y.
#[test]
fn a_box_has_its_moments_about_its_sides() {
    let (sides, r) = ([0.04, 0.02, 0.06], 0.003);
    let solid = SpheroPolyhedron::cuboid(sides, r).unwrap();
    let principal = PrincipalInertia::of(&solid.unit_inertia());
    let [x, y, z] = sphero_box_moments(sides.map(|side| side - 2.0 * r), r);
    for (got, wanted) in principal.moments.iter().zip([z, x, y]) {
        assert!((got / wanted - 1.0).abs() < 1e-12, "{got} {wanted}");
    }
    let axes = [Vector3::z(), Vector3::x(), Vector3::y()];
    for (got, wanted) in principal.axes.iter().zip(axes) {
        assert!((got - wanted).norm() < 1e-12, "{got}");
    }
}

#[test]
fn a_turned_tensor_has_turned_axes_and_the_same_moments() {
    let turn = Rotation3::from_euler_angles(0.3, -0.7, 1.1).into_inner();
    let tensor = turn * Matrix3::from_diagonal(&Vector3::new(3.0, 1.0, 2.0)) * turn.transpose();
    let principal = PrincipalInertia::of(&tensor);
    for (n, moment) in principal.moments.iter().enumerate() {
        assert!((moment - (n + 1) as f64).abs() < 1e-14, "{moment}");
        let axis = principal.axes[n];
        assert!((tensor * axis - axis * *moment).norm() < 1e-14);
    }
    let [a, b, c] = principal.axes;
    assert!((a.cross(&b) - c).norm() < 1e-14, "right-handed");
}

#[test]
fn equal_moments_have_the_axes_nearest_to_the_frame() {
    let cube = SpheroPolyhedron::cube(0.04, 0.002).unwrap();
    let own = [Vector3::x(), Vector3::y(), Vector3::z()];
    assert_eq!(PrincipalInertia::of(&cube.unit_inertia()).axes, own);
    let slab = SpheroPolyhedron::cuboid([0.04, 0.01, 0.04], 0.002).unwrap();
    let [a, b, c] = PrincipalInertia::of(&slab.unit_inertia()).axes;
    assert!((c - Vector3::y()).norm() < 1e-12, "{c}");
    assert!((a.cross(&b) - c).norm() < 1e-12);
    assert!((a.amax() - 1.0).abs() < 1e-12, "{a}");
}
