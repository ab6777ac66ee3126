//! Records of a run: samples of every body, snapshots of the flow, and the outcome.
//! Serialised, these are the JSON of the service. Definitions: docs/method.md, section 9.

mod creep;
mod energy;
mod error_bars;
mod front;
mod inundation;
mod means;
mod mode;
mod motion;
mod outcome;
mod outlook;
mod quantities;
mod recorder;
mod remarks;
mod rest;
mod sampling;
mod scale;
mod settling;
mod snapshots;
mod submergence;
mod turning;

use crate::plan::Plan;
pub use error_bars::{
    AccuracyReport, Basis, BodyErrorBars, FlowErrorBars, Role, RunCost, TargetReport,
    UncertaintyInterval,
};
pub use inundation::{FlowMaps, MapQuantity};
pub use quantities::{
    BODY_QUANTITIES, BodyQuantity, FLOW_QUANTITIES, FlowQuantity, OutcomeQuantity, QuantityKind,
};
pub use recorder::Recorder;
pub use rest::EndedEarly;
use serde::{Deserialize, Serialize};

/// Mode of motion of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "lowercase")]
pub enum Mode {
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

/// State of one body at one sample time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BodySample {
    /// Centre [m].
    pub position_m: [f64; 3],
    /// Unit quaternion [w, x, y, z], body frame to world.
    pub orientation: [f64; 4],
    /// Velocity of the centre [m/s].
    pub velocity_m_s: [f64; 3],
    /// Angular velocity in world axes [rad/s].
    pub angular_velocity_rad_s: [f64; 3],
    /// Force of the flow, mean since the last sample [N].
    pub flow_force_n: [f64; 3],
    /// Torque of the flow about the centre, mean since the last sample [N m].
    pub flow_torque_nm: [f64; 3],
    /// Force of the walls, mean since the last sample [N].
    pub wall_force_n: [f64; 3],
    /// Torque of the walls about the centre, mean since the last sample [N m].
    pub wall_torque_nm: [f64; 3],
    /// Force of other bodies, fixed ones included, mean since the last sample [N].
    pub body_force_n: [f64; 3],
    /// Torque of other bodies about the centre, mean since the last sample [N m].
    pub body_torque_nm: [f64; 3],
    /// Material points in contact in the sub-step that contains the sample time.
    pub touching_points: u32,
    /// Share of the body's height below the surface of the flow round it, 0..1, at the end of the
    /// step that contains the sample time.
    pub submerged_fraction: f64,
    /// Mode of the body's motion.
    pub mode: Mode,
}

/// Every body at one sample time, in the scenario's order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Simulated time [s].
    pub time_s: f64,
    /// One entry per body.
    pub bodies: Vec<BodySample>,
}

/// The flow at one instant, thinned to the number of points that the scenario allows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FlowSnapshot {
    /// Simulated time [s].
    pub time_s: f64,
    /// Points in the flow at that time; `position_m` contains every `thinning`-th.
    pub points: u64,
    /// Number of points per kept point, the same in all snapshots of a run.
    pub thinning: u32,
    /// Identifier of each kept point, ascending: the same material point has the same in all
    /// snapshots of a run.
    pub point_id: Vec<u32>,
    /// Position of each kept point [m].
    pub position_m: Vec<[f32; 3]>,
    /// Speed of each kept point [m/s].
    pub speed_m_s: Vec<f32>,
}

/// Record that the recorder returns during a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Record {
    /// At every sample time, in order.
    Sample(Sample),
    /// At the end of the step that contains a snapshot time.
    Snapshot(FlowSnapshot),
}

/// Outcome of one body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct BodyOutcome {
    /// Time of the first contact with the flow [s]; null if there was none.
    pub first_contact_time_s: Option<f64>,
    /// First time at which the centre is a fortieth of the body's size (cube root of its volume)
    /// from its initial position [s].
    pub onset_time_s: Option<f64>,
    /// Largest speed of the centre [m/s].
    pub peak_speed_m_s: f64,
    /// Time of the largest speed of the centre [s]; null for a body that never moved.
    pub peak_speed_time_s: Option<f64>,
    /// Time from which on the body is at rest until the end [s]; null if it still moves or never
    /// moved.
    pub stop_time_s: Option<f64>,
    /// Net horizontal displacement of the centre [m].
    pub displacement_m: f64,
    /// Length of the centre's path [m].
    pub path_length_m: f64,
    /// Centre at the end [m].
    #[cfg_attr(feature = "schema", schema(min_items = 3, max_items = 3))]
    pub final_position_m: [f64; 3],
    /// Depth of its highest place below the surface of the flow round it at the end, along the
    /// normal of the bed [m]; 0 if it stands out.
    #[serde(default)]
    pub burial_depth_m: f64,
    /// Orientation at the end [w, x, y, z].
    #[cfg_attr(feature = "schema", schema(min_items = 4, max_items = 4))]
    pub final_orientation: [f64; 4],
    /// Uncertainty intervals of all but the orientation; null unless asked for.
    pub error_bars: Option<BodyErrorBars>,
    /// Mass and principal moments of inertia.
    pub mass_properties: MassProperties,
    /// Energy balance of the body; null if no load moves it.
    pub energy: Option<BodyEnergy>,
}

/// Energy balance of a body: kinetic + potential + stored = start + work of the flow + work of
/// bodies − dissipated + made.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct BodyEnergy {
    /// Kinetic, potential and stored energy at the start [J].
    pub start_j: f64,
    /// Kinetic energy at the end [J].
    pub kinetic_j: f64,
    /// Potential energy, relative to the floor, at the end [J].
    pub potential_j: f64,
    /// Energy stored in its contacts with walls and bodies at the end; half of that stored in
    /// contacts with other free bodies [J].
    pub stored_j: f64,
    /// Work of the flow on it [J].
    pub flow_work_j: f64,
    /// Energy received from other bodies: work of prescribed motions, and half of the difference
    /// of a contact's work on this and on the other free body [J].
    pub body_work_j: f64,
    /// Energy dissipated by damping and slip in its contacts with walls and bodies [J].
    pub dissipated_j: f64,
    /// Unaccounted energy: created by the computation if positive, lost if negative [J].
    pub made_j: f64,
    /// Largest rise of `made_j` above its running minimum, over the sum of the largest kinetic and
    /// stored energy, all energy exchanged with flow and bodies, the potential energy of its rises
    /// and falls, and m g times its radius. A run ends beyond 0.01.
    pub made_share: f64,
}

/// Mass properties of a rounded body about its centre of mass.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct MassProperties {
    /// Mass [kg].
    pub mass_kg: f64,
    /// Volume [m³].
    pub volume_m3: f64,
    /// Principal moments of inertia, the smallest first [kg m²].
    #[cfg_attr(feature = "schema", schema(min_items = 3, max_items = 3))]
    pub principal_moments_kg_m2: [f64; 3],
    /// Unit vectors of the principal axes in body axes, right-handed; for about equal moments,
    /// those nearest to the body axes.
    #[cfg_attr(feature = "schema", schema(min_items = 3, max_items = 3))]
    pub principal_axes: [[f64; 3]; 3],
}

/// Outcome of the flow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct FlowOutcome {
    /// Position x beyond which 0.1 % of the released mass lies, mass that left through the open end
    /// included [m]; null without a flow. On a terrain the horizontal distance from the middle of
    /// the release beyond which 1 % of it lies, null once so much has left the map; with several
    /// releases the run-out plus the largest distance within a release.
    pub front_m: Option<f64>,
    /// Front minus the initial toe [m]; null without a front. On a terrain the distance beyond the
    /// circle round the release, with several releases beyond all of their circles.
    pub runout_m: Option<f64>,
    /// Mass that left through the open end, or over the edges of a terrain [kg].
    pub outflow_mass_kg: f64,
    /// Volume of the release that was not placed because a body occupies it [m³].
    pub excluded_volume_m3: f64,
    /// Uncertainty intervals of all but the excluded volume; null unless asked for.
    pub error_bars: Option<FlowErrorBars>,
}

/// Checks that tell whether the run can be trusted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Conservation {
    /// Relative error of the mass balance.
    pub mass_error: f64,
    /// Largest relative residual of the linear momentum balance.
    pub momentum_residual: f64,
    /// Largest relative residual of the angular momentum balance.
    pub angular_momentum_residual: f64,
    /// Relative angular momentum created by particle redistribution; the residual does not include
    /// it.
    pub angular_momentum_from_shifting: f64,
    /// Largest relative rise of mechanical energy.
    pub energy_residual: f64,
    /// Largest overlap of a point with a body, over the sum of point radius and sphero radius.
    pub max_overlap_ratio: f64,
    /// Largest overlap of a body with a wall or another body, over its sphero radius (the smaller
    /// of two).
    pub max_body_overlap_ratio: f64,
    /// Number of penetration corrections of points out of a body.
    pub penetration_corrections: u64,
    /// Points that left through the open end.
    pub points_outflow: u64,
    /// Points lost in any other way.
    pub points_lost: u64,
}

/// Cost of the answer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Cost {
    /// Material points at the start.
    pub points: u64,
    /// Transfers between points and grid.
    pub steps: u64,
    /// Acoustic sub-steps.
    pub substeps: u64,
    /// Sub-steps summed over the points that took part.
    pub point_steps: u64,
    /// Wall time [s].
    pub wall_s: f64,
    /// Point-steps (sub-steps of one point) per second of wall time [1/s].
    pub point_steps_per_s: f64,
    /// Solver threads.
    pub threads: usize,
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Speed of sound in use, √(K/ρ) [m/s]; null without a flow.
    pub sound_speed_m_s: Option<f64>,
}

/// The answer in short. Null stands for an event that did not happen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Outcome {
    /// One entry per body, in the scenario's order.
    pub bodies: Vec<BodyOutcome>,
    /// The flow.
    pub flow: FlowOutcome,
    /// Checks that tell whether the run can be trusted.
    pub conservation: Conservation,
    /// Cost of the run, without the runs behind intervals.
    pub cost: Cost,
    /// Sentences for people: what happened to the bodies and the flow, and how the run ended.
    #[serde(default)]
    pub remarks: Vec<String>,
    /// Early stop of the run; null if it ran for its whole duration.
    pub ended_early: Option<EndedEarly>,
    /// Plan of the run: computation and reductions, as decided before the run.
    pub plan: Option<Plan>,
    /// Runs behind the intervals; null unless asked for.
    pub accuracy: Option<AccuracyReport>,
}
