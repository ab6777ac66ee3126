use super::*;

fn glass_beads(limiting_friction: f64) -> Material {
    Material {
        bulk_density: 1500.0,
        bulk_modulus: 8.0e5,
        shear_modulus: 3.8e5,
        yielding: Yielding::Granular {
            static_friction: 0.382,
            limiting_friction,
            reference_inertial_number: 0.279,
            grain_diameter: 1e-3,
            grain_density: 2500.0,
        },
    }
}

// Values worked out by hand from the quadratic for τ (docs/method.md, equation 6):
// p = 500 Pa, Δt = 1e-5 s; printed to six digits, hence the tolerance.
#[test]
fn the_return_mapping_solves_its_quadratic() {
    let beads = glass_beads(0.644);
    for (trial, expected) in [(200.0, 192.926), (400.0, 226.147), (1000.0, 270.401)] {
        let shear = shear_stress(&beads, trial, 500.0, 1e-5);
        assert!((shear - expected).abs() < 6e-4, "{trial}: {shear}");
    }
    assert_eq!(shear_stress(&beads, 190.0, 500.0, 1e-5), 190.0);
}

#[test]
fn equal_frictions_give_drucker_prager() {
    let beads = glass_beads(0.382);
    let shear = shear_stress(&beads, 1000.0, 500.0, 1e-5);
    assert!((shear - 191.0).abs() < 1e-9, "{shear}");
}

// With τ = μ(I) p after the step, the plastic shear rate that the step
// implies, (τ_trial − τ)/(G Δt), must give back I = γ̇ d √(ρ_s/p).
#[test]
fn flowing_shear_stress_is_mu_of_i() {
    let (beads, pressure, dt) = (glass_beads(0.644), 500.0, 1e-5);
    let trial = 700.0;
    let shear = shear_stress(&beads, trial, pressure, dt);
    let rate = (trial - shear) / (beads.shear_modulus * dt);
    let inertial = rate * 1e-3 * (2500.0f64 / pressure).sqrt();
    let friction = 0.382 + (0.644 - 0.382) / (1.0 + 0.279 / inertial);
    assert!((shear / pressure - friction).abs() < 1e-12);
}

#[test]
fn grains_apart_carry_nothing() {
    let pressed = Sym3::isotropic(-100.0);
    let after = stress(
        &glass_beads(0.644),
        &pressed,
        &Mat3::zeros(),
        1499.9,
        0.0,
        1e-5,
    );
    assert_eq!(after, Sym3::default());
}

// A pure rotation turns the stress with the body: after a quarter turn in
// small steps s_xx has become s_yy. Explicit steps grow s by (ωΔt)² each.
#[test]
fn stress_turns_with_the_material() {
    let elastic = Material {
        yielding: Yielding::Never,
        ..glass_beads(0.644)
    };
    let spin = Mat3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let steps = 10_000;
    let dt = std::f64::consts::FRAC_PI_2 / f64::from(steps);
    let mut turned = Sym3 {
        xx: 1.0,
        yy: -1.0,
        ..Sym3::default()
    };
    for _ in 0..steps {
        turned = stress(&elastic, &turned, &spin, 1500.0, 0.0, dt);
    }
    assert!((turned.xx + 1.0).abs() < 1e-3, "{turned:?}");
    assert!((turned.yy - 1.0).abs() < 1e-3);
    assert!(turned.xy.abs() < 1e-3);
}

#[test]
fn a_matrix_times_its_inverse_is_one() {
    let m = Mat3::new(1.1, 0.2, -0.3, 0.05, 0.9, 0.1, -0.2, 0.3, 1.2);
    let (determinant, inverse) = inverted(&m);
    // A few roundings of numbers of order one.
    assert!((m * inverse - Mat3::identity()).norm() < 1e-15);
    assert!((determinant - m.determinant()).abs() < 1e-15);
}
