//! Scree: a service that answers where an object hit by a granular flow ends
//! up. This library holds the service; the binary adds the command line.
//!
//! The way through it: [`service::start`] binds the address, opens the database
//! and starts the workers; [`http`] takes jobs in and gives results out;
//! [`jobs`] keeps them in the database and runs them; [`results`] turns what a
//! run recorded into what is stored and served; [`pictures`] shows it. Beside all
//! that, [`verify`] compares the solver with what is known.

pub mod config;
pub mod http;
pub mod jobs;
pub mod pictures;
pub mod results;
pub mod service;
pub mod verify;
