//! Jobs: what they are ([`job`]), which are let in ([`submit`]), where they are
//! kept ([`store`]), who runs them ([`pool`], [`campaign`], [`runner`]) and how one that can't
//! be finished says so ([`failure`]), how long one will take ([`forecast`]). [`Jobs`] is the door for HTTP.

pub mod campaign;
pub mod clock;
mod desk;
pub mod failure;
pub mod forecast;
mod headed;
mod intake;
pub mod job;
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

pub use desk::{Dismissed, Jobs, PlanError};
pub use intake::{Intake, SubmitError};
pub use reading::Stretch;
