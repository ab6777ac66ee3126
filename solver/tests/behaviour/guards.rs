//! Runs that go wrong end with an error that gives time, point or body, and numbers. Each scene
//! here is valid and then spoilt by hand so that one guard acts.

use crate::scenes::{Scene, points_by_id};
use scree_solver::simulation::{Guards, Scene as Built};
use scree_solver::{Mover, Simulation, StepError};
use serde_json::json;
use std::ops::ControlFlow;

fn spoilt(scene: &Scene, spoil: impl FnOnce(&mut Built)) -> StepError {
    let mut built = Built::whole(&scene.scenario()).expect("the scene fits");
    spoil(&mut built);
    let mut simulation = Simulation::of_scene(built, 1).expect("the scene fits");
    simulation
        .run(f64::INFINITY, |_, _| ControlFlow::Continue(()))
        .expect_err("it goes wrong")
}

fn in_both_precisions(check: impl Fn(Scene)) {
    for precision in ["single", "double"] {
        check(Scene::impact().set("numerics", "precision", precision));
    }
}

#[test]
fn what_is_faster_than_a_fall_is_named() {
    in_both_precisions(|scene| {
        let error = spoilt(&scene, |built| {
            built.given.guards = Guards::of(9.81, 5e-5, 0.0);
        });
        let StepError::SpeedRunaway {
            mover: Mover::Point(_),
            speed_m_s,
            limit_m_s,
            time_s,
        } = error
        else {
            panic!("{error}");
        };
        assert!(speed_m_s > limit_m_s && limit_m_s < 0.32 && time_s < 0.1);
    });
}

// The cube starts with a small overlap with the floor, which then becomes ten million times as
// stiff: it is thrown up by energy that its contacts made.
#[test]
fn energy_made_by_a_bodys_contacts_ends_the_run() {
    // One at rest would wait for the flow.
    let scene = Scene::impact().first_body("velocity_m_s", json!([1e-3, 0.0, 0.0]));
    let error = spoilt(&scene, |built| {
        built.bodies[0].wall_law.stiffness *= 1e7;
    });
    let StepError::BodyEnergyMade {
        time_s,
        body: 0,
        made_j,
        limit_j,
    } = error
    else {
        panic!("{error}");
    };
    assert!(made_j > limit_j && time_s < 0.1, "{error}");
}

// Friction of points that drives instead of braking: the body's own balance contains only the
// flow's work on it; the balance of the whole run finds the energy made.
#[test]
fn energy_made_between_flow_and_body_ends_the_run() {
    in_both_precisions(|scene| {
        let error = spoilt(&scene, |built| built.bodies[0].flow_law.friction = -3.0);
        let StepError::EnergyRunaway {
            rise_j,
            limit_j,
            mover: Mover::Body(0),
            speed_m_s,
            ..
        } = error
        else {
            panic!("{error}");
        };
        assert!(rise_j > limit_j && speed_m_s > 4.0, "{error}");
    });
}

// A third of its volume: 4,500 kg/m³ where 3,000 are twice the bulk.
#[test]
fn a_crushed_point_is_named() {
    in_both_precisions(|scene| {
        let crushed = 7;
        let error = spoilt(&scene, |built| {
            let flow = built.given.flow.as_mut().expect("there is a flow");
            // Too soft to expand again within a step.
            flow.material.bulk_modulus *= 1e-6;
            flow.material.shear_modulus *= 1e-6;
            built.points[crushed].volume /= 3.0;
        });
        let StepError::Crushed {
            point,
            density_kg_m3,
            limit_kg_m3,
            ..
        } = error
        else {
            panic!("{error}");
        };
        assert_eq!((point, limit_kg_m3), (crushed as u32, 3000.0));
        assert!(density_kg_m3 > 4000.0, "{density_kg_m3}");
    });
}

// Undamped contact with a modulus of 1e12 Pa on a body that weighs a microgram: formerly its
// own sub-steps were limited to 10,000 per millisecond. Now the millisecond is shortened.
#[test]
fn a_body_that_asks_for_many_steps_gets_shorter_ones() {
    let scenario = Scene::channel(40.0, 0.6, 0.6, 0.2)
        .body(json!({
            "shape": {"cube": {"side_m": 0.001}}, "density_kg_m3": 1.0,
            "contact_modulus_pa": 1e12, "restitution": 1.0,
            "position": {"downstream_m": 0.1, "elevation_m": 0.001},
            "velocity_m_s": [0.0, 0.0, -10.0],
        }))
        .lasting(0.001)
        .scenario();
    let mut simulation = Simulation::new(&scenario, 1).expect("the scene fits");
    let (mut shortest, mut most) = (f64::INFINITY, 0);
    simulation
        .run(f64::INFINITY, |simulation, report| {
            shortest = report.substep_s.min(shortest);
            most = simulation.body_report(0).substeps.max(most);
            ControlFlow::Continue(())
        })
        .expect("it runs");
    assert!(shortest < 9e-4 && most <= 20_000, "{shortest} s, {most}");
}

// Formerly points behind the incline sank ever faster: where a flow spreads over its bed the
// nodes behind it move inwards, and took them a cell deep within seconds.
#[test]
fn no_point_sinks_into_the_incline() {
    for precision in ["single", "double"] {
        let scene = Scene::channel(30.0, 0.4, 0.4, 0.1)
            .flow(json!({"volume_m3": 0.0003,
                         "release": {"height_m": 0.04, "toe_distance_m": 0.05}}))
            .set("numerics", "cell_size_m", 0.02)
            .set("numerics", "points_per_cell", 4)
            .set("numerics", "precision", precision)
            .lasting(5.5);
        let simulation = scene.finished();
        let normal = scene.scenario().bed().normal(-0.1, 0.0);
        let depths = points_by_id(&simulation)
            .into_iter()
            .map(|point| -normal.dot(&point.position) / 0.02);
        let deepest = depths.fold(0.0, f64::max);
        println!("{precision}: {deepest} cells behind the incline");
        // A quarter of a cell, and rounding.
        assert!(deepest < 0.2501, "{deepest} cells behind the incline");
    }
}
