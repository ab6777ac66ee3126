//! Pictures of a study: where bodies come to rest, which inputs matter, and how members scatter.

mod frame;
mod rest_map;
mod scatter;
mod tornado;

pub use rest_map::rest_map;
pub use scatter::{Column, scatter_matrix};
pub use tornado::tornado;
