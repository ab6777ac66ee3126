//! Single against double precision, and the instruction sets of single.

use crate::scenes::{Scene, run};
use scree_solver::math::Vec3;
use scree_solver::record::Recorder;
use scree_solver::simulation::PreparedScene;
use scree_solver::{Instructions, Simulation};

/// A channel with a cube, on cells a little smaller than it.
fn coarse() -> Scene {
    Scene::minimal().set("numerics", "cell_size_m", 0.03)
}

fn front_m(scene: &Scene, simulation: &Simulation) -> f64 {
    let outcome = Recorder::of(&PreparedScene::of(&scene.scenario()).expect("it fits"))
        .outcome(simulation, 1.0);
    outcome.flow.front_m.expect("there is a flow")
}

fn cube(simulation: &Simulation) -> Vec3 {
    simulation.bodies()[0].state.position
}

/// Bounds [m] after so long [s]. Both start from the same points to rounding; yielding and
/// contact depend on differences of any size, so they grow, in leaps. Measured: nothing,
/// 1.3e-7, 6.9e-6 (the flow has just struck) and 3.3e-6 for the cube, up to 1.7e-6 for the
/// front, by when the cube has moved 0.2 m.
const APART: [(f64, f64); 4] = [(0.1, 1e-6), (0.2, 1e-6), (0.3, 2e-5), (0.4, 2e-5)];

#[test]
fn single_precision_goes_as_double() {
    let scenes = ["double", "single"].map(|word| coarse().lasting(0.4).precision(word));
    let [mut double, mut single] = scenes.each_ref().map(Scene::start);
    for (until_s, bound) in APART {
        run(&mut double, until_s);
        run(&mut single, until_s);
        let cubes = (cube(&single) - cube(&double)).norm();
        let front = front_m(&scenes[1], &single) - front_m(&scenes[0], &double);
        println!("{until_s} s: cube off by {cubes:.1e} m, front by {front:.1e} m");
        assert!(cubes.max(front.abs()) < bound, "{until_s} s");
    }
    assert_eq!(single.counts(), double.counts());
    let moved = cube(&single).x - cube(&scenes[1].start()).x;
    assert!(moved > 0.1, "the flow hardly moved the cube: {moved}");
    for (simulation, residual) in [(&double, 1e-12), (&single, 2e-7)] {
        let audit = simulation.audit();
        println!(
            "residuals {:.1e}, {:.1e}",
            audit.momentum_residual, audit.angular_momentum_residual
        );
        assert!(audit.mass_error < 1e-12);
        // As in balances.rs; measured 2.0e-15 and 1.2e-8.
        assert!(audit.momentum_residual < residual);
        assert!(audit.angular_momentum_residual < residual);
    }
    let energy = |simulation: &Simulation| simulation.audit().energy_residual();
    assert!((energy(&single) - energy(&double)).abs() < 1e-5);
}

/// A run with no better instructions than these; `None` if this processor lacks
/// them.
fn limited(instructions: Instructions) -> Option<Simulation> {
    if Instructions::detected() < instructions {
        println!("skipped: this processor has no {instructions}");
        return None;
    }
    let mut simulation = coarse().lasting(0.3).start();
    simulation.limit_instructions(instructions);
    run(&mut simulation, f64::INFINITY);
    Some(simulation)
}

#[test]
fn avx2_and_avx512_give_the_same_bits() {
    let runs = [Instructions::Avx2, Instructions::Avx512].map(limited);
    assert_eq!(Instructions::Avx2.fuse(), Instructions::Avx512.fuse());
    if let [Some(avx2), Some(avx512)] = &runs {
        assert!(avx2.save().expect("it ended") == avx512.save().expect("it ended"));
    }
}

#[test]
fn the_baseline_goes_as_the_best() {
    let baseline = limited(Instructions::Baseline).expect("every processor has it");
    let best = limited(Instructions::detected()).expect("it was detected");
    let off = (cube(&baseline) - cube(&best)).norm();
    println!("baseline: cube off by {off:.1e} m");
    // A state saved under the one is therefore not continued under the other.
    let same = baseline.save() == best.save();
    let alike = Instructions::Baseline.fuse() == Instructions::detected().fuse();
    assert_eq!(same, alike);
    // Differences like those between single and double by then; measured 3.6e-6.
    assert!(off < 2e-5, "{off}");
    assert!(baseline.audit().momentum_residual < 2e-7);
}
