//! Parts of a scene that need not be computed: the words that decide it.

use serde::{Deserialize, Serialize};

/// Use of a scene's symmetry about the centre plane: to compute it by halves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Symmetry {
    /// By halves where it is exact.
    #[default]
    Auto,
    /// All of it.
    Full,
    /// By halves; a scene that is not symmetric is refused.
    Mirror,
}

/// Computation of a flow in which nothing varies across the channel yet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Approach {
    /// In a slab of one cell where it is exact.
    #[default]
    Auto,
    /// All across.
    Full,
    /// In a slab; a scene that varies across from the start is refused.
    Slab,
}

/// When a run ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// Once nothing can move a body or the front any more, or with its duration.
    #[default]
    Auto,
    /// With its duration.
    Full,
}
