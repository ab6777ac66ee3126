//! Margin of a scene's step against instability.

use super::trial::Trial;
use scree_solver::Simulation;
use scree_solver::simulation::Scene;
use std::ops::ControlFlow;

/// Multiples of the chosen sub-step that are tried in order.
const MULTIPLES: [f64; 7] = [1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0];
/// Largest number of point-steps of one try.
const BUDGET: u64 = 1_500_000;
/// A run whose energy rises by more than this share of its scale is unstable.
const UNSTABLE: f64 = 0.02;

/// Largest stable sub-step of the flow over the chosen one, of those tried; none
/// without a flow. The step keeps its length in
/// time, and bodies divide their steps into body sub-steps as always.
pub fn factor(trial: &Trial) -> Option<f64> {
    let mut stable = None;
    for multiple in MULTIPLES {
        let scenario = crate::verify::run::scenario_of(&trial.scenario).ok()?;
        let mut scene = Scene::whole(&scenario).ok()?;
        if let Some(alter) = trial.alter {
            alter(&mut scene);
        }
        let limits = &mut scene.given.flow.as_mut()?.limits;
        limits.courant *= multiple;
        limits.body_contact_share *= multiple;
        if scene.points.is_empty() {
            return None;
        }
        stable.get_or_insert(1.0);
        if !is_stable(scene) {
            break;
        }
        stable = Some(multiple);
    }
    stable
}

fn is_stable(scene: Scene) -> bool {
    let Ok(mut simulation) = Simulation::of_scene(scene, 1) else {
        return false;
    };
    let went = simulation.run(f64::INFINITY, |simulation, report| {
        let (_, _, point_steps) = simulation.counts();
        if report.step_ended && point_steps > BUDGET {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    let audit = simulation.audit();
    went.is_ok() && audit.energy_rise() <= UNSTABLE * audit.energy_scale()
}
