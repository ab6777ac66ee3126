//! Multilevel Monte Carlo (Giles 2008, 2015): many members of a coarse level and few of finer
//! ones, each finer one in a pair with the next coarser level on the same inputs.

mod allocation;
mod bias;
mod cloud;
mod control;
mod levels;

pub use allocation::Allocation;
pub use bias::{Bias, WeakConvergence};
pub use cloud::{PlacePair, corrected_places};
pub use control::ControlledEstimate;
pub use levels::{LevelEstimate, LevelMoments, Levels, Pair};

use thiserror::Error;

/// Levels that no estimate can be made from.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MultilevelError {
    /// A level has too few members.
    #[error("level {level} has {members} members or pairs, allowed: at least {least}")]
    TooFewMembers {
        /// Level, counted from 0, the coarsest.
        level: usize,
        /// Members or pairs of it.
        members: usize,
        /// Fewest that an estimate needs.
        least: usize,
    },
    /// There is only one level.
    #[error("there is one level, allowed: at least two")]
    OneLevel,
    /// A number that is not allowed.
    #[error("{what} is {value}, allowed: {allowed}")]
    NotAllowed {
        /// Name of the number.
        what: &'static str,
        /// The number.
        value: f64,
        /// Numbers allowed.
        allowed: &'static str,
    },
}

/// Error if a number is not above a limit or not finite.
fn above(
    limit: f64,
    what: &'static str,
    value: f64,
    allowed: &'static str,
) -> Result<(), MultilevelError> {
    if value > limit && value.is_finite() {
        return Ok(());
    }
    Err(MultilevelError::NotAllowed {
        what,
        value,
        allowed,
    })
}
