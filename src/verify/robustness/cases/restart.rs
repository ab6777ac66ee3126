//! A run resumed from each of its saved states.

use super::places;
use crate::verify::Effort;
use crate::verify::robustness::trial::{Compared, Ended, Special};
use crate::verify::robustness::{Family, Member};
use crate::verify::run::scenario_of;
use scree_solver::Simulation;
use scree_solver::scenario::Scenario;
use std::ops::ControlFlow;

pub(super) const FAMILY: Family = Family {
    name: "restart",
    reason: "whatever a step remembers besides the state shows as another bit",
    members,
};

/// Time between two saved states [s].
const BETWEEN: f64 = 0.05;

fn members(_: Effort) -> Vec<Member> {
    vec![Member::Other(
        "ten cubes in the flow, from every state",
        compare,
    )]
}

fn compare() -> Special {
    let compared = differing();
    match compared {
        Ok((states, differing)) => Special {
            ended: Ended::Finished,
            compared: vec![
                told("states taken up again", states, None),
                told("of them that end with other bits", differing, Some(0.0)),
            ],
        },
        Err(words) => Special {
            ended: Ended::Refused(words),
            compared: Vec::new(),
        },
    }
}

fn told(what: &str, found: f64, bound: Option<f64>) -> Compared {
    Compared {
        what: what.to_owned(),
        found,
        bound,
    }
}

/// Number of states, and of those whose runs end differently from the uninterrupted run.
fn differing() -> Result<(f64, f64), String> {
    let in_words = |error: &dyn std::fmt::Display| error.to_string();
    let scenario = scenario_of(&places::ten_cubes()).map_err(|error| in_words(&error))?;
    let mut whole = Simulation::new(&scenario, 1).map_err(|error| in_words(&error))?;
    let mut states = Vec::new();
    let mut until = 0.0;
    while until < scenario.duration_s {
        states.push(whole.save().map_err(|error| in_words(&error))?);
        until += BETWEEN;
        go(&mut whole, until).map_err(|error| in_words(&error))?;
    }
    let end = whole.save().map_err(|error| in_words(&error))?;
    let mut differing = 0.0;
    for state in &states {
        if end != taken_up(&scenario, state)? {
            differing += 1.0;
        }
    }
    Ok((states.len() as f64, differing))
}

fn taken_up(scenario: &Scenario, state: &[u8]) -> Result<Vec<u8>, String> {
    let again = Simulation::restore(scenario, 2, state);
    let mut again = again.map_err(|error| error.to_string())?;
    go(&mut again, scenario.duration_s).map_err(|error| error.to_string())?;
    again.save().map_err(|error| error.to_string())
}

fn go(simulation: &mut Simulation, until_s: f64) -> Result<(), scree_solver::StepError> {
    simulation.run(until_s, |_, _| ControlFlow::Continue(()))?;
    Ok(())
}
