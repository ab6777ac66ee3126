//! Flow on steep slopes of a terrain.

use crate::terrain::{raster, run, scenario};
use scree_solver::Simulation;
use serde_json::{Value, json};

const GRAVITY: f64 = 9.81;
const FRICTION: f64 = 0.3;
/// Time of sliding [s].
const TIME: f64 = 0.4;

/// Slab of flow, 0.5 m thick across the slope, after it slid down a plane of this inclination that
/// falls in this direction [°].
fn slab_on_plane(inclination: f64, towards: f64) -> Simulation {
    let (tilt, turn) = (inclination.to_radians(), towards.to_radians());
    let map = raster([50, 50], 0.5, |x, y| {
        200.0 - tilt.tan() * (x * turn.cos() + y * turn.sin())
    });
    // 6 m along the slope and 6 m across it.
    let corner = |[along, across]: [f64; 2]| -> Value {
        let (u, v) = (3.0 * along * tilt.cos(), 3.0 * across);
        let (sin, cos) = turn.sin_cos();
        json!([10.0 + u * cos - v * sin, 10.0 + u * sin + v * cos])
    };
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(corner);
    let scene = json!({
        "terrain": {"base_friction": FRICTION},
        "flow": {"releases": [{"polygon_m": corners, "thickness_m": 0.5 / tilt.cos()}]},
        "bodies": [], "duration_s": TIME,
        "numerics": {"cell_size_m": 0.25, "ending": "full"},
    });
    run(&scenario(map, scene)).1
}

// a = g (sin θ − μ cos θ), as long as the bed is slipperier than the flow.
#[test]
fn a_flow_slides_down_steep_slopes_as_a_block() {
    for (inclination, towards) in [(45.0, 0.0), (60.0, 30.0), (70.0, 0.0), (80.0, 45.0)] {
        let simulation = slab_on_plane(inclination, towards);
        let points = simulation.points().into_iter();
        let mut speeds: Vec<f64> = points.map(|point| point.velocity.norm()).collect();
        speeds.sort_by(f64::total_cmp);
        let (sin, cos) = f64::to_radians(inclination).sin_cos();
        let exact = GRAVITY * (sin - FRICTION * cos) * TIME;
        let off = speeds[speeds.len() / 2] / exact - 1.0;
        println!("{inclination}°, towards {towards}°: {:+.2} %", 100.0 * off);
        assert!(off.abs() < 0.01, "{inclination}, {towards}: {off}");
    }
}
