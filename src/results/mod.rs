//! Records of a run, in the forms they take: columns in memory ([`columns`]), compressed
//! chunks in the database ([`chunk`], [`flow`]), and what clients get ([`table`],
//! [`vtk`]). Knows the recorder's data types, and neither the database nor HTTP.

pub mod chunk;
pub mod columns;
pub mod fingerprint;
pub mod flow;
mod planes;
pub mod table;
pub mod vtk;
pub mod zip;

pub use columns::{Selection, TrajectoryColumns};
pub use scree_solver::record::FlowSnapshot;
pub use table::trajectory_json;
