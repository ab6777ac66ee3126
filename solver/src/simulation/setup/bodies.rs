//! The bodies of a scenario at its start.

use super::Setup;
use super::resolution::{Crowd, Expected, contact_modulus};
use super::settle::settle;
use crate::bed::NearGround;
use crate::contact::body_wall::evaluate_wall_contacts;
use crate::contact::law::{ContactLaw, Dampings};
use crate::math::Vec3;
use crate::motion::Velocities;
use crate::rigid::{Body, BodyState, Freedom, InverseInertia, Load, Prescribed, TurnedCore};
use crate::scenario::{self, Pose, Scenario};

/// The bodies of a scenario at the start.
pub(super) fn bodies(
    scenario: &Scenario,
    given: &Setup,
    crowd: &Crowd,
    expected: &Expected,
) -> Vec<Body> {
    let mut dampings = Dampings::default();
    let poses = scenario.initial_poses();
    (0..scenario.bodies.len())
        .map(|place| {
            let modulus = || contact_modulus(crowd, place, expected.speed, scenario.gravity_m_s2);
            body(
                scenario,
                given,
                (place, poses[place]),
                modulus,
                &mut dampings,
            )
        })
        .collect()
}

fn body(
    scenario: &Scenario,
    given: &Setup,
    (place, pose): (usize, Pose),
    automatic_modulus: impl FnOnce() -> f64,
    dampings: &mut Dampings,
) -> Body {
    let spec = &scenario.bodies[place];
    let shape = scenario.shape_of(place);
    let mass = spec.density_kg_m3 * shape.volume();
    let inertia = shape.unit_inertia() * spec.density_kg_m3;
    let modulus = spec.contact_modulus_pa.unwrap_or_else(automatic_modulus);
    let wall_law = ContactLaw::damped(
        modulus,
        shape.sphero_radius(),
        dampings.of(spec.restitution),
        spec.friction,
    );
    let flow_law = match &given.flow {
        Some(flow) => flow.contact_law(dampings.of(spec.flow_restitution), spec.flow_friction),
        None => wall_law,
    };
    let mut body = Body {
        inverse_inertia: InverseInertia::of(&inertia).expect("a solid has inertia"),
        state: BodyState {
            position: pose.position,
            orientation: pose.orientation,
            momentum: Vec3::zeros(),
            angular_momentum: Vec3::zeros(),
            springs: Vec::new(),
            ground_nodes: Vec::new(),
            rolling: Vec::new(),
            wall_load: Load::default(),
            wall_energy: 0.0,
            wall_overlap: 0.0,
            body_load: Load::default(),
            barrier_load: Load::default(),
            touching_bodies: 0,
            still_for: 0.0,
        },
        shape,
        mass,
        inertia,
        wall_law,
        flow_law,
        rolling_friction: spec.rolling_friction,
        freedom: freedom(spec, pose.position),
        wall_touches: Vec::new(),
        near_ground: NearGround::default(),
        turned_core: TurnedCore::default(),
    };
    let velocities = match body.prescribed() {
        Some(prescribed) => prescribed.motion.velocities(0.0),
        None => Velocities {
            linear: Vec3::from(spec.velocity_m_s),
            angular: Vec3::from(spec.angular_velocity_rad_s),
        },
    };
    body.set_velocities(&velocities);
    let walls = given.rigid_walls();
    if spec.position.elevation_m.is_none() && body.freedom == Freedom::Free {
        let under = walls.planes_under(&body.placed());
        settle(&mut body, under.iter(), &given.gravity);
    }
    if body.prescribed().is_none() {
        evaluate_wall_contacts(&mut body, &walls, 0.0);
    }
    body
}

fn freedom(spec: &scenario::Body, start: Vec3) -> Freedom {
    match &spec.motion {
        Some(motion) => Freedom::Prescribed(Prescribed {
            start,
            motion: motion.prescribed(),
        }),
        None if spec.fixed => Freedom::Fixed,
        None => Freedom::Free,
    }
}
