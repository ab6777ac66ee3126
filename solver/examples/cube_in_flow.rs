//! A cube at the foot of an incline, struck and carried by a flow: when, how fast, how far.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use scree_solver::scenario::BodyBuilder;
use scree_solver::{Scenario, compute};
use std::error::Error;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let scenario = Scenario::builder(50.0, 1.0, 1.0)
        .width(0.12)
        .flow(0.004)
        .release(0.15, 0.05)
        .body(BodyBuilder::cube(0.04).at(0.04, 0.0))
        .cell_size(0.03)
        .duration(0.5)
        .build()?;
    let outcome = compute(&scenario, 1, |_| {})?;
    let cube = &outcome.bodies[0];
    println!("struck at {:.3} s", cube.onset_time_s.unwrap_or(f64::NAN));
    println!("fastest at {:.2} m/s", cube.peak_speed_m_s);
    println!("carried {:.3} m so far", cube.displacement_m);
    assert!(cube.displacement_m > 0.01, "the flow carries the cube");
    Ok(())
}
