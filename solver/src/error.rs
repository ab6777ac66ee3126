//! What can go wrong once a scenario is legal.

use thiserror::Error;

/// A legal scenario that this solver nevertheless can't set up.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SetupError {
    /// More material points than one run may hold.
    #[error(
        "the flow needs {points} material points, more than the {limit} one run may hold: raise numerics.cell_size_m (now {cell_size_m} m)"
    )]
    TooManyPoints {
        /// Points the release needs.
        points: u64,
        /// Largest number of points of one run.
        limit: u64,
        /// Cell size in use [m].
        cell_size_m: f64,
    },
    /// A reduction asked for that the scene does not allow.
    #[error("numerics.{key} can't be \"{word}\" in this scene: {why}")]
    NotReducible {
        /// Which of the numerics.
        key: &'static str,
        /// What it was asked to be.
        word: &'static str,
        /// Why it can't.
        why: String,
    },
    /// The worker threads could not be started.
    #[error("cannot start {threads} solver threads: {reason}")]
    Threads {
        /// Threads asked for.
        threads: usize,
        /// The thread pool's own words.
        reason: String,
    },
}

/// A run that can't go on. It names the simulated time and the culprit, and is
/// never worth retrying: the same scenario fails again in the same place.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum StepError {
    /// A point's state stopped being a number.
    #[error("t = {time_s:.6} s: point {point} has a non-finite {quantity}")]
    NonFinitePoint {
        /// Simulated time [s].
        time_s: f64,
        /// Identity of the point.
        point: u32,
        /// Name of the quantity.
        quantity: &'static str,
    },
    /// A body's state stopped being a number.
    #[error("t = {time_s:.6} s: body {body} has a non-finite {quantity}")]
    NonFiniteBody {
        /// Simulated time [s].
        time_s: f64,
        /// Index of the body in the scenario.
        body: usize,
        /// Name of the quantity.
        quantity: &'static str,
    },
    /// The stable sub-step became absurdly small.
    #[error(
        "t = {time_s:.6} s: the stable sub-step fell to {substep_s:e} s (fastest point {speed_m_s:.3} m/s, limit {limit_s:e} s)"
    )]
    TimeStepCollapse {
        /// Simulated time [s].
        time_s: f64,
        /// Sub-step the stability bounds ask for [s].
        substep_s: f64,
        /// Fastest point [m/s].
        speed_m_s: f64,
        /// Smallest sub-step accepted [s].
        limit_s: f64,
    },
    /// The contacts of a body are too stiff for what is lightest among those that hang
    /// together.
    #[error(
        "t = {time_s:.6} s: contacts of body {body} ask for sub-steps of {substep_s:e} s (limit {limit_s:e} s): too stiff for the lightest body that hangs together with it (contact_modulus_pa, density_kg_m3)"
    )]
    BodyTimeStepCollapse {
        /// Simulated time [s].
        time_s: f64,
        /// Index of the body in the scenario.
        body: usize,
        /// Sub-step its contacts ask for [s].
        substep_s: f64,
        /// Smallest sub-step accepted [s].
        limit_s: f64,
    },
    /// A point left the channel through a wall.
    #[error("t = {time_s:.6} s: point {point} is {depth_m:.4} m behind the {wall}")]
    PointBehindWall {
        /// Simulated time [s].
        time_s: f64,
        /// Identity of the point.
        point: u32,
        /// Name of the wall.
        wall: &'static str,
        /// Distance behind the wall [m].
        depth_m: f64,
    },
    /// The core of a body went through a wall: its contact is too soft for
    /// what presses on it.
    #[error(
        "t = {time_s:.6} s: the core of body {body} is {depth_m:.6} m behind the {wall}: its contact with walls is too soft (contact_modulus_pa)"
    )]
    BodyBehindWall {
        /// Simulated time [s].
        time_s: f64,
        /// Index of the body in the scenario.
        body: usize,
        /// Name of the wall.
        wall: &'static str,
        /// Distance behind the wall [m].
        depth_m: f64,
    },
    /// The cores of two bodies all but meet: their contact is too soft for what
    /// presses on it.
    #[error(
        "t = {time_s:.6} s: bodies {body} and {other} overlap by {overlap_m:.6} m, almost to their cores: their contact is too soft (contact_modulus_pa)"
    )]
    BodiesMerge {
        /// Simulated time [s].
        time_s: f64,
        /// Index of one body in the scenario.
        body: usize,
        /// Index of the other.
        other: usize,
        /// Their overlap [m].
        overlap_m: f64,
    },
}

impl StepError {
    /// Simulated time at which the run stopped [s].
    pub fn time_s(&self) -> f64 {
        match *self {
            Self::NonFinitePoint { time_s, .. }
            | Self::NonFiniteBody { time_s, .. }
            | Self::TimeStepCollapse { time_s, .. }
            | Self::BodyTimeStepCollapse { time_s, .. }
            | Self::BodyBehindWall { time_s, .. }
            | Self::BodiesMerge { time_s, .. }
            | Self::PointBehindWall { time_s, .. } => time_s,
        }
    }
}

/// A state that can't be saved now.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SaveError {
    /// The run can't go on from here.
    #[error("a run that failed is not saved: {0}")]
    Failed(StepError),
    /// Some of a step's sub-steps are still to come.
    #[error("t = {time_s:.6} s: amid a step; save where a step ended")]
    AmidStep {
        /// Simulated time [s].
        time_s: f64,
    },
}

/// A saved state that can't be taken up again.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RestoreError {
    /// The bytes are not a saved state of this solver version.
    #[error("not a saved state of this solver: {0}")]
    Unreadable(String),
    /// The state belongs to another scenario.
    #[error("the saved state belongs to another scenario ({what} differs)")]
    OtherScenario {
        /// What differs.
        what: &'static str,
    },
}
