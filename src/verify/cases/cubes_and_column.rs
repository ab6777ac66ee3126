//! Case 17: a column of sand collapses against six cubes stacked 3-2-1.
//!
//! Geometry and material are those of GeoTaichi's granular-impact scene
//! (`configs/scenarios/cubes_and_column.json`): a column of 0.1 × 0.1 × 0.2 m, 0.1 m
//! from cubes of 30 mm, over 0.4 s. The contact properties of the cubes and of the
//! floor are ours. There are no figures to compare with, so the case is qualitative.
//!
//! Conditions that must hold: until the sand arrives no cube moves sideways by more than
//! a hundredth of its sphero radius (the upper three sink until they are supported);
//! and momentum is conserved to 1e-6, as in case 14. Shown without a tolerance: the number of the
//! six
//! that are moved by a tenth of their side or more; the smallest and the largest displacement; and
//! the
//! deepest overlap of two bodies, or of a body and the floor.

use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run, scene_of};
use crate::verify::{Case, Effort, How};
use scree_solver::Simulation;
use scree_solver::math::Vec3;
use serde_json::{Value, json};
use std::ops::ControlFlow;

pub(super) const CASE: Case = Case {
    name: "cubes-and-column",
    number: "17",
    title: "a sand column strikes six cubes stacked 3-2-1",
    source: "GeoTaichi's granular-impact scene, code to code; qualitative",
    how: How::Runs(run),
};

const SCENE: &str = include_str!("../../../configs/scenarios/cubes_and_column.json");
/// Side and sphero radius of its cubes [m].
const SIDE: f64 = 0.03;
const RADIUS: f64 = 0.0015;
/// Cells per side of a cube.
const CELLS: [f64; 4] = [2.0, 3.0, 4.0, 6.0];

fn run(effort: Effort, findings: &mut Findings) {
    let sizes = |of: &'static str, size: f64| Error::Over { of, size };
    for &cells in effort.take(&CELLS, 2) {
        let resolution = Resolution::sized(format!("{cells} cells a side"), 1.0 / cells);
        let questions = [
            Question::new("moved sideways before the hit", "m", 0.0)
                .by(sizes("r", RADIUS))
                .within(0.01),
            Question::new("linear momentum residual", "", 0.0)
                .by(Error::Absolute)
                .within(1e-6),
            Question::new("cubes driven on by a tenth of a side", "", 6.0),
            Question::new("least way downstream", "m", 0.0).by(sizes("side", SIDE)),
            Question::new("largest way downstream", "m", 0.0).by(sizes("side", SIDE)),
            Question::new("deepest overlap of bodies over r", "", 0.0).by(Error::Absolute),
        ];
        findings.take(&resolution, questions, impact(cells));
    }
}

fn scene(cells: f64) -> Value {
    let mut scene: Value = serde_json::from_str(SCENE).expect("the scene is JSON");
    scene["numerics"] = json!({"cell_size_m": SIDE / cells});
    scene
}

fn places(simulation: &Simulation) -> Vec<Vec3> {
    let bodies = simulation.bodies().iter();
    bodies.map(|body| body.state.position).collect()
}

/// Displacements of all cubes since the start [m].
fn ways(simulation: &Simulation, start: &[Vec3]) -> Vec<Vec3> {
    let now = places(simulation);
    now.iter()
        .zip(start)
        .map(|(now, start)| now - start)
        .collect()
}

fn impact(cells: f64) -> Result<Answer<6>, CaseError> {
    let mut run = Run::start(scene_of(&scene(cells))?)?;
    let start = places(&run.simulation);
    let (mut sideways, mut hit) = (0.0f64, false);
    run.watch(f64::INFINITY, |simulation, _| {
        hit |= (0..start.len()).any(|cube| simulation.flow_load(cube).load.force != Vec3::zeros());
        if !hit {
            for way in ways(simulation, &start) {
                sideways = sideways.max(way.xy().norm());
            }
        }
        ControlFlow::Continue(())
    })?;
    if !hit {
        return Err(CaseError::Never("the sand never reached the cubes"));
    }
    let downstream = ways(&run.simulation, &start).into_iter().map(|way| way.x);
    let downstream: Vec<f64> = downstream.collect();
    let driven = downstream.iter().filter(|way| **way >= 0.1 * SIDE).count();
    let audit = run.simulation.audit();
    Ok(run.answer([
        sideways,
        audit.momentum_residual,
        driven as f64,
        downstream.iter().copied().fold(f64::INFINITY, f64::min),
        downstream.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        audit.deepest_body_overlap_ratio,
    ]))
}
