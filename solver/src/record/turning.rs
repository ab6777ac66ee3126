//! Criterion of rolling and sliding of a body on its contacts.

use super::motion::Motion;
use crate::contact::island::BodyReport;
use crate::math::Vec3;
use crate::rigid::Body;
use crate::walls::{Plane, PlanesAt};
use serde::{Deserialize, Serialize};

/// Turn after which a body has left the face, edge or vertex it stood on [rad]; contacts yield
/// by less than a degree.
const TURN: f64 = 0.05;
/// Travel of a sliding body during a turn of [`TURN`], over the product of that turn and its
/// bounding radius.
const TRAVEL: f64 = 2.0;

/// Turn and travel of a body in contact, stretch by stretch: each ends with the turn of a body
/// that rolls or with the travel of one that slides.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, Default)]
pub(super) struct Turning {
    /// Turn about axes in the plane of contact, in this stretch [rad].
    turned: Vec3,
    /// Travel in this stretch [m].
    travelled: Vec3,
    /// True if it rolled in the last stretch.
    rolls: bool,
}

impl Turning {
    /// Adds a sub-step of `dt` [s]; motion in flight counts as neither.
    pub(super) fn take_in(
        &mut self,
        (body, motion): (&Body, &Motion),
        report: &BodyReport,
        walls: &PlanesAt,
        dt: f64,
    ) {
        let Some(normal) = contact_normal(body, report, walls) else {
            return;
        };
        let spin = motion.angular_velocity;
        self.turned += (spin - normal * spin.dot(&normal)) * dt;
        self.travelled += motion.velocity * dt;
        let slides_from = TRAVEL * TURN * body.shape.bounding_radius();
        if self.turned.norm() >= TURN {
            self.begin(true);
        } else if self.travelled.norm() >= slides_from {
            self.begin(false);
        }
    }

    fn begin(&mut self, rolls: bool) {
        *self = Self {
            rolls,
            ..Self::default()
        };
    }

    /// True if it rolls, provided that it is on a wall or body.
    pub(super) fn rolls(&self) -> bool {
        self.rolls
    }
}

/// Unit normal of a body's contact in a sub-step: that of the nearest wall if any touched it,
/// else the direction of other bodies' force.
fn contact_normal(body: &Body, report: &BodyReport, walls: &PlanesAt) -> Option<Vec3> {
    if report.wall_load.force == Vec3::zeros() {
        return report.body_load.force.try_normalize(0.0);
    }
    let gap = |plane: &Plane| {
        let deepest = body.shape.extent_along(&body.to_body(&-plane.normal));
        plane.height(&body.state.position) - deepest
    };
    let nearest = walls.iter().min_by(|a, b| gap(a).total_cmp(&gap(b)));
    nearest.map(|plane| plane.normal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigid::Load;
    use crate::rigid::fixture::cuboid;
    use crate::walls::RigidWalls;

    /// True if a cube on the floor rolls with this velocity and spin for so long.
    fn rolls(velocity: Vec3, spin: Vec3, duration: f64) -> bool {
        let body = cuboid([0.04; 3]);
        let report = BodyReport {
            wall_load: Load {
                force: Vec3::new(0.3, 0.0, 1.0),
                torque: Vec3::zeros(),
            },
            ..BodyReport::default()
        };
        let floor = [Plane {
            name: "floor",
            normal: Vec3::z(),
            offset: -0.02,
            flow_friction: 0.4,
        }];
        let motion = Motion {
            velocity,
            angular_velocity: spin,
            ..Motion::of(&body)
        };
        let walls = RigidWalls::planar(&floor).planes_at(&Vec3::zeros());
        let mut turning = Turning::default();
        for _ in 0..(duration * 1e3) as u32 {
            turning.take_in((&body, &motion), &report, &walls, 1e-3);
        }
        turning.rolls()
    }

    #[test]
    fn rolling_is_turning_about_an_axis_in_the_plane_of_contact() {
        let (along, across) = (Vec3::x(), Vec3::y());
        assert!(rolls(along * 0.5, across * (0.5 / 0.02), 0.1));
        assert!(rolls(Vec3::zeros(), across * 5.0, 0.1));
        assert!(!rolls(along * 0.5, Vec3::z() * 20.0, 1.0), "spins upright");
        assert!(!rolls(along * 0.5, across * 5.0, 1.0), "slides as it turns");
        assert!(
            !rolls(Vec3::zeros(), across * 0.015, 1.0),
            "0.9° are no roll"
        );
    }
}
