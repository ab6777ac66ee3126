//! The outcome.

use super::plan::PlanDocument;
use super::{AccuracyReportDocument, BodyErrorBarsDocument, FlowErrorBarsDocument};
use serde::Serialize;
use utoipa::ToSchema;

/// The answer in short. What did not happen is null.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Outcome)]
pub struct OutcomeDocument {
    /// One entry per body, in the scenario's order.
    pub bodies: Vec<BodyOutcomeDocument>,
    /// The flow.
    pub flow: FlowOutcomeDocument,
    /// Checks that tell whether to trust it.
    pub conservation: ConservationDocument,
    /// Cost of the run, runs behind intervals apart.
    pub cost: CostDocument,
    /// That the run ended before its duration; null if it did not.
    #[schema(required = true)]
    pub ended_early: Option<EndedEarlyDocument>,
    /// Plan of the run: computed and left out, as decided before it.
    #[schema(required = true)]
    pub plan: Option<PlanDocument>,
    /// Runs that the intervals rest on; null unless asked for.
    #[schema(required = true)]
    pub accuracy: Option<AccuracyReportDocument>,
}

/// That a run ended before its duration, and what the rest could have changed.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = EndedEarly)]
pub struct EndedEarlyDocument {
    /// Time [s].
    pub time_s: f64,
    /// Reason.
    pub reason: String,
    /// Distance that a body could still have been moved [m].
    pub body_bound_m: f64,
    /// Distance that the front could still have gone [m]; null without a flow.
    #[schema(required = true)]
    pub front_bound_m: Option<f64>,
}

/// Outcome of one body.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = BodyOutcome)]
pub struct BodyOutcomeDocument {
    /// First time the flow touched it [s]; null if it never did.
    #[schema(required = true)]
    pub first_contact_time_s: Option<f64>,
    /// First time the centre is a fortieth of the body's size (cube root of its volume)
    /// from where it started [s].
    #[schema(required = true)]
    pub onset_time_s: Option<f64>,
    /// Largest speed of the centre [m/s].
    pub peak_speed_m_s: f64,
    /// Time of that [s].
    #[schema(required = true)]
    pub peak_speed_time_s: Option<f64>,
    /// From then to the end at rest [s]; null if it still moves or never moved.
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
    /// Mass, and resistance to turning.
    pub mass_properties: MassPropertiesDocument,
    /// Balance of its energy; null if no load moves it.
    #[schema(required = true)]
    pub energy: Option<BodyEnergyDocument>,
}

/// Balance of a body's energy: kinetic + potential + stored = start + work of the flow +
/// work of bodies − dissipated + made.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = BodyEnergy)]
pub struct BodyEnergyDocument {
    /// Kinetic, potential and stored energy at the start [J].
    pub start_j: f64,
    /// Kinetic energy at the end [J].
    pub kinetic_j: f64,
    /// Energy of its height over the floor at the end [J].
    pub potential_j: f64,
    /// Energy that its contacts with walls and bodies hold at the end; half of what those
    /// with another free body do [J].
    pub stored_j: f64,
    /// Work of the flow on it [J].
    pub flow_work_j: f64,
    /// Energy that other bodies gave it: work of prescribed motions, and half of what a contact did
    /// to it more than to the other free body [J].
    pub body_work_j: f64,
    /// Energy that damping and slipping took in its contacts with walls and bodies [J].
    pub dissipated_j: f64,
    /// Energy that nothing accounts for: made by the computation if positive, lost if not [J].
    pub made_j: f64,
    /// Largest rise of that above its running minimum, over the largest kinetic and stored
    /// energy, all that flow and bodies exchanged with it, what it rose and sank by, and
    /// m g times its radius. A run ends beyond 0.01.
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
    /// Unit axes of these moments in body axes, right-handed; about equal moments
    /// those nearest to the body axes.
    pub principal_axes: [[f64; 3]; 3],
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
    pub outflow_mass_kg: f64,
    /// Volume of the release not placed because a body stands there [m³].
    pub excluded_volume_m3: f64,
    /// Uncertainty intervals of all but the volume left out; null unless asked for.
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
    /// The same for angular momentum.
    pub angular_momentum_residual: f64,
    /// Relative angular momentum that spreading the points evenly made; the
    /// residual does not count it.
    pub angular_momentum_from_shifting: f64,
    /// Largest relative rise of mechanical energy.
    pub energy_residual: f64,
    /// Largest overlap of a point with a body.
    pub max_overlap_ratio: f64,
    /// Largest overlap of a body with a wall or another body, over its sphero
    /// radius (the smaller of two).
    pub max_body_overlap_ratio: f64,
    /// Penetration corrections out of a body.
    pub penetration_corrections: u64,
    /// Points that left by the open end.
    pub points_outflow: u64,
    /// Points lost any other way.
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
