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
use crate::scenario::{self, Ground, Precision, Scenario};
use crate::stability::Pace;
use crate::walls::{Ends, Plane, RigidWalls, VerticalBoundary, VerticalWalls, WallPace, Walls};
use std::sync::Arc;

mod bodies;
mod division;
mod flow;
mod outlet;
mod prepared;
mod reductions;
mod release;
mod resolution;
mod settle;
mod share;
mod symmetry;
mod terrain_release;

pub use division::Division;
pub use flow::GivenFlow;
pub use outlet::Outlet;
pub use prepared::PreparedScene;
pub use reductions::Reductions;
pub use release::Columns;
pub use resolution::Expected;
pub use share::{Share, Shares};
pub(super) use symmetry::near_body;
pub use terrain_release::TerrainColumns;

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
    /// Open ends of the ground.
    pub outlet: Outlet,
    /// The flow, if there is one.
    pub flow: Option<GivenFlow>,
    /// Releases on a terrain after the start.
    pub later: Option<Arc<TerrainColumns>>,
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
    fn of(scenario: &Scenario, expected: Expected) -> Result<(Self, Option<Division>), SetupError> {
        let lattice = resolution::lattice(scenario);
        let walls = match &scenario.ground {
            Ground::Channel(channel) => walls_of_channel(channel, &lattice),
            Ground::Terrain(terrain) => Walls {
                bed: Arc::new(terrain.ground(lattice.spacing.x).under(&lattice)),
                vertical_walls: None,
            },
        };
        let division = division(scenario, &lattice)?;
        let flow = scenario.flow.as_ref().zip(division.as_ref());
        let flow = flow.map(|(flow, division)| {
            GivenFlow::of(
                &flow.material,
                &scenario.numerics,
                &lattice,
                division.point_volume(),
                expected,
            )
        });
        let later = division.as_ref().and_then(Division::on_terrain);
        let later = later.filter(|columns| columns.next_after(0.0).is_some());
        let given = Self {
            identity: scenario.to_json(),
            timing: Timing::lasting(scenario.duration_s),
            gravity: Vec3::new(0.0, 0.0, -scenario.gravity_m_s2),
            lattice,
            planes: walls.planes().copied().collect(),
            guards: guards(scenario, walls.bed.as_ref(), division.as_ref()),
            walls,
            partners: Vec::new(),
            outlet: match &scenario.ground {
                Ground::Channel(channel) => Outlet::End(channel.runout_length_m),
                Ground::Terrain(terrain) => Outlet::Edges(terrain.extent()),
            },
            later: later.cloned().map(Arc::new),
            flow,
        };
        Ok((given, division))
    }

    /// The walls as bodies and points meet them.
    pub fn rigid_walls(&self) -> RigidWalls<'_> {
        RigidWalls {
            planes: &self.planes,
            terrain: self.walls.bed.height_field(),
        }
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

/// Division of a scenario's release into points, if there is one.
fn division(scenario: &Scenario, lattice: &Lattice) -> Result<Option<Division>, SetupError> {
    if let Some(release) = scenario.release() {
        let columns = Columns::of(scenario, lattice, &release)?;
        return Ok(Some(Division::Channel(columns)));
    }
    let on_terrain = scenario.terrain().zip(scenario.flow.as_ref());
    on_terrain
        .map(|_| TerrainColumns::of(scenario, lattice.spacing.x).map(Division::Terrain))
        .transpose()
}

fn walls_of_channel(channel: &scenario::Channel, lattice: &Lattice) -> Walls {
    let vertical_walls = |name, normal: Vec3, distance: f64| Plane {
        name,
        normal,
        offset: -distance,
        flow_friction: channel.side_friction,
    };
    let half_width = 0.5 * channel.width_m;
    Walls {
        bed: Arc::new(channel.bed()),
        vertical_walls: Some(VerticalWalls {
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
        }),
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
            walls: self.rigid_walls(),
            gravity: self.gravity,
            cancellation: None,
        }
    }
}

/// Guards according to the highest fall and the fastest throw.
fn guards(scenario: &Scenario, bed: &dyn Bed, division: Option<&Division>) -> Guards {
    let top = match (scenario.release(), division) {
        (Some(release), _) => bed.elevation(release.back_m, 0.0) + release.vertical_thickness_m,
        (None, Some(Division::Terrain(columns))) => {
            let tops = columns
                .places()
                .map(|([x, y], thickness)| bed.elevation(x, y) + thickness);
            tops.fold(0.0, f64::max)
        }
        (None, _) => 0.0,
    };
    let poses = scenario.initial_poses();
    let bodies = scenario.bodies.iter().enumerate().map(|(place, body)| {
        let radius = scenario.shape_of(place).bounding_radius();
        let motion = body.motion.as_ref().map(scenario::Motion::prescribed);
        let rise = motion.map_or(0.0, |motion| motion.rise(scenario.duration_s));
        let height = poses[place].position.z + radius + rise;
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
