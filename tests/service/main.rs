//! The service through a real HTTP client, on a port and a database of its own
//! for every test. No test sleeps for a fixed time to wait for an event: it polls until
//! the event has happened, or a deadline passes.

mod access;
mod app;
mod bad_input;
mod browser;
mod citations;
mod compression;
mod contract;
mod convergence_study;
mod dismissal;
mod ending;
mod flow;
mod following;
mod http_basics;
mod intake;
mod jobs;
mod layers;
mod ogc;
mod overload;
mod plans;
mod restart;
mod results;
mod runs;
mod scenarios;
mod studies;
mod study_levels;
mod terrain_jobs;
mod terrain_results;
mod terrains;
mod webhooks;
