//! Case 1: free fall.
//!
//! A block of flow, and then a body, is thrown with v₀ and falls without
//! any contact. Its centre of mass follows the parabola
//!
//! x(t) = x₀ + v₀ t + ½ g t²,  v(t) = v₀ + g t
//!
//! (Galilei 1638). Uniform acceleration causes no strain, so no stress may
//! arise, whatever the grid. Tolerances: rounding. In double precision 1e-12 of the
//! path; in single 6e-8 per operation, for positions of order 1 m over some hundred
//! steps, 2e-6 in all. The flow's path has an error of its own: symplectic
//! Euler is ½ g Σ Δt² below the parabola, ½ g t times the longest Δt at most, which is the tolerance for the path, an error of first
//! order. The body moves by velocity Verlet, which is exact under a constant force.

use crate::verify::blocks::{Block, PER_CELL, elastic};
use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run};
use crate::verify::scenes::{GRAVITY, mean_velocity, thrown_down};
use crate::verify::{Case, Effort, How};
use scree_solver::Simulation;
use scree_solver::material::{Material, Yielding};
use scree_solver::math::Vec3;
use scree_solver::scenario::Precision;
use serde_json::json;

pub(super) const CASE: Case = Case {
    name: "free-fall",
    number: "1",
    title: "free fall of a block of flow, and of a body",
    source: "parabola of uniform acceleration (Galilei 1638), exact",
    how: How::Runs(run),
};

/// Duration [s] and speed at the start [m/s].
const DURATION: f64 = 0.2;
const THROWN: Vec3 = Vec3::new(0.5, 0.0, 0.3);

fn run(effort: Effort, findings: &mut Findings) {
    for (precision, word, rounding) in [
        (Precision::Double, "double", 1e-12),
        (Precision::Single, "single", 2e-6),
    ] {
        for &courant in effort.take(&[0.4, 0.2, 0.1, 0.05], 3) {
            let fall = fall(precision, courant);
            let substep = fall.as_ref().map_or(f64::NAN, |fall| fall.substep);
            let resolution = Resolution::sized(format!("{word}, Δt {substep:.1e} s"), substep);
            let gain = GRAVITY * DURATION;
            let path = 0.5 * gain * DURATION;
            let questions = [
                Question::new(format!("speed gained, {word}"), "m/s", gain).within(rounding),
                // Lag of symplectic Euler, and rounding.
                Question::new(format!("height lost, {word}"), "m", path)
                    .within(0.5 * gain * substep / path + rounding),
            ];
            findings.take(&resolution, questions, fall.map(|fall| fall.answer));
        }
        findings.take_order(&format!("height lost, {word}"), rounding, None);
    }
    let path = 0.5 * GRAVITY * DURATION * DURATION;
    let questions = [
        Question::new("speed gained, body", "m/s", GRAVITY * DURATION).within(1e-12),
        Question::new("height lost, body", "m", path).within(1e-12),
    ];
    findings.take(&Resolution::named("own steps"), questions, fall_of_body());
}

fn fall_of_body() -> Result<Answer<2>, CaseError> {
    let mut scene = thrown_down(&json!({"velocity_m_s": THROWN.as_slice()}))?;
    scene.given.gravity.z = -GRAVITY;
    scene.given.timing.duration = DURATION;
    scene.bodies[0].state.position.z = 1.0;
    let mut run = Run::start(scene)?;
    run.to(DURATION)?;
    let body = &run.simulation.bodies()[0];
    let gained = THROWN.z - body.velocity().z;
    let lost = 1.0 + THROWN.z * DURATION - body.state.position.z;
    Ok(run.answer([gained, lost]))
}

struct Fall {
    /// The longest [s].
    substep: f64,
    answer: Answer<2>,
}

fn fall(precision: Precision, courant: f64) -> Result<Fall, CaseError> {
    let block = Block {
        cell: 0.02,
        at: [6, 5, 30],
        cells: [4, 4, 4],
        cells_across: 14,
        per_cell: PER_CELL,
        endless: false,
        material: Material {
            yielding: Yielding::Granular {
                static_friction: 0.4,
                limiting_friction: 0.6,
                reference_inertial_number: 0.3,
                grain_diameter: 1e-3,
                grain_density: 2500.0,
            },
            ..elastic(1500.0, 1e6, 0.3)
        },
        gravity: GRAVITY,
        expected_speed: 1.0,
        precision,
        duration: DURATION,
    };
    let mut scene = block.scene();
    for point in &mut scene.points {
        point.velocity = THROWN;
    }
    let mut longest = f64::INFINITY;
    if let Some(flow) = &mut scene.given.flow {
        flow.limits.courant = courant;
        // Of nearly equal length over the whole fall, so that it determines the error.
        longest = flow.limits.substep(THROWN.norm() + GRAVITY * DURATION);
        longest = DURATION / (DURATION / longest).ceil();
        scene.given.timing.longest_substep = longest;
    }
    let mut run = Run::start(scene)?;
    let start = mean_height(&run.simulation);
    run.to(DURATION)?;
    let gained = THROWN.z - mean_velocity(&run.simulation).z;
    let lost = start + THROWN.z * DURATION - mean_height(&run.simulation);
    Ok(Fall {
        substep: longest,
        answer: run.answer([gained, lost]),
    })
}

/// Height of the mass centre [m]; all points have one mass.
fn mean_height(simulation: &Simulation) -> f64 {
    let mut sum = 0.0;
    simulation.visit_points(None, |point| sum += point.position.z);
    sum / simulation.point_count() as f64
}
