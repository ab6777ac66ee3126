use super::*;
use crate::rigid::fixture::cuboid;

fn floor() -> Plane {
    Plane {
        name: "floor",
        normal: Vec3::z(),
        offset: 0.0,
        flow_friction: 0.0,
    }
}

fn cube_at(height: f64) -> Body {
    let mut body = cuboid([0.04; 3]);
    body.state.position.z = height;
    body
}

#[test]
fn springs_forget_once_apart() {
    let mut body = cube_at(0.0199);
    body.state.momentum = Vec3::new(body.mass, 0.0, 0.0);
    evaluate_wall_contacts(&mut body, &RigidWalls::planar(&[floor()]), 1e-5);
    assert!(
        body.state
            .springs
            .iter()
            .any(|spring| spring.stretch.x > 0.0)
    );
    assert!(
        body.state.wall_load.force.x < 0.0,
        "friction is against the sliding"
    );
    body.state.position.z = 0.0201;
    evaluate_wall_contacts(&mut body, &RigidWalls::planar(&[floor()]), 1e-5);
    assert!(
        body.state
            .springs
            .iter()
            .all(|spring| *spring == Spring::NEW)
    );
    assert_eq!(body.state.wall_load, Load::default());
    assert_eq!(body.state.wall_energy, 0.0);
}
