//! Parts of a scene that could be left out, and the choices made.

use crate::contact::island;
use crate::scenario::{Ending, Scenario};
use crate::simulation::PreparedScene;
use serde::{Deserialize, Serialize};

/// Exact except for the order in which sums are rounded.
const ROUNDING: &str = "exact but for rounding";

/// A reduction of the computation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Choice {
    /// Reduction that was considered.
    pub what: String,
    /// True if the reduction is made.
    pub taken: bool,
    /// Reason for or against the reduction.
    pub why: String,
    /// Error caused by the reduction.
    pub error: String,
    /// Field of the scenario that overrides the decision, as a JSON pointer; null if there is
    /// none.
    pub decided_by: Option<String>,
}

/// All choices for a scenario.
pub(super) fn of(prepared: &PreparedScene) -> Vec<Choice> {
    let scenario = &prepared.scenario;
    vec![
        mirror(prepared),
        slab(prepared),
        no_bodies(prepared),
        asleep(prepared),
        stiffness(prepared),
        blocks(prepared),
        ending(scenario),
    ]
}

fn choice(
    what: &str,
    error: &str,
    decided_by: Option<&str>,
    found: Result<String, String>,
) -> Choice {
    Choice {
        what: what.to_owned(),
        taken: found.is_ok(),
        why: found.unwrap_or_else(|why| why),
        error: error.to_owned(),
        decided_by: decided_by.map(|key| format!("/numerics/{key}")),
    }
}

fn mirror(prepared: &PreparedScene) -> Choice {
    let found = prepared.reductions.mirror.clone();
    let why = "flow and bodies are symmetric about the centre plane";
    choice(
        "half of the flow is computed, the other half is its mirror image",
        ROUNDING,
        Some("symmetry"),
        found.map(|()| why.to_owned()),
    )
}

fn slab(prepared: &PreparedScene) -> Choice {
    let found = prepared.reductions.slab.clone();
    let why = "the side walls are smooth, and nothing varies across until the flow nears a body";
    choice(
        "the flow begins as a slab of one cell",
        ROUNDING,
        Some("approach"),
        found.map(|()| why.to_owned()),
    )
}

fn no_bodies(prepared: &PreparedScene) -> Choice {
    let found = match prepared.bodies.len() {
        0 => Ok("there are no bodies".to_owned()),
        1 => Err("there is a body".to_owned()),
        more => Err(format!("there are {more} bodies")),
    };
    choice("no contacts are looked for", "exact", None, found)
}

fn asleep(prepared: &PreparedScene) -> Choice {
    let mut bodies = prepared.bodies.clone();
    island::hold(&mut bodies, &prepared.given.gravity);
    let held = bodies.iter().filter(|body| body.is_held()).count();
    let found = match held {
        0 => Err("no free body is held by the walls alone".to_owned()),
        1 => Ok("1 body is held by the walls".to_owned()),
        more => Ok(format!("{more} bodies are held by the walls")),
    };
    choice(
        "bodies that stand wait without steps until something touches them",
        "a body stands within 1e-6 of its weight; exact but for that",
        None,
        found,
    )
}

fn stiffness(prepared: &PreparedScene) -> Choice {
    let scenario = &prepared.scenario;
    let given = scenario.numerics.sound_speed_m_s.is_some();
    let modulus = scenario
        .flow
        .as_ref()
        .and_then(|flow| flow.material.youngs_modulus_pa);
    let found = match &prepared.given.flow {
        None => Err("there is no flow".to_owned()),
        Some(flow) if given || modulus.is_some() => Err(format!(
            "the stiffness is given: where the flow or a body presses hardest, density \
             varies by about {:.2} %",
            100.0 * flow.density_change()
        )),
        Some(flow) => Ok(format!(
            "sound at {:.2} m/s: where the flow or a body presses hardest, density varies \
             by about {:.2} %",
            flow.limits.sound_speed,
            100.0 * flow.density_change()
        )),
    };
    choice(
        "grains are softer than they are",
        "density varies by about 1/100 (equation 32)",
        Some("sound_speed_m_s"),
        found,
    )
}

fn blocks(prepared: &PreparedScene) -> Choice {
    let found = match prepared.division {
        Some(_) => Ok("a node without points near it does nothing"),
        None => Err("there is no flow: there are neither points nor nodes"),
    };
    choice(
        "nodes are kept only where points are",
        "exact",
        None,
        found.map(str::to_owned).map_err(str::to_owned),
    )
}

fn ending(scenario: &Scenario) -> Choice {
    let found = match scenario.numerics.ending {
        Ending::Auto => Ok("what it changes is bounded before it is done".to_owned()),
        Ending::Full => Err("numerics.ending is \"full\"".to_owned()),
    };
    choice(
        "the run ends once nothing can move a body or the front any more",
        "bounds of body, front and outflow are in the outcome (section 12)",
        Some("ending"),
        found,
    )
}
