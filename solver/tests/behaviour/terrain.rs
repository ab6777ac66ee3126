//! Flow and bodies on a terrain (docs/method.md, section 14).

use scree_solver::math::Vec3;
use scree_solver::raster::Raster;
use scree_solver::scenario::{Maps, Scenario};
use scree_solver::simulation::PreparedScene;
use scree_solver::{Outcome, Recorder, Simulation};
use serde_json::{Value, json};
use std::ops::ControlFlow;
use std::sync::Arc;

const GRAVITY: f64 = 9.81;

/// Name of the height map in these scenarios.
pub(crate) fn name() -> String {
    "ab".repeat(32)
}

/// A raster of these numbers of cells, of a height at every place from its middle.
pub(crate) fn raster(cells: [usize; 2], cell: f64, of: impl Fn(f64, f64) -> f64) -> Raster {
    let middle = cells.map(|count| 0.5 * count as f64 * cell);
    Raster::sampled(cells, cell, |x, y| of(x - middle[0], y - middle[1]))
}

/// A scenario on this height map, in local coordinates.
pub(crate) fn scenario(height: Raster, mut document: Value) -> Scenario {
    let mut maps = Maps::default();
    maps.insert(&name(), Arc::new(height));
    document["terrain"]["height_map"] = name().into();
    document["terrain"]["coordinates"] = "local".into();
    Scenario::from_value_with(&document, &maps).unwrap_or_else(|error| panic!("{error:?}"))
}

/// Runs to the end; returns the outcome and the simulation.
pub(crate) fn run(scenario: &Scenario) -> (Outcome, Simulation) {
    let prepared = PreparedScene::of(scenario).expect("it can be set up");
    let mut recorder = Recorder::of(&prepared);
    let mut simulation = Simulation::of(prepared, 2).expect("threads");
    recorder.start(&simulation);
    let until = scenario.duration_s;
    let run = simulation.run(until, |simulation, report| {
        recorder.watch(simulation, report).1
    });
    run.unwrap_or_else(|error| panic!("{error}"));
    (recorder.outcome(&simulation, 0.0), simulation)
}

/// A plane that falls by `slope` towards this direction [rad].
fn plane(slope: f64, towards: f64) -> impl Fn(f64, f64) -> f64 {
    move |x, y| 500.0 - slope * (x * towards.cos() + y * towards.sin())
}

/// Centres of a cube of 1 m at these times [s] on a plane of this inclination [°], which falls in
/// this direction [°].
fn cube_on_plane(
    inclination: f64,
    towards: f64,
    friction: f64,
    times: [f64; 2],
) -> [(Vec3, Vec3); 2] {
    let slope = inclination.to_radians().tan();
    let map = raster([60, 60], 1.0, plane(slope, towards.to_radians()));
    let scene = json!({
        "terrain": {}, "flow": null, "duration_s": times[1],
        "bodies": [{
            "shape": {"cube": {"side_m": 1.0}}, "friction": friction, "yaw_deg": towards,
            "position": {"east_m": 30.0, "north_m": 30.0}
        }],
        "numerics": {"cell_size_m": 1.0},
    });
    let mut simulation = Simulation::new(&scenario(map, scene), 1).expect("it can be set up");
    times.map(|time| {
        let go_on = |_: &Simulation, _: &_| ControlFlow::Continue(());
        simulation.run(time, go_on).expect("it runs");
        let body = &simulation.bodies()[0];
        (body.state.position, body.velocity())
    })
}

// a = g (sin θ − μ cos θ), whichever way the plane falls.
#[test]
fn a_body_slides_down_a_plane_as_a_block() {
    let (inclination, friction, times) = (30.0_f64, 0.3, [0.5, 1.5]);
    let (sin, cos) = inclination.to_radians().sin_cos();
    let exact = GRAVITY * (sin - friction * cos);
    for towards in [0.0, 17.0, 45.0, 90.0, 205.0] {
        let [start, end] = cube_on_plane(inclination, towards, friction, times);
        let (sine, cosine) = f64::to_radians(towards).sin_cos();
        let down = Vec3::new(cosine * cos, sine * cos, -sin);
        let found = (end.1 - start.1).dot(&down) / (times[1] - times[0]);
        let aside = (end.0 - start.0).dot(&Vec3::new(-sine, cosine, 0.0));
        println!(
            "{towards}°: {:+.2e} of a, {aside:.1e} m aside",
            found / exact - 1.0
        );
        assert!(
            (found / exact - 1.0).abs() < 1e-3,
            "{towards}: {found} {exact}"
        );
        assert!(aside.abs() < 1e-3, "{towards}: {aside} m aside");
    }
}

#[test]
fn a_body_rests_on_a_plane_without_creep() {
    for towards in [0.0, 30.0, 111.0] {
        // The springs of friction take up the load first.
        let [start, end] = cube_on_plane(15.0, towards, 0.5, [2.0, 10.0]);
        let moved = (end.0 - start.0).norm();
        println!("{towards}°: {moved:e} m in 8 s");
        assert!(moved < 1e-9, "{towards}: {moved}");
    }
}

/// A slab laid across a ridge with its middle this far beside the crest [m]; the deepest place of
/// its core below the ground on its way, and where it ends.
fn slab_on_ridge(beside: f64) -> (f64, Simulation) {
    let map = raster([80, 60], 0.5, |x, _| 100.0 - (x * x + 1.0).sqrt());
    let scene = json!({
        "terrain": {}, "flow": null, "duration_s": 2.5,
        "bodies": [{
            "shape": {"box": {"sides_m": [4.0, 2.0, 0.8]}}, "friction": 0.2,
            "position": {"east_m": 20.0 + beside, "north_m": 15.0},
            "orientation": [1, 0, 0, 0]
        }],
        "numerics": {"cell_size_m": 0.5},
    });
    let scenario = scenario(map, scene);
    let mut simulation = Simulation::new(&scenario, 1).expect("it can be set up");
    let mut deepest = 0.0_f64;
    let run = simulation.run(2.5, |simulation, _| {
        let body = &simulation.bodies()[0];
        for n in -8..=8 {
            // The middle of the lower face.
            let arm = Vec3::new(0.23 * f64::from(n), 0.0, -0.4);
            let place = body.state.position + body.to_world(&arm);
            let plane = simulation.bed().tangent(place.x, place.y);
            deepest = deepest.max(-plane.height(&place));
        }
        ControlFlow::Continue(())
    });
    run.expect("it runs");
    (deepest, simulation)
}

// A plane face has no vertex near a crest: without the terrain's nodes it would sink in.
#[test]
fn a_slab_tips_off_a_ridge_instead_of_sinking_in() {
    let (deepest, simulation) = slab_on_ridge(0.6);
    let body = &simulation.bodies()[0];
    println!("deepest {deepest}, ends at {}", body.state.position);
    println!("energy {:?}", simulation.body_energy(0));
    let radius = body.shape.sphero_radius();
    assert!(deepest < 0.5 * radius, "{deepest} of {radius}");
    assert!(body.state.position.x > 25.0, "{}", body.state.position);
}

/// Half width of the strip that is looked at [m].
const STRIP: f64 = 0.1;

/// Mean velocity downstream of the points of the strip [m/s], and their mean place [m].
fn strip_mean(simulation: &Simulation, middle: Vec3) -> (f64, f64) {
    let (mut velocity, mut place, mut mass) = (0.0, 0.0, 0.0);
    simulation.visit_points(None, |point| {
        let at = point.position - middle;
        if at.y.abs() < STRIP {
            velocity += point.mass * point.velocity.x;
            place += point.mass * at.x;
            mass += point.mass;
        }
    });
    (velocity / mass, place / mass)
}

fn run_to(scenario: &Scenario, until: f64) -> Simulation {
    let mut simulation = Simulation::new(scenario, 2).expect("it can be set up");
    let go_on = |_: &Simulation, _: &_| ControlFlow::Continue(());
    let run = simulation.run(until, go_on);
    run.unwrap_or_else(|error| panic!("{error}"));
    simulation
}

// A release so wide that its middle does not know of its sides yet, on the raster of a channel.
#[test]
fn the_raster_of_a_channel_moves_a_flow_as_the_channel_does() {
    let (inclination, thickness, length) = (40.0_f64, 0.1, 0.3);
    let (tan, cos) = (
        inclination.to_radians().tan(),
        inclination.to_radians().cos(),
    );
    let vertical = thickness / cos;
    let channel = json!({
        "channel": {"inclination_deg": inclination, "incline_length_m": 0.8, "runout_length_m": 0.8},
        "flow": {"volume_m3": vertical * length * 0.2,
                 "release": {"height_m": thickness, "toe_distance_m": 0.1}},
        "bodies": [], "duration_s": 0.4, "numerics": {"cell_size_m": 0.02}
    });
    let reference = Scenario::from_value(&channel).expect("a scenario");
    let reference = strip_mean(&run_to(&reference, 0.4), Vec3::zeros());
    for cell in [0.02, 0.01, 0.005] {
        // The foot lies at x = 0.8 m, on an edge between two cells.
        let cells = [1.6, 1.6].map(|length: f64| (length / cell).round() as usize);
        let map = raster(cells, cell, |x, _| 100.0 + (-x * tan).max(0.0));
        let (back, front) = (0.7 - length, 0.7);
        let scene = json!({
            "terrain": {"base_friction": 0.4},
            "flow": {"releases": [{
                "polygon_m": [[back, 0.1], [front, 0.1], [front, 1.5], [back, 1.5]],
                "thickness_m": vertical
            }]},
            "bodies": [], "duration_s": 0.4, "numerics": {"cell_size_m": 0.02}
        });
        let found = strip_mean(
            &run_to(&scenario(map, scene), 0.4),
            Vec3::new(0.8, 0.8, 0.0),
        );
        let (speed, way) = (found.0 / reference.0 - 1.0, found.1 - reference.1);
        println!(
            "raster of {cell} m: speed {:+.2} %, place {:+.1} mm",
            100.0 * speed,
            1e3 * way
        );
        assert!(speed.abs() < 0.01, "{cell}: {speed}");
        assert!(way.abs() < 0.002, "{cell}: {way} m");
    }
}

/// Front of a flow and rest of a cube in its way, on a plane that falls in this direction [°],
/// downstream from the middle [m].
fn turned(towards: f64, cell: f64) -> (f64, f64) {
    let (sine, cosine) = towards.to_radians().sin_cos();
    let slope = 20f64.to_radians().tan();
    let map = raster([80, 80], 0.05, plane(slope, towards.to_radians()));
    let place = |ahead: f64, aside: f64| {
        [
            2.0 + ahead * cosine - aside * sine,
            2.0 + ahead * sine + aside * cosine,
        ]
    };
    let [east, north] = place(0.15, 0.0);
    let scene = json!({
        "terrain": {"base_friction": 0.5},
        "flow": {"releases": [{
            "polygon_m": [place(-0.6, -0.3), place(0.0, -0.3), place(0.0, 0.3), place(-0.6, 0.3)],
            "thickness_m": 0.2
        }]},
        "bodies": [{"shape": {"cube": {"side_m": 0.1}}, "yaw_deg": towards,
                    "position": {"east_m": east, "north_m": north}}],
        "numerics": {"cell_size_m": cell}
    });
    let (outcome, simulation) = run(&scenario(map, scene));
    let body = &simulation.bodies()[0].state.position;
    let ahead = (body.x - 2.0) * cosine + (body.y - 2.0) * sine;
    (outcome.flow.front_m.expect("a flow"), ahead - 0.15)
}

// Six cells across the cube. Largest difference of any direction from the mean of all: 2 %.
#[test]
fn the_grid_does_not_care_how_a_plane_lies() {
    let directions = [0.0, 15.0, 30.0, 45.0];
    let found = directions.map(|towards| turned(towards, 0.1 / 6.0));
    for (what, of) in [("front", 0), ("body", 1)] {
        let values = found.map(|found| [found.0, found.1][of]);
        let mean = values.iter().sum::<f64>() / 4.0;
        let off = values.map(|value| value / mean - 1.0);
        println!("{what}: {values:.4?} m towards {directions:?}°, off by {off:.4?}");
        assert!(off.iter().all(|off| off.abs() < 0.02), "{what}: {off:?}");
    }
}

/// A parabola that ends level, this high and long [m], on a map of these cells [m].
fn parabola(height: f64, length: f64, cell: f64) -> Raster {
    let cells = [1.2 * length / cell, 8.0 / cell].map(|count| count.round() as usize);
    raster(cells, cell, |x, _| {
        let left = 1.0 - (x + 0.6 * length - 2.0) / length;
        100.0 + height * left.max(0.0).powi(2) + if left > 1.0 { (left - 1.0) * 0.2 } else { 0.0 }
    })
}

// The energy line: what slides under Coulomb friction alone comes to rest where the line of its
// friction angle meets the slope. The slope turns so slowly that the force of turning adds half a
// per cent of the weight.
#[test]
fn a_block_on_a_parabola_stops_on_its_energy_line() {
    let friction = 0.12;
    let angle = |start: Vec3, end: Vec3| (start.z - end.z) / (end.xy() - start.xy()).norm();
    let scene = json!({
        "terrain": {}, "flow": null, "duration_s": 20.0,
        "bodies": [{"shape": {"cube": {"side_m": 0.3}}, "friction": friction,
                    "position": {"east_m": 2.5, "north_m": 4.0}}],
        "numerics": {"cell_size_m": 0.25},
    });
    let alone = scenario(parabola(2.0, 20.0, 0.25), scene);
    let start = Simulation::new(&alone, 1).expect("a scene").bodies()[0]
        .state
        .position;
    let end = run(&alone).1.bodies()[0].state.position;
    let body = angle(start, end) / friction - 1.0;
    println!(
        "body: {:+.2} % over {:.2} m",
        100.0 * body,
        (end - start).norm()
    );
    assert!(body.abs() < 0.01, "{body}");
    let scene = json!({
        "terrain": {"base_friction": friction},
        "flow": {"releases": [{
            "polygon_m": [[2.3, 3.5], [3.5, 3.5], [3.5, 4.5], [2.3, 4.5]], "thickness_m": 0.4
        }], "material": {"static_friction": 10.0, "limiting_friction": 10.0}},
        "bodies": [], "duration_s": 20.0, "numerics": {"cell_size_m": 0.1},
    });
    let block = scenario(parabola(2.0, 20.0, 0.25), scene);
    let middle = |simulation: &Simulation| {
        let (mut moment, mut mass) = (Vec3::zeros(), 0.0);
        simulation.visit_points(None, |point| {
            moment += point.position * point.mass;
            mass += point.mass;
        });
        moment / mass
    };
    let start = middle(&Simulation::new(&block, 1).expect("a scene"));
    let (outcome, simulation) = run(&block);
    let flow = angle(start, middle(&simulation)) / friction - 1.0;
    println!("flow: {:+.2} %, {:?}", 100.0 * flow, outcome.conservation);
    assert!(flow.abs() < 0.01, "{flow}");
}

/// A hilly map with two releases, the second later, a body in the way, and an edge near by.
fn hilly() -> Scenario {
    let map = raster([60, 50], 0.1, |x, y| {
        50.0 - 0.5 * x + 0.15 * (2.0 * x).sin() * (1.5 * y).cos()
    });
    scenario(
        map,
        json!({
            "terrain": {"base_friction": 0.3},
            "flow": {"releases": [
                {"polygon_m": [[4.2, 1.9], [5.0, 2.0], [4.9, 2.8], [4.3, 2.7]], "thickness_m": 0.3},
                {"polygon_m": [[2.0, 2.0], [2.6, 2.1], [2.3, 2.7]], "thickness_m": 0.25, "time_s": 0.3}
            ]},
            "bodies": [{"shape": {"cube": {"side_m": 0.25}}, "yaw_deg": 20,
                        "position": {"east_m": 5.3, "north_m": 2.4}}],
            "duration_s": 1.2, "sample_interval_s": 0.1,
            "numerics": {"cell_size_m": 0.08, "ending": "full"}
        }),
    )
}

/// Bits of all that moves.
fn bits(simulation: &Simulation) -> Vec<u64> {
    let mut points = simulation.points();
    points.sort_by_key(|point| point.id);
    let of = |v: &Vec3| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    let points = points
        .iter()
        .flat_map(|point| [of(&point.position), of(&point.velocity)]);
    let bodies = simulation.bodies().iter();
    let bodies = bodies.flat_map(|body| [of(&body.state.position), of(&body.state.momentum)]);
    points.chain(bodies).flatten().collect()
}

#[test]
fn threads_and_a_restart_change_no_bit_on_a_terrain() {
    let scenario = hilly();
    let whole = run_to(&scenario, 1.2);
    let one = {
        let mut simulation = Simulation::new(&scenario, 1).expect("a scene");
        let run = simulation.run(1.2, |_, _| ControlFlow::Continue(()));
        run.expect("it runs");
        simulation
    };
    assert!(bits(&whole) == bits(&one), "threads");
    // Before the second release, and after it.
    for stop in [0.2, 0.6] {
        let first = run_to(&scenario, stop);
        let saved = first.save().expect("between two steps");
        let mut second = Simulation::restore(&scenario, 2, &saved).expect("the same scenario");
        let run = second.run(1.2, |_, _| ControlFlow::Continue(()));
        run.expect("it runs");
        assert!(bits(&whole) == bits(&second), "restart at {stop} s");
    }
}

#[test]
fn the_books_of_a_terrain_are_closed() {
    let (outcome, simulation) = run(&hilly());
    let books = &outcome.conservation;
    println!("{books:?} {:?}", outcome.flow);
    assert!(books.mass_error < 1e-12, "{}", books.mass_error);
    assert!(
        books.momentum_residual < 1e-5,
        "{}",
        books.momentum_residual
    );
    assert!(
        books.angular_momentum_residual < 1e-4,
        "{}",
        books.angular_momentum_residual
    );
    assert!(
        outcome.flow.outflow_mass_kg > 0.0,
        "some of it leaves the map"
    );
    assert_eq!(books.points_lost, 0);
    // No point behind the ground.
    let mut deepest = 0.0_f64;
    simulation.visit_points(None, |point| {
        let plane = simulation.bed().tangent(point.position.x, point.position.y);
        deepest = deepest.max(-plane.height(&point.position));
    });
    println!("deepest point {deepest} m");
    assert!(deepest < 0.5 * simulation.cell_size_m(), "{deepest}");
}
