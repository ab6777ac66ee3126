//! Hints: legal values of a scenario that are probably not meant, or costly.

use super::cost::longest_substep;
use super::names::names;
use crate::scenario::Scenario;
use crate::simulation::PreparedScene;
use serde::{Deserialize, Serialize};

/// An inclination below this may have been meant in radians [°].
const MEANT_IN_RADIANS_DEG: f64 = 2.0;
/// Sub-steps because of a light body, over those of the flow, above which there is a hint.
const MANY_TIMES: f64 = 1.5;

/// Warning about a scenario: something that is allowed, but probably not intended or unexpectedly
/// costly.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Hint {
    /// Field that the warning is about, as a JSON pointer.
    pub field: String,
    /// One sentence for people.
    pub detail: String,
}

/// All hints for a scenario.
pub(super) fn of(prepared: &PreparedScene) -> Vec<Hint> {
    let scenario = &prepared.scenario;
    let hints = [
        inclination_in_radians(scenario),
        thin_bodies(prepared),
        unreached_bodies(prepared),
        light_bodies(prepared),
        cells_by_target(prepared),
    ];
    hints.into_iter().flatten().collect()
}

fn hint(field: &str, detail: String) -> Hint {
    Hint {
        field: field.to_owned(),
        detail,
    }
}

/// An inclination so small that it looks like radians.
fn inclination_in_radians(scenario: &Scenario) -> Option<Hint> {
    let given = scenario.channel()?.inclination_deg;
    (given > 0.0 && given < MEANT_IN_RADIANS_DEG).then(|| {
        let detail = format!(
            "an inclination of {given}° is next to none: in degrees? {given} rad are {:.1}°",
            given.to_degrees()
        );
        hint("/channel/inclination_deg", detail)
    })
}

/// Bodies thinner than a cell, which the flow hardly resolves.
fn thin_bodies(prepared: &PreparedScene) -> Option<Hint> {
    let scenario = &prepared.scenario;
    prepared.division.as_ref()?;
    let cell = prepared.given.lattice.spacing.x;
    let width = |body: usize| scenario.shape_of(body).least_width();
    let thin = bodies(scenario).filter(|body| width(*body) < cell);
    let thin: Vec<usize> = thin.collect();
    let thinnest = thin.iter().map(|body| width(*body)).reduce(f64::min)?;
    let detail = format!(
        "{} thinner than a cell ({thinnest:.4} m, cells of {cell:.4} m), too coarse for the flow \
         round such a body; four cells across would be {:.4} m",
        subject(&thin),
        0.25 * thinnest
    );
    Some(hint("/numerics/cell_size_m", detail))
}

/// Bodies at rest beyond the reach of the flow's energy: a flow that starts at its highest
/// place has lost all height to friction by then.
fn unreached_bodies(prepared: &PreparedScene) -> Option<Hint> {
    let scenario = &prepared.scenario;
    let release = scenario.release()?;
    let base = scenario.channel()?.base_friction;
    let friction = scenario.flow.as_ref()?.material.static_friction.min(base);
    let bed = &prepared.given.walls.bed;
    let top = bed.elevation(release.back_m, 0.0) + release.vertical_thickness_m;
    let reach = release.front_m + top / friction;
    let beyond = |body: &usize| {
        let given = &scenario.bodies[*body];
        let waits = given.motion.is_none() && given.velocity_m_s == [0.0; 3];
        let [x, _] = given.position.place.coordinates();
        let back = x - scenario.shape_of(*body).bounding_radius();
        waits && back > reach
    };
    let missed: Vec<usize> = bodies(scenario).filter(beyond).collect();
    let first = missed.first()?;
    let detail = format!(
        "the flow probably does not come as far as {}: from {top:.3} m above the floor, friction \
         {friction} stops it before x = {reach:.2} m",
        names(&missed)
    );
    let field = format!("/bodies/{first}/position/downstream_m");
    Some(hint(&field, detail))
}

/// Bodies so light that their contacts with the flow take short sub-steps (equation 26).
fn light_bodies(prepared: &PreparedScene) -> Option<Hint> {
    let scenario = &prepared.scenario;
    (prepared.division.as_ref()).filter(|division| division.points() > 0)?;
    let flow = prepared.given.flow.as_ref()?;
    let own = longest_substep(&flow.limits);
    let taken = |body: usize| own / flow.contact_substep(&prepared.bodies[body..=body]);
    let light: Vec<usize> = bodies(scenario)
        .filter(|body| taken(*body) > MANY_TIMES)
        .collect();
    let lightest = light.iter().copied();
    let lightest = lightest.max_by(|a, b| taken(*a).total_cmp(&taken(*b)))?;
    let duration = prepared.given.timing.duration;
    let detail = format!(
        "{} light against the flow: with a density of {} kg/m³, where the bulk has {}, body \
         {lightest} alone takes {:.0} sub-steps instead of {:.0} (equation 26)",
        subject(&light),
        scenario.bodies[lightest].density_kg_m3,
        flow.material.bulk_density,
        (taken(lightest) * duration / own).ceil(),
        (duration / own).ceil()
    );
    Some(hint(&format!("/bodies/{lightest}/density_kg_m3"), detail))
}

/// Cells of a plan that differ from those of the run.
fn cells_by_target(prepared: &PreparedScene) -> Option<Hint> {
    let scenario = &prepared.scenario;
    let (target, quantity) = scenario.accuracy.goal()?;
    let cell = prepared.given.lattice.spacing.x;
    let detail = format!(
        "the target of {target} for {} chooses the cells, by its first runs: this cost is that \
         of the cells a run without a target takes ({cell:.4} m)",
        quantity.key()
    );
    Some(hint("/accuracy/target", detail))
}

fn bodies(scenario: &Scenario) -> std::ops::Range<usize> {
    0..scenario.bodies.len()
}

fn subject(bodies: &[usize]) -> String {
    let is = if bodies.len() == 1 { "is" } else { "are" };
    format!("{} {is}", names(bodies))
}

#[cfg(test)]
mod tests;
