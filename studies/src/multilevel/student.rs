//! Student's t distribution.

use crate::normal;

/// Quantile at a probability 0.5 < p < 1 of Student's t distribution with at least one degree of
/// freedom: exact of one and two, which stand for a little more, too; of three and more by the
/// expansion in 1/ν (Abramowitz & Stegun 1964, 26.7.5), within 1 % at p = 0.975.
pub(super) fn quantile(probability: f64, freedom: f64) -> f64 {
    let between = 2.0 * probability - 1.0;
    if freedom < 2.0 {
        return libm::tan(0.5 * std::f64::consts::PI * between);
    }
    if freedom < 3.0 {
        return between * (2.0 / (1.0 - between * between)).sqrt();
    }
    let z = normal::quantile(probability);
    let square = z * z;
    let first = z * (square + 1.0) / 4.0;
    let second = z * ((5.0 * square + 16.0) * square + 3.0) / 96.0;
    let third = z * (((3.0 * square + 19.0) * square + 17.0) * square - 15.0) / 384.0;
    z + (first + (second + third / freedom) / freedom) / freedom
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::distribution::{ContinuousCDF, StudentsT};

    #[test]
    fn quantiles_are_those_of_another_library() {
        for freedom in [1.0, 2.0, 3.0, 5.0, 10.0, 30.0, 1000.0] {
            let other = StudentsT::new(0.0, 1.0, freedom)
                .unwrap()
                .inverse_cdf(0.975);
            let own = quantile(0.975, freedom);
            assert!((own / other - 1.0).abs() < 0.01, "{freedom}: {own} {other}");
        }
    }
}
