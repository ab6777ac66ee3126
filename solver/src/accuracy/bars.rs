//! Bands of everything in an outcome, from the outcomes of its companions.

use super::series::{Kind, Scale, Series};
use crate::record::{Band, BodyBars, BodyOutcome, FlowBars, Outcome};
use crate::scenario::Quantity;

/// The outcomes a band is made of.
#[derive(Debug)]
pub(super) struct Runs<'a> {
    /// What the bands are about.
    pub(super) answer: &'a Outcome,
    /// With larger cells, finer ones first.
    pub(super) coarser: Vec<&'a Outcome>,
    /// With a softer material, and the one among the coarser of the same cells.
    pub(super) softer: Option<[&'a Outcome; 2]>,
    /// Width of the thinnest body, or the thickness of the release without bodies [m].
    pub(super) across_m: f64,
}

impl Runs<'_> {
    /// Bands of a body's quantities.
    pub(super) fn body(&self, index: usize) -> BodyBars {
        let way_m = self.answer.bodies[index].displacement_m;
        let band = |kind: Kind, of: fn(&BodyOutcome) -> Option<f64>| {
            self.band(kind, way_m, |outcome| of(&outcome.bodies[index]))
        };
        let place = |axis: usize| {
            let kind = [Kind::Along, Kind::Across, Kind::Up][axis];
            self.band(kind, way_m, |outcome| {
                Some(outcome.bodies[index].final_position_m[axis])
            })
        };
        BodyBars {
            onset_time_s: band(Kind::Moment, |body| body.onset_time_s),
            peak_speed_m_s: band(Kind::Speed, |body| Some(body.peak_speed_m_s)),
            peak_speed_time_s: band(Kind::Moment, |body| body.peak_speed_time_s),
            stop_time_s: band(Kind::Stop, |body| body.stop_time_s),
            displacement_m: band(Kind::Length, |body| Some(body.displacement_m)),
            path_length_m: band(Kind::Length, |body| Some(body.path_length_m)),
            final_position_m: [0, 1, 2].map(place),
        }
    }

    /// Bands of the flow's quantities.
    pub(super) fn flow(&self) -> FlowBars {
        let way_m = self.answer.flow.runout_m.map_or(0.0, f64::abs);
        let band = |kind: Kind, of: fn(&Outcome) -> Option<f64>| self.band(kind, way_m, of);
        FlowBars {
            front_m: band(Kind::Reach, |outcome| outcome.flow.front_m),
            runout_m: band(Kind::Reach, |outcome| outcome.flow.runout_m),
            outflow_mass_kg: band(Kind::Mass, |outcome| Some(outcome.flow.outflow_mass_kg)),
        }
    }

    fn band(&self, kind: Kind, way_m: f64, of: impl Fn(&Outcome) -> Option<f64>) -> Band {
        let place = |outcome: &Outcome| (outcome.cost.cell_size_m, of(outcome));
        let mut places = vec![place(self.answer)];
        places.extend(self.coarser.iter().map(|outcome| place(outcome)));
        let softer = self.softer.map(|pair| pair.map(&of));
        Series {
            kind,
            scale: Scale {
                across_m: self.across_m,
                way_m,
            },
            places,
            softer,
        }
        .band()
    }
}

/// The band of a quantity in an outcome that has bands.
pub(super) fn band_of(outcome: &Outcome, quantity: Quantity, body: u32) -> Option<Band> {
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

/// How far a band reaches from its value, over the value; `None` if an end is open or
/// the value is 0.
pub(super) fn relative(band: &Band) -> Option<f64> {
    let value = band.value.filter(|value| *value != 0.0)?;
    let reach = (band.high? - value).max(value - band.low?);
    Some(reach / value.abs())
}
