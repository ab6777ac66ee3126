//! Densities of the members as a further draw would have them.

use super::grid::{DensityGrid, Kernel};

/// Density at each place that the other places give it [1/m²], in ascending order.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scores {
    ascending: Vec<f64>,
}

impl Scores {
    /// Scores of weighted places under their density; a place of weight w counts w times.
    ///
    /// Of independent draws each is left out of its own density. The members of a balanced design
    /// keep apart, so that leaving one out would leave a hole which a further draw does not find;
    /// of it the share of the noise ratio is left out, and its copies in a resample entirely. A
    /// hole is no deeper than the density around it: what stays is multiplied by the share that
    /// the others have in the density, so that nothing stays of a member far from all others.
    pub(super) fn of(
        kernel: &Kernel,
        density: &DensityGrid,
        places_m: &[[f64; 2]],
        weights: &[f64],
        noise: f64,
    ) -> Self {
        let total: f64 = weights.iter().sum();
        let score = |(place, weight): (&[f64; 2], &f64)| {
            let own = kernel.own(*place);
            let others = total * kernel.at(density, *place) - weight * own;
            let kept = (1.0 - noise) * own * others / (others + own);
            let score = (others + kept) / (total - weight + 1.0 - noise);
            let copies = *weight as usize;
            std::iter::repeat_n(score, copies)
        };
        let mut ascending: Vec<f64> = places_m.iter().zip(weights).flat_map(score).collect();
        ascending.sort_by(f64::total_cmp);
        Self { ascending }
    }

    /// Level above which a further draw has its density with a probability p: the (n + 1)(1 − p)-th
    /// smallest score, since a further draw falls with equal chance between any two of n. None of
    /// too few scores.
    pub(super) fn level(&self, probability: f64) -> Option<f64> {
        let rank = (self.ascending.len() + 1) as f64 * (1.0 - probability);
        (rank >= 1.0).then(|| crate::moments::at(&self.ascending, rank - 1.0))
    }

    /// Number of places with a score of at least a level.
    pub(super) fn above(&self, level: f64) -> u64 {
        let below = self.ascending.partition_point(|score| *score < level);
        (self.ascending.len() - below) as u64
    }
}
