//! Trajectories and snapshots of the flow.

use serde::Serialize;
use utoipa::ToSchema;

/// The trajectory of one body.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Trajectory)]
pub struct TrajectorySchema {
    /// The job.
    #[schema(format = "uuid")]
    pub job_id: String,
    /// Index of the body in the scenario.
    pub body: u32,
    /// Columns with one entry per sample.
    pub columns: TrajectoryColumnsSchema,
}

/// Columns of a trajectory, all of equal length. Forces and torques are
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
    /// Force of other bodies, fixed ones included [N].
    pub body_force_n: Vec<[f64; 3]>,
    /// Torque of other bodies about the centre [N m].
    pub body_torque_nm: Vec<[f64; 3]>,
    /// Material points in contact.
    pub touching_points: Vec<u32>,
    /// Share of the body's height below the surface of the flow, 0..1.
    pub submerged_fraction: Vec<f64>,
    /// Mode of motion.
    pub mode: Vec<ModeSchema>,
}

/// Mode of motion of a body.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "lowercase")]
#[schema(as = Mode)]
pub enum ModeSchema {
    /// At rest, or fixed.
    Resting,
    /// In contact with a wall or another body, and hardly turning over as it travels.
    Sliding,
    /// In contact with a wall or another body, turning over about as fast as it travels.
    Rolling,
    /// Without contact with walls and other bodies for most of the time since the last sample.
    Saltating,
    /// Supported by the flow more than by walls and other bodies.
    Carried,
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
    /// Number of points in the flow at that time.
    pub points: u64,
    /// Thinning factor: one in this many points is kept.
    pub thinning: u32,
    /// Position of each kept point [m].
    pub position_m: Vec<[f32; 3]>,
    /// Speed of each kept point [m/s].
    pub speed_m_s: Vec<f32>,
}
