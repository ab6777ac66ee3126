//! Uncertainty intervals of all quantities of an outcome, from the outcomes of its refinement
//! runs.

use super::series::{ErrorScale, GridSeries, QuantityKind};
use crate::record::{BodyErrorBars, BodyOutcome, FlowErrorBars, Outcome, UncertaintyInterval};
use crate::scenario::Quantity;

/// The outcomes from which an interval is made.
#[derive(Debug)]
pub(super) struct StudyOutcomes<'a> {
    /// The outcome whose quantities get intervals.
    pub(super) answer: &'a Outcome,
    /// Outcomes with larger cells, finer ones first.
    pub(super) coarser: Vec<&'a Outcome>,
    /// Outcome with a material of reduced stiffness, and the coarser outcome with the same cells.
    pub(super) reduced_stiffness: Option<[&'a Outcome; 2]>,
    /// Width of the thinnest body, or the thickness of the release without bodies [m].
    pub(super) across_m: f64,
}

impl StudyOutcomes<'_> {
    /// Uncertainty intervals of a body's quantities.
    pub(super) fn body(&self, index: usize) -> BodyErrorBars {
        let way_m = self.answer.bodies[index].displacement_m;
        let interval = |kind: QuantityKind, of: fn(&BodyOutcome) -> Option<f64>| {
            self.interval(kind, way_m, |outcome| of(&outcome.bodies[index]))
        };
        let place = |axis: usize| {
            let kind = [QuantityKind::Along, QuantityKind::Across, QuantityKind::Up][axis];
            self.interval(kind, way_m, |outcome| {
                Some(outcome.bodies[index].final_position_m[axis])
            })
        };
        BodyErrorBars {
            onset_time_s: interval(QuantityKind::Moment, |body| body.onset_time_s),
            peak_speed_m_s: interval(QuantityKind::Speed, |body| Some(body.peak_speed_m_s)),
            peak_speed_time_s: interval(QuantityKind::Moment, |body| body.peak_speed_time_s),
            stop_time_s: interval(QuantityKind::Stop, |body| body.stop_time_s),
            displacement_m: interval(QuantityKind::Length, |body| Some(body.displacement_m)),
            path_length_m: interval(QuantityKind::Length, |body| Some(body.path_length_m)),
            final_position_m: [0, 1, 2].map(place),
        }
    }

    /// Uncertainty intervals of the flow's quantities.
    pub(super) fn flow(&self) -> FlowErrorBars {
        let way_m = self.answer.flow.runout_m.map_or(0.0, f64::abs);
        let interval =
            |kind: QuantityKind, of: fn(&Outcome) -> Option<f64>| self.interval(kind, way_m, of);
        FlowErrorBars {
            front_m: interval(QuantityKind::Reach, |outcome| outcome.flow.front_m),
            runout_m: interval(QuantityKind::Reach, |outcome| outcome.flow.runout_m),
            outflow_mass_kg: interval(QuantityKind::Mass, |outcome| {
                Some(outcome.flow.outflow_mass_kg)
            }),
        }
    }

    fn interval(
        &self,
        kind: QuantityKind,
        way_m: f64,
        of: impl Fn(&Outcome) -> Option<f64>,
    ) -> UncertaintyInterval {
        let place = |outcome: &Outcome| (outcome.cost.cell_size_m, of(outcome));
        let mut places = vec![place(self.answer)];
        places.extend(self.coarser.iter().map(|outcome| place(outcome)));
        let reduced_stiffness = self.reduced_stiffness.map(|pair| pair.map(&of));
        GridSeries {
            kind,
            scale: ErrorScale {
                across_m: self.across_m,
                way_m,
            },
            places,
            reduced_stiffness,
        }
        .interval()
    }
}

/// The interval of a quantity in an outcome that has intervals.
pub(super) fn interval_of(
    outcome: &Outcome,
    quantity: Quantity,
    body: u32,
) -> Option<UncertaintyInterval> {
    if !quantity.is_of_a_body() {
        let bars = outcome.flow.error_bars.as_ref()?;
        return Some(match quantity {
            Quantity::Front => bars.front_m,
            _ => bars.runout_m,
        });
    }
    let bars = outcome.bodies.get(body as usize)?.error_bars.as_ref()?;
    Some(match quantity {
        Quantity::Onset => bars.onset_time_s,
        Quantity::PeakSpeed => bars.peak_speed_m_s,
        Quantity::PeakTime => bars.peak_speed_time_s,
        Quantity::Stop => bars.stop_time_s,
        Quantity::PathLength => bars.path_length_m,
        _ => bars.displacement_m,
    })
}

/// A quantity of an outcome; `None` if it did not happen.
pub(super) fn value_of(outcome: &Outcome, quantity: Quantity, body: u32) -> Option<f64> {
    let of_body = outcome.bodies.get(body as usize);
    match quantity {
        Quantity::Front => outcome.flow.front_m,
        Quantity::Runout => outcome.flow.runout_m,
        Quantity::Onset => of_body?.onset_time_s,
        Quantity::PeakSpeed => Some(of_body?.peak_speed_m_s),
        Quantity::PeakTime => of_body?.peak_speed_time_s,
        Quantity::Stop => of_body?.stop_time_s,
        Quantity::Displacement => Some(of_body?.displacement_m),
        Quantity::PathLength => Some(of_body?.path_length_m),
    }
}

/// Distance from the value to the farther end of an interval, over the value; `None` if an end
/// is open or the value is 0.
pub(super) fn relative(interval: &UncertaintyInterval) -> Option<f64> {
    let value = interval.value.filter(|value| *value != 0.0)?;
    let reach = (interval.high? - value).max(value - interval.low?);
    Some(reach / value.abs())
}
