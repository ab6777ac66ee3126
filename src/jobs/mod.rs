//! Jobs: what they are ([`job`]), which are let in ([`submit`]), where they are
//! kept ([`store`]), who runs them ([`pool`], [`campaign`], [`runner`]) and how one that can't
//! be finished says so ([`failure`]), how long one will take ([`forecast`]). [`JobService`] is the door for HTTP.

mod admission;
pub mod campaign;
pub mod clock;
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
mod saved_campaign;
pub mod saved_run;
pub mod store;
pub mod submit;
mod watch;
mod worker;

pub use admission::{SubmissionRequest, SubmitError};
pub use job_service::{Dismissed, JobService, PlanError};
pub use reading::TrajectoryRange;
