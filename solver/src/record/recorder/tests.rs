use super::*;
use crate::simulation::PreparedScene;
use serde_json::{Value, json};
use std::ops::ControlFlow;

fn scenario(change: impl FnOnce(&mut Value)) -> Scenario {
    let mut scenario = json!({
        "channel": {"inclination_deg": 40, "incline_length_m": 0.5, "runout_length_m": 0.3, "width_m": 0.04},
        "flow": {"volume_m3": 0.0003, "release": {"height_m": 0.05, "toe_distance_m": 0.0}},
        "bodies": [{"shape": {"cube": {"side_m": 0.04}}, "position": {"downstream_m": 0.03}}],
        "numerics": {"cell_size_m": 0.02, "symmetry": "full"}, "duration_s": 0.1, "sample_interval_s": 0.03, "flow_snapshots": 3
    });
    change(&mut scenario);
    Scenario::from_value(&scenario).expect("a scenario")
}

fn records_of(scenario: &Scenario) -> (Vec<Record>, Simulation, Recorder) {
    let mut simulation = Simulation::new(scenario, 1).expect("it fits");
    let mut recorder = Recorder::of(&PreparedScene::of(scenario).expect("it fits"));
    let mut records = recorder.start(&simulation);
    simulation
        .run(f64::INFINITY, |simulation, report| {
            records.extend(recorder.observe(simulation, report));
            ControlFlow::Continue(())
        })
        .expect("it runs");
    (records, simulation, recorder)
}

fn samples(records: &[Record]) -> Vec<&Sample> {
    let samples = records.iter().filter_map(|record| match record {
        Record::Sample(sample) => Some(sample),
        Record::Snapshot(_) => None,
    });
    samples.collect()
}

fn snapshots(records: &[Record]) -> Vec<&FlowSnapshot> {
    let snapshots = records.iter().filter_map(|record| match record {
        Record::Snapshot(snapshot) => Some(snapshot),
        Record::Sample(_) => None,
    });
    snapshots.collect()
}

// Exactly k · interval, and the end, which here is no multiple of it.
#[test]
fn samples_lie_at_their_times() {
    let (records, ..) = records_of(&scenario(|_| {}));
    let times: Vec<f64> = samples(&records)
        .iter()
        .map(|sample| sample.time_s)
        .collect();
    assert_eq!(times, [0.0, 0.03, 2.0 * 0.03, 3.0 * 0.03, 0.1]);
}

// Asked for at 0, 0.05 and 0.1 s.
#[test]
fn snapshots_are_taken_at_the_end_of_their_step() {
    let (records, ..) = records_of(&scenario(|_| {}));
    let taken = snapshots(&records);
    let times: Vec<f64> = taken.iter().map(|snapshot| snapshot.time_s).collect();
    assert_eq!((times.len(), times[0], times[2]), (3, 0.0, 0.1));
    assert!(times[1] >= 0.05 && times[1] < 0.053, "{}", times[1]);
    for snapshot in taken {
        assert_eq!(snapshot.thinning, 1);
        assert_eq!(snapshot.position_m.len() as u64, snapshot.points);
        assert_eq!(snapshot.speed_m_s.len(), snapshot.position_m.len());
    }
    let one = records_of(&scenario(|scenario| scenario["flow_snapshots"] = 1.into())).0;
    assert_eq!(snapshots(&one).len(), 1);
    let none = records_of(&scenario(|scenario| scenario["flow_snapshots"] = 0.into())).0;
    assert!(snapshots(&none).is_empty());
}

const BUDGET: usize = 1_000;

#[test]
fn snapshots_are_thinned_to_the_budget() {
    let fine = scenario(|scenario| {
        scenario["numerics"]["cell_size_m"] = 0.005.into();
        scenario["duration_s"] = 0.into();
        scenario["flow_snapshot_points"] = BUDGET.into();
    });
    let (records, simulation, _) = records_of(&fine);
    let released = simulation.points().len();
    assert!(released > 2 * BUDGET);
    let taken = snapshots(&records);
    assert_eq!(taken[0].points, released as u64);
    assert_eq!(taken[0].thinning as usize, released.div_ceil(BUDGET));
    let kept = taken[0].position_m.len();
    assert!(kept <= BUDGET && kept > BUDGET / 2);
}

/// The same identifier is the same material point, also after a slab has become the whole flow and
/// after points have left through the open end: nothing moves farther than the fastest point could.
#[test]
fn snapshots_have_the_same_points() {
    for bodies in [json!([]), scenario_bodies()] {
        check_points_of_snapshots(&bodies);
    }
}

fn scenario_bodies() -> Value {
    json!([{"shape": {"cube": {"side_m": 0.02}}, "position": {"downstream_m": 0.03}}])
}

fn check_points_of_snapshots(bodies: &Value) {
    let leaving = scenario(|scenario| {
        scenario["channel"]["runout_length_m"] = 0.1.into();
        scenario["channel"]["base_friction"] = 0.2.into();
        scenario["bodies"] = bodies.clone();
        scenario["numerics"] = json!({"cell_size_m": 0.01, "ending": "full"});
        scenario["flow_snapshot_points"] = 300.into();
        scenario["flow_snapshots"] = 41.into();
        scenario["duration_s"] = 1.2.into();
    });
    let (records, ..) = records_of(&leaving);
    let taken = snapshots(&records);
    let first = taken[0].points;
    let last = taken[taken.len() - 1];
    assert!(
        last.points < first && last.points > 0,
        "{first} {}",
        last.points
    );
    for pair in taken.windows(2) {
        let (before, after) = (pair[0], pair[1]);
        assert_eq!(before.thinning, after.thinning);
        assert!(after.point_id.is_sorted_by(|a, b| a < b));
        let speeds = before.speed_m_s.iter().chain(&after.speed_m_s);
        let fastest = speeds.copied().fold(0.0, f32::max);
        let farthest = 1.2 * fastest * (after.time_s - before.time_s) as f32 + 0.005;
        let mut found = 0;
        for (id, to) in after.point_id.iter().zip(&after.position_m) {
            let Ok(place) = before.point_id.binary_search(id) else {
                panic!("point {id} appears at {} s", after.time_s);
            };
            let way: f32 = (0..3)
                .map(|k| (to[k] - before.position_m[place][k]).powi(2))
                .sum();
            assert!(way.sqrt() <= farthest, "point {id} moves {} m", way.sqrt());
            found += 1;
        }
        assert!(found > 0);
    }
}

// Forces are means since the last sample: a sliding cube's momentum changes by
// their sum with gravity's. Free flight and contact alike; rounding only.
#[test]
fn mean_forces_account_for_the_motion() {
    let (records, simulation, _) = records_of(&scenario(|_| {}));
    let mass = simulation.bodies()[0].mass;
    let samples = samples(&records);
    let mut struck = false;
    for pair in samples.windows(2) {
        let (before, after) = (&pair[0].bodies[0], &pair[1].bodies[0]);
        let span = pair[1].time_s - pair[0].time_s;
        struck |= after.flow_force_n != [0.0; 3];
        for axis in 0..3 {
            let gravity = if axis == 2 { -9.81 * mass } else { 0.0 };
            let given = span * (after.flow_force_n[axis] + after.wall_force_n[axis] + gravity);
            let changed = mass * (after.velocity_m_s[axis] - before.velocity_m_s[axis]);
            assert!((given - changed).abs() < 1e-12, "{given} {changed}");
        }
    }
    assert!(struck, "the flow never reached the cube");
}

#[test]
fn the_outcome_adds_up() {
    let (_, simulation, recorder) = records_of(&scenario(|_| {}));
    let outcome = recorder.outcome(&simulation, 2.0);
    assert_eq!(outcome.conservation.points_lost, 0);
    assert_eq!(outcome.cost.points, simulation.released_points());
    let (steps, substeps, point_steps) = simulation.counts();
    assert_eq!(
        (outcome.cost.steps, outcome.cost.substeps),
        (steps, substeps)
    );
    assert_eq!(point_steps, substeps * simulation.released_points());
    assert_eq!(outcome.cost.point_steps_per_s, point_steps as f64 / 2.0);
    let foremost = simulation
        .points()
        .iter()
        .map(|p| p.position.x)
        .fold(f64::MIN, f64::max);
    let front = outcome.flow.front_m.expect("there is a flow");
    let half = 0.5 * simulation.point_spacing_m();
    assert!(front <= foremost + half && front > 0.0);
    // The initial toe lies at the foot.
    assert_eq!(outcome.flow.runout_m, Some(front));
    let x = simulation.bodies()[0].state.position;
    assert_eq!(outcome.bodies[0].final_position_m, [x.x, x.y, x.z]);
}
