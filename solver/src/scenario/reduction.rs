//! Reductions of a scene, and the words for their choice.

use serde::{Deserialize, Serialize};

/// Use of a scene's symmetry about the centre plane: computation by halves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Symmetry {
    /// Computation by halves where it is exact.
    #[default]
    Auto,
    /// No use of symmetry.
    Full,
    /// Computation by halves; a scene that is not symmetric is refused.
    Mirror,
}

/// Computation of a flow that is still uniform across the channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Approach {
    /// Computation in a slab of one cell where it is exact.
    #[default]
    Auto,
    /// Computation across the whole width.
    Full,
    /// Computation in a slab; a scene that varies across from the start is refused.
    Slab,
}

/// End of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// Early, when nothing can move a body or the front any more, or with its duration.
    #[default]
    Auto,
    /// End with its duration.
    Full,
}
