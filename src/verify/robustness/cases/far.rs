//! Scenes a hundred metres from the origin in single precision.

use super::strike;
use crate::verify::Effort;
use crate::verify::robustness::trial::{Compared, Ended, Special, centre};
use crate::verify::robustness::{Family, Member};
use crate::verify::run::scenario_of;
use scree_solver::Simulation;
use serde_json::{Value, json};

pub(super) const FAMILY: Family = Family {
    name: "far away",
    reason: "32 bits resolve 8 µm at 100 m, a two-thousandth of a cell",
    members,
};

/// Distance [m].
const FAR: f64 = 100.0;
/// A collapse moves its centre of mass by centimetres; the difference may be a
/// thousandth of that, since rounding alone changes the paths of points.
const APART: f64 = 1e-3;

fn members(_: Effort) -> Vec<Member> {
    vec![Member::Other("collapse 100 m upstream", compare)]
}

/// A column that collapses on the flat, this far upstream.
fn collapse(toe_distance_m: f64) -> Value {
    let mut scenario = strike(0.0);
    scenario["bodies"] = json!([]);
    scenario["channel"]["incline_length_m"] = json!(toe_distance_m + 0.5);
    scenario["flow"]["release"]["toe_distance_m"] = json!(toe_distance_m);
    scenario
}

fn compare() -> Special {
    let moved = |toe: f64| -> Result<f64, String> {
        let scenario = scenario_of(&collapse(toe)).map_err(|error| error.to_string())?;
        let simulation = Simulation::new(&scenario, 1);
        let mut simulation = simulation.map_err(|error| error.to_string())?;
        let start = centre(&simulation);
        let went = simulation.run(f64::INFINITY, |_, _| std::ops::ControlFlow::Continue(()));
        went.map_err(|error| error.to_string())?;
        Ok((centre(&simulation) - start).norm())
    };
    match (moved(0.2), moved(FAR)) {
        (Ok(near), Ok(far)) => Special {
            ended: Ended::Finished,
            compared: vec![
                Compared {
                    what: "way of the mass centre there over here, less 1".to_owned(),
                    found: far / near - 1.0,
                    bound: Some(APART),
                },
                Compared {
                    what: "way of the mass centre [m]".to_owned(),
                    found: near,
                    bound: None,
                },
            ],
        },
        (near, far) => Special {
            ended: Ended::Refused(near.and(far).err().unwrap_or_default()),
            compared: Vec::new(),
        },
    }
}
