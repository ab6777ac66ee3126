//! The HTTP interface: receives jobs and returns results. Holds no SQL and
//! computes nothing; every error is answered with an RFC 9457
//! problem document.

mod access;
mod archive;
mod arriving_body;
mod batch;
mod browser;
mod choice;
mod coding;
mod common_answers;
mod compression;
mod connections;
mod contract;
mod documents;
mod drawings;
mod etag;
mod events;
mod examples;
mod field_errors;
mod flow;
mod idempotency;
mod jobs;
mod listing;
mod maps;
mod metrics;
mod named_job;
mod ogc;
mod operator;
mod page;
mod paging;
mod pieces;
mod plans;
mod problem;
mod query;
mod reading;
mod router;
mod scenario_body;
pub mod server;
mod services;
mod shares;
mod slow_client;
mod static_text;
mod studies;
mod submission;
mod system;
mod terrains;
mod tracked_body;
mod trajectory;
mod turns;
mod vector_lengths;

pub use router::{openapi, router};
pub use services::Services;
