//! Limits of the designs.

use crate::distribution::SMALLEST_PROBABILITY;
use crate::study::Violation;

/// Most members of a study.
const MOST_MEMBERS: u64 = 1 << 20;

/// A count that must be a power of two of at least two: only then are Sobol' points balanced
/// (Owen 2020, On dropping the first Sobol' point).
pub(super) fn power_of_two(pointer: &str, count: u64) -> Option<Violation> {
    let right = count.is_power_of_two() && (2..=MOST_MEMBERS).contains(&count);
    let allowed = format!("a power of two, 2 <= x <= {MOST_MEMBERS}");
    (!right).then(|| Violation::of(pointer, count, allowed))
}

/// A count of at least so many, and at most as many as a study may have members.
pub(super) fn at_least(pointer: &str, count: u64, least: u64) -> Option<Violation> {
    let right = (least..=MOST_MEMBERS).contains(&count);
    let allowed = format!("{least} <= x <= {MOST_MEMBERS}");
    (!right).then(|| Violation::of(pointer, count, allowed))
}

/// More members than a study may have.
pub(super) fn too_many(members: u64) -> Option<Violation> {
    (members > MOST_MEMBERS).then(|| {
        let message = format!("the design has {members} members, allowed: at most {MOST_MEMBERS}");
        Violation::new("", message)
    })
}

/// Middle of one of so many equally likely levels.
pub(super) fn middle(level: u64, levels: u64) -> f64 {
    (level as f64 + 0.5) / levels as f64
}

/// Probability within what the quantiles take.
pub(super) fn clamped(probability: f64) -> f64 {
    probability.clamp(SMALLEST_PROBABILITY, 1.0 - SMALLEST_PROBABILITY)
}
