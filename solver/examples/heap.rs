//! Three blocks dropped on each other: bodies alone, without a flow.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use scree_solver::scenario::BodyBuilder;
use scree_solver::{Scenario, compute};
use std::error::Error;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let block = |elevation_m: f64, lateral_m: f64| {
        BodyBuilder::cube(0.04)
            .at(0.2, lateral_m)
            .elevation(elevation_m)
            .set("/friction", 0.5)
            .set("/restitution", 0.2)
    };
    let scenario = Scenario::builder(0.0, 0.5, 0.5)
        .width(0.3)
        .body(block(0.02, 0.0))
        .body(block(0.08, 0.005))
        .body(block(0.15, -0.005))
        .duration(1.0)
        .build()?;
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
