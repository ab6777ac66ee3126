//! Multilevel estimates, against a stand-in whose levels have a known error.

mod allocation;
mod cloud;

use crate::support::{deviation, independent, mean, z};
use scree_studies::multilevel::{Levels, Pair};

/// Members and pairs of the three levels.
const MEMBERS: [u64; 3] = [600, 80, 20];
/// Cost of one member: half the cell size, sixteen times the work.
const COSTS: [f64; 3] = [1.0, 16.0, 256.0];

/// Stand-in for a run: exp(u₀) and an error that halves from level to level, a part of it random.
fn quantity(u: &[f64], level: i32) -> f64 {
    let cell = 0.5_f64.powi(level);
    u[0].exp() + 0.2 * cell * (1.0 + u[1]) + 0.1 * cell * z(u[2])
}

/// Expectation on a level.
fn expectation(level: i32) -> f64 {
    std::f64::consts::E - 1.0 + 0.3 * 0.5_f64.powi(level)
}

fn levels(seed: u64, members: [u64; 3]) -> Levels {
    let drawn = |level: u64| independent(members[level as usize], 3, 10 * seed + level);
    let base = drawn(0).iter().map(|u| quantity(u, 0)).collect();
    let pairs = |level: i32| {
        let drawn = drawn(level as u64);
        let pair = |u: &Vec<f64>| Pair {
            coarse: quantity(u, level - 1),
            fine: quantity(u, level),
        };
        drawn.iter().map(pair).collect()
    };
    Levels::new(base, vec![pairs(1), pairs(2)]).unwrap()
}

/// Asserts that estimates have a truth as their mean and the variance they claim.
fn assert_unbiased(estimates: &[(f64, f64)], truth: f64) {
    let values: Vec<f64> = estimates.iter().map(|one| one.0).collect();
    let claimed = mean(&estimates.iter().map(|one| one.1).collect::<Vec<f64>>()).sqrt();
    let error = deviation(&values) / (values.len() as f64).sqrt();
    assert!(
        (mean(&values) - truth).abs() < 3.0 * error,
        "{} {truth} ± {error}",
        mean(&values)
    );
    let ratio = claimed / deviation(&values);
    assert!((0.85..1.15).contains(&ratio), "{ratio}");
}

#[test]
fn the_mean_is_that_of_the_finest_level() {
    let estimate = |seed| {
        let found = levels(seed, MEMBERS).mean();
        (found.value, found.variance)
    };
    let estimates: Vec<(f64, f64)> = (0..200).map(estimate).collect();
    assert_unbiased(&estimates, expectation(2));
}

#[test]
fn the_probability_of_exceedance_is_that_of_the_finest_level() {
    let exact = independent(200_000, 3, 777);
    let above = exact.iter().filter(|u| quantity(u, 2) > 2.0).count() as f64;
    let estimate = |seed| {
        let found = levels(seed, MEMBERS).exceeding(2.0).mean();
        (found.value, found.variance)
    };
    let estimates: Vec<(f64, f64)> = (0..200).map(estimate).collect();
    assert_unbiased(&estimates, above / 200_000.0);
}

#[test]
fn control_variates_are_unbiased_and_no_noisier() {
    let members = [600, 100, 40];
    let controlled = |seed| {
        let found = levels(seed, members).controlled_mean(20).unwrap();
        (found.value, found.variance)
    };
    let estimates: Vec<(f64, f64)> = (0..200).map(controlled).collect();
    assert_unbiased(&estimates, expectation(2));
    let found = levels(1, members).controlled_mean(20).unwrap();
    assert!(
        found
            .coefficients
            .iter()
            .all(|one| (0.7..1.1).contains(one)),
        "{found:?}"
    );
}

#[test]
fn control_variates_hold_where_the_levels_hardly_correlate() {
    // The coarse level has nothing to do with the fine one and varies ten times as much.
    let weak = |seed: u64| {
        let base = independent(400, 1, 2 * seed)
            .iter()
            .map(|u| 10.0 * z(u[0]))
            .collect();
        let pair = |u: &Vec<f64>| Pair {
            coarse: 10.0 * z(u[0]),
            fine: 1.0 + z(u[1]),
        };
        let pairs = independent(60, 2, 2 * seed + 1).iter().map(pair).collect();
        Levels::new(base, vec![pairs]).unwrap()
    };
    let spread = |estimate: fn(&Levels) -> f64| {
        let values: Vec<f64> = (0..100).map(|seed| estimate(&weak(seed))).collect();
        (mean(&values), deviation(&values))
    };
    let telescoping = spread(|levels| levels.mean().value);
    let controlled = spread(|levels| levels.controlled_mean(20).unwrap().value);
    assert!((controlled.0 - 1.0).abs() < 0.1, "{controlled:?}");
    assert!(
        controlled.1 < 0.3 * telescoping.1,
        "{controlled:?} {telescoping:?}"
    );
}
