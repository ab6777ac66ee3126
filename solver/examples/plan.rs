//! A plan: what a run will compute and cost, before it is made.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use scree_solver::{Plan, Scenario};
use std::error::Error;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let text = include_str!("../../configs/scenarios/source_paper.json");
    let scenario = Scenario::from_json(text)?;
    let plan = Plan::new(&scenario)?;
    println!(
        "{} points, {} point-steps",
        plan.cost.points, plan.cost.point_steps
    );
    println!("{} MB", plan.cost.memory_bytes / 1_000_000);
    assert!(plan.cost.points > 10_000);
    Ok(())
}
