//! Mass and momentum of flow and bodies against walls and gravity, every step:
//! docs/accuracy.md, case 14.

use crate::scenes::{Scene, watch};
use scree_solver::Simulation;

/// Bounds of the relative residuals in one precision.
struct Bounds {
    precision: &'static str,
    residual: f64,
}

/// An imbalance is rounding. Double: some 1e-16 per sum over thousands of points
/// and steps; measured 4e-15. Single: 6e-8 per operation, in either direction, so
/// that most of it cancels in the sums over points; measured 1.5e-8 to 2.6e-8,
/// linear and angular.
const EACH: [Bounds; 2] = [
    Bounds {
        precision: "double",
        residual: 1e-12,
    },
    Bounds {
        precision: "single",
        residual: 2e-7,
    },
];

/// Bound of the mass error: masses never change, and are summed in f64 in both
/// precisions. Measured: 6e-16.
const MASS: f64 = 1e-12;

/// Runs a scene in both precisions, checks its balances at every step and shows its end.
fn balanced(name: &str, scene: &Scene, look: impl Fn(&Simulation)) {
    for bounds in EACH {
        let mut simulation = scene.clone().precision(bounds.precision).start();
        watch(&mut simulation, f64::INFINITY, |simulation, report| {
            let audit = simulation.audit();
            if report.step_ended {
                let (linear, angular) = (audit.momentum_residual, audit.angular_momentum_residual);
                assert!(audit.mass_error < MASS, "{}", audit.mass_error);
                assert!(linear < bounds.residual, "{name}: {linear:e}");
                assert!(angular < bounds.residual, "{name}: {angular:e}");
            }
        })
        .expect("the scene runs");
        let audit = simulation.audit();
        println!(
            "{name}, {}: mass {:.1e}, linear {:.1e}, angular {:.1e}, energy {:.1e}, overlap {:.2}",
            bounds.precision,
            audit.mass_error,
            audit.momentum_residual,
            audit.angular_momentum_residual,
            audit.energy_residual(),
            audit.deepest_overlap_ratio,
        );
        look(&simulation);
    }
}

#[test]
fn flow_and_free_body_balance() {
    balanced("free body", &Scene::impact(), |simulation| {
        let moved = simulation.bodies()[0].state.position.x - 0.04;
        assert!(moved > 1e-3, "the flow never struck the cube: {moved}");
    });
}

#[test]
fn flow_and_barrier_balance() {
    let scene = Scene::impact().first_body("fixed", true);
    balanced("barrier", &scene, |simulation| {
        assert!(simulation.flow_load(0).touching_points > 0);
        assert_eq!(simulation.bodies()[0].state.position.x, 0.04);
    });
}

#[test]
fn flow_that_leaves_stays_in_the_balance() {
    let scene = Scene::impact().set("channel", "runout_length_m", 0.1);
    balanced("open end", &scene, |simulation| {
        assert!(simulation.audit().points_outflow > 0);
        let there = simulation.points().len() as u64 + simulation.audit().points_outflow;
        assert_eq!(there, simulation.released_points());
    });
}

#[test]
fn rough_side_walls_balance() {
    let scene = Scene::impact().set("channel", "side_friction", 0.5);
    balanced("rough sides", &scene, |_| {});
}
