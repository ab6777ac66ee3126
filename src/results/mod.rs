//! Records of a run in their forms: columns in memory ([`columns`]), compressed
//! chunks in the database ([`chunk`], [`flow`]), and formats for clients ([`table`],
//! [`terrain`], [`vtk`]). Depends on the recorder's data types, and on neither the database nor HTTP.

pub mod chunk;
pub mod columns;
pub mod fingerprint;
pub mod flow;
pub mod frames;
pub mod interpolation;
pub mod numpy;
mod planes;
pub mod table;
pub mod terrain;
pub mod vtk;
pub mod zip;

pub use columns::{Selection, TrajectoryColumns};
pub use scree_solver::record::FlowSnapshot;
pub use table::trajectory_json;
