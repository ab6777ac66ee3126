//! Limits of scenes: nothing to compute, and states that can't be computed.

use crate::scenes::{Scene, run, watch};
use scree_solver::record::Recorder;
use scree_solver::simulation::PreparedScene;
use scree_solver::{SaveError, StepError};
use serde_json::json;

#[test]
fn a_run_of_no_duration_is_its_start() {
    let scene = Scene::impact().lasting(0.0);
    let simulation = scene.finished();
    assert_eq!(simulation.time_s(), 0.0);
    assert_eq!(simulation.counts(), (0, 0, 0));
    let mut recorder = Recorder::of(&PreparedScene::of(&scene.scenario()).expect("it fits"));
    assert_eq!(
        recorder.start(&simulation).len(),
        2,
        "a sample and a snapshot"
    );
    let outcome = recorder.outcome(&simulation, 0.0);
    assert_eq!(outcome.bodies[0].onset_time_s, None);
    assert_eq!(outcome.flow.runout_m.map(f64::round), Some(0.0));
}

#[test]
fn no_volume_is_no_flow() {
    let body = json!({"shape": {"cube": {"side_m": 0.04}}, "position": {"downstream_m": -0.5}});
    let bare = Scene::channel(35.0, 1.0, 1.0, 0.2).body(body).lasting(0.3);
    let empty = bare.clone().flow(json!({"volume_m3": 0.0}));
    let (without, with) = (bare.finished(), empty.finished());
    assert_eq!(with.released_points(), 0);
    assert_eq!(with.sound_speed_m_s(), None);
    assert_eq!(without.bodies()[0].state, with.bodies()[0].state);
}

#[test]
fn nothing_at_all_runs_to_its_end() {
    let scene = Scene::channel(35.0, 1.0, 1.0, 0.2).lasting(0.5);
    let simulation = scene.finished();
    assert_eq!(simulation.time_s(), 0.5);
    let outcome = Recorder::of(&PreparedScene::of(&scene.scenario()).expect("it fits"))
        .outcome(&simulation, 1.0);
    assert!(outcome.bodies.is_empty());
    assert_eq!(outcome.flow.front_m, None);
}

#[test]
fn a_flow_without_bodies_runs() {
    let simulation = Scene::impact().without_bodies().lasting(0.05).finished();
    assert!(simulation.counts().2 > 0);
}

// After the last point has left through the open end the run continues to its end.
#[test]
fn a_flow_may_leave_altogether() {
    let scene = Scene::channel(60.0, 0.3, 0.01, 0.04)
        .flow(json!({"volume_m3": 0.0001, "release": {"height_m": 0.03, "toe_distance_m": 0.0}}))
        .set("channel", "base_friction", 0.0)
        .set("numerics", "cell_size_m", 0.02)
        .lasting(1.5);
    let simulation = scene.finished();
    assert_eq!(simulation.time_s(), 1.5);
    assert_eq!(
        simulation.audit().points_outflow,
        simulation.released_points()
    );
    assert!(simulation.audit().mass_error < 1e-12);
}

// A block of 1,000,000 kg/m³ falls on a cube whose contact carries only its own weight.
#[test]
fn a_run_that_failed_stays_so() {
    let cube = |elevation: f64, density: f64| {
        json!({"shape": {"cube": {"side_m": 0.04}}, "density_kg_m3": density,
               "position": {"downstream_m": 0.1, "elevation_m": elevation}})
    };
    let mut soft = cube(0.02, 2000.0);
    soft["contact_modulus_pa"] = json!(1e6);
    let scene = Scene::channel(40.0, 0.6, 0.6, 0.2)
        .body(soft)
        .body(cube(0.1, 1e6))
        .lasting(0.5);
    let mut simulation = scene.start();
    let error = watch(&mut simulation, 0.5, |_, _| {}).expect_err("it can't run");
    println!("{error}");
    assert!(
        matches!(
            error,
            StepError::BodiesMerge { .. } | StepError::BodyBehindWall { .. }
        ),
        "{error:?}"
    );
    assert!(error.time_s() > 0.0 && error.time_s() < 0.5);
    // It stays failed, also for a time already reached, and can't be saved.
    let now = simulation.time_s();
    assert_eq!(watch(&mut simulation, now, |_, _| {}), Err(error.clone()));
    assert_eq!(simulation.save(), Err(SaveError::Failed(error)));
}

// A body thrown as fast as scenarios allow either runs or ends with an error that names time
// and body; never a panic, never a non-finite state.
#[test]
fn an_absurd_throw_ends_in_order() {
    for (sound, velocity) in [(None, 1e3), (Some(20.0), 1e3), (Some(20.0), 50.0)] {
        let scene = Scene::impact()
            .first_body("velocity_m_s", json!([-velocity, 0.0, 0.0]))
            .set("numerics", "sound_speed_m_s", sound)
            .lasting(0.001);
        let mut simulation = scene.start();
        match watch(&mut simulation, 0.001, |_, _| {}) {
            Ok(()) => assert_eq!(simulation.time_s(), 0.001),
            Err(error) => {
                println!("{velocity} m/s, sound {sound:?}: {error}");
                assert!(error.time_s() <= 0.001);
                assert!(error.to_string().contains("t = "));
            }
        }
        let audit = simulation.audit();
        println!(
            "{velocity} m/s, sound {sound:?}: {} put back, energy {:.1e}, mass {:.1e}, linear {:.1e}, angular {:.1e}",
            audit.penetration_corrections,
            audit.energy_residual(),
            audit.mass_error,
            audit.momentum_residual,
            audit.angular_momentum_residual
        );
    }
}

// A cube thrown at 50 m/s through a flow given a sound speed of 20 m/s formerly travelled half
// a cell per sub-step, past points that it should have struck: the sub-step depended on the
// points' speed only.
#[test]
fn a_thrown_body_does_not_jump_over_points() {
    let scene = Scene::impact()
        .first_body("velocity_m_s", json!([-50.0, 0.0, 0.0]))
        .set("numerics", "sound_speed_m_s", 20.0)
        .lasting(0.002);
    let mut simulation = scene.start();
    let cell = simulation.cell_size_m();
    watch(&mut simulation, 0.002, |simulation, report| {
        let travel = report.substep_s * simulation.bodies()[0].velocity().norm();
        // Largest travel of a body in a sub-step.
        assert!(travel < 0.4 * cell, "{travel} m in one sub-step");
    })
    .expect("it runs");
    assert!(simulation.flow_load(0).touching_points > 0);
}

#[test]
fn running_beyond_the_end_changes_nothing() {
    let mut simulation = Scene::impact().lasting(0.02).finished();
    let saved = simulation.save();
    run(&mut simulation, 5.0);
    assert_eq!(simulation.save(), saved);
}

/// A coarse release on the incline, close to a cube.
fn beside_a_cube(flow: serde_json::Value) -> Scene {
    Scene::channel(40.0, 0.6, 0.6, 0.2)
        .flow(flow)
        .body(json!({
            "shape": {"cube": {"side_m": 0.06}},
            "position": {"downstream_m": 0.035},
        }))
        .set("numerics", "cell_size_m", 0.03)
        .lasting(0.1)
}

// Formerly a cube of 0.1 kg/m³ flew off at 15 km/s: the friction of the points that touched it
// could take more momentum per sub-step than the cube had. Nothing here can be faster than a
// fall through the release.
#[test]
fn a_body_lighter_than_air_is_carried_not_thrown() {
    let flow = json!({"volume_m3": 0.002, "release": {"height_m": 0.08, "toe_distance_m": 0.0}});
    for friction in [0.4, 10.0] {
        let mut simulation = Scene::channel(40.0, 0.6, 0.6, 0.2)
            .flow(flow.clone())
            .body(json!({
                "shape": {"cube": {"side_m": 0.06}},
                "density_kg_m3": 0.1,
                "flow_friction": friction,
                "position": {"downstream_m": -0.1},
            }))
            .set("numerics", "cell_size_m", 0.03)
            .lasting(0.05)
            .start();
        let mut fastest = 0.0f64;
        let start = simulation.bodies()[0].state.position;
        watch(&mut simulation, 0.05, |simulation, report| {
            let body = &simulation.bodies()[0];
            // Contacts start with the flow's mean pressure all round; until they carry the actual
            // stress, a body without mass moves at once by a part of an overlap.
            if report.time_s > 1e-3 {
                fastest = fastest.max(body.velocity().norm());
            } else {
                assert!((body.state.position - start).norm() < 1e-3);
            }
        })
        .expect("the scene runs");
        assert!(
            fastest < 2.0 * f64::sqrt(2.0 * 9.81 * 0.08),
            "{fastest} m/s"
        );
    }
}

// Points of a release much thinner than a cell are as light as it is, and the contact of the
// cube with them was formerly as stiff as with whole ones: they shot away.
#[test]
fn a_release_thinner_than_a_point_stays_slow() {
    for volume_m3 in [1e-9, 1e-6] {
        let flow = json!({
            "volume_m3": volume_m3, "release": {"height_m": 0.08, "toe_distance_m": 0.0}
        });
        let simulation = beside_a_cube(flow).finished();
        let points = simulation.points();
        let speeds = points.iter().map(|point| point.velocity.norm());
        let fastest = speeds.fold(0.0, f64::max);
        // Free fall over the release's height.
        assert!(fastest < f64::sqrt(2.0 * 9.81 * 0.08), "{fastest} m/s");
    }
}

// Its contact would carry it, and is changed by hand.
#[test]
fn a_body_pressed_through_the_floor_ends_the_run() {
    let scenario = Scene::channel(40.0, 0.6, 0.6, 0.2)
        .body(json!({
            "shape": {"cube": {"side_m": 0.06}},
            "position": {"downstream_m": 0.1, "elevation_m": 0.05},
        }))
        .lasting(0.5)
        .scenario();
    let mut scene = scree_solver::simulation::Scene::whole(&scenario).expect("it fits");
    scene.bodies[0].wall_law.stiffness *= 1e-6;
    let error = scree_solver::Simulation::of_scene(scene, 1)
        .expect("it fits")
        .run(0.5, |_, _| std::ops::ControlFlow::Continue(()))
        .unwrap_err();
    assert!(
        matches!(
            error,
            StepError::BodyBehindWall {
                body: 0,
                wall: "floor",
                ..
            }
        ),
        "{error}"
    );
}
