//! Saved states.

use super::clock::Clock;
use super::flow::{SavedFlow, restore as restore_flow};
use super::setup::PreparedScene;
use super::{Simulation, start_threads};
use crate::body_energy::BodyEnergy;
use crate::contact::body_body::ContactPair;
use crate::diagnostics::{Audit, FlowMoments};
use crate::error::RestoreError;
use crate::rigid::BodyState;
use crate::scenario::Scenario;
use serde::{Deserialize, Serialize};

/// Parts of a saved state, in this order.
#[derive(Serialize, Deserialize)]
struct Saved {
    version: String,
    scenario: String,
    clock: Clock,
    flow: SavedFlow,
    moments: FlowMoments,
    bodies: Vec<BodyState>,
    contact_pairs: Vec<ContactPair>,
    audit: Audit,
    energies: Vec<BodyEnergy>,
}

pub(super) fn save(simulation: &Simulation) -> Vec<u8> {
    let state = &simulation.state;
    let bodies = state.bodies.iter().map(|body| body.state.clone());
    let saved = Saved {
        version: crate::VERSION.to_owned(),
        scenario: simulation.given.identity.clone(),
        clock: state.clock.clone(),
        flow: state.flow.saved(),
        moments: state.moments,
        bodies: bodies.collect(),
        contact_pairs: state.contact_pairs.clone(),
        audit: state.audit.clone(),
        energies: state.energies.clone(),
    };
    postcard::to_allocvec(&saved).expect("plain numbers always serialise")
}

pub(super) fn restore(
    scenario: &Scenario,
    threads: usize,
    bytes: &[u8],
) -> Result<Simulation, RestoreError> {
    let unreadable = |reason: String| RestoreError::Unreadable(reason);
    let saved: Saved =
        postcard::from_bytes(bytes).map_err(|error| unreadable(error.to_string()))?;
    if saved.version != crate::VERSION {
        return Err(unreadable(format!("it is of version {}", saved.version)));
    }
    if saved.scenario != scenario.to_json() {
        return Err(RestoreError::OtherScenario {
            what: "the scenario",
        });
    }
    let pool = start_threads(threads).map_err(|error| unreadable(error.to_string()))?;
    let prepared = PreparedScene::of(scenario).map_err(|error| unreadable(error.to_string()))?;
    let (given, bodies) = (prepared.given, prepared.bodies);
    if bodies.len() != saved.bodies.len() {
        return Err(RestoreError::OtherScenario {
            what: "the number of bodies",
        });
    }
    let flow = restore_flow(saved.flow, &given, prepared.reductions.shares);
    let mut simulation = Simulation::assemble(given, flow, bodies, pool);
    for (body, state) in simulation.state.bodies.iter_mut().zip(saved.bodies) {
        body.state = state;
    }
    simulation.state.contact_pairs = saved.contact_pairs;
    simulation.state.clock = saved.clock;
    simulation.state.audit = saved.audit;
    simulation.state.energies = saved.energies;
    simulation.state.moments = saved.moments;
    Ok(simulation)
}
