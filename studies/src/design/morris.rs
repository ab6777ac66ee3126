//! Trajectories of elementary effects.

use super::limits;
use crate::random::{Purpose, Random};
use crate::study::Violation;
use serde::{Deserialize, Serialize};

/// Trajectories (Morris 1991): each begins at a random point of a grid of levels and moves one
/// input after the other, in random order, by half the levels. The levels are the middles of
/// equally likely parts, the quantiles at (k + ½)/p, since an unbounded distribution has no end
/// for a level to lie at; so a step is ½ of probability.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = MorrisDesign))]
#[serde(deny_unknown_fields)]
pub struct Morris {
    /// Number r of trajectories, at least 2; there are r (d + 1) members for d inputs.
    pub trajectories: u64,
    /// Number p of levels, even.
    pub levels: u64,
    /// Seed of the trajectories.
    pub seed: u64,
}

/// One trajectory.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Trajectory {
    /// Start and end of each input.
    ends: Vec<[f64; 2]>,
    /// Inputs in the order in which they move.
    pub(crate) order: Vec<usize>,
}

impl Morris {
    pub(super) fn point(&self, index: u64, inputs: usize) -> Vec<f64> {
        let members = inputs as u64 + 1;
        let trajectory = self.trajectory(index / members, inputs);
        trajectory.point((index % members) as usize)
    }

    /// Trajectory of a number below that of the trajectories.
    pub(crate) fn trajectory(&self, number: u64, inputs: usize) -> Trajectory {
        let mut random = Random::new(Purpose::Trajectory, self.seed, [number, 0]);
        let half = self.levels / 2;
        let ends = (0..inputs).map(|_| {
            let start = random.below(self.levels as usize) as u64;
            let end = if start < half {
                start + half
            } else {
                start - half
            };
            [start, end].map(|level| limits::middle(level, self.levels))
        });
        Trajectory {
            ends: ends.collect(),
            order: random.order(inputs),
        }
    }

    pub(super) fn violations(&self) -> Vec<Violation> {
        let mut found = Vec::new();
        found.extend(limits::at_least("/trajectories", self.trajectories, 2));
        if self.levels < 2 || !self.levels.is_multiple_of(2) {
            let allowed = "an even number, x >= 2";
            found.push(Violation::of("/levels", self.levels, allowed));
        }
        found
    }
}

impl Trajectory {
    /// Point after so many steps.
    fn point(&self, steps: usize) -> Vec<f64> {
        let mut point: Vec<f64> = self.ends.iter().map(|[start, _]| *start).collect();
        for input in &self.order[..steps] {
            point[*input] = self.ends[*input][1];
        }
        point
    }

    /// Change of an input's probability as it moves, ±½.
    pub(crate) fn step(&self, input: usize) -> f64 {
        let [start, end] = self.ends[input];
        end - start
    }
}
