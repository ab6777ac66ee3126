//! The interval of one quantity, from its values at several cell sizes (docs/method.md,
//! equations 70–74).

use super::fit::{LinearFit, observed_order};
use crate::record::{Basis, QuantityKind, UncertaintyInterval};

/// Half the width over the difference, if there is only one.
const SAFETY_OF_ONE: f64 = 3.0;
/// Observed orders that are plausible.
const PLAUSIBLE: (f64, f64) = (0.5, 4.0);
/// Error that runs of other cell sizes do not show, in cells of the answer for a length: it
/// depends on the positions of points within their cells.
const FLOOR_CELLS: f64 = 0.01;
/// The same error as a share of the value.
const FLOOR_SHARE: f64 = 0.002;

/// Weights of the parts of an interval (equation 72).
#[derive(Debug)]
struct IntervalWeights {
    /// Weight of the extrapolated trend.
    trend: f64,
    /// Width against the trend, over the width with it.
    against: f64,
    /// Weight of the scatter.
    scatter: f64,
    /// Error to be expected at one cell across the thinnest body, over the scale.
    across: f64,
    /// Error to be expected at a path of one cell, over the scale.
    way: f64,
}

impl IntervalWeights {
    const fn of([trend, against, scatter, across, way]: [f64; 5]) -> Self {
        Self {
            trend,
            against,
            scatter,
            across,
            way,
        }
    }
}

impl QuantityKind {
    /// Weights fitted to scenes that served for nothing else (decision 24), and rounded.
    const fn weights(self) -> IntervalWeights {
        IntervalWeights::of(match self {
            Self::Moment => [0.0, 1.0, 2.0, 0.15, 0.2],
            Self::Stop => [1.0, 1.0, 2.5, 0.1, 0.0],
            Self::Speed => [1.0, 0.4, 2.0, 0.1, 0.8],
            Self::Length | Self::Along => [1.0, 0.5, 2.0, 0.1, 0.4],
            Self::Across => [0.0, 1.0, 2.0, 0.05, 0.0],
            Self::Up => [0.0, 1.0, 2.5, 0.0125, 0.0],
            Self::Reach => [1.0, 1.0, 2.0, 0.25, 0.2],
            // Nothing was fitted: extrapolation along a first-order line.
            Self::Mass => [1.0, 1.0, 2.5, 0.0, 0.0],
        })
    }

    const fn is_a_length(self) -> bool {
        self.is_a_place() || matches!(self, Self::Length)
    }

    /// True if the quantity is a coordinate. Its origin is arbitrary, so its errors are relative to
    /// the path.
    const fn is_a_place(self) -> bool {
        matches!(self, Self::Along | Self::Across | Self::Up | Self::Reach)
    }
}

/// Lengths that the cells of the answer are compared with.
#[derive(Debug, Clone, Copy)]
pub(super) struct ErrorScale {
    /// Width of the thinnest body, or the thickness of the release without bodies [m].
    pub(super) across_m: f64,
    /// Length of the path of the body or the flow [m].
    pub(super) way_m: f64,
}

/// A quantity at several cell sizes.
#[derive(Debug, Clone)]
pub(super) struct GridSeries {
    /// Its kind.
    pub(super) kind: QuantityKind,
    /// Lengths that its cells are compared with.
    pub(super) scale: ErrorScale,
    /// Cell size [m] and value, those of the answer first, then ever larger cells;
    /// no value where it did not happen.
    pub(super) places: Vec<(f64, Option<f64>)>,
    /// Value with a material of reduced stiffness, and with the same cells and the usual stiffness.
    pub(super) reduced_stiffness: Option<[Option<f64>; 2]>,
}

impl GridSeries {
    /// The interval round the answer's value.
    pub(super) fn interval(&self) -> UncertaintyInterval {
        let happened: Vec<(f64, f64)> = self
            .places
            .iter()
            .filter_map(|(size, value)| Some((*size, (*value)?)))
            .collect();
        let value = self.places.first().and_then(|place| place.1);
        let nothing = UncertaintyInterval {
            value,
            low: None,
            high: None,
            order: None,
            basis: Basis::Nothing,
        };
        if happened.is_empty() {
            return UncertaintyInterval {
                basis: Basis::NeverHappened,
                ..nothing
            };
        }
        if happened.len() < self.places.len() {
            return self.of_some(&happened, nothing);
        }
        match happened.len() {
            1 => nothing,
            2 => self.about(&happened, Basis::OneRefinementRun, None),
            _ if happened.iter().all(|place| place.1 == happened[0].1) => {
                self.about(&happened, Basis::Same, None)
            }
            _ => match observed_order(&happened, PLAUSIBLE) {
                Some(order) => self.about(&happened, Basis::Converging, Some(order)),
                None => self.about(&happened, Basis::Scattered, None),
            },
        }
    }

    /// Interval of a quantity that exists in some of the runs only: not before the earliest.
    fn of_some(
        &self,
        happened: &[(f64, f64)],
        nothing: UncertaintyInterval,
    ) -> UncertaintyInterval {
        let values = || happened.iter().map(|place| place.1);
        let least = values().fold(f64::INFINITY, f64::min);
        let most = values().fold(f64::NEG_INFINITY, f64::max);
        UncertaintyInterval {
            low: Some(self.not_below(least - (most - least))),
            basis: Basis::SometimesHappened,
            ..nothing
        }
    }

    fn about(
        &self,
        happened: &[(f64, f64)],
        basis: Basis,
        order: Option<f64>,
    ) -> UncertaintyInterval {
        let (size, value) = happened[0];
        let weights = self.kind.weights();
        let (trend, scatter) = match happened {
            [_, (_, other)] => (0.0, SAFETY_OF_ONE * (value - other).abs()),
            _ => {
                let line = LinearFit::through(happened);
                let scatter = weights.scatter * line.scatter;
                (-weights.trend * line.slope * size, scatter)
            }
        };
        let expected = match basis {
            Basis::Same => 0.0,
            _ => self.expected(&weights, size, value),
        };
        let around = scatter.hypot(expected).hypot(self.of_softness());
        let [down, up] = [-trend, trend].map(|way| {
            let beyond = if way < 0.0 { weights.against } else { 1.0 };
            way.max(0.0) + beyond * around + self.floor(size, value)
        });
        UncertaintyInterval {
            value: Some(value),
            low: Some(self.not_below(value - down)),
            high: Some(value + up),
            order,
            basis,
        }
    }

    /// The error that scenes in general have with such cells, whatever these values show.
    fn expected(&self, weights: &IntervalWeights, size: f64, value: f64) -> f64 {
        let ErrorScale { across_m, way_m } = self.scale;
        let scale = if self.kind.is_a_place() {
            way_m
        } else {
            value.abs()
        };
        let across = weights.across * size / across_m;
        // A path of less than a cell is as uncertain as one of a cell.
        let way = weights.way * size / way_m.max(size);
        scale * across.hypot(way)
    }

    /// Change of the value with half the sound speed (equation 73).
    fn of_softness(&self) -> f64 {
        match self.reduced_stiffness {
            Some([Some(reduced_stiffness), Some(usual)]) => (reduced_stiffness - usual).abs(),
            _ => 0.0,
        }
    }

    fn floor(&self, size: f64, value: f64) -> f64 {
        if self.kind.is_a_length() {
            FLOOR_CELLS * size
        } else {
            FLOOR_SHARE * value.abs()
        }
    }

    fn not_below(&self, low: f64) -> f64 {
        if self.kind.is_a_place() {
            low
        } else {
            low.max(0.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(values: &[Option<f64>]) -> GridSeries {
        let sizes = [0.01, 0.015, 0.02, 0.025];
        GridSeries {
            kind: QuantityKind::Speed,
            scale: ErrorScale {
                across_m: 0.03,
                way_m: 0.2,
            },
            places: sizes.into_iter().zip(values.iter().copied()).collect(),
            reduced_stiffness: None,
        }
    }

    fn happened(values: &[f64]) -> GridSeries {
        series(&values.iter().copied().map(Some).collect::<Vec<_>>())
    }

    fn half_width(interval: &UncertaintyInterval) -> f64 {
        0.5 * (interval.high.unwrap() - interval.low.unwrap())
    }

    #[test]
    fn values_on_a_line_get_an_interval_that_follows_them() {
        let series = happened(&[1.1, 1.15, 1.2, 1.25]);
        let interval = series.interval();
        assert_eq!(interval.basis, Basis::Converging);
        assert!((interval.order.unwrap() - 1.0).abs() < 0.05, "{interval:?}");
        let weights = QuantityKind::Speed.weights();
        // Without scatter the remainder is the error of scenes in general.
        let around = 1.1 * (weights.across / 3.0).hypot(weights.way / 20.0);
        let floor = 1.1 * FLOOR_SHARE;
        // The limit is 1.0.
        let low = 1.1 - 0.1 * weights.trend - around - floor;
        let high = 1.1 + weights.against * around + floor;
        let ends = [interval.low.unwrap() - low, interval.high.unwrap() - high];
        assert!(ends.iter().all(|off| off.abs() < 1e-12), "{interval:?}");
        assert!(interval.low.unwrap() < 1.0, "{interval:?}");
    }

    #[test]
    fn finer_cells_and_longer_ways_make_narrower_intervals() {
        let width = |cells: f64, way_m: f64, kind: QuantityKind| {
            let values = [1.0 + cells, 1.0 + 1.75 * cells, 1.0 + 2.5 * cells];
            let places = [0.01, 0.0175, 0.025].map(|size| cells * size);
            let places = places.into_iter().zip(values.map(Some)).collect();
            let scale = ErrorScale {
                across_m: 0.03,
                way_m,
            };
            half_width(
                &GridSeries {
                    kind,
                    scale,
                    places,
                    reduced_stiffness: None,
                }
                .interval(),
            )
        };
        for kind in [
            QuantityKind::Moment,
            QuantityKind::Stop,
            QuantityKind::Speed,
            QuantityKind::Length,
            QuantityKind::Reach,
        ] {
            assert!(
                width(0.5, 0.2, kind) < 0.8 * width(1.0, 0.2, kind),
                "{kind:?}"
            );
        }
        assert!(width(1.0, 0.4, QuantityKind::Speed) < width(1.0, 0.2, QuantityKind::Speed));
        assert!(width(1.0, 0.4, QuantityKind::Across) > width(1.0, 0.2, QuantityKind::Across));
        // A path of less than a cell is no less certain than a cell, and no path has a finite
        // interval.
        assert_eq!(
            width(1.0, 0.0, QuantityKind::Speed),
            width(1.0, 0.01, QuantityKind::Speed)
        );
    }

    #[test]
    fn values_that_turn_get_a_wide_band_and_no_order() {
        let interval = happened(&[1.1, 1.2, 1.1, 1.2]).interval();
        assert_eq!((interval.basis, interval.order), (Basis::Scattered, None));
        assert!(half_width(&interval) > 0.1, "{interval:?}");
    }

    #[test]
    fn values_that_are_all_the_same_keep_the_smallest_interval() {
        let interval = happened(&[1.0; 4]).interval();
        assert_eq!(interval.basis, Basis::Same);
        assert!(
            (half_width(&interval) - FLOOR_SHARE).abs() < 1e-12,
            "{interval:?}"
        );
        let mut of_length = happened(&[1.0; 4]);
        of_length.kind = QuantityKind::Along;
        let interval = of_length.interval();
        assert!(
            (half_width(&interval) - 0.01 * FLOOR_CELLS).abs() < 1e-12,
            "{interval:?}"
        );
    }

    #[test]
    fn one_refinement_run_makes_a_wide_interval_and_none_makes_none() {
        let one = happened(&[1.0, 1.1]).interval();
        assert_eq!(one.basis, Basis::OneRefinementRun);
        assert!(half_width(&one) > 0.3, "{one:?}");
        let none = happened(&[1.0]).interval();
        assert_eq!(
            (none.basis, none.low, none.high),
            (Basis::Nothing, None, None)
        );
    }

    #[test]
    fn what_happened_in_some_runs_only_has_no_upper_end() {
        let answer_moves_on = series(&[None, Some(1.0), Some(1.2)]).interval();
        assert_eq!(answer_moves_on.basis, Basis::SometimesHappened);
        assert_eq!((answer_moves_on.value, answer_moves_on.high), (None, None));
        assert!(answer_moves_on.low.unwrap() < 1.0);
        let coarser_moves_on = series(&[Some(1.0), None, Some(1.2)]).interval();
        assert_eq!(coarser_moves_on.value, Some(1.0));
        assert_eq!(coarser_moves_on.high, None);
        let never = series(&[None; 3]).interval();
        assert_eq!((never.basis, never.low), (Basis::NeverHappened, None));
    }

    #[test]
    fn softness_widens_the_band_as_an_error_of_its_own() {
        let mut values = happened(&[1.1, 1.15, 1.2, 1.25]);
        let before = values.interval();
        let around = |interval: &UncertaintyInterval| {
            1.1 - 0.1 * values.kind.weights().trend - interval.low.unwrap()
        };
        let around_before = around(&before) - 1.1 * FLOOR_SHARE;
        let mut reduced_stiffness = values.clone();
        reduced_stiffness.reduced_stiffness = Some([Some(1.3), Some(1.2)]);
        let around_after = around(&reduced_stiffness.interval()) - 1.1 * FLOOR_SHARE;
        assert!((around_after - around_before.hypot(0.1)).abs() < 1e-12);
        values.reduced_stiffness = Some([None, Some(1.2)]);
        assert_eq!(values.interval(), before);
    }

    #[test]
    fn what_cannot_be_negative_has_no_negative_interval() {
        let mut values = happened(&[0.1, 0.4, 0.2, 0.6]);
        assert_eq!(values.interval().low, Some(0.0));
        values.kind = QuantityKind::Along;
        values.scale.way_m = 0.4;
        assert!(values.interval().low.unwrap() < 0.0);
    }
}
