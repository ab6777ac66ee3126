//! Studies with known answers.

#![expect(
    clippy::print_stdout,
    reason = "figures of the key tests, by --nocapture"
)]

mod answers;
mod correlations;
mod designs;
mod distributions;
mod document;
mod ensemble;
mod incline;
mod multilevel;
mod regions;
mod sensitivity;
mod stop;
mod support;
mod violations;
