use super::*;
use crate::rigid::Freedom;
use crate::rigid::fixture::cuboid;

fn flow(mass: f64, linear: Vec3, energy: f64) -> Totals {
    Totals {
        mass,
        momentum: Impulse {
            linear,
            angular: Vec3::new(0.0, linear.z, 0.0),
        },
        momentum_scale: linear.norm(),
        kinetic_energy: linear.norm_squared() / (2.0 * mass),
        energy,
        ..Totals::default()
    }
}

fn impulse(linear: Vec3) -> Impulse {
    Impulse {
        linear,
        angular: Vec3::new(0.0, linear.z, 0.0),
    }
}

#[test]
fn what_is_accounted_for_leaves_no_residual() {
    let (start, bodies) = (flow(2.0, Vec3::zeros(), 1.0), Totals::default());
    let mut audit = Audit::start(&start, &bodies);
    let push = Vec3::new(3.0, 0.0, -4.0);
    audit.exchange(&impulse(push));
    audit.check(&flow(2.0, push, 1.0), &bodies, 0.0);
    assert_eq!(audit.momentum_residual, 0.0);
    assert_eq!(audit.angular_momentum_residual, 0.0);
    assert_eq!(audit.mass_error, 0.0);
}

// 5 kg m/s given, 1 missing: a residual of 1 over Σ m|v| = 4 and 5 exchanged.
#[test]
fn what_is_missing_shows_and_stays() {
    let (start, bodies) = (flow(2.0, Vec3::zeros(), 1.0), Totals::default());
    let mut audit = Audit::start(&start, &bodies);
    audit.exchange(&impulse(Vec3::new(0.0, 0.0, 5.0)));
    audit.check(&flow(2.0, Vec3::new(0.0, 0.0, 4.0), 1.0), &bodies, 0.0);
    assert!((audit.momentum_residual - 1.0 / 9.0).abs() < 1e-15);
    assert!((audit.angular_momentum_residual - 1.0 / 9.0).abs() < 1e-15);
    audit.check(&flow(2.0, Vec3::new(0.0, 0.0, 5.0), 1.0), &bodies, 0.0);
    assert!(
        (audit.momentum_residual - 1.0 / 9.0).abs() < 1e-15,
        "the largest counts"
    );
}

#[test]
fn what_left_is_still_part_of_the_balance() {
    let moving = Vec3::new(4.0, 0.0, 0.0);
    let bodies = Totals::default();
    let mut audit = Audit::start(&flow(2.0, moving, 4.0), &bodies);
    audit.leave(7, &flow(0.5, moving * 0.25, 1.0));
    audit.check(&flow(1.5, moving * 0.75, 3.0), &bodies, 0.0);
    assert_eq!((audit.points_outflow, audit.outflow_mass()), (7, 0.5));
    assert_eq!((audit.mass_error, audit.momentum_residual), (0.0, 0.0));
    assert_eq!(audit.energy_residual(), 0.0);
    audit.check(&flow(1.4, moving * 0.75, 3.0), &bodies, 0.0);
    assert!((audit.mass_error - 0.05).abs() < 1e-15);
}

// Down from 4 to 1 J, up again to 1.5 J, with a kinetic energy of 4 J at most: 0.125.
#[test]
fn energy_is_measured_from_its_lowest() {
    let bodies = Totals::default();
    let fast = Vec3::new(4.0, 0.0, 0.0);
    let mut audit = Audit::start(&flow(2.0, fast, 4.0), &bodies);
    audit.check(&flow(2.0, fast, 1.0), &bodies, 0.0);
    audit.check(&flow(2.0, Vec3::zeros(), 1.2), &bodies, 0.3);
    assert!((audit.energy_residual() - 0.125).abs() < 1e-15);
    let still = Audit::start(&Totals::default(), &bodies);
    assert_eq!(still.energy_residual(), 0.0);
}

#[test]
fn barriers_carry_no_momentum_of_the_balance() {
    let mut body = cuboid([0.04; 3]);
    body.state.position = Vec3::new(1.0, 0.0, 2.0);
    body.state.momentum = Vec3::new(0.0, 0.0, 3.0);
    body.state.angular_momentum = Vec3::new(0.0, 0.5, 0.0);
    let gravity = Vec3::new(0.0, 0.0, -10.0);
    let totals = Totals::of_bodies(std::slice::from_ref(&body), &gravity);
    assert_eq!(totals.momentum.linear, body.state.momentum);
    // x × p = (1, 0, 2) × (0, 0, 3) = (0, −3, 0), and the body's own.
    assert_eq!(totals.momentum.angular, Vec3::new(0.0, -2.5, 0.0));
    let potential = totals.energy - totals.kinetic_energy;
    assert!((potential - body.mass * 20.0).abs() < 1e-12);
    body.freedom = Freedom::Fixed;
    assert_eq!(Totals::of_bodies(&[body], &gravity), Totals::default());
}

#[test]
fn weight_acts_at_the_mass_centre() {
    let totals = Totals {
        mass: 2.0,
        first_moment: Vec3::new(6.0, 0.0, 0.0),
        ..Totals::default()
    };
    let weight = FlowMoments::of(&totals).weight(&Vec3::new(0.0, 0.0, -10.0), 0.1);
    assert!((weight.linear - Vec3::new(0.0, 0.0, -2.0)).norm() < 1e-15);
    // Lever 3 m: 3 × 2 N s, turning x towards −z, which is +y.
    assert!((weight.angular - Vec3::new(0.0, 6.0, 0.0)).norm() < 1e-14);
}
