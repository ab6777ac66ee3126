//! Edges of a terrain: what leaves it, and what the outcome says of that.

use crate::terrain::{raster, run, scenario};
use serde_json::{Value, json};

/// Outcome of a release and a cube on a plane that falls to the east, close to the eastern edge, with
/// this friction of the cube.
fn remarks(friction: f64) -> Vec<String> {
    let map = raster([30, 30], 0.1, |x, _| 5.0 - 0.6 * x);
    let square = |west: f64, size: f64| -> Value {
        json!([
            [west, 1.4],
            [west + size, 1.4],
            [west + size, 1.4 + size],
            [west, 1.4 + size]
        ])
    };
    let scene = json!({
        "terrain": {},
        "flow": {"releases": [{"polygon_m": square(2.3, 0.3), "thickness_m": 0.1}]},
        "bodies": [{"shape": {"cube": {"side_m": 0.1}}, "friction": friction,
                    "position": {"east_m": 2.8, "north_m": 0.4}}],
        "duration_s": 1.2, "numerics": {"cell_size_m": 0.05},
    });
    let (outcome, simulation) = run(&scenario(map, scene));
    let east = simulation.bodies()[0].state.position.x;
    assert_eq!(east > 3.0, friction < 0.6, "{east}");
    assert!(outcome.flow.outflow_mass_kg > 0.0);
    outcome.remarks
}

#[test]
fn the_outcome_says_what_left_the_height_map() {
    let says = |remarks: &[String], what: &str| remarks.iter().any(|of| of.contains(what));
    let slid = remarks(0.2);
    assert!(says(&slid, "body 0 left the height map"), "{slid:?}");
    assert!(
        says(&slid, "of the flow left over the edges of the height map"),
        "{slid:?}"
    );
    let stayed = remarks(0.9);
    assert!(!says(&stayed, "body 0 left"), "{stayed:?}");
}

// Two equal releases far apart go as far as each of them alone.
#[test]
fn run_out_counts_from_the_nearest_release() {
    let runout = |places: &[f64]| {
        let map = raster([60, 20], 0.1, |_, _| 1.0);
        let release = |west: &f64| {
            json!({"polygon_m": [[west, 0.8], [west + 0.4, 0.8], [west + 0.4, 1.2], [*west, 1.2]],
                   "thickness_m": 0.3})
        };
        let releases: Vec<Value> = places.iter().map(release).collect();
        let scene = json!({
            "terrain": {}, "flow": {"releases": releases}, "bodies": [],
            "duration_s": 0.4, "numerics": {"cell_size_m": 0.05},
        });
        let flow = run(&scenario(map, scene)).0.flow;
        flow.front_m.zip(flow.runout_m).expect("a flow")
    };
    let (front, alone) = runout(&[1.0]);
    let (both_fronts, both) = runout(&[1.0, 4.6]);
    assert!(alone > 0.05, "{alone}");
    assert!((both / alone - 1.0).abs() < 0.02, "{both} {alone}");
    assert!((both_fronts - both - (front - alone)).abs() < 1e-12);
}

// What has left is no front any more; what has stayed still moves.
#[test]
fn a_flow_that_leaves_the_map_is_followed_to_its_end() {
    let outflow = |ending: &str| {
        let map = raster([40, 20], 0.1, |x, _| 5.0 - 0.5 * x);
        let scene = json!({
            "terrain": {"base_friction": 0.3},
            "flow": {"releases": [{
                "polygon_m": [[3.0, 0.6], [3.8, 0.6], [3.8, 1.4], [3.0, 1.4]], "thickness_m": 0.2
            }]},
            "bodies": [], "duration_s": 1.5,
            "numerics": {"cell_size_m": 0.05, "ending": ending},
        });
        run(&scenario(map, scene)).0.flow.outflow_mass_kg
    };
    let (until_rest, whole) = (outflow("auto"), outflow("full"));
    assert!(whole > 100.0, "{whole} kg");
    assert!(
        (until_rest / whole - 1.0).abs() < 0.01,
        "{until_rest} {whole}"
    );
}

// A flow at rest is no reason to end before another comes.
#[test]
fn a_run_goes_on_to_its_last_release() {
    let map = raster([30, 20], 0.1, |_, _| 1.0);
    let release = |west: f64, time: f64| {
        json!({"polygon_m": [[west, 0.8], [west + 0.4, 0.8], [west + 0.4, 1.2], [west, 1.2]],
               "thickness_m": 0.1, "time_s": time})
    };
    let scene = json!({
        "terrain": {}, "flow": {"releases": [release(0.5, 0.0), release(2.0, 4.0)]},
        "bodies": [], "duration_s": 4.5, "numerics": {"cell_size_m": 0.05},
    });
    let (outcome, simulation) = run(&scenario(map, scene));
    assert!(simulation.time_s() > 4.0, "{:?}", outcome.ended_early);
    let points = simulation.points();
    let east = points.iter().filter(|point| point.position.x > 1.5).count();
    assert_eq!(2 * east, points.len());
}
