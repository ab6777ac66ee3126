//! Flow over and against cliffs: maps with vertical steps between cells, at every angle to the grid.

use crate::terrain::{raster, scenario};
use scree_solver::Simulation;
use serde_json::json;
use std::collections::HashMap;
use std::ops::ControlFlow;

const GRAVITY: f64 = 9.81;
/// Cells of the computation [m].
const CELL: f64 = 0.5;
/// Inclination of the ground without cliffs (rise over run).
const SLOPE: f64 = 0.3;
/// Side of the map [m].
const SIDE: f64 = 40.0;

/// Height of cliffs at a place [m].
type Height<'a> = &'a dyn Fn(f64, f64) -> f64;

/// A release of 6 m × 6 m about (−6, 0) on ground that falls to the east, with cliffs `of` a place;
/// `cell` is the side of the map's cells [m].
fn release_on(cell: f64, of: impl Fn(f64, f64) -> f64) -> Simulation {
    let count = (SIDE / cell) as usize;
    let map = raster([count, count], cell, |x, y| 50.0 - SLOPE * x + of(x, y));
    let [west, south] = [0.5 * SIDE - 9.0, 0.5 * SIDE - 3.0];
    let [east, north] = [west + 6.0, south + 6.0];
    let scene = json!({
        "terrain": {"base_friction": 0.15},
        "flow": {"releases": [{
            "polygon_m": [[west, south], [east, south], [east, north], [west, north]],
            "thickness_m": 1.0,
        }]},
        "bodies": [], "duration_s": 4.0, "numerics": {"cell_size_m": CELL},
    });
    Simulation::new(&scenario(map, scene), 2).expect("it can be set up")
}

fn run_to(simulation: &mut Simulation, until: f64) {
    let run = simulation.run(until, |_, _| ControlFlow::Continue(()));
    run.unwrap_or_else(|error| panic!("{error}"));
}

/// Depth of the deepest point behind the surface [cells].
fn deepest(simulation: &Simulation) -> f64 {
    let ground = simulation.rigid_walls().terrain.expect("a terrain");
    let mut deepest = 0.0_f64;
    simulation.visit_points(None, |point| {
        let height = ground
            .nearest_plane(&point.position)
            .height(&point.position);
        deepest = deepest.max(-height / CELL);
    });
    deepest
}

/// True in a square about (x, 0) of this half side.
fn square(x: f64, half: f64) -> impl Fn(f64, f64) -> bool {
    move |u, v| (u - x).abs() < half && v.abs() < half
}

// A flow of which a point gets a cell deep into the ground ends with an error.
#[test]
fn no_point_gets_into_a_cliff() {
    let step = |if_true: f64, is_so: bool| if is_so { if_true } else { 0.0 };
    let tower = |x, y| step(10.0, square(3.0, 2.0)(x, y));
    let pit = |x, y| step(-10.0, square(3.0, 4.0)(x, y));
    let gully = |_: f64, y: f64| step(10.0, y.abs() > 3.5);
    let spires = |x: f64, y: f64| {
        let odd = ((x / 3.0).floor() + (y / 3.0).floor()).rem_euclid(3.0);
        step(6.0, odd == 0.0 && x > -2.0)
    };
    let cliffs: [(&str, Height); 4] = [
        ("tower", &tower),
        ("pit", &pit),
        ("gully", &gully),
        ("spires", &spires),
    ];
    for (name, of) in cliffs {
        for cell in [0.5, 1.0, 2.0] {
            let mut simulation = release_on(cell, of);
            run_to(&mut simulation, 4.0);
            let deepest = deepest(&simulation);
            println!("{name} in cells of {cell} m: deepest point {deepest:.2} cells");
            assert!(deepest < 1.0, "{name}: {deepest}");
        }
    }
}

/// Vertical speeds of the points in the air [m/s], by their identity: higher above the ground than a
/// flow is thick, also a cell beside them.
fn falling(simulation: &Simulation) -> HashMap<u32, f64> {
    let ground = simulation.bed();
    let mut falling = HashMap::new();
    simulation.visit_points(None, |point| {
        let at = point.position;
        let sides = [-1, 0, 1].map(|i| [-1, 0, 1].map(|j| [i, j]));
        let is_clear = sides.as_flattened().iter().all(|side| {
            let [x, y] = side.map(|way| f64::from(way) * CELL);
            ground.elevation(at.x + x, at.y + y) + 2.0 < at.z
        });
        if is_clear {
            falling.insert(point.id, point.velocity.z);
        }
    });
    falling
}

// What is in the air before a cliff falls freely, whichever way the cliff lies.
#[test]
fn a_flow_falls_freely_over_a_cliff() {
    for towards in [0.0, 30.0, 45.0, 80.0] {
        let (sin, cos) = f64::to_radians(towards).sin_cos();
        for cell in [0.5, 1.0] {
            let is_above = |x: f64, y: f64| (x + 2.5) * cos + y * sin < 0.0;
            let mut simulation = release_on(cell, |x, y| if is_above(x, y) { 12.0 } else { 0.0 });
            run_to(&mut simulation, 2.2);
            let (before, start) = (falling(&simulation), simulation.time_s());
            run_to(&mut simulation, 2.5);
            let after = falling(&simulation);
            let takes = simulation.time_s() - start;
            let both = before.iter().filter_map(|(id, before)| {
                let after = after.get(id)?;
                Some((before - after) / (GRAVITY * takes))
            });
            let mut rates: Vec<f64> = both.collect();
            rates.sort_by(f64::total_cmp);
            let median = rates[rates.len() / 2];
            run_to(&mut simulation, 4.0);
            let deepest = deepest(&simulation);
            println!(
                "{towards}° in cells of {cell} m: {} points in the air, they fall with {median:.3} g; \
                 deepest point {deepest:.2} cells",
                rates.len()
            );
            assert!((median - 1.0).abs() < 0.03, "{median}");
            assert!(deepest < 1.0, "{deepest}");
        }
    }
}
