//! Studies: one scenario with uncertain inputs, computed many times as jobs. What a study asks and
//! what follows from its members is the crate `scree-studies`; here its members are made, their
//! outcomes are read, and clients are served ([`StudyService`]).

pub(crate) mod driver;
pub mod export;
pub mod local;
pub mod members;
pub mod outcome;
pub mod plan;
pub mod questions;
pub mod schedule;
pub mod service;
pub mod study;

pub use service::StudyService;
