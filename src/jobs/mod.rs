//! Jobs: what they are ([`job`]), which are let in ([`submit`]), where they are
//! kept ([`store`]), who runs them ([`pool`], [`campaign`], [`runner`]) and how one that can't
//! be finished says so ([`failure`]), how long one will take ([`forecast`]). [`Jobs`] is the door for HTTP.

pub mod campaign;
mod desk;
pub mod failure;
pub mod forecast;
pub mod job;
pub mod pool;
pub mod progress;
pub mod recording;
pub mod runner;
pub mod store;
pub mod submit;
mod worker;

pub use desk::{Dismissed, Jobs, PlanError, SubmitError};
