//! Quantities of an outcome that get uncertainty intervals. A further one is an entry here, a
//! field of the outcome and of its intervals, and its computation in `outcome.rs`.

use super::{BodyErrorBars, BodyOutcome, FlowErrorBars, FlowOutcome, UncertaintyInterval};

/// Kind of a quantity, which decides how its interval is made, and its natural bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum QuantityKind {
    /// Time at which something begins or is largest: not negative.
    Moment,
    /// Time at which something comes to rest: not negative.
    Stop,
    /// A speed: not negative.
    Speed,
    /// A length of a body's path: not negative.
    Length,
    /// A coordinate along the channel.
    Along,
    /// A coordinate across it.
    Across,
    /// A height.
    Up,
    /// Position of a flow's front, or its run-out.
    Reach,
    /// A mass: not negative.
    Mass,
}

/// A quantity of a body or of the flow.
#[derive(Debug, Clone, Copy)]
pub struct OutcomeQuantity<Of, Bars> {
    /// Key in the outcome, and the component of a vector.
    pub name: &'static str,
    /// Heading of a table, with the unit.
    pub heading: &'static str,
    /// Kind.
    pub kind: QuantityKind,
    /// Value; `None` if the event did not happen.
    pub value: fn(&Of) -> Option<f64>,
    /// Interval.
    pub interval: fn(&Bars) -> &UncertaintyInterval,
}

/// A quantity of a body.
pub type BodyQuantity = OutcomeQuantity<BodyOutcome, BodyErrorBars>;
/// A quantity of the flow.
pub type FlowQuantity = OutcomeQuantity<FlowOutcome, FlowErrorBars>;

/// All quantities of a body.
pub const BODY_QUANTITIES: [BodyQuantity; 9] = [
    OutcomeQuantity {
        name: "onset_time_s",
        heading: "onset [s]",
        kind: QuantityKind::Moment,
        value: |body| body.onset_time_s,
        interval: |bars| &bars.onset_time_s,
    },
    OutcomeQuantity {
        name: "peak_speed_m_s",
        heading: "peak [m/s]",
        kind: QuantityKind::Speed,
        value: |body| Some(body.peak_speed_m_s),
        interval: |bars| &bars.peak_speed_m_s,
    },
    OutcomeQuantity {
        name: "peak_speed_time_s",
        heading: "peak at [s]",
        kind: QuantityKind::Moment,
        value: |body| body.peak_speed_time_s,
        interval: |bars| &bars.peak_speed_time_s,
    },
    OutcomeQuantity {
        name: "stop_time_s",
        heading: "rest from [s]",
        kind: QuantityKind::Stop,
        value: |body| body.stop_time_s,
        interval: |bars| &bars.stop_time_s,
    },
    OutcomeQuantity {
        name: "displacement_m",
        heading: "displaced [m]",
        kind: QuantityKind::Length,
        value: |body| Some(body.displacement_m),
        interval: |bars| &bars.displacement_m,
    },
    OutcomeQuantity {
        name: "path_length_m",
        heading: "path [m]",
        kind: QuantityKind::Length,
        value: |body| Some(body.path_length_m),
        interval: |bars| &bars.path_length_m,
    },
    OutcomeQuantity {
        name: "final_position_m, x",
        heading: "final x [m]",
        kind: QuantityKind::Along,
        value: |body| Some(body.final_position_m[0]),
        interval: |bars| &bars.final_position_m[0],
    },
    OutcomeQuantity {
        name: "final_position_m, y",
        heading: "final y [m]",
        kind: QuantityKind::Across,
        value: |body| Some(body.final_position_m[1]),
        interval: |bars| &bars.final_position_m[1],
    },
    OutcomeQuantity {
        name: "final_position_m, z",
        heading: "final z [m]",
        kind: QuantityKind::Up,
        value: |body| Some(body.final_position_m[2]),
        interval: |bars| &bars.final_position_m[2],
    },
];

/// All quantities of the flow.
pub const FLOW_QUANTITIES: [FlowQuantity; 3] = [
    OutcomeQuantity {
        name: "front_m",
        heading: "front [m]",
        kind: QuantityKind::Reach,
        value: |flow| flow.front_m,
        interval: |bars| &bars.front_m,
    },
    OutcomeQuantity {
        name: "runout_m",
        heading: "run-out [m]",
        kind: QuantityKind::Reach,
        value: |flow| flow.runout_m,
        interval: |bars| &bars.runout_m,
    },
    OutcomeQuantity {
        name: "outflow_mass_kg",
        heading: "outflow [kg]",
        kind: QuantityKind::Mass,
        value: |flow| Some(flow.outflow_mass_kg),
        interval: |bars| &bars.outflow_mass_kg,
    },
];

impl BodyErrorBars {
    /// The interval of each quantity.
    pub fn of(interval: impl FnMut(&BodyQuantity) -> UncertaintyInterval) -> Self {
        let [onset, peak, peak_time, stop, displacement, path, x, y, z] =
            BODY_QUANTITIES.each_ref().map(interval);
        Self {
            onset_time_s: onset,
            peak_speed_m_s: peak,
            peak_speed_time_s: peak_time,
            stop_time_s: stop,
            displacement_m: displacement,
            path_length_m: path,
            final_position_m: [x, y, z],
        }
    }
}

impl FlowErrorBars {
    /// The interval of each quantity.
    pub fn of(interval: impl FnMut(&FlowQuantity) -> UncertaintyInterval) -> Self {
        let [front_m, runout_m, outflow_mass_kg] = FLOW_QUANTITIES.each_ref().map(interval);
        Self {
            front_m,
            runout_m,
            outflow_mass_kg,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Basis;

    fn numbered(number: &mut f64) -> UncertaintyInterval {
        *number += 1.0;
        UncertaintyInterval {
            value: Some(*number),
            low: None,
            high: None,
            order: None,
            basis: Basis::Nothing,
        }
    }

    #[test]
    fn every_quantity_has_the_interval_made_for_it() {
        let mut number = 0.0;
        let bars = BodyErrorBars::of(|_| numbered(&mut number));
        let json = serde_json::to_value(&bars).unwrap();
        for (place, quantity) in BODY_QUANTITIES.iter().enumerate() {
            assert_eq!((quantity.interval)(&bars).value, Some(place as f64 + 1.0));
            let (key, axis) = match quantity.name.split_once(", ") {
                None => (quantity.name, None),
                Some((key, axis)) => (key, "xyz".find(axis)),
            };
            let interval = axis.map_or(&json[key], |axis| &json[key][axis]);
            assert_eq!(interval["value"], place as f64 + 1.0, "{}", quantity.name);
        }
        let mut number = 0.0;
        let bars = FlowErrorBars::of(|_| numbered(&mut number));
        let json = serde_json::to_value(&bars).unwrap();
        for (place, quantity) in FLOW_QUANTITIES.iter().enumerate() {
            assert_eq!((quantity.interval)(&bars).value, Some(place as f64 + 1.0));
            assert_eq!(json[quantity.name]["value"], place as f64 + 1.0);
        }
    }
}
