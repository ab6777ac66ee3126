//! A flow in a checkpoint.

use crate::mpm::blocks::Blocks;
use crate::mpm::lanes::Real;
use crate::scenario::Precision;
use crate::simulation::setup::Share;
use serde::{Deserialize, Serialize};

/// A flow between two steps in a checkpoint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::simulation) enum SavedFlow {
    /// None at all.
    None,
    /// In single precision.
    Single(Blocks<f32>),
    /// In double precision.
    Double(Blocks<f64>),
    /// A share of it.
    Share(Share, Box<SavedFlow>),
}

impl SavedFlow {
    /// Precision in which it was computed.
    pub(super) fn precision(&self) -> Precision {
        match self {
            Self::None | Self::Double(_) => Precision::Double,
            Self::Single(_) => Precision::Single,
            Self::Share(_, flow) => flow.precision(),
        }
    }
}

/// A precision whose flows a checkpoint holds.
pub(in crate::simulation) trait Saved: Real {
    /// A flow between two steps.
    fn saved(blocks: Blocks<Self>) -> SavedFlow;
}

impl Saved for f32 {
    fn saved(blocks: Blocks<Self>) -> SavedFlow {
        SavedFlow::Single(blocks)
    }
}

impl Saved for f64 {
    fn saved(blocks: Blocks<Self>) -> SavedFlow {
        SavedFlow::Double(blocks)
    }
}
