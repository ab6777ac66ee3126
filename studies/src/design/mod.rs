//! Designs: which points of the unit cube of the inputs the members take.

mod explicit;
mod factorial;
mod latin_hypercube;
mod limits;
mod morris;
mod one_at_a_time;
mod saltelli;
mod sobol;

pub use explicit::Explicit;
pub use factorial::{FullFactorial, LevelCounts};
pub use latin_hypercube::LatinHypercube;
pub use morris::Morris;
pub use one_at_a_time::OneAtATime;
pub use saltelli::Saltelli;
pub use sobol::Sobol;

use crate::study::Violation;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Design of a study's members.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Design {
    /// Scrambled Sobol' points, for probabilities and regions.
    Sobol(Sobol),
    /// Latin hypercube.
    LatinHypercube(LatinHypercube),
    /// All combinations of levels.
    FullFactorial(FullFactorial),
    /// Trajectories of elementary effects, for screening.
    Morris(Morris),
    /// Two samples and their mixtures, for Sobol' indices.
    Saltelli(Saltelli),
    /// One input after the other away from the median.
    OneAtATime(OneAtATime),
    /// Values of every member, given.
    Explicit(Explicit),
}

/// Point of a member.
#[derive(Debug, Clone, PartialEq)]
pub enum Point<'a> {
    /// Probability of each input, within the smallest one a design produces and one minus it.
    Unit(Vec<f64>),
    /// Value of each input.
    Values(&'a [Value]),
}

impl Design {
    /// Number of members for so many inputs.
    pub fn members(&self, inputs: usize) -> u64 {
        let further = inputs as u64;
        match self {
            Self::Sobol(sobol) => sobol.members,
            Self::LatinHypercube(latin) => latin.members,
            Self::FullFactorial(factorial) => factorial.members(inputs),
            Self::Morris(morris) => morris.trajectories.saturating_mul(further + 1),
            Self::Saltelli(saltelli) => saltelli.base_members.saturating_mul(further + 2),
            Self::OneAtATime(one) => one.members(inputs),
            Self::Explicit(explicit) => explicit.members.len() as u64,
        }
    }

    /// Point of a member, a pure function of the design, the index and the number of inputs; the
    /// index is below the number of members, and the design has no violation.
    pub fn point(&self, index: u64, inputs: usize) -> Point<'_> {
        Point::Unit(match self {
            Self::Sobol(sobol) => sobol.point(index, inputs),
            Self::LatinHypercube(latin) => latin.point(index, inputs),
            Self::FullFactorial(factorial) => factorial.point(index, inputs),
            Self::Morris(morris) => morris.point(index, inputs),
            Self::Saltelli(saltelli) => saltelli.point(index, inputs),
            Self::OneAtATime(one) => one.point(index, inputs),
            Self::Explicit(explicit) => return Point::Values(&explicit.members[index as usize]),
        })
    }

    /// True if the other design has this one's members first, so that their outcomes stay good.
    pub fn can_be_enlarged_to(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Sobol(one), Self::Sobol(other)) => {
                one.seed == other.seed && one.members <= other.members
            }
            (Self::Saltelli(one), Self::Saltelli(other)) => {
                one.seed == other.seed && one.base_members <= other.base_members
            }
            (Self::Morris(one), Self::Morris(other)) => {
                (one.seed, one.levels) == (other.seed, other.levels)
                    && one.trajectories <= other.trajectories
            }
            (Self::Explicit(one), Self::Explicit(other)) => other.members.starts_with(&one.members),
            _ => self == other,
        }
    }

    /// Next larger design of the kind, with twice the members; none of a kind that cannot be
    /// enlarged.
    pub fn doubled(&self) -> Option<Self> {
        match self.clone() {
            Self::Sobol(mut sobol) => {
                sobol.members = sobol.members.saturating_mul(2);
                Some(Self::Sobol(sobol))
            }
            Self::Saltelli(mut saltelli) => {
                saltelli.base_members = saltelli.base_members.saturating_mul(2);
                Some(Self::Saltelli(saltelli))
            }
            Self::Morris(mut morris) => {
                morris.trajectories = morris.trajectories.saturating_mul(2);
                Some(Self::Morris(morris))
            }
            _ => None,
        }
    }

    /// True if a member is a draw from the inputs' distributions, so that it counts for
    /// probabilities: all of Sobol', Latin hypercube, factorial and explicit designs, the two
    /// base samples of a Saltelli design, none of the others.
    pub fn is_draw(&self, index: u64, inputs: usize) -> bool {
        match self {
            Self::Sobol(_) | Self::LatinHypercube(_) => true,
            Self::FullFactorial(_) | Self::Explicit(_) => true,
            Self::Saltelli(_) => index % (inputs as u64 + 2) < 2,
            Self::Morris(_) | Self::OneAtATime(_) => false,
        }
    }

    /// True if the draws' coordinates are uniform.
    pub(crate) fn is_uniform(&self) -> bool {
        matches!(
            self,
            Self::Sobol(_) | Self::LatinHypercube(_) | Self::Saltelli(_)
        )
    }

    /// True if the design has draws from the inputs' distributions.
    pub(crate) fn has_draws(&self) -> bool {
        self.is_draw(0, 0)
    }

    /// True if the indices of the design need independent inputs.
    pub(crate) fn needs_independence(&self) -> bool {
        matches!(
            self,
            Self::Morris(_) | Self::Saltelli(_) | Self::OneAtATime(_)
        )
    }

    /// All that is wrong with the design for so many inputs; each pointer begins at the design.
    pub fn violations(&self, inputs: usize) -> Vec<Violation> {
        let (key, mut found) = match self {
            Self::Sobol(sobol) => ("sobol", sobol.violations()),
            Self::LatinHypercube(latin) => ("latin_hypercube", latin.violations()),
            Self::FullFactorial(factorial) => ("full_factorial", factorial.violations(inputs)),
            Self::Morris(morris) => ("morris", morris.violations()),
            Self::Saltelli(saltelli) => ("saltelli", saltelli.violations()),
            Self::OneAtATime(one) => ("one_at_a_time", one.violations()),
            Self::Explicit(explicit) => ("explicit", explicit.violations(inputs)),
        };
        if found.is_empty() {
            found.extend(limits::too_many(self.members(inputs)));
        }
        Violation::under(&format!("/{key}"), found)
    }
}
