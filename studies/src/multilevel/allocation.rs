//! Number of members on each level.

use super::estimate::LevelMeans;
use crate::study::FEWEST_MEMBERS;

impl LevelMeans<1> {
    /// Numbers of members, coarse to fine, with which the mean, extrapolated to vanishing cells,
    /// has at most a variance, at the least cost: N_l = √(V_l / C_l) Σ √(V_k C_k) / V, where V_l is
    /// the weighted variance of a level's term (Giles 2008, equation 2.4). As levels are nested, a
    /// member of a level costs one run.
    ///
    /// `costs` is the work of a member on each level, in any unit.
    pub(super) fn allocation(&self, costs: &[f64], variance: f64) -> Vec<f64> {
        let weights = self.weights(self.extrapolation());
        let weighted = self.terms.iter().zip(&weights);
        let variances = weighted.map(|(term, weight)| {
            let weight = weight[(0, 0)];
            weight * weight * term.variance[(0, 0)]
        });
        let variances: Vec<f64> = variances.collect();
        let levels = || variances.iter().zip(costs);
        let sum: f64 = levels().map(|(one, cost)| (one * cost).sqrt()).sum();
        // Of a variance to which covariances add, the levels' own terms may take a part.
        let own = self.terms.iter().zip(&variances);
        let own: f64 = own.map(|(term, one)| one / term.members as f64).sum();
        let (all, _) = self.extrapolated_variance(0);
        let variance = if all > 0.0 {
            variance * own / all
        } else {
            variance
        };
        let mut members: Vec<f64> = levels()
            .map(|(one, cost)| (one / cost).sqrt() * sum / variance)
            .map(|members| members.ceil().max(FEWEST_MEMBERS as f64))
            .collect();
        // A member of a level is one of all coarser levels, too.
        for level in (1..members.len()).rev() {
            members[level - 1] = members[level - 1].max(members[level]);
        }
        members
    }
}
