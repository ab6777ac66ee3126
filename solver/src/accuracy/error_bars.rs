//! Uncertainty intervals of all quantities of an outcome, from the outcomes of its refinement
//! runs.

use super::series::{ErrorScale, GridSeries};
use crate::record::{
    BODY_QUANTITIES, BodyErrorBars, BodyQuantity, FLOW_QUANTITIES, FlowErrorBars, FlowQuantity,
    Outcome, QuantityKind, UncertaintyInterval,
};
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
        BodyErrorBars::of(|quantity| {
            let of = |outcome: &Outcome| (quantity.value)(&outcome.bodies[index]);
            self.interval(quantity.kind, way_m, of)
        })
    }

    /// Uncertainty intervals of the flow's quantities.
    pub(super) fn flow(&self) -> FlowErrorBars {
        let way_m = self.answer.flow.runout_m.map_or(0.0, f64::abs);
        FlowErrorBars::of(|quantity| {
            let of = |outcome: &Outcome| (quantity.value)(&outcome.flow);
            self.interval(quantity.kind, way_m, of)
        })
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
    if let Some(of_flow) = of_flow(quantity) {
        return Some(*(of_flow.interval)(outcome.flow.error_bars.as_ref()?));
    }
    let bars = outcome.bodies.get(body as usize)?.error_bars.as_ref()?;
    Some(*(of_body(quantity)?.interval)(bars))
}

/// A quantity of an outcome; `None` if it did not happen.
pub(super) fn value_of(outcome: &Outcome, quantity: Quantity, body: u32) -> Option<f64> {
    if let Some(of_flow) = of_flow(quantity) {
        return (of_flow.value)(&outcome.flow);
    }
    (of_body(quantity)?.value)(outcome.bodies.get(body as usize)?)
}

fn of_flow(quantity: Quantity) -> Option<&'static FlowQuantity> {
    FLOW_QUANTITIES
        .iter()
        .find(|one| one.name == quantity.key())
}

fn of_body(quantity: Quantity) -> Option<&'static BodyQuantity> {
    BODY_QUANTITIES
        .iter()
        .find(|one| one.name == quantity.key())
}

/// Distance from the value to the farther end of an interval, over the value; `None` if an end
/// is open or the value is 0.
pub(super) fn relative(interval: &UncertaintyInterval) -> Option<f64> {
    let value = interval.value.filter(|value| *value != 0.0)?;
    let reach = (interval.high? - value).max(value - interval.low?);
    Some(reach / value.abs())
}
