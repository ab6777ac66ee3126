//! Mean and variance of numbers.

/// Mean; 0 of no number.
pub(crate) fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / (numbers.len().max(1)) as f64
}

/// Variance without bias: squares about the mean over n − 1; 0 of fewer than two numbers.
pub(crate) fn variance(numbers: &[f64]) -> f64 {
    let mean = mean(numbers);
    let squares: f64 = numbers.iter().map(|x| (x - mean) * (x - mean)).sum();
    squares / (numbers.len().saturating_sub(1).max(1)) as f64
}

/// Covariance without bias of numbers that belong together by place.
pub(crate) fn covariance(one: &[f64], other: &[f64]) -> f64 {
    let means = (mean(one), mean(other));
    let both = one.iter().zip(other);
    let products: f64 = both.map(|(x, y)| (x - means.0) * (y - means.1)).sum();
    products / (one.len().saturating_sub(1).max(1)) as f64
}

/// Numbers in ascending order.
pub(crate) fn sorted(numbers: &[f64]) -> Vec<f64> {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// Number at a place of a sorted list that is counted from 0 and may lie between two; beyond the
/// ends it is that of the end. The list has a number.
pub(crate) fn at(sorted: &[f64], place: f64) -> f64 {
    let last = sorted.len() - 1;
    let place = place.clamp(0.0, last as f64);
    let below = place.floor() as usize;
    let above = (below + 1).min(last);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}
