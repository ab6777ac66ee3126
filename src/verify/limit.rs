//! Limit of a quantity as cells get finer, from its three finest values.

use super::findings::Finding;
use serde::Serialize;

/// Range of possible orders. Below the least, the limit is farther away than the
/// values are apart, and is meaningless.
const ORDERS: (f64, f64) = (0.5, 12.0);

/// Grid-converged limit of a quantity (h → 0), by Richardson extrapolation.
#[derive(Debug, Clone, Serialize)]
pub struct Limit {
    /// Name of the quantity.
    pub quantity: String,
    /// Its unit.
    pub unit: &'static str,
    /// The three finest resolutions, in words.
    pub over: Vec<String>,
    /// Observed order and limit; none if the values don't settle: if they oscillate,
    /// or change by more with finer cells.
    pub found: Option<Extrapolated>,
}

/// Extrapolation by value = limit + C · sizeᵒʳᵈᵉʳ through three values.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Extrapolated {
    /// Observed order.
    pub order: f64,
    /// The value at size zero.
    pub limit: f64,
}

impl Limit {
    /// Limit from the findings about one quantity, coarse ones first.
    pub(super) fn of<'a>(quantity: &str, findings: impl Iterator<Item = &'a Finding>) -> Self {
        let mut places = Vec::new();
        let (mut over, mut unit) = (Vec::new(), "");
        for finding in findings {
            if let (Some(size), Some(value)) = (finding.resolution.size, finding.measured) {
                places.push((size, value));
                over.push(finding.resolution.label.clone());
                unit = finding.question.unit;
            }
        }
        let first = places.len().saturating_sub(3);
        Self {
            quantity: quantity.to_owned(),
            unit,
            over: over.split_off(first),
            found: extrapolated(&places),
        }
    }
}

/// Limit of these sizes and values; the finest value if they don't settle, NaN
/// if there is none.
pub(super) fn limit_or_finest(places: &[(f64, f64)]) -> f64 {
    let finest = places.last().map_or(f64::NAN, |place| place.1);
    extrapolated(places).map_or(finest, |found| found.limit)
}

/// Extrapolation from the last three of these sizes and values.
pub(super) fn extrapolated(places: &[(f64, f64)]) -> Option<Extrapolated> {
    let [.., coarse, middle, fine] = places else {
        return None;
    };
    let steps = (coarse.1 - middle.1, middle.1 - fine.1);
    let power = |size: f64, order: f64| (size / fine.0).powf(order);
    // Increases with the order.
    let ratio =
        |order| (power(coarse.0, order) - power(middle.0, order)) / (power(middle.0, order) - 1.0);
    let (mut low, mut high) = ORDERS;
    let wanted = steps.0 / steps.1;
    if !(ratio(low)..ratio(high)).contains(&wanted) {
        return None;
    }
    for _ in 0..60 {
        let order = 0.5 * (low + high);
        if ratio(order) < wanted {
            low = order;
        } else {
            high = order;
        }
    }
    let limit = fine.1 - steps.1 / (power(middle.0, low) - 1.0);
    Some(Extrapolated { order: low, limit })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(order: f64) -> Vec<(f64, f64)> {
        let value = |size: f64| (size, 5.0 - 2.0 * size.powf(order));
        [0.9, 0.4, 0.3, 0.15].map(value).to_vec()
    }

    #[test]
    fn a_power_is_found_with_its_limit() {
        for order in [0.6, 1.0, 2.7] {
            let found = extrapolated(&values(order)).unwrap();
            assert!((found.order - order).abs() < 1e-6, "{found:?}");
            assert!((found.limit - 5.0).abs() < 1e-6, "{found:?}");
        }
    }

    #[test]
    fn what_does_not_settle_has_no_limit() {
        let turning = [(4.0, 1.0), (2.0, 1.5), (1.0, 1.2)];
        let running_away = [(4.0, 1.0), (2.0, 1.1), (1.0, 1.5)];
        let still = [(4.0, 1.0), (2.0, 1.0), (1.0, 1.0)];
        for places in [&turning[..], &running_away, &still, &turning[..2]] {
            assert_eq!(extrapolated(places), None);
        }
    }
}
