//! Scree's computation: a granular flow solved by the Material Point Method (MPM) coupled to
//! rigid sphero-polyhedra (SDM), in three dimensions.
//!
//! A [`scenario::Scenario`] (validated JSON) makes a [`Simulation`], which is
//! [`run`](Simulation::run) while a [`record::Recorder`] turns its states into samples, flow
//! snapshots and an [`record::Outcome`]. An [`accuracy::ConvergenceStudy`] lists the runs from
//! which the error of the outcome is estimated. The crate has no clock, files, environment or
//! service of its own. SI units throughout; axes: x downstream (0 at the foot of the incline),
//! y across (0 on the centre line), z up (0 on the floor).

pub mod accuracy;
pub mod available_volume;
pub mod body_energy;
pub mod contact;
pub mod diagnostics;
pub mod error;
pub mod grid;
pub mod kernel;
pub mod material;
pub mod math;
pub mod method;
pub mod motion;
pub mod mpm;
pub mod plan;
pub mod points;
pub mod record;
pub mod rigid;
pub mod scenario;
pub mod shape;
pub mod simulation;
pub mod stability;
pub mod walls;

pub use error::{Mover, RestoreError, SaveError, SetupError, StepError};
pub use mpm::instructions::Instructions;
pub use simulation::{Ending, Simulation, StageTimer, StepStage, SubstepReport};

/// Version of this crate, part of every answer.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
