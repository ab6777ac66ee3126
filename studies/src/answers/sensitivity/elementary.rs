//! Elementary effects of Morris trajectories.

use crate::design::Morris;
use crate::moments;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Elementary effects of the inputs on a quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ElementaryEffects {
    /// Effects of the inputs, in their order.
    pub inputs: Vec<ElementaryEffect>,
}

/// Elementary effects of one input: changes of the quantity over the change of the input's
/// probability, so in the unit of the quantity for the whole range of the input.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ElementaryEffect {
    /// Mean μ of the effects (Morris 1991).
    pub mean: Moment,
    /// Mean μ* of their sizes, by which inputs are ranked (Campolongo, Cariboni & Saltelli 2007).
    pub mean_size: Moment,
    /// Standard deviation σ of the effects, large for an input that interacts or acts non-linearly.
    pub deviation: Moment,
    /// Number of effects behind it.
    pub effects: u64,
    /// Effects left out because a member lacks the quantity.
    pub effects_left_out: u64,
}

/// Statistic of the effects.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = EffectMoment))]
pub struct Moment {
    /// Value, in the unit of the quantity.
    pub value: f64,
    /// Standard error by the jackknife (Tukey 1958), which for a mean is s/√r.
    pub standard_error: f64,
}

impl ElementaryEffects {
    /// Effects from the known members; none if an input has fewer than two.
    pub(super) fn of(design: &Morris, inputs: usize, known: &BTreeMap<u64, f64>) -> Option<Self> {
        let mut effects = vec![Vec::new(); inputs];
        for number in 0..design.trajectories {
            let trajectory = design.trajectory(number, inputs);
            let first = number * (inputs as u64 + 1);
            for (step, input) in trajectory.order.iter().enumerate() {
                let before = known.get(&(first + step as u64));
                let after = known.get(&(first + step as u64 + 1));
                if let (Some(before), Some(after)) = (before, after) {
                    effects[*input].push((after - before) / trajectory.step(*input));
                }
            }
        }
        let of_one = |effects: &Vec<f64>| ElementaryEffect::of(effects, design.trajectories);
        let inputs = effects.iter().map(of_one).collect::<Option<_>>()?;
        Some(Self { inputs })
    }
}

impl ElementaryEffect {
    fn of(effects: &[f64], trajectories: u64) -> Option<Self> {
        if effects.len() < 2 {
            return None;
        }
        let sizes: Vec<f64> = effects.iter().map(|effect| effect.abs()).collect();
        Some(Self {
            mean: Moment::of(effects, moments::mean),
            mean_size: Moment::of(&sizes, moments::mean),
            deviation: Moment::of(effects, |effects| moments::variance(effects).sqrt()),
            effects: effects.len() as u64,
            effects_left_out: trajectories - effects.len() as u64,
        })
    }
}

impl Moment {
    /// Statistic of two or more effects with its jackknife error √((r − 1)/r Σ (s₋ᵢ − s̄)²).
    fn of(effects: &[f64], statistic: fn(&[f64]) -> f64) -> Self {
        let without = |place: usize| {
            let others = [&effects[..place], &effects[place + 1..]].concat();
            statistic(&others)
        };
        let left_out: Vec<f64> = (0..effects.len()).map(without).collect();
        let count = effects.len() as f64;
        let squares = (count - 1.0) * moments::variance(&left_out);
        Self {
            value: statistic(effects),
            standard_error: ((count - 1.0) / count * squares).sqrt(),
        }
    }
}
