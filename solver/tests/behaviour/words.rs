//! Agreement of the outcome and samples with the motion of a body.

use crate::scenes::Scene;
use scree_solver::Simulation;
use scree_solver::record::{BodyOutcome, BodySample, Mode, Record, Recorder};
use scree_solver::simulation::PreparedScene;
use serde_json::{Value, json};
use std::ops::ControlFlow;

/// Modes of the first body, and its outcome, at the end of its run.
fn told(scene: &Scene) -> (Vec<Mode>, BodyOutcome) {
    let (samples, outcome) = sampled(scene);
    (samples.iter().map(|sample| sample.mode).collect(), outcome)
}

/// Samples of the first body, and its outcome, at the end of its run.
fn sampled(scene: &Scene) -> (Vec<BodySample>, BodyOutcome) {
    let scenario = scene.scenario();
    let prepared = PreparedScene::of(&scenario).expect("the scene fits");
    let mut recorder = Recorder::of(&prepared);
    let mut simulation = Simulation::of(prepared, 1).expect("it starts");
    let mut records = recorder.start(&simulation);
    simulation
        .run(f64::INFINITY, |simulation, report| {
            records.extend(recorder.observe(simulation, report));
            ControlFlow::Continue(())
        })
        .expect("it runs");
    let samples = records.iter().filter_map(|record| match record {
        Record::Sample(sample) => Some(sample.bodies[0]),
        Record::Snapshot(_) => None,
    });
    let outcome = recorder.outcome(&simulation, 1.0).bodies.remove(0);
    (samples.collect(), outcome)
}

/// A cube of 5 cm in a channel without a flow.
fn cube(inclination_deg: f64, body: &Value) -> Scene {
    let mut cube = json!({"shape": {"cube": {"side_m": 0.05}}});
    for (key, value) in body.as_object().expect("fields of a body") {
        cube[key] = value.clone();
    }
    Scene::channel(inclination_deg, 3.0, 3.0, 0.5).body(cube)
}

fn count(modes: &[Mode], wanted: Mode) -> usize {
    modes.iter().filter(|mode| **mode == wanted).count()
}

#[test]
fn a_cube_that_slides_on_its_face_slides_spinning_or_not() {
    let down = cube(
        20.0,
        &json!({"friction": 0.1, "position": {"downstream_m": -2.5}}),
    );
    let (modes, _) = told(&down.lasting(1.0));
    assert_eq!(
        count(&modes[2..], Mode::Sliding),
        modes.len() - 2,
        "{modes:?}"
    );
    let spinning = cube(
        0.0,
        &json!({"friction": 0.2, "position": {"downstream_m": 0.5},
                "velocity_m_s": [0.5, 0.0, 0.0], "angular_velocity_rad_s": [0.0, 0.0, 20.0]}),
    );
    let (modes, outcome) = told(&spinning.lasting(0.6));
    let sliding = count(&modes, Mode::Sliding);
    assert!(sliding > 20, "{modes:?}");
    assert_eq!(
        sliding + count(&modes, Mode::Resting),
        modes.len(),
        "{modes:?}"
    );
    // It turns on the spot for a little longer than it travels.
    assert!(
        outcome
            .stop_time_s
            .is_some_and(|stop| stop > 0.2 && stop < 0.4)
    );
}

#[test]
fn a_cube_that_tumbles_rolls_and_flies() {
    let scene = cube(
        50.0,
        &json!({"friction": 1.5, "restitution": 0.0, "position": {"downstream_m": -2.5}}),
    );
    let (modes, _) = told(&scene.lasting(1.0));
    let (rolling, flying) = (count(&modes, Mode::Rolling), count(&modes, Mode::Saltating));
    assert!(rolling > 15 && flying > 15, "{modes:?}");
    // Until it has tipped by three degrees it could still fall back on its face.
    assert!(count(&modes, Mode::Sliding) <= 5, "{modes:?}");
}

#[test]
fn a_cube_borne_by_the_flow_is_carried() {
    let release = json!({"height_m": 0.1, "toe_distance_m": 0.05});
    let scene = Scene::channel(40.0, 0.5, 1.0, 0.2)
        .flow(json!({"volume_m3": 0.004, "release": release}))
        .body(
            json!({"shape": {"cube": {"side_m": 0.05}}, "density_kg_m3": 1500, "yaw_deg": 25,
            "position": {"downstream_m": -0.12, "lateral_m": 0.03, "elevation_m": 0.166}}),
        )
        .set("numerics", "cell_size_m", 0.025)
        .lasting(0.3);
    let (modes, outcome) = told(&scene);
    assert!(count(&modes, Mode::Carried) >= modes.len() - 4, "{modes:?}");
    assert!(outcome.first_contact_time_s.is_some_and(|time| time < 0.05));
}

// Contacts without dissipation: the cube keeps ringing with the energy left when it stands.
#[test]
fn a_cube_that_trembles_in_its_place_has_stopped() {
    let scene = cube(
        0.0,
        &json!({"friction": 0.4, "restitution": 1.0, "position": {"downstream_m": 0.5},
                "velocity_m_s": [0.5, 0.0, 0.0]}),
    );
    let (samples, outcome) = sampled(&scene.lasting(1.0));
    let stop = outcome.stop_time_s.expect("it goes nowhere");
    // Friction alone would take 0.127 s.
    assert!(stop > 0.12 && stop < 0.25, "{stop}");
    let [x, ..] = outcome.final_position_m;
    for sample in &samples[30..] {
        assert_eq!(sample.mode, Mode::Resting);
        assert!((sample.position_m[0] - x).abs() < 2e-4);
    }
    let speed = |sample: &BodySample| sample.velocity_m_s[2].abs();
    let fastest = samples[30..].iter().map(speed).fold(0.0, f64::max);
    assert!(fastest > 2e-3, "it does not tremble: {fastest}");
}

#[test]
fn what_the_flow_does_not_reach_says_so() {
    let scene = Scene::impact()
        .first_body("position", json!({"downstream_m": 0.9}))
        .lasting(0.1);
    let (modes, outcome) = told(&scene);
    assert_eq!(outcome.first_contact_time_s, None);
    assert_eq!(count(&modes, Mode::Resting), modes.len());
}
