//! A simulation step by step, stopped half-way, saved, and gone on with.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use scree_solver::{Scenario, Simulation};
use std::error::Error;
use std::ops::ControlFlow;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let text = include_str!("../../configs/scenarios/minimal.json");
    let scenario = Scenario::from_json(text)?;
    let mut simulation = Simulation::new(&scenario, 1)?;
    simulation.run(0.05, |_, _| ControlFlow::Continue(()))?;
    let state = simulation.save()?;
    println!("{} bytes at {:.3} s", state.len(), simulation.time_s());
    let mut again = Simulation::restore(&scenario, 1, &state)?;
    for simulation in [&mut simulation, &mut again] {
        simulation.run(0.1, |_, _| ControlFlow::Continue(()))?;
    }
    let place = |simulation: &Simulation| simulation.bodies()[0].state.position;
    assert_eq!(place(&simulation), place(&again), "to the last bit");
    Ok(())
}
