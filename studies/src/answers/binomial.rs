//! Binomial distribution, and the bounds that follow from it.

/// Halvings of a bracket until it has no digit left.
const HALVINGS: u32 = 60;
/// Share of a sum below which further terms are left out.
const NEGLIGIBLE: f64 = 1e-18;

/// Probability of k or more successes of n, each of probability p.
pub(super) fn at_least(k: u64, n: u64, p: f64) -> f64 {
    if k == 0 || p >= 1.0 {
        return f64::from(u8::from(k <= n));
    }
    if k > n || p <= 0.0 {
        return 0.0;
    }
    // The side of the mean on which the terms fall away from k is summed.
    if k as f64 > n as f64 * p {
        upper_sum(k, n, p)
    } else {
        1.0 - upper_sum(n - k + 1, n, 1.0 - p)
    }
}

/// Sum of the probabilities of k, k + 1, …, n, which fall from k on.
fn upper_sum(k: u64, n: u64, p: f64) -> f64 {
    let mut term = exactly(k, n, p);
    let mut sum = 0.0;
    for successes in k..=n {
        sum += term;
        if term < NEGLIGIBLE * sum {
            break;
        }
        term *= (n - successes) as f64 / (successes + 1) as f64 * p / (1.0 - p);
    }
    sum
}

/// Probability of exactly k successes of n, 0 < p < 1.
fn exactly(k: u64, n: u64, p: f64) -> f64 {
    let factorial = |count: u64| libm::lgamma(count as f64 + 1.0);
    let ways = factorial(n) - factorial(k) - factorial(n - k);
    libm::exp(ways + k as f64 * libm::log(p) + (n - k) as f64 * libm::log1p(-p))
}

/// Lower bound of the probability behind k successes of n: it is below the bound with a
/// probability of at most `tail` (Clopper & Pearson 1934).
pub(super) fn lower_bound(k: u64, n: u64, tail: f64) -> f64 {
    if k == 0 {
        return 0.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if at_least(k, n, middle) < tail {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Upper bound, likewise.
pub(super) fn upper_bound(k: u64, n: u64, tail: f64) -> f64 {
    1.0 - lower_bound(n.saturating_sub(k), n, tail)
}

/// Ranks r and s, counted from 1, of the order statistics of n draws that bound the quantile at
/// p: it is below the r-th with a probability of at most `tail`, and above the s-th likewise.
/// Rank 0 and n + 1 stand for no bound.
pub(super) fn quantile_ranks(p: f64, n: u64, tail: f64) -> (u64, u64) {
    // The number of draws below the quantile is binomial; the r-th lies above it if fewer than r
    // do.
    let lower = last_where(n, |rank| at_least(rank, n, p) >= 1.0 - tail);
    let upper = last_where(n, |rank| at_least(rank, n, p) > tail) + 1;
    (lower, upper)
}

/// Largest number of 0..=n for which a condition holds that holds from 0 up to some number.
fn last_where(n: u64, holds: impl Fn(u64) -> bool) -> u64 {
    let (mut holding, mut failing) = (0, n + 1);
    while failing - holding > 1 {
        let middle = holding.midpoint(failing);
        if holds(middle) {
            holding = middle;
        } else {
            failing = middle;
        }
    }
    holding
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::distribution::{Beta, Binomial, ContinuousCDF, DiscreteCDF};

    #[test]
    fn tails_are_those_of_another_library() {
        for (k, n, p) in [
            (1, 10, 0.3),
            (7, 10, 0.3),
            (100, 1000, 0.11),
            (900, 1000, 0.89),
        ] {
            let other = Binomial::new(p, n).unwrap().sf(k - 1);
            assert!((at_least(k, n, p) - other).abs() < 1e-9, "{k} {n} {p}");
        }
        assert_eq!(at_least(0, 5, 0.2), 1.0);
        assert_eq!(at_least(6, 5, 0.2), 0.0);
        assert_eq!(at_least(5, 5, 1.0), 1.0);
        assert_eq!(at_least(1, 5, 0.0), 0.0);
    }

    #[test]
    fn bounds_are_quantiles_of_the_beta_distribution() {
        for (k, n) in [(1, 10), (5, 10), (10, 10), (230, 256)] {
            let beta = Beta::new(k as f64, (n - k + 1) as f64).unwrap();
            let other = beta.inverse_cdf(0.025);
            assert!((lower_bound(k, n, 0.025) - other).abs() < 1e-6, "{k} {n}");
        }
        assert_eq!(lower_bound(0, 10, 0.025), 0.0);
        assert_eq!(upper_bound(10, 10, 0.025), 1.0);
        // No success in n: the bound is 1 − tail^(1/n).
        let exact = 1.0 - libm::pow(0.025, 0.1);
        assert!((upper_bound(0, 10, 0.025) - exact).abs() < 1e-12);
    }

    #[test]
    fn ranks_hold_the_quantile_as_often_as_told_and_no_narrower_ones_do() {
        for (p, n) in [(0.5, 20), (0.9, 100), (0.1, 1000)] {
            let (lower, upper) = quantile_ranks(p, n, 0.025);
            assert!(at_least(lower, n, p) >= 0.975 && at_least(lower + 1, n, p) < 0.975);
            assert!(at_least(upper, n, p) <= 0.025 && at_least(upper - 1, n, p) > 0.025);
        }
        // Six draws: all lie on one side of the median once in 32.
        assert_eq!(quantile_ranks(0.5, 6, 0.025), (1, 6));
        assert_eq!(quantile_ranks(0.5, 5, 0.025), (0, 6));
    }
}
