//! Scree's computation: a granular flow solved by the Material Point Method (MPM) coupled to
//! rigid sphero-polyhedra (SDM), in three dimensions. SI units throughout; axes: x downstream (0
//! at the foot of the incline), y across (0 on the centre line), z up (0 on the floor).
//!
//! A [`Scenario`] is read from JSON, all violations at once, and [`compute`]d to an [`Outcome`]:
//!
//! ```
//! use scree_solver::{Scenario, compute};
//!
//! // Two litres of sand slide down 40° onto a cube of 4 cm, in coarse cells.
//! let scenario = Scenario::from_json(
//!     r#"{
//!         "channel": {"inclination_deg": 40, "incline_length_m": 0.5,
//!                     "runout_length_m": 0.5, "width_m": 0.12},
//!         "flow": {"volume_m3": 0.002, "release": {"height_m": 0.1, "toe_distance_m": 0.0}},
//!         "bodies": [{"shape": {"cube": {"side_m": 0.04}},
//!                     "position": {"downstream_m": 0.04}}],
//!         "numerics": {"cell_size_m": 0.03},
//!         "duration_s": 0.3
//!     }"#,
//! )?;
//! let outcome = compute(&scenario, 1, |_record| {})?;
//! let cube = &outcome.bodies[0];
//! println!("struck at {:?} s, {} m/s at most", cube.onset_time_s, cube.peak_speed_m_s);
//! assert!(cube.peak_speed_m_s > 0.1);
//! assert!(outcome.conservation.momentum_residual < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Step by step, a [`Simulation`] is [`run`](Simulation::run) while a [`Recorder`] turns its
//! states into [`Record`]s and the outcome. A [`Plan`] says beforehand what a run will compute
//! and cost; a [`ConvergenceStudy`] lists the runs from which the error of an outcome is
//! estimated. The numbers of the method that were chosen are in [`METHOD`]. The crate has no
//! clock, files, environment or service of its own.

// With closed doors, what only benchmark and verification use is not used at all.
#![cfg_attr(not(feature = "kernels"), allow(dead_code, unreachable_pub))]

pub mod accuracy;
pub mod bed;
mod cancellation;
mod compute;
pub mod error;
pub mod material;
pub mod math;
pub mod motion;
pub mod plan;
pub mod points;
pub mod raster;
pub mod record;
pub mod rigid;
pub mod scenario;
#[cfg(feature = "schema")]
pub mod schema;
pub mod shape;
pub mod simulation;
pub mod walls;

// The kernels of the method, open to its benchmark and verification alone.
#[cfg(not(feature = "kernels"))]
mod available_volume;
#[cfg(feature = "kernels")]
#[doc(hidden)]
pub mod available_volume;
#[cfg(not(feature = "kernels"))]
mod body_energy;
#[cfg(feature = "kernels")]
#[doc(hidden)]
pub mod body_energy;
#[cfg(not(feature = "kernels"))]
mod contact;
#[cfg(feature = "kernels")]
#[doc(hidden)]
pub mod contact;
#[cfg(not(feature = "kernels"))]
mod diagnostics;
#[cfg(feature = "kernels")]
#[doc(hidden)]
pub mod diagnostics;
#[cfg(not(feature = "kernels"))]
mod grid;
#[cfg(feature = "kernels")]
#[doc(hidden)]
pub mod grid;
#[cfg(not(feature = "kernels"))]
mod kernel;
#[cfg(feature = "kernels")]
#[doc(hidden)]
pub mod kernel;
#[cfg(not(feature = "kernels"))]
mod method;
#[cfg(feature = "kernels")]
#[doc(hidden)]
pub mod method;
#[cfg(not(feature = "kernels"))]
mod mpm;
#[cfg(feature = "kernels")]
#[doc(hidden)]
pub mod mpm;
#[cfg(not(feature = "kernels"))]
mod stability;
#[cfg(feature = "kernels")]
#[doc(hidden)]
pub mod stability;

pub use accuracy::ConvergenceStudy;
pub use cancellation::Cancellation;
pub use compute::{ComputeError, compute};
pub use diagnostics::Audit;
pub use error::{Mover, RestoreError, SaveError, SetupError, StepError};
pub use method::METHOD;
pub use mpm::instructions::Instructions;
pub use plan::Plan;
pub use record::{BodyOutcome, FlowOutcome, FlowSnapshot, Outcome, Record, Recorder, Sample};
pub use scenario::{Scenario, ScenarioError};
pub use simulation::{Ending, Simulation, StageTimer, StepStage, SubstepReport};

/// Version of this crate, part of every answer.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
