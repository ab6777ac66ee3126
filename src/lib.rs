//! Scree: a service that computes where an object hit by a granular flow ends
//! up. This library holds the service; the binary adds the command line.
//!
//! Structure: [`service::start`] binds the address, opens the database
//! and starts the workers, and [`worker_process::start`] starts workers alone; [`http`] receives jobs and returns results;
//! [`jobs`] keeps them in the database; [`runs`] computes a scenario; [`results`] converts the
//! records of a run into stored and served forms; [`pictures`] draws them; [`terrains`] has the
//! rasters that scenarios name. Separately, [`verify`]
//! compares the solver with known answers.

pub mod config;
mod database;
pub mod http;
pub mod jobs;
pub mod machine;
pub mod pictures;
mod quota;
pub mod results;
pub mod runs;
pub mod service;
pub mod studies;
pub mod terrains;
pub mod verify;
mod webhooks;
pub mod worker_process;
