//! Bias, allocation and cost.

use super::{COSTS, MEMBERS, expectation, levels};
use crate::support::{deviation, mean};
use scree_studies::multilevel::{Levels, MultilevelError, Pair, WeakConvergence, corrected_places};

#[test]
fn the_bias_is_extrapolated_from_the_finest_difference() {
    let convergence = WeakConvergence::new(2.0, 1.0).unwrap();
    let found: Vec<_> = (0..200)
        .map(|seed| levels(seed, MEMBERS).bias(&convergence))
        .collect();
    let truth = std::f64::consts::E - 1.0 - expectation(2);
    let estimates: Vec<f64> = found.iter().map(|bias| bias.estimate).collect();
    assert!(
        (mean(&estimates) - truth).abs() < 0.003,
        "{} {truth}",
        mean(&estimates)
    );
    let bounded = found
        .iter()
        .filter(|bias| bias.bound >= truth.abs())
        .count();
    assert!(bounded >= 190, "{bounded}");
    let within = |target: f64| found[0].is_within(target);
    assert!(within(1.5 * found[0].bound) && !within(1.4 * found[0].bound));
    // Second order: a quarter of the difference is left, a third of it beyond.
    let second = WeakConvergence::new(2.0, 2.0).unwrap();
    let ratio =
        levels(1, MEMBERS).bias(&convergence).estimate / levels(1, MEMBERS).bias(&second).estimate;
    assert!((ratio - 3.0).abs() < 1e-12);
}

#[test]
fn the_allocation_reaches_its_target_at_less_cost() {
    let pilot = levels(5, [200, 200, 200]);
    let target = 0.02;
    let found = pilot.allocation(&COSTS, target).unwrap();
    println!(
        "members {:?}, {:.1} times cheaper than {} of the finest level",
        found.members, found.gain, found.single_level_members
    );
    assert!(found.gain > 5.0, "{found:?}");
    assert!(found.members.windows(2).all(|pair| pair[0] > pair[1]));
    let cost: f64 = found.members[0] as f64 * 1.0
        + found.members[1] as f64 * 17.0
        + found.members[2] as f64 * 272.0;
    assert!((found.cost - cost).abs() < 1e-9);
    assert!((found.gain - found.single_level_cost / cost).abs() < 1e-12);

    let members = [found.members[0], found.members[1], found.members[2]];
    let estimates: Vec<f64> = (0..60)
        .map(|seed| levels(100 + seed, members).mean().value)
        .collect();
    let allowed = target / 2_f64.sqrt();
    let ratio = deviation(&estimates) / allowed;
    assert!((0.75..1.2).contains(&ratio), "{ratio}");
}

#[test]
fn no_other_allocation_of_the_same_cost_is_quieter() {
    let pilot = levels(5, [200, 200, 200]);
    let found = pilot.allocation(&COSTS, 0.005).unwrap();
    let moments = pilot.mean().levels;
    let variance = |members: [f64; 3]| -> f64 {
        moments
            .iter()
            .zip(members)
            .map(|(level, members)| level.variance / members)
            .sum()
    };
    let best = [0, 1, 2].map(|level| found.members[level] as f64);
    for (from, to) in [(0, 1), (1, 2), (2, 0), (1, 0)] {
        let pair_costs = [1.0, 17.0, 272.0];
        let moved = 0.1 * best[from] * pair_costs[from];
        let mut other = best;
        other[from] -= moved / pair_costs[from];
        other[to] += moved / pair_costs[to];
        assert!(variance(other) > variance(best), "{from} {to}");
    }
}

#[test]
fn what_has_no_estimate_is_refused() {
    let pair = Pair {
        coarse: 0.0,
        fine: 1.0,
    };
    let too_few = |level, members, least| MultilevelError::TooFewMembers {
        level,
        members,
        least,
    };
    assert_eq!(
        Levels::new(vec![1.0, 2.0], vec![]),
        Err(MultilevelError::OneLevel)
    );
    assert_eq!(
        Levels::new(vec![1.0], vec![vec![pair; 2]]),
        Err(too_few(0, 1, 2))
    );
    assert_eq!(
        Levels::new(vec![1.0; 2], vec![vec![pair; 2], vec![pair]]),
        Err(too_few(2, 1, 2))
    );
    let levels = Levels::new(vec![1.0, 2.0], vec![vec![pair; 12]]).unwrap();
    assert_eq!(levels.controlled_mean(11), Err(too_few(1, 12, 13)));
    let refused = |found: Result<(), MultilevelError>| found.unwrap_err().to_string();
    assert_eq!(
        refused(levels.controlled_mean(7).map(|_| ())),
        "number of pilots is 7, allowed: x >= 8"
    );
    assert_eq!(
        refused(levels.allocation(&[1.0], 0.1).map(|_| ())),
        "number of costs is 1, allowed: the number of levels"
    );
    assert_eq!(
        refused(levels.allocation(&[1.0, 0.0], 0.1).map(|_| ())),
        "cost is 0, allowed: x > 0"
    );
    assert_eq!(
        refused(levels.allocation(&[1.0, 2.0], 0.0).map(|_| ())),
        "target is 0, allowed: x > 0"
    );
    assert_eq!(
        refused(WeakConvergence::new(1.0, 1.0).map(|_| ())),
        "refinement is 1, allowed: x > 1"
    );
    assert_eq!(
        refused(WeakConvergence::new(2.0, 0.0).map(|_| ())),
        "order is 0, allowed: x > 0"
    );
    assert_eq!(
        corrected_places(&[[0.0, 0.0]], &[], 1),
        Err(too_few(1, 0, 10))
    );
}
