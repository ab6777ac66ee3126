mod free_turning;

use super::fixture::cuboid;
use super::*;

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

// A push through the centre is resisted by the mass alone; off centre, a unit push at the arm
// a changes the speed of the place by 1/m + (a × n)·I⁻¹(a × n).
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
