//! The documents that the service hands through without looking inside, as the
//! contract describes them: the solver must not know the service, so its types
//! can't describe themselves. A test holds these against what the solver reads
//! and writes.

use serde::Serialize;
use utoipa::ToSchema;

/// A scenario. Whatever has a default may be left out; what the service answers
/// with has everything filled in, and null stands for "automatic".
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Scenario)]
pub struct ScenarioDocument {
    /// Free text.
    #[schema(required = false)]
    pub title: String,
    /// Incline and floor between two side walls.
    pub channel: ChannelDocument,
    /// The granular flow; null for none.
    #[schema(required = true)]
    pub flow: Option<FlowDocument>,
    /// The rigid bodies.
    pub bodies: Vec<BodyDocument>,
    /// Gravity [m/s²].
    #[schema(required = false)]
    pub gravity_m_s2: f64,
    /// Simulated time [s].
    #[schema(required = false)]
    pub duration_s: f64,
    /// Time between samples [s]: they lie at k · interval and at the end.
    #[schema(required = false)]
    pub sample_interval_s: f64,
    /// Snapshots of the flow, spread evenly over the run.
    #[schema(required = false)]
    pub flow_snapshots: u32,
    /// Numerical choices.
    #[schema(required = false)]
    pub numerics: NumericsDocument,
}

/// Incline and floor between two side walls. x downstream, 0 at the foot of the
/// incline; y across, 0 on the centre line; z up, 0 on the floor.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Channel)]
pub struct ChannelDocument {
    /// Inclination of the inclined part [°].
    pub inclination_deg: f64,
    /// Horizontal length of the inclined part [m].
    pub incline_length_m: f64,
    /// Horizontal length of the floor [m].
    pub runout_length_m: f64,
    /// Distance between the side walls [m].
    #[schema(required = false)]
    pub width_m: f64,
    /// Coulomb friction between flow and incline or floor.
    #[schema(required = false)]
    pub base_friction: f64,
    /// Coulomb friction between flow and the upright walls.
    #[schema(required = false)]
    pub side_friction: f64,
}

/// The granular flow.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Flow)]
pub struct FlowDocument {
    /// Released volume [m³].
    pub volume_m3: f64,
    /// Where it is released.
    #[schema(required = false)]
    pub release: ReleaseDocument,
    /// What it is made of.
    #[schema(required = false)]
    pub material: MaterialDocument,
}

/// The release: the whole width, vertical front and back, upper face parallel
/// to the slope.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Release)]
pub struct ReleaseDocument {
    /// Thickness normal to the slope [m].
    #[schema(required = false)]
    pub height_m: f64,
    /// Horizontal distance of the front from the foot of the incline [m].
    #[schema(required = false)]
    pub toe_distance_m: f64,
}

/// Granular material.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Material)]
pub struct MaterialDocument {
    /// Density of the bulk at rest [kg/m³].
    #[schema(required = false)]
    pub bulk_density_kg_m3: f64,
    /// Density of a grain [kg/m³].
    #[schema(required = false)]
    pub grain_density_kg_m3: f64,
    /// Diameter of a grain [m].
    #[schema(required = false)]
    pub grain_diameter_m: f64,
    /// Friction at rest.
    #[schema(required = false)]
    pub static_friction: f64,
    /// Friction at large inertial number.
    #[schema(required = false)]
    pub limiting_friction: f64,
    /// Inertial number at which friction is half-way between the two.
    #[schema(required = false)]
    pub reference_inertial_number: f64,
    /// Poisson's ratio.
    #[schema(required = false)]
    pub poissons_ratio: f64,
    /// Young's modulus [Pa]; null: from the sound speed.
    pub youngs_modulus_pa: Option<f64>,
}

/// A rigid body.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Body)]
pub struct BodyDocument {
    /// Shape.
    pub shape: ShapeDocument,
    /// Radius of the rounding sphere [m].
    #[schema(required = false)]
    pub sphero_radius_m: f64,
    /// Density [kg/m³].
    #[schema(required = false)]
    pub density_kg_m3: f64,
    /// Where its centre starts.
    #[schema(required = false)]
    pub position: PositionDocument,
    /// Turn about the normal of its support [°].
    #[schema(required = false)]
    pub yaw_deg: f64,
    /// Free orientation [w, x, y, z] instead of `yaw_deg`.
    pub orientation: Option<[f64; 4]>,
    /// Initial velocity [m/s].
    #[schema(required = false)]
    pub velocity_m_s: [f64; 3],
    /// Initial angular velocity, world axes [rad/s].
    #[schema(required = false)]
    pub angular_velocity_rad_s: [f64; 3],
    /// Coulomb friction with walls.
    #[schema(required = false)]
    pub friction: f64,
    /// Restitution with walls.
    #[schema(required = false)]
    pub restitution: f64,
    /// Coulomb friction with the flow.
    #[schema(required = false)]
    pub flow_friction: f64,
    /// Restitution with the flow.
    #[schema(required = false)]
    pub flow_restitution: f64,
    /// Hertz contact modulus with walls [Pa]; null: automatic.
    pub contact_modulus_pa: Option<f64>,
    /// A fixed body is a barrier.
    #[schema(required = false)]
    pub fixed: bool,
}

/// Shape of a body.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Shape)]
pub enum ShapeDocument {
    /// A cube.
    Cube {
        /// Distance between opposite flats, rounding included [m].
        side_m: f64,
    },
}

/// Centre of a body.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Position)]
pub struct PositionDocument {
    /// x [m].
    #[schema(required = false)]
    pub downstream_m: f64,
    /// y [m].
    #[schema(required = false)]
    pub lateral_m: f64,
    /// z [m]; null: resting on the floor or flat on the incline.
    pub elevation_m: Option<f64>,
}

/// Numerical choices; null: automatic.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Numerics)]
pub struct NumericsDocument {
    /// Cell size [m].
    pub cell_size_m: Option<f64>,
    /// Material points per cell.
    #[schema(required = false)]
    pub points_per_cell: u32,
    /// Speed of sound in the flow, √(K/ρ) [m/s].
    pub sound_speed_m_s: Option<f64>,
    /// Courant number of the acoustic sub-step.
    pub courant: Option<f64>,
    /// Courant number of the flow's own step.
    pub flow_courant: Option<f64>,
    /// Solver threads; at most those of a worker.
    pub threads: Option<u32>,
}

/// The answer in short. What did not happen is null.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Outcome)]
pub struct OutcomeDocument {
    /// One entry per body, in the scenario's order.
    pub bodies: Vec<BodyOutcomeDocument>,
    /// The flow.
    pub flow: FlowOutcomeDocument,
    /// Whether to trust it.
    pub audit: AuditDocument,
    /// What it cost.
    pub cost: CostDocument,
}

/// Outcome of one body.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = BodyOutcome)]
pub struct BodyOutcomeDocument {
    /// First time the centre is 1 mm from where it started [s].
    #[schema(required = true)]
    pub onset_time_s: Option<f64>,
    /// Largest speed of the centre [m/s].
    pub peak_speed_m_s: f64,
    /// When that was [s].
    #[schema(required = true)]
    pub peak_speed_time_s: Option<f64>,
    /// From then to the end slower than 1 mm/s [s].
    #[schema(required = true)]
    pub stop_time_s: Option<f64>,
    /// Net horizontal displacement of the centre [m].
    pub displacement_m: f64,
    /// Length of the centre's path [m].
    pub path_length_m: f64,
    /// Centre at the end [m].
    pub final_position_m: [f64; 3],
    /// Orientation at the end [w, x, y, z].
    pub final_orientation: [f64; 4],
}

/// Outcome of the flow.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FlowOutcome)]
pub struct FlowOutcomeDocument {
    /// The x beyond which 0.1 % of the released mass lies [m].
    #[schema(required = true)]
    pub front_m: Option<f64>,
    /// Front minus the initial toe [m].
    #[schema(required = true)]
    pub runout_m: Option<f64>,
    /// Mass that left by the open end [kg].
    pub mass_left_kg: f64,
    /// Volume of the release not placed because a body stands there [m³].
    pub volume_left_out_m3: f64,
}

/// Whether the run can be trusted.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Audit)]
pub struct AuditDocument {
    /// Relative error of the mass balance.
    pub mass_error: f64,
    /// Largest relative residual of the linear momentum balance.
    pub momentum_residual: f64,
    /// The same for angular momentum.
    pub angular_momentum_residual: f64,
    /// Largest relative rise of mechanical energy.
    pub energy_residual: f64,
    /// Largest overlap of a point with a body.
    pub max_overlap_ratio: f64,
    /// Points put back out of a body.
    pub points_put_back: u64,
    /// Points that left by the open end.
    pub points_left: u64,
    /// Points lost any other way.
    pub points_lost: u64,
}

/// What the answer cost.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Cost)]
pub struct CostDocument {
    /// Material points at the start.
    pub points: u64,
    /// Transfers between points and grid.
    pub steps: u64,
    /// Acoustic sub-steps.
    pub substeps: u64,
    /// Wall time [s].
    pub wall_s: f64,
    /// Sub-steps of one point, per second of wall time [1/s].
    pub point_steps_per_s: f64,
    /// Solver threads.
    pub threads: u32,
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Speed of sound in use [m/s].
    #[schema(required = true)]
    pub sound_speed_m_s: Option<f64>,
}

/// The trajectory of one body.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Trajectory)]
pub struct TrajectorySchema {
    /// The job.
    #[schema(format = "uuid")]
    pub job_id: String,
    /// Index of the body in the scenario.
    pub body: u32,
    /// One entry a sample in every column.
    pub columns: TrajectoryColumnsSchema,
}

/// The columns of a trajectory, all of equal length. Forces and torques are
/// means since the sample before.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = TrajectoryColumns)]
pub struct TrajectoryColumnsSchema {
    /// Simulated time [s].
    pub time_s: Vec<f64>,
    /// Centre [x, y, z] [m].
    pub position_m: Vec<[f64; 3]>,
    /// Unit quaternion [w, x, y, z].
    pub orientation: Vec<[f64; 4]>,
    /// Velocity of the centre [m/s].
    pub velocity_m_s: Vec<[f64; 3]>,
    /// Angular velocity, world axes [rad/s].
    pub angular_velocity_rad_s: Vec<[f64; 3]>,
    /// Force of the flow [N].
    pub flow_force_n: Vec<[f64; 3]>,
    /// Torque of the flow about the centre [N m].
    pub flow_torque_nm: Vec<[f64; 3]>,
    /// Force of the walls [N].
    pub wall_force_n: Vec<[f64; 3]>,
    /// Torque of the walls about the centre [N m].
    pub wall_torque_nm: Vec<[f64; 3]>,
    /// Material points in contact.
    pub touching_points: Vec<u32>,
    /// Share of the body's height below the surface of the flow, 0..1.
    pub submerged_fraction: Vec<f64>,
    /// How the body moves.
    pub mode: Vec<ModeSchema>,
}

/// How a body moves.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "lowercase")]
#[schema(as = Mode)]
pub enum ModeSchema {
    /// Slower than 1 mm/s, rotation included.
    Resting,
    /// On a wall, mostly translating.
    Sliding,
    /// On a wall, turning about as fast as it travels.
    Rolling,
    /// Off the walls most of the time.
    Saltating,
}

/// The flow at one instant.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FlowSnapshot)]
pub struct FlowSchema {
    /// The job.
    #[schema(format = "uuid")]
    pub job_id: String,
    /// Simulated time [s].
    pub time_s: f64,
    /// Points in the flow then.
    pub points: u64,
    /// One in how many of them is kept.
    pub thinning: u32,
    /// Position of each kept point [m].
    pub position_m: Vec<[f32; 3]>,
    /// Speed of each kept point [m/s].
    pub speed_m_s: Vec<f32>,
}
