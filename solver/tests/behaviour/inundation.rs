//! Maps of what a flow does to a terrain (docs/method.md, section 13).

use crate::terrain::{raster, scenario};
use scree_solver::raster::Raster;
use scree_solver::record::MapQuantity;
use scree_solver::scenario::Scenario;
use scree_solver::simulation::PreparedScene;
use scree_solver::{Recorder, Simulation};
use serde_json::{Value, json};
use std::ops::ControlFlow;

/// A block of 10 m × 8 m and 2 m thick on a map of this many cells of this size.
fn block(cells: usize, cell: f64, slope: f64, numerics: &Value, duration: f64) -> Scenario {
    let map = raster([cells, cells / 2], cell, |x, _| 500.0 - slope * x);
    let (middle, north) = (0.25 * cells as f64 * cell, 0.25 * cells as f64 * cell);
    let corners = [[-5.0, -4.0], [5.0, -4.0], [5.0, 4.0], [-5.0, 4.0]];
    let corners = corners.map(|[x, y]| [middle + x, north + y]);
    let scene = json!({
        "terrain": {"base_friction": 0.3}, "duration_s": duration, "numerics": numerics,
        "flow": {
            "releases": [{"polygon_m": corners, "thickness_m": 2.0}],
            "material": {},
        },
        "bodies": [],
    });
    scenario(map, scene)
}

/// The maps of a run.
struct Mapped {
    height: Raster,
    speed: Raster,
    arrival: Raster,
    deposit: Raster,
}

impl Mapped {
    fn all(&self) -> [&Raster; 4] {
        [&self.height, &self.speed, &self.arrival, &self.deposit]
    }
}

/// Runs to the end, interrupted and restored once if asked.
fn maps_of(scenario: &Scenario, threads: usize, restored: bool) -> (Mapped, Simulation) {
    let prepared = PreparedScene::of(scenario).expect("it can be set up");
    let mut recorder = Recorder::of(&prepared);
    let mut simulation = Simulation::of(prepared, threads).expect("threads");
    recorder.start(&simulation);
    let middle = 0.5 * scenario.duration_s;
    for until in [middle, scenario.duration_s] {
        let run = simulation.run(until, |simulation, report| {
            recorder.observe(simulation, report);
            ControlFlow::Continue(())
        });
        run.unwrap_or_else(|error| panic!("{error}"));
        if restored {
            let saved = simulation.save().expect("between two steps");
            simulation = Simulation::restore(scenario, threads, &saved).expect("its own state");
        }
    }
    let maps = recorder
        .flow_maps(&simulation)
        .expect("a flow on a terrain");
    let [height, speed, arrival, deposit] = MapQuantity::ALL.map(|quantity| maps.raster(quantity));
    let mapped = Mapped {
        height,
        speed,
        arrival,
        deposit,
    };
    (mapped, simulation)
}

// Whether the cells of the map are finer than the computation's, as large, or larger.
#[test]
fn a_block_at_rest_is_as_high_as_it_is_thick() {
    for (cells, cell, mapped) in [
        (160, 0.25, 1.0),
        (80, 0.5, 1.0),
        (40, 1.0, 1.0),
        (20, 2.0, 2.0),
    ] {
        let scene = block(cells, cell, 0.0, &json!({"cell_size_m": 1.0}), 0.0);
        let (maps, _) = maps_of(&scene, 1, false);
        for map in maps.all() {
            assert_eq!((map.cell_size, map.west, map.south), (mapped, 0.0, 0.0));
            assert_eq!([map.east(), map.north()], [40.0, 20.0]);
            assert!(map.at_cell(25.0, 10.0).is_nan());
        }
        let height = &maps.height;
        let volume: f64 = height
            .values
            .iter()
            .filter(|height| height.is_finite())
            .sum();
        assert!(
            (volume * mapped * mapped / 160.0 - 1.0).abs() < 1e-5,
            "{cell}: {volume}"
        );
        for [east, north] in [[10.1, 10.1], [7.9, 8.1], [12.9, 11.9]] {
            let there = height.at_cell(east, north);
            assert!(
                (there / 2.0 - 1.0).abs() < 1e-5,
                "{cell}: {there} at {east}, {north}"
            );
        }
        assert_eq!(maps.deposit.at_cell(10.1, 10.1), height.at_cell(10.1, 10.1));
        assert_eq!(maps.speed.at_cell(10.1, 10.1), 0.0);
        assert_eq!(maps.arrival.at_cell(10.1, 10.1), 0.0);
    }
}

#[test]
fn a_flow_arrives_in_order_and_leaves_no_gaps() {
    let scene = block(120, 1.0, 0.8, &json!({"cell_size_m": 1.0}), 6.0);
    let (maps, simulation) = maps_of(&scene, 2, false);
    let foremost = (simulation.points().iter().map(|point| point.position.x)).fold(0.0, f64::max);
    assert!(foremost > 60.0, "{foremost}");
    let (mut last, mut reached) = (0.0, 0);
    for east in 36..(foremost as usize - 3) {
        let at = |map: &Raster| map.at_cell(east as f64 + 0.5, 30.5);
        assert!(at(&maps.height) > 0.0, "{east}");
        let arrival = at(&maps.arrival);
        // The foremost points are too few.
        if arrival.is_nan() {
            continue;
        }
        assert!(arrival >= last, "{east}: {arrival} {last}");
        (last, reached) = (arrival, reached + 1);
        let fastest = (2.0 * 9.81 * 0.8 * (east as f64 - 24.0)).sqrt();
        let speed = at(&maps.speed);
        assert!(speed > 1.0 && speed < fastest, "{east}: {speed} {fastest}");
    }
    assert!(reached > 40, "{reached}");
    // The release has moved on.
    assert_eq!(maps.deposit.at_cell(26.5, 30.5), 0.0);
    let deposit: f64 = maps
        .deposit
        .values
        .iter()
        .filter(|height| height.is_finite())
        .sum();
    assert!((deposit / 160.0 - 1.0).abs() < 1e-4, "{deposit}");
    for (height, end) in maps.height.values.iter().zip(&maps.deposit.values) {
        assert!(
            height.is_nan() == end.is_nan() && (end.is_nan() || end <= height),
            "{height} {end}"
        );
    }
}

// What hasn't left lies in the maps, also the half of a point's square that reaches over an edge.
#[test]
fn a_deposit_at_the_edges_is_whole() {
    let scene = block(24, 1.0, 0.7, &json!({"cell_size_m": 1.0}), 2.5);
    let mass = |simulation: &Simulation| -> f64 {
        let points = simulation.points().into_iter();
        points.map(|point| point.mass).sum()
    };
    let released = mass(&Simulation::new(&scene, 1).expect("it can be set up"));
    let (maps, simulation) = maps_of(&scene, 2, false);
    let left = mass(&simulation) / released;
    assert!((0.1..0.9).contains(&left), "{left} still there");
    let heights = maps.deposit.values.iter();
    let deposit: f64 = heights.filter(|height| height.is_finite()).sum();
    assert!(
        (deposit / (160.0 * left) - 1.0).abs() < 1e-5,
        "{deposit} of {}",
        160.0 * left
    );
}

#[test]
fn maps_are_the_same_with_any_threads_and_after_a_restart() {
    let scene = block(60, 1.0, 0.6, &json!({"cell_size_m": 1.0}), 1.5);
    let bits = |maps: &Mapped| -> Vec<u64> {
        let values = maps.all().into_iter().flat_map(|map| &map.values);
        values.map(|value| value.to_bits()).collect()
    };
    let whole = bits(&maps_of(&scene, 1, false).0);
    for (threads, restored) in [(2, false), (1, true)] {
        assert!(
            whole == bits(&maps_of(&scene, threads, restored).0),
            "{threads} {restored}"
        );
    }
}
