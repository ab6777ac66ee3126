use super::fixture::cuboid;
use super::*;

/// The 1:2:3 box of validation.md, case 5, spinning about its middle axis but
/// for a little.
fn tumbling() -> Body {
    let mut body = cuboid([0.01, 0.02, 0.03]);
    let spin = Vec3::new(0.01, 10.0, 0.02);
    body.state.angular_momentum = body.inertia * spin;
    body
}

fn turned_freely(steps: u32, duration: f64) -> Body {
    let mut body = tumbling();
    for _ in 0..steps {
        body.drift(duration / f64::from(steps));
    }
    body
}

// Against a run a hundred times finer, halving the step divides the error of
// the orientation by four.
#[test]
fn free_turning_is_of_second_order() {
    let fine = turned_freely(40_000, 1.0).state.orientation;
    let error = |steps| turned_freely(steps, 1.0).state.orientation.angle_to(&fine);
    let (coarse, half) = (error(200), error(400));
    let order = (coarse / half).log2();
    assert!(order > 1.9 && order < 2.2, "{order}: {coarse:e}, {half:e}");
}

// A space-fixed angular momentum is what drift starts from, so only the energy
// can drift: with order 2 from the midpoint rule; 1e-4 at 0.01 rad per step.
#[test]
fn free_turning_keeps_energy() {
    let (start, end) = (tumbling(), turned_freely(10_000, 10.0));
    let drift = end.kinetic_energy() / start.kinetic_energy() - 1.0;
    assert!(drift.abs() < 1e-4, "{drift:e}");
    assert_eq!(start.state.angular_momentum, end.state.angular_momentum);
}

// Turning about the middle axis is unstable: the body flips over, again and
// again (Dzhanibekov).
#[test]
fn the_middle_axis_flips() {
    let mut body = tumbling();
    let mut lowest = 1.0f64;
    for _ in 0..10_000 {
        body.drift(1e-3);
        lowest = lowest.min(body.to_world(&Vec3::y()).y);
    }
    assert!(lowest < -0.9, "{lowest}");
}

#[test]
fn angular_velocity_is_about_world_axes() {
    let mut body = cuboid([0.01, 0.02, 0.03]);
    body.state.orientation = UnitQuaternion::from_euler_angles(0.3, -0.8, 1.9);
    let spin = Vec3::new(1.0, -2.0, 3.0);
    body.state.angular_momentum = body.to_world(&(body.inertia * body.to_body(&spin)));
    assert!((body.angular_velocity() - spin).norm() < 1e-13);
    let arm = Vec3::new(0.0, 0.1, 0.0);
    assert!((body.velocity_at(&arm) - spin.cross(&arm)).norm() < 1e-13);
}

// A push through the centre meets the mass alone; off centre, a unit push at
// the arm a changes the speed of the place by 1/m + (a × n)·I⁻¹(a × n).
#[test]
fn effective_mass_resists_a_push() {
    let body = cuboid([0.01, 0.02, 0.03]);
    let through = body.effective_mass(&Vec3::new(0.0, 0.0, 0.01), &Vec3::z());
    assert!((through / body.mass - 1.0).abs() < 1e-14);
    let (arm, push) = (Vec3::new(0.004, -0.003, 0.01), Vec3::z());
    let mut pushed = body.clone();
    pushed.kick(
        &Load {
            force: push,
            torque: arm.cross(&push),
        },
        1.0,
    );
    let speed = pushed.velocity_at(&arm).dot(&push);
    assert!((body.effective_mass(&arm, &push) * speed - 1.0).abs() < 1e-13);
}
