//! The band of one quantity, from its values at several cell sizes (docs/method.md,
//! equations 70–74).

use super::fit::{Line, observed_order};
use crate::record::{Band, Basis};

/// How much of the scatter is added to the trend: chosen, with the next one, on scenes
/// that served for nothing else.
const SCATTER: f64 = 2.5;
/// How far a band goes against the trend, over how far with it: finer cells mostly
/// change a value as the coarser ones did.
const BACK: f64 = 0.5;
/// Half the width over the only difference there is.
const SAFETY_OF_ONE: f64 = 3.0;
/// Observed orders that are plausible.
const PLAUSIBLE: (f64, f64) = (0.5, 4.0);
/// What no run of another cell size tells, in cells of the answer for a length: where
/// points lie within their cells.
const FLOOR_CELLS: f64 = 0.01;
/// The same as a share of the value.
const FLOOR_SHARE: f64 = 0.002;

/// What a quantity is, for the smallest width of its band and its natural bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A time, a speed or a mass: not negative.
    Amount,
    /// A length: not negative.
    Length,
    /// A coordinate.
    Place,
}

/// A quantity at several cell sizes.
#[derive(Debug, Clone)]
pub(super) struct Series {
    /// What it is.
    pub(super) kind: Kind,
    /// Cell size [m] and value, those of the answer first, then ever larger cells;
    /// no value where it did not happen.
    pub(super) places: Vec<(f64, Option<f64>)>,
    /// With a softer material, and with the same cells and the usual one.
    pub(super) softer: Option<[Option<f64>; 2]>,
}

impl Series {
    /// The band round the answer's value.
    pub(super) fn band(&self) -> Band {
        let happened: Vec<(f64, f64)> = self
            .places
            .iter()
            .filter_map(|(size, value)| Some((*size, (*value)?)))
            .collect();
        let value = self.places.first().and_then(|place| place.1);
        let nothing = Band {
            value,
            low: None,
            high: None,
            order: None,
            basis: Basis::Nothing,
        };
        if happened.is_empty() {
            return Band {
                basis: Basis::NeverHappened,
                ..nothing
            };
        }
        if happened.len() < self.places.len() {
            return self.of_some(&happened, nothing);
        }
        match happened.len() {
            1 => nothing,
            2 => self.about(&happened, Basis::OneCompanion, None),
            _ if happened.iter().all(|place| place.1 == happened[0].1) => {
                self.about(&happened, Basis::Same, None)
            }
            _ => match observed_order(&happened, PLAUSIBLE) {
                Some(order) => self.about(&happened, Basis::Converging, Some(order)),
                None => self.about(&happened, Basis::Scattered, None),
            },
        }
    }

    /// It happened in some of the runs: not before the earliest, if at all.
    fn of_some(&self, happened: &[(f64, f64)], nothing: Band) -> Band {
        let values = || happened.iter().map(|place| place.1);
        let least = values().fold(f64::INFINITY, f64::min);
        let most = values().fold(f64::NEG_INFINITY, f64::max);
        Band {
            low: Some(self.not_below(least - (most - least))),
            basis: Basis::SometimesHappened,
            ..nothing
        }
    }

    fn about(&self, happened: &[(f64, f64)], basis: Basis, order: Option<f64>) -> Band {
        let (size, value) = happened[0];
        let (trend, off_it) = match happened {
            [_, (_, other)] => (0.0, SAFETY_OF_ONE * (value - other).abs()),
            _ => {
                let line = Line::through(happened);
                (-line.slope * size, SCATTER * line.scatter)
            }
        };
        let [down, up] = [-trend, trend].map(|way| way.max(-BACK * way));
        let around = off_it + self.of_softness() + self.floor(size, value);
        Band {
            value: Some(value),
            low: Some(self.not_below(value - down - around)),
            high: Some(value + up + around),
            order,
            basis,
        }
    }

    /// What half the sound speed changes (equation 73).
    fn of_softness(&self) -> f64 {
        match self.softer {
            Some([Some(softer), Some(usual)]) => (softer - usual).abs(),
            _ => 0.0,
        }
    }

    fn floor(&self, size: f64, value: f64) -> f64 {
        match self.kind {
            Kind::Length | Kind::Place => FLOOR_CELLS * size,
            Kind::Amount => FLOOR_SHARE * value.abs(),
        }
    }

    fn not_below(&self, low: f64) -> f64 {
        match self.kind {
            Kind::Place => low,
            Kind::Amount | Kind::Length => low.max(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(values: &[Option<f64>]) -> Series {
        let sizes = [0.01, 0.015, 0.02, 0.025];
        Series {
            kind: Kind::Amount,
            places: sizes.into_iter().zip(values.iter().copied()).collect(),
            softer: None,
        }
    }

    fn happened(values: &[f64]) -> Series {
        series(&values.iter().copied().map(Some).collect::<Vec<_>>())
    }

    fn half_width(band: &Band) -> f64 {
        0.5 * (band.high.unwrap() - band.low.unwrap())
    }

    #[test]
    fn values_on_a_line_get_a_band_that_reaches_their_limit() {
        let band = happened(&[1.1, 1.15, 1.2, 1.25]).band();
        assert_eq!(band.basis, Basis::Converging);
        assert!((band.order.unwrap() - 1.0).abs() < 0.05, "{band:?}");
        // The limit is 1.0, and half of that way lies on the other side.
        let ends = [band.low.unwrap(), band.high.unwrap()];
        let floor = 1.1 * FLOOR_SHARE;
        assert!((ends[0] - (1.0 - floor)).abs() < 1e-12, "{band:?}");
        assert!((ends[1] - (1.15 + floor)).abs() < 1e-12, "{band:?}");
    }

    #[test]
    fn values_that_turn_get_a_wide_band_and_no_order() {
        let band = happened(&[1.1, 1.2, 1.1, 1.2]).band();
        assert_eq!((band.basis, band.order), (Basis::Scattered, None));
        assert!(half_width(&band) > 0.1, "{band:?}");
    }

    #[test]
    fn values_that_are_all_the_same_keep_the_smallest_band() {
        let band = happened(&[1.0; 4]).band();
        assert_eq!(band.basis, Basis::Same);
        assert!((half_width(&band) - FLOOR_SHARE).abs() < 1e-12, "{band:?}");
        let mut of_length = happened(&[1.0; 4]);
        of_length.kind = Kind::Length;
        let band = of_length.band();
        assert!(
            (half_width(&band) - 0.01 * FLOOR_CELLS).abs() < 1e-12,
            "{band:?}"
        );
    }

    #[test]
    fn one_companion_makes_a_wide_band_and_none_makes_none() {
        let one = happened(&[1.0, 1.1]).band();
        assert_eq!(one.basis, Basis::OneCompanion);
        assert!(half_width(&one) > 0.3, "{one:?}");
        let none = happened(&[1.0]).band();
        assert_eq!(
            (none.basis, none.low, none.high),
            (Basis::Nothing, None, None)
        );
    }

    #[test]
    fn what_happened_in_some_runs_only_has_no_upper_end() {
        let answer_moves_on = series(&[None, Some(1.0), Some(1.2)]).band();
        assert_eq!(answer_moves_on.basis, Basis::SometimesHappened);
        assert_eq!((answer_moves_on.value, answer_moves_on.high), (None, None));
        assert!(answer_moves_on.low.unwrap() < 1.0);
        let companion_moves_on = series(&[Some(1.0), None, Some(1.2)]).band();
        assert_eq!(companion_moves_on.value, Some(1.0));
        assert_eq!(companion_moves_on.high, None);
        let never = series(&[None; 3]).band();
        assert_eq!((never.basis, never.low), (Basis::NeverHappened, None));
    }

    #[test]
    fn softness_widens_the_band_by_what_it_changes() {
        let mut values = happened(&[1.1, 1.15, 1.2, 1.25]);
        let before = half_width(&values.band());
        values.softer = Some([Some(1.3), Some(1.2)]);
        assert!((half_width(&values.band()) - before - 0.1).abs() < 1e-12);
        values.softer = Some([None, Some(1.2)]);
        assert_eq!(half_width(&values.band()), before);
    }

    #[test]
    fn what_cannot_be_negative_has_no_negative_band() {
        let mut values = happened(&[0.1, 0.4, 0.2, 0.6]);
        assert_eq!(values.band().low, Some(0.0));
        values.kind = Kind::Place;
        assert!(values.band().low.unwrap() < 0.0);
    }
}
