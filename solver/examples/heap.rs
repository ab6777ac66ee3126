//! Three blocks dropped on each other: bodies alone, without a flow.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use scree_solver::{Scenario, compute};
use serde_json::json;
use std::error::Error;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let block = |elevation_m: f64, lateral_m: f64| {
        json!({"shape": {"cube": {"side_m": 0.04}}, "friction": 0.5, "restitution": 0.2,
               "position": {"downstream_m": 0.2, "lateral_m": lateral_m,
                            "elevation_m": elevation_m}})
    };
    let scenario = Scenario::from_json(
        &json!({
            "channel": {"inclination_deg": 0, "incline_length_m": 0.5,
                        "runout_length_m": 0.5, "width_m": 0.3},
            "flow": null,
            "bodies": [block(0.02, 0.0), block(0.08, 0.005), block(0.15, -0.005)],
            "duration_s": 1.0
        })
        .to_string(),
    )?;
    let outcome = compute(&scenario, 1, |_| {})?;
    for (place, body) in outcome.bodies.iter().enumerate() {
        let energy = body.energy.as_ref().ok_or("every body is free")?;
        println!(
            "body {place}: at {:?} m, made {:.0e}",
            body.final_position_m, energy.made_share
        );
        assert!(energy.made_share < 1e-3, "contacts make no energy");
    }
    Ok(())
}
