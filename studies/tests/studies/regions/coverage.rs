//! Probability that regions hold, and their areas.

use super::{Map, caught_or_carried, normal, places, skewed, sobol, two_peaked};
use crate::support::{deviation, independent, mean};
use scree_studies::answers::RestDistribution;

/// Shares of 1,000 fresh members in the 90 % regions of twelve studies of 256 members.
fn coverage(map: Map, design: fn(u64) -> Vec<Vec<f64>>) -> Vec<f64> {
    let share = |seed: u64| {
        let rest = RestDistribution::of(&places(&design(seed), map), &[0.9]);
        let fresh = independent(1000, 3, 100 + seed);
        let within = fresh.iter().filter(|u| rest.contains(0, map(u)));
        within.count() as f64 / 1000.0
    };
    (0..12).map(share).collect()
}

/// Asserts that the mean of shares is 90 % and that no study is far from it.
fn assert_covers(what: &str, shares: &[f64], spread: f64) {
    let (mean, deviation) = (mean(shares), deviation(shares));
    println!(
        "90 % region, {what}: {:.1} ± {:.1} %",
        100.0 * mean,
        100.0 * deviation
    );
    assert!((mean - 0.9).abs() < 0.015, "{what}: {mean}");
    assert!(deviation < spread, "{what}: {deviation}");
}

#[test]
fn of_fresh_members_the_region_holds_its_probability() {
    let design = |seed| sobol(256, seed, 3);
    assert_covers("one skewed peak, Sobol'", &coverage(skewed, design), 0.02);
    assert_covers("two peaks, Sobol'", &coverage(two_peaked, design), 0.02);
}

// The line makes the kernels too narrow for the other peak, where many members stand alone.
#[test]
fn it_does_where_one_peak_is_a_line_and_the_other_wide() {
    let design = |seed| sobol(256, seed, 3);
    let shares = coverage(caught_or_carried, design);
    assert_covers("a line and a wide peak, Sobol'", &shares, 0.02);
}

#[test]
fn of_independent_members_too() {
    let design = |seed| independent(256, 3, 1000 + seed);
    assert_covers(
        "one skewed peak, independent",
        &coverage(skewed, design),
        0.035,
    );
    assert_covers(
        "two peaks, independent",
        &coverage(two_peaked, design),
        0.035,
    );
}

#[test]
fn areas_are_those_of_the_distribution_and_their_errors_are_honest() {
    let (mut areas, mut errors, mut noise) = (Vec::new(), Vec::new(), Vec::new());
    for seed in 0..12 {
        let rest = RestDistribution::of(&places(&independent(512, 2, seed), normal), &[0.9]);
        areas.push(rest.regions[0].area_m2);
        errors.push(rest.regions[0].area_standard_error_m2);
        noise.push(rest.noise_ratio.unwrap());
    }
    // An ellipse: π σ_x σ_y χ², with the 90 % quantile χ² = −2 ln 0.1.
    let truth = 2.0 * std::f64::consts::PI * -2.0 * 0.1_f64.ln();
    let ratio = mean(&areas) / truth;
    println!(
        "area over its truth: {ratio:.3} ± {:.3}",
        deviation(&areas) / truth
    );
    assert!((0.97..1.1).contains(&ratio), "{ratio}");
    let honesty = mean(&errors) / deviation(&areas);
    assert!((0.6..1.7).contains(&honesty), "{honesty}");
    assert!(mean(&noise) > 0.85, "{noise:?}");
}

#[test]
fn a_balanced_design_is_seen_to_be_quiet() {
    let rest = RestDistribution::of(&places(&sobol(512, 1, 2), normal), &[0.9]);
    assert!(rest.noise_ratio.unwrap() < 0.3, "{:?}", rest.noise_ratio);
}
