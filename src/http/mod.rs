//! The HTTP interface: takes jobs in, gives results out. Holds no SQL and
//! computes nothing; every answer that is not the wanted one is an RFC 9457
//! problem document.

pub mod contract;
mod documents;
mod jobs;
mod named_job;
mod plans;
mod problem;
mod query;
mod results;
mod router;
mod scenario_body;
pub mod server;
mod system;

pub use router::{openapi, router};
