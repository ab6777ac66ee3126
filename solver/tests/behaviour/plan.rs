//! The plan of a run against the run.

use crate::scenes::{PRECISIONS, Scene, run};
use scree_solver::Plan;
use scree_solver::points::Point;
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

/// Memory that a plan counts for all but points and nodes [bytes].
const BASE: f64 = 4e6;

#[test]
fn memory_is_about_as_much_as_foretold() {
    for precision in PRECISIONS {
        let scene = Scene::impact().precision(precision).lasting(0.5);
        let mut simulation = scene.start();
        let foretold = Plan::new(&scene.scenario()).expect("the scene fits").cost;
        // While it is set up there are the points of the release beside the packed ones.
        let (packed, _) = simulation.bytes();
        let mut most = packed + simulation.point_count() * size_of::<Point>();
        for tenths in 1..=5 {
            run(&mut simulation, f64::from(tenths) / 10.0);
            let (points, grid) = simulation.bytes();
            most = most.max(points + grid);
        }
        let ratio = foretold.memory_bytes as f64 / (most as f64 + BASE);
        println!(
            "{precision}: {} bytes foretold, {most} held",
            foretold.memory_bytes
        );
        assert!((0.5..=2.0).contains(&ratio), "{ratio}");
    }
}
