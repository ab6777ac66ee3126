//! Samples and snapshots show a run and change no bit of it.

use crate::scenes::{PRECISIONS, Scene, points_by_id};
use scree_solver::record::{BodySample, Outcome, Record, Recorder};
use scree_solver::scenario::Scenario;
use scree_solver::simulation::PreparedScene;
use scree_solver::{Ending, Simulation};
use serde_json::json;

/// Shorter than a sub-step, about a step, and longer than the run [s].
const INTERVALS: [f64; 3] = [7e-5, 0.003, 1.0];
const DURATION: f64 = 0.2;

/// A finished run with its records.
struct Shown {
    simulation: Simulation,
    records: Vec<Record>,
    outcome: Outcome,
}

/// Runs a scenario, saved to bytes and restored at these times [s].
fn shown(scenario: &Scenario, moved_at: &[f64]) -> Shown {
    let prepared = PreparedScene::of(scenario).expect("the scene fits");
    let mut recorder = Recorder::of(&prepared);
    let mut simulation = Simulation::of(prepared, 1).expect("it starts");
    let mut records = recorder.start(&simulation);
    for until in moved_at.iter().chain([&f64::INFINITY]) {
        let ending = simulation.run(*until, |simulation, report| {
            let (taken, flow) = recorder.watch(simulation, report);
            records.extend(taken);
            flow
        });
        if ending == Ok(Ending::Interrupted) {
            break;
        }
        let bytes = simulation.save().expect("a step ended");
        let known = serde_json::to_string(&recorder).expect("a recorder is JSON");
        simulation = Simulation::restore(scenario, 1, &bytes).expect("it was just saved");
        recorder = serde_json::from_str(&known).expect("it was just written");
    }
    let mut outcome = recorder.outcome(&simulation, 1.0);
    outcome.plan = None;
    Shown {
        simulation,
        records,
        outcome,
    }
}

fn times(shown: &Shown) -> Vec<f64> {
    let samples = shown.records.iter().filter_map(|record| match record {
        Record::Sample(sample) => Some(sample.time_s),
        Record::Snapshot(_) => None,
    });
    samples.collect()
}

fn first_bodies(shown: &Shown) -> Vec<BodySample> {
    let samples = shown.records.iter().filter_map(|record| match record {
        Record::Sample(sample) => Some(sample.bodies[0]),
        Record::Snapshot(_) => None,
    });
    samples.collect()
}

fn sampled(scene: &Scene, interval_s: f64, snapshots: u32) -> Scenario {
    let mut scenario = scene.scenario();
    scenario.sample_interval_s = interval_s;
    scenario.flow_snapshots = snapshots;
    scenario
}

/// A flow that strikes a cube, on both paths, in a slab and then half of it; a cube
/// that bounces without a flow, and one that comes to rest early.
fn scenes() -> Vec<Scene> {
    let release = json!({"height_m": 0.1, "toe_distance_m": 0.02});
    let flow = Scene::impact()
        .flow(json!({"volume_m3": 0.002, "release": release}))
        .lasting(DURATION);
    let thrown = Scene::channel(20.0, 1.0, 1.0, 0.3)
        .body(json!({"shape": {"cube": {"side_m": 0.04}},
            "position": {"downstream_m": 0.2, "elevation_m": 0.05},
            "velocity_m_s": [0.3, 0.1, 0.0], "angular_velocity_rad_s": [3.0, 5.0, 1.0]}))
        .body(json!({"shape": {"cube": {"side_m": 0.04}}, "position": {"downstream_m": 0.24}}));
    let mut all: Vec<Scene> = PRECISIONS.map(|word| flow.clone().precision(word)).into();
    all.push(thrown.clone().lasting(DURATION));
    all.push(thrown.lasting(3.0));
    all
}

#[test]
fn neither_samples_nor_snapshots_touch_the_run() {
    for scene in scenes() {
        let [fine, close, none] =
            INTERVALS.map(|interval| shown(&sampled(&scene, interval.max(1e-5), 0), &[]));
        for (other, snapshots) in [
            (&close, 0),
            (&none, 0),
            (&shown(&sampled(&scene, 0.01, 50), &[]), 50),
        ] {
            let bodies = |shown: &Shown| -> Vec<_> {
                let bodies = shown.simulation.bodies().iter();
                bodies.map(|body| body.state.clone()).collect()
            };
            assert_eq!(bodies(&fine), bodies(other));
            assert_eq!(
                points_by_id(&fine.simulation),
                points_by_id(&other.simulation)
            );
            assert_eq!(fine.outcome, other.outcome, "{snapshots} snapshots");
        }
        assert!(fine.outcome.bodies[0].displacement_m > 1e-3);
    }
}

#[test]
fn samples_lie_at_multiples_of_their_interval() {
    let scene = &scenes()[1];
    for interval in INTERVALS {
        let times = times(&shown(&sampled(scene, interval, 0), &[]));
        let (end, before) = times.split_last().expect("there are samples");
        assert_eq!(*end, DURATION);
        for (k, time) in before.iter().enumerate() {
            assert_eq!(*time, k as f64 * interval);
        }
        assert_eq!(
            times.len(),
            (DURATION / interval - 1e-9).ceil() as usize + 1
        );
    }
}

// The bodies of a sample at a time do not depend on the number of samples.
#[test]
fn a_body_is_at_one_place_at_a_time() {
    for scene in scenes().iter().take(3) {
        let all = first_bodies(&shown(&sampled(scene, 0.001, 0), &[]));
        let few = first_bodies(&shown(&sampled(scene, 0.008, 0), &[]));
        for (k, body) in few.iter().enumerate() {
            let same = &all[8 * k];
            assert_eq!(body.position_m, same.position_m);
            assert_eq!(body.orientation, same.orientation);
            assert_eq!(body.velocity_m_s, same.velocity_m_s);
        }
    }
}

#[test]
fn a_saved_run_loses_and_repeats_no_sample() {
    for scene in scenes() {
        let scenario = sampled(&scene, INTERVALS[0], 7);
        let (whole, parts) = (
            shown(&scenario, &[]),
            shown(&scenario, &[0.011, 0.05, 0.12]),
        );
        let bytes = |shown: &Shown| serde_json::to_string(&shown.records).expect("it is JSON");
        assert!(bytes(&whole) == bytes(&parts), "records differ");
        assert_eq!(whole.outcome, parts.outcome);
    }
}

// The last scene rests long before its 3 s are over.
#[test]
fn a_run_that_ends_early_ends_in_a_sample_and_a_snapshot() {
    let scene = scenes().pop().expect("there are scenes");
    for interval in [0.002, 10.0] {
        let run = shown(&sampled(&scene, interval, 3), &[]);
        let ended = run.outcome.ended_early.as_ref().expect("it rests").time_s;
        assert!(ended < 2.0, "{ended}");
        assert_eq!(times(&run).last(), Some(&ended));
        let Some(Record::Snapshot(last)) = run.records.last() else {
            panic!("no snapshot at the end");
        };
        assert_eq!(last.time_s, ended);
    }
}
