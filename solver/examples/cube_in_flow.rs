//! A cube at the foot of an incline, struck and carried by a flow: when, how fast, how far.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use scree_solver::{Scenario, compute};
use serde_json::json;
use std::error::Error;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let scenario = Scenario::from_json(
        &json!({
            "channel": {"inclination_deg": 50, "incline_length_m": 1.0,
                        "runout_length_m": 1.0, "width_m": 0.12},
            "flow": {"volume_m3": 0.004, "release": {"height_m": 0.15}},
            "bodies": [{"shape": {"cube": {"side_m": 0.04}}, "position": {"downstream_m": 0.04}}],
            "numerics": {"cell_size_m": 0.03}, "duration_s": 0.5
        })
        .to_string(),
    )?;
    let outcome = compute(&scenario, 1, |_| {})?;
    let cube = &outcome.bodies[0];
    println!("struck at {:.3} s", cube.onset_time_s.unwrap_or(f64::NAN));
    println!("fastest at {:.2} m/s", cube.peak_speed_m_s);
    println!("carried {:.3} m so far", cube.displacement_m);
    assert!(cube.displacement_m > 0.01, "the flow carries the cube");
    Ok(())
}
