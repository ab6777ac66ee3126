//! Jobs: what they are ([`job`]), which are let in ([`submit`]), where they are
//! kept ([`store`]), who runs them ([`pool`], [`convergence_study`], [`runner`]) and how one that can't
//! be finished says so ([`failure`]), how long one will take ([`forecast`]). [`JobService`] is the door for HTTP.

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
