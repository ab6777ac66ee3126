//! Bodies with a prescribed motion: they follow it, and their effect on flow and free bodies is
//! booked.

use crate::scenes::{PRECISIONS, Scene, points_by_id, run, watch};
use scree_solver::math::Vec3;
use scree_solver::record::Recorder;
use scree_solver::simulation::{PreparedScene, Scene as SolverScene};
use scree_solver::{Simulation, StepError};
use serde_json::{Value, json};
use std::f64::consts::PI;

/// A box that moves, alone in a channel.
fn alone(motion: &Value) -> Scene {
    Scene::channel(0.0, 1.0, 1.0, 0.2)
        .body(json!({"shape": {"box": {"sides_m": [0.02, 0.04, 0.06]}},
            "position": {"downstream_m": 0.1, "elevation_m": 0.1}, "motion": motion}))
        .set("numerics", "ending", "full")
        .lasting(0.5)
}

/// The impact scene with a cube that is driven against the flow, lifted and turned about y.
fn driven() -> Scene {
    Scene::impact().first_body(
        "motion",
        json!({"times_s": [0.05, 0.15, 0.3],
            "velocity_m_s": [[0, 0, 0], [-0.8, 0, 0.1], [0.2, 0, 0]],
            "angular_velocity_rad_s": [[0, 0, 0], [0, 5, 0], [0, -3, 0]]}),
    )
}

/// Position of the driven cube after 0.3 s: from 0.04 m on 0.04 m back in 0.1 s, and 0.045 m in
/// the rest of the time; up from 0.02 m by 5 mm and 7.5 mm.
const DRIVEN_TO: [f64; 3] = [-0.045, 0.0, 0.0325];

#[test]
fn a_body_moves_as_told() -> Result<(), StepError> {
    let motion = json!({"velocity_m_s": [0.3, -0.1, 0.2], "angular_velocity_rad_s": [0, 0, 4]});
    let mut simulation = alone(&motion).start();
    watch(&mut simulation, f64::INFINITY, |simulation, report| {
        let (body, t) = (&simulation.bodies()[0], report.time_s);
        let place = Vec3::new(0.1 + 0.3 * t, -0.1 * t, 0.1 + 0.2 * t);
        assert!((body.state.position - place).norm() < 1e-15);
        let turned = body.state.orientation.scaled_axis() - Vec3::new(0.0, 0.0, 4.0 * t);
        assert!(turned.norm() < 1e-12, "{turned}");
        assert!((body.velocity() - Vec3::new(0.3, -0.1, 0.2)).norm() < 1e-15);
        assert!((body.angular_velocity() - Vec3::new(0.0, 0.0, 4.0)).norm() < 1e-14);
    })
}

#[test]
fn a_table_is_followed_exactly() -> Result<(), StepError> {
    // Half a turn in all: 2π rad/s at the middle of half a second.
    let motion = json!({"times_s": [0, 0.25, 0.5],
        "velocity_m_s": [[0, 0, 0], [0.4, 0, 0], [0, 0, 0]],
        "angular_velocity_rad_s": [[0, 0, 0], [2.0 * PI, 0, 0], [0, 0, 0]]});
    let mut simulation = alone(&motion).start();
    watch(&mut simulation, f64::INFINITY, |simulation, report| {
        let (body, t) = (&simulation.bodies()[0], report.time_s);
        let back = (t - 0.25).max(0.0);
        let area = 0.5 * t * t - back * back;
        assert!((body.state.position.x - 0.1 - 1.6 * area).abs() < 1e-14);
        assert!((body.state.orientation.angle() - 8.0 * PI * area).abs() < 1e-12);
    })?;
    let body = &simulation.bodies()[0];
    assert!((body.state.position.x - 0.2).abs() < 1e-15);
    assert!((body.state.orientation.angle() - 0.5 * PI).abs() < 1e-12);
    assert_eq!(body.largest_speed(), 0.0);
    Ok(())
}

// A turn about an axis that itself turns has no closed form: of second order in the step.
#[test]
fn a_changing_axis_is_of_second_order() {
    let motion = json!({"times_s": [0, 0.5],
        "angular_velocity_rad_s": [[6, 0, 0], [0, 6, 0]]});
    let end = |interval_s: f64| {
        let scene = alone(&motion);
        let mut scene = SolverScene::of(&scene.scenario()).expect("the scene fits");
        scene.given.timing.longest_substep = interval_s;
        let mut simulation = Simulation::of_scene(scene, 1).expect("a thread starts");
        run(&mut simulation, f64::INFINITY);
        simulation.bodies()[0].state.orientation
    };
    let [coarse, middle, fine] = [1e-3, 5e-4, 2.5e-4].map(end);
    let ratio = coarse.angle_to(&middle) / middle.angle_to(&fine);
    assert!((3.8..4.2).contains(&ratio), "{ratio}");
}

#[test]
fn no_flow_keeps_it_from_its_way_and_the_books_balance() {
    // As for free bodies and barriers.
    for (precision, bound) in PRECISIONS.into_iter().zip([1e-12, 2e-7]) {
        let mut simulation = driven().precision(precision).start();
        let mut touched = 0;
        watch(&mut simulation, f64::INFINITY, |simulation, _| {
            touched += simulation.flow_load(0).touching_points;
        })
        .expect("the scene runs");
        assert!(touched > 0, "the flow never met the cube");
        let state = &simulation.bodies()[0].state;
        let off = state.position - Vec3::from(DRIVEN_TO);
        assert!(off.norm() < 1e-14, "{off}");
        let audit = simulation.audit();
        let (linear, angular) = (audit.momentum_residual, audit.angular_momentum_residual);
        println!("{precision}: linear {linear:.1e}, angular {angular:.1e}");
        assert!(linear < bound && angular < bound);
    }
}

#[test]
fn a_motion_of_nothing_is_a_fixed_body() {
    for precision in PRECISIONS {
        let scene = Scene::impact().precision(precision).full().lasting(0.25);
        let fixed = scene.clone().first_body("fixed", true).finished();
        let told = scene.first_body("motion", json!({})).finished();
        assert!(told.flow_load(0).touching_points > 0);
        assert_eq!(points_by_id(&fixed), points_by_id(&told));
        assert_eq!(fixed.flow_load(0), told.flow_load(0));
        let state = |simulation: &Simulation| simulation.bodies()[0].state.clone();
        assert_eq!(state(&fixed).orientation, state(&told).orientation);
        assert_eq!(told.audit().work_given(), 0.0);
    }
}

// It starts 1 cm behind a cube at rest on the floor, and pushes it on for 15 cm.
#[test]
fn a_free_body_is_pushed_along() {
    let mut simulation = Scene::channel(0.0, 1.0, 1.0, 0.2)
        .body(
            json!({"shape": {"cube": {"side_m": 0.04}}, "restitution": 0,
            "position": {"downstream_m": 0.1}}),
        )
        .body(
            json!({"shape": {"box": {"sides_m": [0.02, 0.1, 0.04]}}, "friction": 0,
            "position": {"downstream_m": 0.06, "elevation_m": 0.021},
            "motion": {"velocity_m_s": [0.2, 0, 0]}}),
        )
        .lasting(0.8)
        .start();
    let mut pushed = Vec3::zeros();
    watch(&mut simulation, f64::INFINITY, |simulation, report| {
        pushed += simulation.body_report(1).body_load.force * report.substep_s;
    })
    .expect("the scene runs");
    let [cube, pusher] = [0, 1].map(|body| &simulation.bodies()[body]);
    assert!((pusher.state.position.x - 0.22).abs() < 1e-15);
    let gap = cube.state.position.x - pusher.state.position.x - 0.03;
    assert!(gap.abs() < 1e-3, "{gap}");
    assert!(
        (cube.velocity().x - 0.2).abs() < 0.02,
        "{}",
        cube.velocity()
    );
    // The friction of the floor acts for 0.75 s, and the cube's start.
    let weight = cube.mass * 9.81;
    let expected = -(0.4 * weight * 0.75 + cube.mass * 0.2);
    assert!(
        (pushed.x / expected - 1.0).abs() < 0.03,
        "{pushed} {expected}"
    );
    let audit = simulation.audit();
    assert!((audit.work_given() / (-pushed.x * 0.2) - 1.0).abs() < 1e-9);
    assert!(audit.momentum_residual < 1e-12 && audit.angular_momentum_residual < 1e-12);
}

// Each is an island with sub-steps of its own: the other changes nothing.
#[test]
fn two_bodies_are_pushed_as_each_alone() {
    let pushed = |lateral: &[f64]| {
        let mut scene = Scene::channel(0.0, 1.0, 1.0, 0.3);
        for lateral_m in lateral {
            scene = scene.body(json!({"shape": {"cube": {"side_m": 0.04}},
                "contact_modulus_pa": 1e7,
                "position": {"downstream_m": 0.1, "lateral_m": lateral_m}}));
        }
        let mut simulation = scene
            .body(json!({"shape": {"box": {"sides_m": [0.02, 0.2, 0.04]}},
                "contact_modulus_pa": 1e7,
                "position": {"downstream_m": 0.06, "elevation_m": 0.021},
                "motion": {"velocity_m_s": [0.2, 0, 0], "angular_velocity_rad_s": [0, 0, 0.3]}}))
            .lasting(0.2)
            .start();
        let mut on_pusher = Vec3::zeros();
        watch(&mut simulation, f64::INFINITY, |simulation, report| {
            let load = simulation.body_report(lateral.len()).body_load;
            on_pusher += load.force * report.substep_s;
        })
        .expect("the scene runs");
        (simulation, on_pusher)
    };
    let (both, on_both) = pushed(&[0.06, -0.06]);
    let mut on_each = Vec3::zeros();
    for (place, lateral) in [0.06, -0.06].into_iter().enumerate() {
        let (alone, on_pusher) = pushed(&[lateral]);
        assert!(alone.bodies()[0].velocity().x > 0.1);
        assert_eq!(both.bodies()[place].state, alone.bodies()[0].state);
        on_each += on_pusher;
    }
    assert!((on_both - on_each).norm() < 1e-12 * on_each.norm());
}

// The cube gains 30 times its initial energy, all of it accounted for.
#[test]
fn what_a_motion_lifts_gets_its_energy_from_it() {
    let mut simulation = Scene::channel(0.0, 1.0, 1.0, 0.2)
        .body(json!({"shape": {"cube": {"side_m": 0.04}},
            "position": {"downstream_m": 0.1, "elevation_m": 0.0401}}))
        .body(json!({"shape": {"box": {"sides_m": [0.1, 0.1, 0.02]}},
            "position": {"downstream_m": 0.1, "elevation_m": 0.01},
            "motion": {"times_s": [0.1, 0.3], "velocity_m_s": [[0, 0, 0], [0, 0, 1]]}}))
        .lasting(1.4)
        .start();
    run(&mut simulation, f64::INFINITY);
    let cube = &simulation.bodies()[0];
    let height = cube.state.position.z - 0.04;
    assert!((height - 1.2).abs() < 1e-3, "{height}");
    let gained = cube.mass * (9.81 * height + 0.5);
    let audit = simulation.audit();
    assert!((audit.work_given() / gained - 1.0).abs() < 1e-3);
    assert!(
        audit.energy_rise() < 1e-3 * gained,
        "{}",
        audit.energy_rise()
    );
}

#[test]
fn a_saved_motion_goes_on_with_the_same_bits() {
    for precision in PRECISIONS {
        let scene = driven()
            .body(json!({"shape": {"cube": {"side_m": 0.03}},
                "position": {"downstream_m": 0.08}}))
            .precision(precision);
        let whole = scene.finished().save().expect("it ended");
        let scenario = scene.scenario();
        let mut parts = scene.start();
        for until_s in [0.03, 0.101, 0.22] {
            run(&mut parts, until_s);
            let saved = parts.save().expect("a step ended");
            parts = Simulation::restore(&scenario, 2, &saved).expect("it was just saved");
        }
        run(&mut parts, f64::INFINITY);
        assert!(parts.save().expect("it ended") == whole, "states differ");
    }
}

#[test]
fn no_run_ends_early_while_a_motion_lasts() {
    let ends = |times: Value| {
        let motion = json!({"times_s": times, "velocity_m_s": [[0, 0, 0], [0.1, 0, 0], [0, 0, 0]]});
        let scene = alone(&motion)
            .set("numerics", "ending", "auto")
            .lasting(3.0);
        let scenario = scene.scenario();
        let mut recorder = Recorder::of(&PreparedScene::of(&scenario).expect("it fits"));
        let mut simulation = scene.start();
        recorder.start(&simulation);
        let mut ended = None;
        watch(&mut simulation, f64::INFINITY, |simulation, report| {
            if ended.is_none() && recorder.watch(simulation, report).1.is_break() {
                ended = Some(report.time_s);
            }
        })
        .expect("the scene runs");
        ended
    };
    let stopped = ends(json!([0, 0.5, 1.5])).expect("nothing moves from 1.5 s on");
    assert!((1.5..1.6).contains(&stopped), "{stopped}");
    // It has not begun before 2 s.
    assert_eq!(ends(json!([2, 2.5, 3.5])), None);
}

#[test]
fn only_a_motion_in_the_centre_plane_is_mirrored() {
    let reductions = |motion: Value| {
        let scene = Scene::impact().first_body("motion", motion);
        let outline = PreparedScene::of(&scene.scenario()).expect("the scene fits");
        outline.reductions
    };
    let in_plane =
        reductions(json!({"velocity_m_s": [1, 0, 1], "angular_velocity_rad_s": [0, 1, 0]}));
    assert_eq!(in_plane.mirror, Ok(()));
    let across = json!({"times_s": [0, 1], "velocity_m_s": [[0, 0, 0], [0, 1, 0]]});
    let turning = json!({"angular_velocity_rad_s": [0, 0, 1]});
    for motion in [across, turning] {
        let found = reductions(motion).mirror.expect_err("it leaves the plane");
        assert!(found.contains("out of the centre plane"), "{found}");
    }
    assert!(
        in_plane
            .slab
            .expect_err("it moves")
            .contains("prescribed motion")
    );
}

#[test]
fn half_a_flow_drives_as_the_whole() {
    let force = |scene: Scene| {
        let mut impulse = Vec3::zeros();
        let mut simulation = scene.precision("double").start();
        watch(&mut simulation, f64::INFINITY, |simulation, report| {
            impulse += simulation.flow_load(0).load.force * report.substep_s;
        })
        .expect("the scene runs");
        impulse
    };
    let (half, whole) = (force(driven()), force(driven().full()));
    assert!(whole.x > 0.0, "{whole}");
    let off = Vec3::new(half.x - whole.x, 0.0, half.z - whole.z);
    assert!(off.norm() < 1e-6 * whole.norm(), "{half} {whole}");
}
