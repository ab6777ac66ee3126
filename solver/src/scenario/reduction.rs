//! Reductions of a scene, and the words for their choice.

use serde::{Deserialize, Serialize};

/// Computation of a scene that is symmetric about the centre plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Symmetry {
    /// As a symmetric half where that is exact.
    #[default]
    Auto,
    /// In full.
    Full,
    /// As a symmetric half; a scene that is not symmetric is refused.
    Mirror,
}

/// Computation of a flow that does not vary across the channel yet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Approach {
    /// As a quasi-2D slab of one cell where that is exact.
    #[default]
    Auto,
    /// Over the full width.
    Full,
    /// As a quasi-2D slab; a scene that varies across the channel from the start is refused.
    Slab,
}

/// Condition that ends a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Ending {
    /// Early stop once nothing can move a body or the front any more; at the latest after the
    /// duration.
    #[default]
    Auto,
    /// At the end of the duration.
    Full,
}
