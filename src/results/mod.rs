//! What a run recorded, in the three forms it takes: columns in memory
//! ([`columns`]), compressed chunks in the database ([`chunk`], [`flow`]) and
//! the JSON of the service ([`json`]). Knows the recorder's data types, and
//! neither the database nor HTTP.

pub mod chunk;
pub mod columns;
pub mod fingerprint;
pub mod flow;
pub mod json;
mod planes;

pub use columns::{Selection, TrajectoryColumns};
pub use json::trajectory_json;
pub use scree_solver::record::FlowSnapshot;
