//! Number of members for each level.

use super::levels::Levels;
use super::{MultilevelError, above};
use serde::{Deserialize, Serialize};

/// Variance and cost of one level.
struct LevelCost {
    /// Variance of the term of the sum.
    variance: f64,
    /// Cost of one member or pair.
    cost: f64,
}

/// Members of each level for a target, and what they cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = LevelAllocation))]
pub struct Allocation {
    /// Members of level 0, then pairs of each further level.
    pub members: Vec<u64>,
    /// Cost of all members, in the unit of the costs given.
    pub cost: f64,
    /// Members of the finest level alone for the same target.
    pub single_level_members: u64,
    /// Their cost.
    pub single_level_cost: f64,
    /// Single-level cost over the cost: how many times cheaper the levels are.
    pub gain: f64,
}

impl Levels {
    /// Allocation for a target of the root of the mean square error, from the variances of these
    /// members and the costs of one member on each level, coarse to fine.
    ///
    /// Half of the mean square error is left to the bias, so the sampling variance is at most
    /// ε²/2; the numbers that reach it at the least cost are N_l = 2/ε² √(V_l/C_l) Σ √(V_k C_k)
    /// (Giles 2008, equation 2.4), at least two of a level. A pair costs both its members.
    ///
    /// # Errors
    /// A target or a cost that is not positive, or as many costs as there are not levels.
    pub fn allocation(
        &self,
        member_costs: &[f64],
        target: f64,
    ) -> Result<Allocation, MultilevelError> {
        above(0.0, "target", target, "x > 0")?;
        let levels = self.level_costs(member_costs)?;
        let allowed_variance = 0.5 * target * target;
        let sum: f64 = levels
            .iter()
            .map(|level| (level.variance * level.cost).sqrt())
            .sum();
        let members = levels.iter().map(|level| {
            let number = (level.variance / level.cost).sqrt() * sum / allowed_variance;
            (number.ceil() as u64).max(2)
        });
        let members: Vec<u64> = members.collect();
        let costs = levels.iter().zip(&members);
        let cost: f64 = costs
            .map(|(level, members)| level.cost * *members as f64)
            .sum();
        let single = (self.finest_variance() / allowed_variance).ceil() as u64;
        let single_level_cost = single as f64 * member_costs[member_costs.len() - 1];
        Ok(Allocation {
            members,
            cost,
            single_level_members: single,
            single_level_cost,
            gain: single_level_cost / cost,
        })
    }

    /// Variance and cost of each level.
    fn level_costs(&self, member_costs: &[f64]) -> Result<Vec<LevelCost>, MultilevelError> {
        let moments = self.mean().levels;
        if member_costs.len() != moments.len() {
            return Err(MultilevelError::NotAllowed {
                what: "number of costs",
                value: member_costs.len() as f64,
                allowed: "the number of levels",
            });
        }
        for cost in member_costs {
            above(0.0, "cost", *cost, "x > 0")?;
        }
        let coarser = [0.0].into_iter().chain(member_costs.iter().copied());
        let costs = member_costs.iter().zip(coarser).zip(&moments);
        let level = |((fine, coarse), moments): ((&f64, f64), &super::LevelMoments)| LevelCost {
            variance: moments.variance,
            cost: fine + coarse,
        };
        Ok(costs.map(level).collect())
    }
}
