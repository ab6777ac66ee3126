//! The outcome.

use super::plan::PlanDocument;
use super::{AccuracyReportDocument, BodyErrorBarsDocument, FlowErrorBarsDocument};
use serde::Serialize;
use utoipa::ToSchema;

/// The answer in short. Null stands for an event that did not happen.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Outcome)]
pub struct OutcomeDocument {
    /// One entry per body, in the scenario's order.
    pub bodies: Vec<BodyOutcomeDocument>,
    /// The flow.
    pub flow: FlowOutcomeDocument,
    /// Checks that tell whether the run can be trusted.
    pub conservation: ConservationDocument,
    /// Cost of the run, without the runs behind intervals.
    pub cost: CostDocument,
    /// Early stop of the run; null if it ran for its whole duration.
    #[schema(required = true)]
    pub ended_early: Option<EndedEarlyDocument>,
    /// Plan of the run: computation and reductions, as decided before the run.
    #[schema(required = true)]
    pub plan: Option<PlanDocument>,
    /// Runs behind the intervals; null unless asked for.
    #[schema(required = true)]
    pub accuracy: Option<AccuracyReportDocument>,
}

/// Early stop of a run, with bounds on the changes that the rest of the run could have made.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = EndedEarly)]
pub struct EndedEarlyDocument {
    /// Time of the early stop [s].
    pub time_s: f64,
    /// Reason for the early stop.
    pub reason: String,
    /// Bound on the further displacement of any body [m].
    pub body_bound_m: f64,
    /// Bound on the further advance of the front [m]; null without a flow.
    #[schema(required = true)]
    pub front_bound_m: Option<f64>,
}

/// Outcome of one body.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = BodyOutcome)]
pub struct BodyOutcomeDocument {
    /// Time of the first contact with the flow [s]; null if there was none.
    #[schema(required = true)]
    pub first_contact_time_s: Option<f64>,
    /// First time at which the centre is a fortieth of the body's size (cube root of its volume)
    /// from its initial position [s].
    #[schema(required = true)]
    pub onset_time_s: Option<f64>,
    /// Largest speed of the centre [m/s].
    pub peak_speed_m_s: f64,
    /// Time of the largest speed of the centre [s].
    #[schema(required = true)]
    pub peak_speed_time_s: Option<f64>,
    /// Time from which on the body is at rest until the end [s]; null if it still moves or never
    /// moved.
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
    /// Uncertainty intervals of all but the orientation; null unless asked for.
    #[schema(required = true)]
    pub error_bars: Option<BodyErrorBarsDocument>,
    /// Mass and principal moments of inertia.
    pub mass_properties: MassPropertiesDocument,
    /// Energy balance of the body; null if no load moves it.
    #[schema(required = true)]
    pub energy: Option<BodyEnergyDocument>,
}

/// Energy balance of a body: kinetic + potential + stored = start + work of the flow +
/// work of bodies − dissipated + made.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = BodyEnergy)]
pub struct BodyEnergyDocument {
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
    /// stored energy, all energy exchanged with flow and bodies, the potential energy of its
    /// rises and falls, and m g times its radius. A run ends beyond 0.01.
    pub made_share: f64,
}

/// Mass properties of a rounded body about its centre of mass.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = MassProperties)]
pub struct MassPropertiesDocument {
    /// Mass [kg].
    pub mass_kg: f64,
    /// Volume [m³].
    pub volume_m3: f64,
    /// Principal moments of inertia, the smallest first [kg m²].
    pub principal_moments_kg_m2: [f64; 3],
    /// Unit vectors of the principal axes in body axes, right-handed; for about equal moments,
    /// those nearest to the body axes.
    pub principal_axes: [[f64; 3]; 3],
}

/// Outcome of the flow.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FlowOutcome)]
pub struct FlowOutcomeDocument {
    /// Position x beyond which 0.1 % of the released mass lies [m].
    #[schema(required = true)]
    pub front_m: Option<f64>,
    /// Front minus the initial toe [m].
    #[schema(required = true)]
    pub runout_m: Option<f64>,
    /// Mass that left through the open end [kg].
    pub outflow_mass_kg: f64,
    /// Volume of the release that was not placed because a body occupies it [m³].
    pub excluded_volume_m3: f64,
    /// Uncertainty intervals of all but the excluded volume; null unless asked for.
    #[schema(required = true)]
    pub error_bars: Option<FlowErrorBarsDocument>,
}

/// Checks that tell whether the run can be trusted.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Conservation)]
pub struct ConservationDocument {
    /// Relative error of the mass balance.
    pub mass_error: f64,
    /// Largest relative residual of the linear momentum balance.
    pub momentum_residual: f64,
    /// Largest relative residual of the angular momentum balance.
    pub angular_momentum_residual: f64,
    /// Relative angular momentum created by particle redistribution; the
    /// residual does not include it.
    pub angular_momentum_from_shifting: f64,
    /// Largest relative rise of mechanical energy.
    pub energy_residual: f64,
    /// Largest overlap of a point with a body, over the sum of point radius and sphero radius.
    pub max_overlap_ratio: f64,
    /// Largest overlap of a body with a wall or another body, over its sphero
    /// radius (the smaller of two).
    pub max_body_overlap_ratio: f64,
    /// Number of penetration corrections of points out of a body.
    pub penetration_corrections: u64,
    /// Points that left through the open end.
    pub points_outflow: u64,
    /// Points lost in any other way.
    pub points_lost: u64,
}

/// Cost of the answer.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Cost)]
pub struct CostDocument {
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
    pub threads: u32,
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Sound speed in use [m/s].
    #[schema(required = true)]
    pub sound_speed_m_s: Option<f64>,
}
