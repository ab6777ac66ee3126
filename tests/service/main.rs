//! The service through a real HTTP client, on a port and a database of its own
//! for every test. Nothing sleeps to wait for something: it is asked for until
//! it is there, or a deadline passes.

mod access;
mod app;
mod bad_input;
mod citations;
mod contract;
mod convergence_study;
mod dismissal;
mod ending;
mod following;
mod http_basics;
mod intake;
mod jobs;
mod layers;
mod plans;
mod restart;
mod results;
mod runner;
mod scenarios;
