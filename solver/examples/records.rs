//! Samples of a run as they arise: the way of a boulder down a slope.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use scree_solver::{Record, Scenario, compute};
use serde_json::json;
use std::error::Error;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let scenario = Scenario::from_json(
        &json!({
            "channel": {"inclination_deg": 30, "incline_length_m": 2.0,
                        "runout_length_m": 2.0, "width_m": 1.0},
            "flow": null,
            "bodies": [{"shape": {"regular": {"solid": "icosahedron", "size_m": 0.2}},
                        "position": {"downstream_m": -1.5}, "friction": 0.5}],
            "duration_s": 1.0, "sample_interval_s": 0.2
        })
        .to_string(),
    )?;
    let mut samples = 0;
    compute(&scenario, 1, |record| {
        if let Record::Sample(sample) = record {
            println!(
                "{:.1} s: {:?} m",
                sample.time_s, sample.bodies[0].position_m
            );
            samples += 1;
        }
    })?;
    assert!(samples >= 6, "one every 0.2 s");
    Ok(())
}
