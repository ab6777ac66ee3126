//! Standard normal distribution.

use statrs::distribution::{ContinuousCDF, Normal};
use std::f64::consts::FRAC_1_SQRT_2;

/// Spacing of the quantiles, 2⁻⁴⁰: far above the rounding of Φ, far below what an input needs.
const SPACING: f64 = 1.0 / (1_u64 << 40) as f64;

/// Distribution function Φ(z).
pub(crate) fn cdf(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// Density φ(z).
pub(crate) fn density(z: f64) -> f64 {
    let scale = (2.0 * std::f64::consts::PI).sqrt();
    libm::exp(-0.5 * z * z) / scale
}

/// Quantile Φ⁻¹(u) for 0 < u < 1, to within 2⁻⁴⁰.
///
/// `statrs` takes the logarithm of the system's library, whose last bit differs between
/// machines. So its value only starts the search for the largest multiple of the spacing whose
/// Φ, of `libm`, is not above u.
pub(crate) fn quantile(u: f64) -> f64 {
    if u > 0.5 {
        return -lower_quantile(1.0 - u);
    }
    lower_quantile(u)
}

fn lower_quantile(u: f64) -> f64 {
    let start = Normal::standard().inverse_cdf(u);
    let mut place = (start / SPACING).floor();
    while cdf(place * SPACING) > u {
        place -= 1.0;
    }
    while cdf((place + 1.0) * SPACING) <= u {
        place += 1.0;
    }
    place * SPACING
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_tables() {
        // Wichura 1988, algorithm AS 241, table of checks.
        let table = [
            (0.25, -0.674_489_750_196_081_7),
            (0.001, -3.090_232_306_167_814),
            (1e-20, -9.262_340_089_798_408),
            (0.975, 1.959_963_984_540_054),
        ];
        for (u, z) in table {
            assert!((quantile(u) - z).abs() < 2e-12, "{u}: {}", quantile(u));
        }
        assert_eq!(quantile(0.5), 0.0);
    }

    #[test]
    fn a_noisy_start_has_the_same_quantile() {
        for step in 1..1000 {
            let u = f64::from(step) / 2000.0;
            let z = quantile(u);
            assert!(cdf(z) <= u && cdf(z + SPACING) > u);
        }
    }
}
