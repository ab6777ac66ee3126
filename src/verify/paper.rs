//! The source paper's scene and the motion of its cube.

use super::run::{Answer, CaseError, Run, scenario_of};
use scree_solver::record::Recorder;
use scree_solver::simulation::PreparedScene;
use scree_solver::stability::Limits;
use serde_json::{Value, json};
use std::ops::ControlFlow;

const SCENE: &str = include_str!("../../configs/scenarios/source_paper.json");
/// Side of its cube [m].
const SIDE: f64 = 0.04;
/// Quantities measured by [`motion`], and their units.
pub(super) const QUANTITIES: [(&str, &str); 4] = [
    ("onset", "s"),
    ("peak speed", "m/s"),
    ("displacement", "m"),
    ("at rest from", "s"),
];

/// The scene with this number of cells per side of the cube.
pub(super) fn scene(cells: f64) -> Value {
    let mut scene: Value = serde_json::from_str(SCENE).expect("the scene is JSON");
    scene["numerics"] = json!({"cell_size_m": SIDE / cells});
    scene["flow_snapshots"] = json!(0);
    scene
}

/// Step limits that the solver chooses for the scene.
///
/// # Errors
/// The scene is refused.
pub(super) fn limits_of(scene: &Value) -> Result<Limits, CaseError> {
    let flow = PreparedScene::whole(&scenario_of(scene)?)?.given.flow;
    Ok(flow.ok_or(CaseError::Never("there is no flow"))?.limits)
}

/// The [`QUANTITIES`] of the cube. If it still moves at the end, the time
/// of rest is NaN.
///
/// # Errors
/// The scene is refused or can't be computed, or the flow doesn't move the cube.
pub(super) fn motion(scene: &Value) -> Result<Answer<4>, CaseError> {
    let scenario = scenario_of(scene)?;
    let prepared = PreparedScene::whole(&scenario)?;
    let mut recorder = Recorder::of(&prepared);
    let mut run = Run::start(prepared.scene())?;
    recorder.start(&run.simulation);
    run.watch(f64::INFINITY, |simulation, report| {
        recorder.observe(simulation, report);
        ControlFlow::Continue(())
    })?;
    let outcome = recorder.outcome(&run.simulation, 0.0);
    let [cube] = &outcome.bodies[..] else {
        return Err(CaseError::Never("there is not one cube"));
    };
    let onset = cube.onset_time_s;
    let onset = onset.ok_or(CaseError::Never("the flow never moved the cube"))?;
    let rest = cube.stop_time_s.unwrap_or(f64::NAN);
    Ok(run.answer([onset, cube.peak_speed_m_s, cube.displacement_m, rest]))
}
