//! Errors of a valid scenario.

use std::fmt;
use thiserror::Error;

/// A valid scenario that this solver can't set up.
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
    /// A requested reduction that the scene does not allow.
    #[error("numerics.{key} can't be \"{word}\" in this scene: {why}")]
    NotReducible {
        /// Key among the numerics.
        key: &'static str,
        /// Requested value.
        word: &'static str,
        /// Reason for the refusal.
        why: String,
    },
    /// The worker threads could not be started.
    #[error("cannot start {threads} solver threads: {reason}")]
    Threads {
        /// Threads asked for.
        threads: usize,
        /// Error message of the thread pool.
        reason: String,
    },
}

/// A point or body that moves too fast.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mover {
    /// The point of this identity.
    Point(u32),
    /// The body of this index in the scenario.
    Body(usize),
}

impl fmt::Display for Mover {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point(point) => write!(to, "point {point}"),
            Self::Body(body) => write!(to, "body {body}"),
        }
    }
}

/// An error that ends a run. It names the simulated time and the offending particle or body,
/// and is never worth retrying: the same scenario fails again in the same place.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum StepError {
    /// A point's state became non-finite.
    #[error("t = {time_s:.6} s: point {point} has a non-finite {quantity}")]
    NonFinitePoint {
        /// Simulated time [s].
        time_s: f64,
        /// Identity of the point.
        point: u32,
        /// Name of the quantity.
        quantity: &'static str,
    },
    /// A body's state became non-finite.
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
    /// A body needs more sub-steps of its own than the limit: its contact is too stiff for its
    /// mass, or it spins too fast.
    #[error(
        "t = {time_s:.6} s: body {body} needs {asked:.0} sub-steps of its own within one of {substep_s:e} s, more than {limit:.0}: its contact is too stiff for its mass (contact_modulus_pa), or it spins too fast"
    )]
    BodyStepCollapse {
        /// Simulated time [s].
        time_s: f64,
        /// Index of the body in the scenario.
        body: usize,
        /// Sub-step of the flow, or of the scene without one [s].
        substep_s: f64,
        /// Body sub-steps that its contacts and its spin ask for.
        asked: f64,
        /// Most body sub-steps taken.
        limit: f64,
    },
    /// A point or body is faster than the initial state allows.
    #[error(
        "t = {time_s:.6} s: {mover} moves at {speed_m_s:.3} m/s; what could fall and what was thrown gives no more than {limit_m_s:.3} m/s, a wide margin included"
    )]
    SpeedRunaway {
        /// Simulated time [s].
        time_s: f64,
        /// The point or body.
        mover: Mover,
        /// Its speed [m/s].
        speed_m_s: f64,
        /// Largest speed accepted [m/s].
        limit_m_s: f64,
    },
    /// The mechanical energy has risen: only an unstable computation makes energy.
    #[error(
        "t = {time_s:.6} s: the mechanical energy has risen by {rise_j:.4e} J above its lowest value, more than {limit_j:.4e} J; fastest is {mover} with {speed_m_s:.3} m/s"
    )]
    EnergyRunaway {
        /// Simulated time [s].
        time_s: f64,
        /// Rise above the running minimum [J].
        rise_j: f64,
        /// Largest rise accepted [J].
        limit_j: f64,
        /// The fastest point or body.
        mover: Mover,
        /// Speed [m/s].
        speed_m_s: f64,
    },
    /// A body has gained energy that nothing accounts for: its contacts made it.
    #[error(
        "t = {time_s:.6} s: the contacts of body {body} have made {made_j:.4e} J, more than {limit_j:.4e} J"
    )]
    BodyEnergyMade {
        /// Simulated time [s].
        time_s: f64,
        /// Index of the body in the scenario.
        body: usize,
        /// Rise of the energy made above its running minimum [J].
        made_j: f64,
        /// Largest rise accepted [J].
        limit_j: f64,
    },
    /// A point is denser than its material can be.
    #[error(
        "t = {time_s:.6} s: point {point} is crushed to {density_kg_m3:.0} kg/m³, more than {limit_kg_m3:.0} kg/m³: the material is too soft for its weight or its speed (sound_speed_m_s, youngs_modulus_pa)"
    )]
    Crushed {
        /// Simulated time [s].
        time_s: f64,
        /// Identity of the point.
        point: u32,
        /// Its density [kg/m³].
        density_kg_m3: f64,
        /// Largest density accepted [kg/m³].
        limit_kg_m3: f64,
    },
    /// A point is in the core of a body and there is no room for a penetration correction.
    #[error(
        "t = {time_s:.6} s: point {point} is {depth_m:.6} m inside the core of body {body}, with walls on every way out"
    )]
    PointInsideBody {
        /// Simulated time [s].
        time_s: f64,
        /// Identity of the point.
        point: u32,
        /// Index of the body in the scenario.
        body: usize,
        /// Depth below the nearest face of the core [m].
        depth_m: f64,
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
    /// The core of a body went through a wall: its contact is too soft for its load.
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
    /// The cores of two bodies nearly touch: their contact is too soft for its load.
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
            | Self::BodyBehindWall { time_s, .. }
            | Self::BodiesMerge { time_s, .. }
            | Self::BodyStepCollapse { time_s, .. }
            | Self::SpeedRunaway { time_s, .. }
            | Self::EnergyRunaway { time_s, .. }
            | Self::BodyEnergyMade { time_s, .. }
            | Self::Crushed { time_s, .. }
            | Self::PointInsideBody { time_s, .. }
            | Self::PointBehindWall { time_s, .. } => time_s,
        }
    }
}

/// A state that can't be saved now.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SaveError {
    /// The run can't go on from here.
    #[error("a run that failed is not saved: {0}")]
    Failed(StepError),
    /// A step is not complete: some of its sub-steps are still to come.
    #[error("t = {time_s:.6} s: amid a step; save where a step ended")]
    AmidStep {
        /// Simulated time [s].
        time_s: f64,
    },
    /// The run was cancelled: it may have stopped within a sub-step.
    #[error("a run that was cancelled is not saved")]
    Cancelled,
}

/// A saved state that can't be restored.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RestoreError {
    /// The bytes are not a saved state of this solver version.
    #[error("not a saved state of this solver: {0}")]
    Unreadable(String),
    /// The state belongs to another scenario.
    #[error("the saved state belongs to another scenario ({what} differs)")]
    OtherScenario {
        /// The difference.
        what: &'static str,
    },
}
