//! Studies on several levels, against a stand-in whose levels have a known error.

mod accuracy;
mod bounds;
mod places;

use crate::support::{unit_study, z};
use scree_studies::{Ensemble, Finished, Member, MemberId, MemberOutcome, Study};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Cells of the coarsest level [m].
const COARSEST_M: f64 = 0.03;

/// Study of four inputs over 0..1 on three levels, with questions.
fn study(members: [u64; 3], seed: u64, questions: &Value) -> Study {
    let design = json!({"sobol": {"members": members[0], "seed": seed}});
    let finer_levels = json!([{"cell_size_m": 0.02, "members": members[1]},
                              {"cell_size_m": 0.015, "members": members[2]}]);
    Study {
        scenario: json!({"numerics": {"cell_size_m": COARSEST_M}}),
        finer_levels: serde_json::from_value(finer_levels).unwrap(),
        ..unit_study(4, &design, questions)
    }
}

/// Stand-in for a run: exp(u₀) and an error of first order in the cell size, a part of it random; and
/// chaos, which no smooth function of the inputs tells, a part of it the same on all levels.
fn quantity(u: &[f64], cell_size_m: f64) -> f64 {
    let cells = cell_size_m / COARSEST_M;
    let chaos = 0.2 * chaos(u[3], 1e4) + 0.1 * cells * chaos(u[3], 1.7e4);
    u[0].exp() + 0.2 * cells * (1.0 + u[1]) + 0.1 * cells * z(u[2]) + chaos
}

/// Uniform over −√3..√3, of variance 1.
fn chaos(u: f64, factor: f64) -> f64 {
    12.0_f64.sqrt() * ((u * factor).fract() - 0.5)
}

/// Expectation of the stand-in with cells of a size, 0 in the limit.
fn expectation(cell_size_m: f64) -> f64 {
    std::f64::consts::E - 1.0 + 0.3 * cell_size_m / COARSEST_M
}

/// All runs of a study, each with an outcome that follows from its inputs and its cell size.
fn runs(ensemble: &Ensemble, outcome: impl Fn(&[f64], f64) -> MemberOutcome) -> Vec<Member> {
    let study = ensemble.study();
    let levels = 0..study.levels();
    let ids = levels.flat_map(|level| {
        let members = 0..study.members_on(level);
        members.map(move |index| MemberId { level, index })
    });
    ids.map(|id| {
        let scenario = ensemble.scenario_on(id).unwrap();
        let cell_size_m = scenario["numerics"]["cell_size_m"].as_f64().unwrap();
        let input = |place: usize| scenario[place.to_string()].as_f64().unwrap();
        let inputs: Vec<f64> = (0..study.inputs.len()).map(input).collect();
        Member {
            level: id.level,
            index: id.index,
            outcome: outcome(&inputs, cell_size_m),
        }
    })
    .collect()
}

/// Outcome with the quantity y, and the work of cells of a size.
fn finished(y: f64, cell_size_m: f64) -> MemberOutcome {
    let work = 1e6 * (COARSEST_M / cell_size_m).powi(4);
    let quantities = [("y".to_owned(), y), ("point_steps".to_owned(), work)];
    MemberOutcome::Finished(Finished {
        quantities: BTreeMap::from(quantities),
        bodies: Vec::new(),
    })
}
