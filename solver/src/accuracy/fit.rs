//! Lines and powers through values at several cell sizes (docs/method.md,
//! equations 70 and 71).

/// Orders that are tried within the plausible range.
const ORDERS: u32 = 140;

/// The line nearest to values over their cell sizes, by weighted least squares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LinearFit {
    /// Change of the value per cell size.
    pub(super) slope: f64,
    /// Standard deviation of the values about the line.
    pub(super) scatter: f64,
}

impl LinearFit {
    /// Through at least three places (size, value) of different sizes. Weights go with
    /// the inverse of the size, so that fine cells count more.
    pub(super) fn through(places: &[(f64, f64)]) -> Self {
        let count = places.len() as f64;
        let all: f64 = places.iter().map(|place| 1.0 / place.0).sum();
        let weighted = |of: &dyn Fn(&(f64, f64)) -> f64| {
            places.iter().map(|place| of(place) / place.0).sum::<f64>() / all
        };
        let size = weighted(&|place| place.0);
        let value = weighted(&|place| place.1);
        let spread = weighted(&|place| (place.0 - size).powi(2));
        let product = weighted(&|place| (place.0 - size) * (place.1 - value));
        let slope = product / spread;
        let off = |place: &(f64, f64)| place.1 - value - slope * (place.0 - size);
        let squares = weighted(&|place| off(place).powi(2));
        Self {
            slope,
            scatter: (squares * count / (count - 2.0)).sqrt(),
        }
    }
}

/// The order p at which values come closest to φ₀ + α sizeᵖ, by least squares; `None`
/// if they turn, or if that order is not within `plausible`.
pub(super) fn observed_order(places: &[(f64, f64)], plausible: (f64, f64)) -> Option<f64> {
    let rising = places.is_sorted_by(|a, b| a.1 < b.1);
    let falling = places.is_sorted_by(|a, b| a.1 > b.1);
    if !rising && !falling {
        return None;
    }
    let (low, high) = plausible;
    let scatter = |order: f64| {
        let powers = places
            .iter()
            .map(|(size, value)| (size.powf(order), *value));
        LinearFit::through(&powers.collect::<Vec<_>>()).scatter
    };
    let step = (high - low) / f64::from(ORDERS);
    let orders = (0..=ORDERS).map(|place| low + step * f64::from(place));
    let best = orders.min_by(|a, b| scatter(*a).total_cmp(&scatter(*b)))?;
    // At an end of the range the nearest order lies beyond it.
    (best > low && best < high).then_some(best)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn power(order: f64, noise: f64) -> Vec<(f64, f64)> {
        let value = |(place, size): (usize, f64)| {
            let sign = if place.is_multiple_of(2) { 1.0 } else { -1.0 };
            (size, 5.0 - 2.0 * size.powf(order) + sign * noise)
        };
        [0.1, 0.15, 0.2, 0.25]
            .into_iter()
            .enumerate()
            .map(value)
            .collect()
    }

    #[test]
    fn a_line_is_found_whatever_the_weights() {
        let line = LinearFit::through(&power(1.0, 0.0));
        assert!((line.slope + 2.0).abs() < 1e-12, "{line:?}");
        assert!(line.scatter < 1e-12, "{line:?}");
        assert!(LinearFit::through(&power(1.0, 0.01)).scatter > 0.01);
    }

    #[test]
    fn the_order_of_a_power_is_found_and_no_other() {
        for order in [1.0, 1.5, 3.0] {
            let found = observed_order(&power(order, 0.0), (0.5, 4.0)).unwrap();
            assert!((found - order).abs() < 0.03, "{found} for {order}");
        }
        assert_eq!(observed_order(&power(0.2, 0.0), (0.5, 4.0)), None);
        assert_eq!(observed_order(&power(6.0, 0.0), (0.5, 4.0)), None);
        assert_eq!(
            observed_order(&power(1.0, 0.2), (0.5, 4.0)),
            None,
            "it turns"
        );
        let still = [(0.1, 1.0), (0.15, 1.0), (0.2, 1.0)];
        assert_eq!(observed_order(&still, (0.5, 4.0)), None);
    }
}
