//! Energy of a body in the outcome.

use super::BodyEnergy;
use crate::body_energy::{potential, stored};
use crate::simulation::Simulation;

/// Balance of a body's energy so far; none for a fixed or prescribed body.
pub(super) fn body_energy(simulation: &Simulation, place: usize) -> Option<BodyEnergy> {
    let (bodies, gravity) = (simulation.bodies(), simulation.gravity());
    let body = bodies.get(place).filter(|body| body.is_free())?;
    let balance = simulation.body_energy(place);
    Some(BodyEnergy {
        start_j: balance.start,
        kinetic_j: body.kinetic_energy(),
        potential_j: potential(body, &gravity),
        stored_j: stored(place, bodies, simulation.contact_pairs()),
        flow_work_j: balance.flow_work,
        body_work_j: balance.body_work,
        dissipated_j: balance.dissipated,
        made_j: balance.made,
        made_share: balance.rise() / balance.scale(body, &gravity),
    })
}
