//! Scene of a scenario: set-up of the run, bodies and points.

use super::clock::Timing;
use super::guards::Guards;
use crate::bed::Bed;
use crate::contact::island::Surroundings;
use crate::contact::point_body::Reach;
use crate::error::SetupError;
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::points::Point;
use crate::rigid::Body;
use crate::scenario::{self, Precision, Scenario};
use crate::stability::Pace;
use crate::walls::{Ends, Plane, VerticalBoundary, VerticalWalls, WallPace, Walls};
use std::sync::Arc;

mod bodies;
mod flow;
mod prepared;
mod reductions;
mod release;
mod resolution;
mod settle;
mod share;
mod symmetry;

pub use flow::GivenFlow;
pub use prepared::PreparedScene;
pub use reductions::Reductions;
pub use release::Columns;
pub use resolution::Expected;
pub use share::{Share, Shares};
pub(super) use symmetry::near_body;

/// A scene in the solver's own terms, made from a scenario. A caller that builds one without a
/// scenario is responsible for it: nothing here is validated.
#[derive(Debug)]
pub struct Scene {
    /// Constant set-up.
    pub given: Setup,
    /// The bodies at the start.
    pub bodies: Vec<Body>,
    /// The material points at the start.
    pub points: Vec<Point>,
    /// Arithmetic of the flow. The elastic test law is always in f64.
    pub precision: Precision,
    /// Volume not released because a body is there [m³].
    pub volume_left_out: f64,
    /// Computed shares of the flow, the points being those of the first; `None`: all of it.
    pub shares: Option<Shares>,
}

/// Constant set-up of a run.
#[derive(Debug, Clone)]
pub struct Setup {
    /// Identity of the scene: a scenario's JSON.
    pub identity: String,
    /// Duration, and bounds of the steps.
    pub timing: Timing,
    /// Gravity [m/s²].
    pub gravity: Vec3,
    /// Lattice of the nodes.
    pub lattice: Lattice,
    /// The walls as constraints of the flow.
    pub walls: Walls,
    /// The walls as planes for bodies.
    pub planes: Vec<Plane>,
    /// Mirror image of each body, if half of a symmetric flow is computed; else empty.
    pub partners: Vec<usize>,
    /// x of the open end [m].
    pub open_end: f64,
    /// The flow, if there is one.
    pub flow: Option<GivenFlow>,
    /// Guards.
    pub guards: Guards,
}

impl Scene {
    /// The scene of a scenario, with the reductions of its numerics.
    ///
    /// # Errors
    /// Too many points for one run, or a reduction that the scene does not allow.
    pub fn of(scenario: &Scenario) -> Result<Self, SetupError> {
        Ok(PreparedScene::of(scenario)?.scene())
    }

    /// The scene of a scenario, computed as a whole: it can be changed by hand without its
    /// reductions becoming wrong.
    ///
    /// # Errors
    /// Too many points for one run.
    pub fn whole(scenario: &Scenario) -> Result<Self, SetupError> {
        Ok(PreparedScene::whole(scenario)?.scene())
    }
}

impl Setup {
    /// Set-up of a scenario's run, and the division of its release.
    fn of(scenario: &Scenario, expected: Expected) -> Result<(Self, Option<Columns>), SetupError> {
        let channel = &scenario.channel;
        let lattice = resolution::lattice(scenario);
        let walls = walls(channel, &lattice);
        let release = scenario.release();
        let columns = release.map(|release| Columns::of(scenario, &lattice, &release));
        let columns = columns.transpose()?;
        let flow = scenario.flow.as_ref().zip(columns.as_ref());
        let flow = flow.map(|(flow, columns)| {
            GivenFlow::of(
                &flow.material,
                &scenario.numerics,
                &lattice,
                columns.volume,
                expected,
            )
        });
        let given = Self {
            identity: scenario.to_json(),
            timing: Timing::lasting(scenario.duration_s),
            gravity: Vec3::new(0.0, 0.0, -scenario.gravity_m_s2),
            lattice,
            planes: walls.planes().copied().collect(),
            guards: guards(scenario, walls.bed.as_ref()),
            walls,
            partners: Vec::new(),
            open_end: channel.runout_length_m,
            flow,
        };
        Ok((given, columns))
    }

    /// The set-up with other walls, and with the mirror image of each body if one of them is a
    /// mirror.
    pub(super) fn between(&self, walls: Walls, partners: Vec<usize>) -> Self {
        Self {
            walls,
            partners,
            ..self.clone()
        }
    }

    /// Largest distance from a body [m] at which a point at a transfer may touch it before the next
    /// one.
    pub(crate) fn contact_reach(&self, bodies: &[Body], pace: &Pace) -> Reach {
        let Some(flow) = &self.flow else {
            return Reach {
                sphere: 0.0,
                travel: 0.0,
            };
        };
        let duration = pace.substep * f64::from(pace.count);
        let body_travel = bodies
            .iter()
            .map(|body| body.speed_ahead() * duration)
            .fold(0.0, f64::max);
        // A step of a single sub-step may exceed the flow's Courant number.
        let cells = flow.limits.flow_courant.max(flow.limits.courant);
        let flow_travel = cells * flow.limits.cell_size;
        Reach {
            sphere: flow.sphere.radius,
            // Twice both, for bodies and points that speed up within the step.
            travel: 2.0 * (flow_travel + body_travel),
        }
    }
}

fn walls(channel: &scenario::Channel, lattice: &Lattice) -> Walls {
    let vertical_walls = |name, normal: Vec3, distance: f64| Plane {
        name,
        normal,
        offset: -distance,
        flow_friction: channel.side_friction,
    };
    let half_width = 0.5 * channel.width_m;
    Walls {
        bed: Arc::new(channel.bed()),
        vertical_walls: VerticalWalls {
            ends: Ends::Back(VerticalBoundary::Wall(vertical_walls(
                "back wall",
                Vec3::x(),
                channel.incline_length_m,
            ))),
            sides: [
                VerticalBoundary::Wall(vertical_walls("right side wall", Vec3::y(), half_width)),
                VerticalBoundary::Wall(vertical_walls("left side wall", -Vec3::y(), half_width)),
            ],
            halves_across: 2 * (channel.width_m / lattice.spacing.y).round() as i32,
        },
    }
}

impl Setup {
    /// Length of a sub-step of `dt` [s], in the terms of the walls.
    pub(super) fn wall_pace(&self, dt: f64) -> WallPace {
        let sound = |flow: &GivenFlow| self.lattice.spacing.min() / flow.material.p_wave_speed();
        WallPace {
            dt,
            crossing: self.flow.as_ref().map_or(0.0, sound) / dt,
        }
    }

    /// External conditions of the bodies' motion from a time on [s].
    pub(super) fn surroundings(&self, time: f64) -> Surroundings<'_> {
        Surroundings {
            time,
            planes: &self.planes,
            gravity: self.gravity,
            cancellation: None,
        }
    }
}

/// Guards according to the highest fall and the fastest throw.
fn guards(scenario: &Scenario, bed: &dyn Bed) -> Guards {
    let release = scenario.release();
    let top = release.map_or(0.0, |release| {
        bed.elevation(release.back_m, 0.0) + release.vertical_thickness_m
    });
    let bodies = scenario.bodies.iter().enumerate().map(|(place, body)| {
        let radius = scenario.shape_of(place).bounding_radius();
        let motion = body.motion.as_ref().map(scenario::Motion::prescribed);
        let rise = motion.map_or(0.0, |motion| motion.rise(scenario.duration_s));
        let height = scenario.initial_pose(place).position.z + radius + rise;
        (height, body.thrown_m_s(radius))
    });
    let (highest, fastest) = bodies.fold((top, 0.0f64), |(top, speed), (height, thrown)| {
        (top.max(height), speed.max(thrown))
    });
    Guards::of(scenario.gravity_m_s2, highest, fastest)
}

/// A point at rest.
fn resting_point(id: u32, position: Vec3, mass: f64, volume: f64) -> Point {
    Point {
        id,
        mass,
        volume,
        position,
        velocity: Vec3::zeros(),
        affine: crate::math::Mat3::zeros(),
        stress: crate::math::Sym3::default(),
    }
}
