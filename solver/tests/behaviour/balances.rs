//! Mass and momentum of flow and bodies against walls and gravity, every step:
//! validation.md, case 14.

use crate::scenes::{Scene, watch};
use scree_solver::Simulation;

/// Bound of the relative residuals: states and sums are f64, so an imbalance is
/// rounding, some 1e-16 per sum over thousands of points and steps. Measured:
/// 1e-14.
const ROUNDING: f64 = 1e-12;

/// Runs a scene and holds its balances at every step.
fn balanced(name: &str, scene: &Scene) -> Simulation {
    let mut simulation = scene.start();
    watch(&mut simulation, f64::INFINITY, |simulation, report| {
        let audit = simulation.audit();
        if report.step_ended {
            assert!(audit.mass_error < ROUNDING, "{}", audit.mass_error);
            assert!(
                audit.momentum_residual < ROUNDING,
                "{}",
                audit.momentum_residual
            );
            assert!(
                audit.angular_momentum_residual < ROUNDING,
                "{}",
                audit.angular_momentum_residual
            );
        }
    })
    .expect("the scene runs");
    let audit = simulation.audit();
    println!(
        "{name}: mass {:.1e}, linear {:.1e}, angular {:.1e}, energy {:.1e}, overlap {:.2}",
        audit.mass_error,
        audit.momentum_residual,
        audit.angular_momentum_residual,
        audit.energy_residual(),
        audit.deepest_overlap_ratio,
    );
    simulation
}

#[test]
fn flow_and_free_body_balance() {
    let simulation = balanced("free body", &Scene::impact());
    let moved = simulation.bodies()[0].state.position.x - 0.04;
    assert!(moved > 1e-3, "the flow never struck the cube: {moved}");
}

#[test]
fn flow_and_barrier_balance() {
    let scene = Scene::impact().first_body("fixed", true);
    let simulation = balanced("barrier", &scene);
    assert!(simulation.flow_load(0).touching_points > 0);
    assert_eq!(simulation.bodies()[0].state.position.x, 0.04);
}

#[test]
fn flow_that_leaves_stays_in_the_balance() {
    let scene = Scene::impact().set("channel", "runout_length_m", 0.1);
    let simulation = balanced("open end", &scene);
    assert!(simulation.audit().points_left > 0);
    let there = simulation.points().len() as u64 + simulation.audit().points_left;
    assert_eq!(there, simulation.released_points());
}

#[test]
fn rough_side_walls_balance() {
    let scene = Scene::impact().set("channel", "side_friction", 0.5);
    balanced("rough sides", &scene);
}
