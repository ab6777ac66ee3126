//! Jobs: how far they are ([`progress`]) and what runs them ([`runner`]).

pub mod progress;
pub mod runner;
