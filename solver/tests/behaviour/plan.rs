//! The plan of a run against the run.

use crate::scenes::{PRECISIONS, Scene, run};
use scree_solver::grid::BlockKey;
use scree_solver::mpm::chunk::Packed;
use scree_solver::points::Point;
use scree_solver::{Plan, Simulation};
use serde_json::json;

/// Scenes of different kinds: a cube struck, a flow only, bodies only.
fn scenes() -> [Scene; 4] {
    let light = json!({"shape": {"cube": {"side_m": 0.04}}, "density_kg_m3": 60,
        "position": {"downstream_m": 0.04}});
    [
        Scene::impact().lasting(0.125),
        Scene::impact().without_bodies().lasting(0.1),
        Scene::impact().without_bodies().body(light).lasting(0.1),
        Scene::impact().set("flow", "volume_m3", 0.0).lasting(0.105),
    ]
}

#[test]
fn points_and_steps_are_as_many_as_foretold() {
    for scene in scenes() {
        let simulation = scene.finished();
        let foretold = Plan::new(&scene.scenario()).expect("the scene fits").cost;
        let (steps, substeps, point_steps) = simulation.counts();
        println!("{foretold:?}; {steps} steps, {substeps} sub-steps, {point_steps} point-steps");
        assert_eq!(foretold.points, simulation.released_points());
        // The flow is not faster than expected: the sub-step is that of a lone point.
        assert_eq!(foretold.substeps, substeps);
        assert_eq!(foretold.point_steps, point_steps);
        let off = foretold.steps as f64 / steps as f64;
        assert!((0.9..=1.1).contains(&off), "{off}");
    }
}

/// Memory that a plan counts for all but the flow [bytes].
const BASE: f64 = 4e6;
/// Bytes per computed point when the front and all that moves are looked at: a place with
/// its mass, two ends of it, a reach with its mass, and the place, way and energy of what moves.
const LOOKED_AT: usize = 16 + 2 * 16 + 16 + 24;

/// Memory while points of the release become packed ones, and while the flow moves [bytes].
fn held(simulation: &Simulation, precision: &str) -> usize {
    let (points, grid) = simulation.bytes();
    let arriving = match precision {
        "single" => size_of::<(BlockKey, Packed<f32>)>(),
        _ => size_of::<(BlockKey, Packed<f64>)>(),
    };
    let set_up = points + simulation.computed_points() * (size_of::<Point>() + arriving);
    set_up.max(points + grid + simulation.computed_points() * LOOKED_AT)
}

#[test]
fn memory_is_about_as_much_as_foretold() {
    for precision in PRECISIONS {
        let scenes = [
            Scene::impact().lasting(0.5),
            // A slab, whose many images take nothing.
            Scene::impact()
                .without_bodies()
                .set("channel", "width_m", 1.2)
                .set("flow", "volume_m3", 0.02)
                .lasting(0.3),
        ];
        for scene in scenes {
            let scene = scene.precision(precision);
            let foretold = Plan::new(&scene.scenario()).expect("the scene fits").cost;
            let mut simulation = scene.start();
            let mut most = held(&simulation, precision);
            for tenths in 1..=5 {
                run(&mut simulation, f64::from(tenths) / 10.0);
                most = most.max(held(&simulation, precision));
            }
            let ratio = foretold.memory_bytes as f64 / (most as f64 + BASE);
            println!(
                "{precision}: {} bytes foretold, {most} held, {ratio}",
                foretold.memory_bytes
            );
            assert!((0.8..=1.25).contains(&ratio), "{ratio}");
        }
    }
}
