//! Bodies alone on rough ground (docs/method.md, equations 82 and 83).

use crate::terrain::{raster, run, scenario};
use scree_solver::Outcome;
use serde_json::json;

/// A number between −1 and 1 that has nothing to do with that of the next cell.
fn noise(x: f64, y: f64, seed: f64) -> f64 {
    2.0 * ((12.9898 * x + 78.233 * y + seed).sin() * 43_758.545_3).rem_euclid(1.0) - 1.0
}

/// Outcome of a box with these sides [m] on ground that falls by 0.6, with noise up to this height [m]
/// in cells of 1 m.
fn box_on_noise(sides: [f64; 3], height: f64, seed: f64) -> Outcome {
    let map = raster([60, 60], 1.0, |x, y| {
        45.0 - 0.6 * x + height * noise(x, y, seed)
    });
    let scene = json!({
        "terrain": {}, "flow": null, "duration_s": 4.0,
        "bodies": [{
            "shape": {"box": {"sides_m": sides}}, "friction": 0.2,
            "position": {"east_m": 12.0, "north_m": 30.2}
        }],
    });
    run(&scenario(map, scene)).0
}

// Faces and edges meet the ground by its nodes, whose springs have a potential as those of vertices do.
#[test]
fn boxes_make_no_energy_on_rough_ground() {
    for sides in [[2.0, 2.0, 2.0], [6.0, 6.0, 4.0]] {
        for height in [0.1, 0.5, 1.0] {
            for seed in [1.0, 2.0] {
                let outcome = box_on_noise(sides, height, seed);
                let body = &outcome.bodies[0];
                let made = body.energy.expect("a free body").made_share;
                println!("{sides:?} m, {height} m, {seed}: {made:.1e} made");
                assert!(made < 1e-3, "{sides:?}, {height}, {seed}: {made}");
            }
        }
    }
}
