//! All violations of a scenario at once, each with its place, range and unit.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use scree_solver::{Scenario, ScenarioError};
use serde_json::json;
use std::error::Error;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let wrong = json!({
        "channel": {"inclination_deg": 95, "incline_length_m": 1.0,
                    "runout_length_m": 1.0, "width_m": -0.2},
        "flow": null, "bodies": [], "duration_s": 1.0
    });
    let Err(ScenarioError::Invalid(violations)) = Scenario::from_json(&wrong.to_string()) else {
        return Err("the scenario is wrong".into());
    };
    for violation in &violations {
        println!(
            "{}: {:?} is not {}",
            violation.pointer, violation.value, violation.allowed
        );
    }
    assert!(violations.len() >= 2);
    Ok(())
}
