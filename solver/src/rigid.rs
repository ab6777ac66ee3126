//! Rigid bodies: sphero-polyhedra that move (docs/method.md, equations 15 and 16).

use crate::bed::{NearGround, PlacedSolid};
use crate::contact::friction::Spring;
use crate::contact::law::ContactLaw;
use crate::contact::wall_touch::WallTouch;
use crate::math::{Mat3, Vec3};
use crate::motion::{PrescribedMotion, Velocities};
use crate::shape::SpheroPolyhedron;
use nalgebra::{Quaternion, UnitQuaternion};
use serde::{Deserialize, Serialize};

mod approach;
mod free_turning;
mod inertia;
mod turned_core;

pub use approach::approach_bound;
pub use inertia::InverseInertia;
pub use turned_core::TurnedCore;

/// Degrees of freedom of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum Freedom {
    /// Loads move it.
    Free,
    /// Loads move it, but it never leaves the plane y = 0 nor turns out of it: loads that would do
    /// that are rounding.
    InPlane,
    /// A barrier, which nothing moves.
    Fixed,
    /// A prescribed motion, whatever acts on it.
    Prescribed(Prescribed),
}

/// A prescribed motion from a starting position.
#[derive(Debug, Clone, PartialEq)]
pub struct Prescribed {
    /// Centre at time 0 [m].
    pub start: Vec3,
    /// Motion from there.
    pub motion: PrescribedMotion,
}

/// A rigid body: its properties and its state.
#[derive(Debug, Clone)]
pub struct Body {
    /// Its shape.
    pub shape: SpheroPolyhedron,
    /// Mass [kg].
    pub mass: f64,
    /// Inertia tensor in the body frame [kg m²].
    pub inertia: Mat3,
    /// Its inverse.
    pub inverse_inertia: InverseInertia,
    /// Law of its contacts with walls.
    pub wall_law: ContactLaw,
    /// Law of its contacts with material points.
    pub flow_law: ContactLaw,
    /// Rolling resistance: the torque of a contact is at most this × its
    /// equivalent radius × its normal force.
    pub rolling_friction: f64,
    /// Freedom to move.
    pub freedom: Freedom,
    /// Its contacts with walls, as last found; kept to avoid allocations.
    pub wall_touches: Vec<WallTouch>,
    /// Features near a terrain, as last found; kept since they hold for a while.
    pub near_ground: NearGround,
    /// Its core vertices in world axes, as last turned; kept to turn them once per sub-step.
    pub turned_core: TurnedCore,
    /// State.
    pub state: BodyState,
}

/// State of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodyState {
    /// Centre of mass [m].
    pub position: Vec3,
    /// Body frame to world.
    pub orientation: UnitQuaternion<f64>,
    /// Momentum [kg m/s].
    pub momentum: Vec3,
    /// Angular momentum about the centre of mass, world axes [kg m²/s].
    pub angular_momentum: Vec3,
    /// Tangential spring of every pair of core vertex and wall, vertex by vertex, then those of the
    /// nodes of a terrain that it touches; new where they are apart.
    pub springs: Vec<Spring>,
    /// Nodes of a terrain that it touches, in order.
    pub ground_nodes: Vec<[i32; 2]>,
    /// Their springs against rolling; empty without rolling resistance.
    pub rolling: Vec<Spring>,
    /// Current load of the walls.
    pub wall_load: Load,
    /// Energy stored in its wall contacts now [J].
    pub wall_energy: f64,
    /// Its deepest overlap with a wall now [m]; 0 off all walls.
    pub wall_overlap: f64,
    /// Current load of other free bodies.
    pub body_load: Load,
    /// Current load of fixed bodies, and of those with a prescribed motion.
    pub barrier_load: Load,
    /// Number of bodies it touches now.
    pub touching_bodies: u32,
    /// Time for which it has hardly moved, without a flow on it [s]; infinite while it is in its
    /// initial static equilibrium on the walls.
    pub still_for: f64,
}

/// Force and torque on a body.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Load {
    /// Force [N].
    pub force: Vec3,
    /// Torque about the centre of mass [N m].
    pub torque: Vec3,
}

impl Load {
    /// Adds another load on the same body.
    pub fn add(&mut self, other: &Self) {
        self.force += other.force;
        self.torque += other.torque;
    }

    /// Adds a force that acts at `arm` from the centre of mass.
    pub fn add_at(&mut self, arm: &Vec3, force: &Vec3) {
        self.force += force;
        self.torque += arm.cross(force);
    }

    /// The load times a factor.
    pub fn times(&self, factor: f64) -> Self {
        Self {
            force: self.force * factor,
            torque: self.torque * factor,
        }
    }

    /// Power at these velocities of the body on which it acts [W].
    pub fn power(&self, at: &Velocities) -> f64 {
        self.force.dot(&at.linear) + self.torque.dot(&at.angular)
    }
}

impl Body {
    /// Velocity of the centre of mass [m/s].
    pub fn velocity(&self) -> Vec3 {
        self.state.momentum / self.mass
    }

    /// Angular velocity in world axes [rad/s].
    pub fn angular_velocity(&self) -> Vec3 {
        self.inverse_inertia_times(&self.state.orientation, &self.state.angular_momentum)
    }

    /// Both velocities, in world axes; zero for a fixed body.
    pub fn velocities(&self) -> Velocities {
        match self.freedom {
            Freedom::Fixed => Velocities::NONE,
            Freedom::Free | Freedom::InPlane | Freedom::Prescribed(_) => {
                self.velocities_with(&self.state.momentum, &self.state.angular_momentum)
            }
        }
    }

    /// Velocities with other momenta, in the current orientation.
    pub fn velocities_with(&self, momentum: &Vec3, angular_momentum: &Vec3) -> Velocities {
        Velocities {
            linear: momentum / self.mass,
            angular: self.inverse_inertia_times(&self.state.orientation, angular_momentum),
        }
    }

    /// Velocity of the place at `arm` from the centre of mass [m/s].
    pub fn velocity_at(&self, arm: &Vec3) -> Vec3 {
        self.velocity() + self.angular_velocity().cross(arm)
    }

    /// A vector of the body frame in world axes.
    pub fn to_world(&self, v: &Vec3) -> Vec3 {
        self.state.orientation * v
    }

    /// A vector of world axes in the body frame.
    pub fn to_body(&self, v: &Vec3) -> Vec3 {
        self.state.orientation.inverse_transform_vector(v)
    }

    /// Distance of a place from the rounded surface [m]; negative inside.
    pub fn distance_to(&self, place: &Vec3) -> f64 {
        let arm = place - self.state.position;
        let closest = self.shape.closest_feature(&self.to_body(&arm));
        closest.distance - self.shape.sphero_radius()
    }

    /// F·F/m + T·I⁻¹T [W/s]: the power of a load at the accelerations that it gives, over their
    /// duration.
    pub fn response(&self, load: &Load) -> f64 {
        let turning = load.torque.dot(&self.angular_acceleration(&load.torque));
        load.force.norm_squared() / self.mass + turning
    }

    /// Angular acceleration that a torque gives to a body with zero angular velocity [rad/s²].
    pub fn angular_acceleration(&self, torque: &Vec3) -> Vec3 {
        self.inverse_inertia_times(&self.state.orientation, torque)
    }

    /// 1/m [1/kg]; 0 for a fixed or prescribed body.
    pub fn inverse_mass(&self) -> f64 {
        if self.is_free() { 1.0 / self.mass } else { 0.0 }
    }

    /// Its shape in its place.
    pub fn placed(&self) -> PlacedSolid<'_> {
        PlacedSolid {
            shape: &self.shape,
            position: self.state.position,
            orientation: self.state.orientation,
        }
    }

    /// True if loads move it.
    pub fn is_free(&self) -> bool {
        match self.freedom {
            Freedom::Free | Freedom::InPlane => true,
            Freedom::Fixed | Freedom::Prescribed(_) => false,
        }
    }

    /// Its prescribed motion, if it has one.
    pub fn prescribed(&self) -> Option<&Prescribed> {
        match &self.freedom {
            Freedom::Prescribed(prescribed) => Some(prescribed),
            Freedom::Free | Freedom::InPlane | Freedom::Fixed => None,
        }
    }

    /// Moves a body with a prescribed motion from one time to a later one [s]; leaves
    /// any other as it is.
    pub fn follow(&mut self, from: f64, to: f64) {
        let Freedom::Prescribed(prescribed) = &self.freedom else {
            return;
        };
        self.state.position = prescribed.start + prescribed.motion.way(to);
        if let Some(turn) = prescribed.motion.turn(from, to) {
            let mut end = turn * self.state.orientation;
            end.renormalize();
            self.state.orientation = end;
        }
        let velocities = prescribed.motion.velocities(to);
        self.set_velocities(&velocities);
    }

    /// Sets the momenta to those of these velocities in the current orientation.
    pub fn set_velocities(&mut self, velocities: &Velocities) {
        self.state.momentum = velocities.linear * self.mass;
        let spin = self.to_body(&velocities.angular);
        self.state.angular_momentum = self.to_world(&(self.inertia * spin));
    }

    /// Work of its prescribed motion against a load on it in `dt` [J]; none without such a motion.
    pub fn work_against(&self, load: &Load, dt: f64) -> f64 {
        match self.freedom {
            Freedom::Prescribed(_) => -load.power(&self.velocities()) * dt,
            Freedom::Free | Freedom::InPlane | Freedom::Fixed => 0.0,
        }
    }

    /// Mass that resists a force along `direction` (unit) at `arm` [kg].
    pub fn effective_mass(&self, arm: &Vec3, direction: &Vec3) -> f64 {
        let lever = arm.cross(direction);
        let turned = self.inverse_inertia_times(&self.state.orientation, &lever);
        1.0 / (1.0 / self.mass + lever.dot(&turned))
    }

    /// Kinetic energy [J].
    pub fn kinetic_energy(&self) -> f64 {
        let spinning = self.state.angular_momentum.dot(&self.angular_velocity());
        0.5 * (self.state.momentum.norm_squared() / self.mass + spinning)
    }

    /// True if it is in its initial static equilibrium, held by the walls alone.
    pub fn is_held(&self) -> bool {
        self.state.still_for == f64::INFINITY
    }

    /// True if a wall or another body touches it.
    pub fn is_supported(&self) -> bool {
        self.state.wall_energy > 0.0 || self.state.touching_bodies > 0
    }

    /// Largest speed of any of its places [m/s].
    pub fn largest_speed(&self) -> f64 {
        self.fastest_place(&self.velocity(), &self.angular_velocity())
    }

    /// Largest speed of a place, for these velocities in world axes.
    fn fastest_place(&self, linear: &Vec3, angular: &Vec3) -> f64 {
        self.shape
            .fastest_place(&self.to_body(linear), &self.to_body(angular))
    }

    /// Upper bound of the speed that free turning can give to any place of it [m/s]: of the energy
    /// of turning a place has no more than its compliance allows, (ω×c)·n = ω·(c×n) ≤ √(ω·Iω)
    /// √((c×n)·I⁻¹(c×n)).
    pub fn turning_bound(&self) -> f64 {
        let twice_energy = self.state.angular_momentum.dot(&self.angular_velocity());
        (twice_energy.max(0.0) * self.shape.turning_compliance() / self.mass).sqrt()
    }

    /// Compliance to forces that turn it, at a place with this arm in world axes, in the direction
    /// where it is largest [1/kg]; 0 for a body that is not free.
    pub fn turning_compliance_at(&self, arm: &Vec3) -> f64 {
        if self.is_free() {
            self.inverse_inertia.compliance_at(&self.to_body(arm))
        } else {
            0.0
        }
    }

    /// Least mass that resists a force anywhere on its surface [kg].
    pub fn least_effective_mass(&self) -> f64 {
        self.mass / (1.0 + self.shape.turning_compliance())
    }

    /// Largest speed in a step that begins now [m/s]: the current one, or the largest of a
    /// prescribed motion.
    pub fn speed_ahead(&self) -> f64 {
        match &self.freedom {
            Freedom::Prescribed(prescribed) => {
                prescribed.motion.fastest(self.shape.bounding_radius())
            }
            Freedom::Free | Freedom::InPlane | Freedom::Fixed => self.largest_speed(),
        }
    }

    /// Largest acceleration of a place under gravity [m/s²] and a load, without the effect of its
    /// current turning [m/s²]; 0 for a fixed or prescribed body.
    pub fn largest_acceleration(&self, gravity: &Vec3, load: &Load) -> f64 {
        match self.freedom {
            Freedom::Fixed | Freedom::Prescribed(_) => 0.0,
            Freedom::Free | Freedom::InPlane => {
                let linear = gravity + load.force / self.mass;
                self.fastest_place(&linear, &self.angular_acceleration(&load.torque))
            }
        }
    }

    /// Changes momentum and angular momentum by `load` over `dt`; returns their means in that time.
    /// The work of the load at their velocities is the change of kinetic energy.
    pub fn kick(&mut self, load: &Load, dt: f64) -> [Vec3; 2] {
        let before = (self.state.momentum, self.state.angular_momentum);
        self.state.momentum += load.force * dt;
        self.state.angular_momentum += load.torque * dt;
        if self.freedom == Freedom::InPlane {
            self.state.momentum.y = 0.0;
            self.state.angular_momentum.x = 0.0;
            self.state.angular_momentum.z = 0.0;
        }
        let after = (self.state.momentum, self.state.angular_momentum);
        [0.5 * (before.0 + after.0), 0.5 * (before.1 + after.1)]
    }

    /// Moves and turns freely for `dt`, at constant momentum and angular momentum. The
    /// turning is reversible and symplectic: its energy stays near that of the start.
    pub fn drift(&mut self, dt: f64) {
        self.state.position += self.velocity() * dt;
        self.state.orientation = if self.freedom == Freedom::InPlane {
            self.turned_in_plane(dt)
        } else {
            let state = &self.state;
            self.inverse_inertia
                .turned_freely(&state.orientation, &state.angular_momentum, dt)
        };
    }

    /// Orientation after turning for `dt` about the direction of y, which is a principal axis
    /// except for rounding, which would turn the body out of the plane.
    fn turned_in_plane(&self, dt: f64) -> UnitQuaternion<f64> {
        let (sin, cos) = (0.5 * self.angular_velocity().y * dt).sin_cos();
        let turn = Quaternion::new(cos, 0.0, sin, 0.0);
        UnitQuaternion::new_normalize(turn * self.state.orientation.into_inner())
    }

    /// Name of the first non-finite quantity, if any.
    pub fn non_finite(&self) -> Option<&'static str> {
        let state = &self.state;
        let finite = [
            ("position", state.position.sum().is_finite()),
            ("velocity", state.momentum.sum().is_finite()),
            ("angular velocity", state.angular_momentum.sum().is_finite()),
            ("orientation", state.orientation.coords.sum().is_finite()),
        ];
        finite
            .into_iter()
            .find_map(|(name, finite)| (!finite).then_some(name))
    }

    fn inverse_inertia_times(&self, orientation: &UnitQuaternion<f64>, v: &Vec3) -> Vec3 {
        orientation * (&self.inverse_inertia * orientation.inverse_transform_vector(v))
    }
}

#[cfg(test)]
pub(crate) mod fixture;
#[cfg(test)]
mod tests;
