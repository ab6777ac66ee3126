//! Jobs: their data ([`job`]), validation ([`submit`]), storage ([`store`]), execution
//! ([`pool`], [`convergence_study`], [`runner`]), failures ([`failure`]) and forecasts of their
//! wall time ([`forecast`]). HTTP uses them through [`JobService`].

mod admission;
pub mod clock;
pub mod convergence_study;
pub mod failure;
pub mod forecast;
mod headed;
pub mod job;
mod job_service;
mod lease_heartbeat;
mod open_chunk;
pub mod pool;
pub mod progress;
mod reading;
pub mod recording;
pub mod runner;
pub mod saved_run;
mod saved_study;
pub mod store;
pub mod submit;
mod watch;
mod worker;

pub use admission::{SubmissionRequest, SubmitError};
pub use job_service::{Dismissed, JobService, PlanError};
pub use reading::TrajectoryRange;
