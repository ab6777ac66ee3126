//! Case 8: longitudinal vibration of an elastic bar.
//!
//! A bar lies at the back wall, a symmetry plane, and is free at its other end; it has
//! smooth walls beside it and nothing above or below. Without Poisson's effect,
//! ν = 0, it moves only along its axis, and its lowest mode (Rayleigh 1877)
//!
//! v = V sin(πx/2L) cos ωt,  ω = (π/2L) √(M/ρ),
//!
//! is imposed at t = 0. ω follows from the zero crossings of the velocity's
//! component in the mode, Σ m v sin(πx/2L). Strains of 1e-4 keep it linear. Tolerance: order
//! 1.8 in the cell size, with the sub-step proportional to it; none for the error itself.

use crate::verify::blocks::{Block, PER_CELL, elastic};
use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run};
use crate::verify::{Case, Effort, How};
use scree_solver::Simulation;
use scree_solver::math::Mat3;
use scree_solver::scenario::Precision;
use scree_solver::simulation::Scene;
use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::ControlFlow;

pub(super) const CASE: Case = Case {
    name: "elastic-bar",
    number: "8",
    title: "lowest longitudinal mode of an elastic bar, fixed at one end",
    source: "ω = (π/2L) √(M/ρ) (Rayleigh 1877)",
    how: How::Runs(run),
};

const LENGTH: f64 = 0.4;
const DENSITY: f64 = 1500.0;
const WAVE_SPEED: f64 = 10.0;
const LARGEST_STRAIN: f64 = 1e-4;
/// Half periods that are timed.
const HALF_PERIODS: usize = 6;

/// Cells along the bar.
const CELLS: [u32; 5] = [6, 12, 24, 48, 96];

fn run(effort: Effort, findings: &mut Findings) {
    let exact = FRAC_PI_2 / LENGTH * WAVE_SPEED;
    for &cells in effort.take(&CELLS, 4) {
        let size = LENGTH / f64::from(cells);
        let resolution = Resolution::sized(format!("{cells} cells"), size);
        let question = Question::new("angular frequency", "rad/s", exact);
        findings.take(&resolution, [question], frequency(cells));
    }
    findings.take_order("angular frequency", 1e-7, Some(1.8));
}

fn scene(cells: u32) -> Scene {
    let block = Block {
        cell: LENGTH / f64::from(cells),
        at: [0, 0, 3],
        cells: [cells, 2, 2],
        cells_across: 2,
        per_cell: PER_CELL,
        endless: false,
        material: elastic(DENSITY, DENSITY * WAVE_SPEED * WAVE_SPEED, 0.0),
        gravity: 0.0,
        // About four sub-steps per step.
        expected_speed: WAVE_SPEED / 8.0,
        precision: Precision::Double,
        duration: f64::from(HALF_PERIODS as u32 + 1) * 2.0 * LENGTH / WAVE_SPEED,
    };
    let mut scene = block.scene();
    let wave_number = FRAC_PI_2 / LENGTH;
    let largest_speed = LARGEST_STRAIN * WAVE_SPEED;
    for point in &mut scene.points {
        let (sin, cos) = (wave_number * point.position.x).sin_cos();
        point.velocity.x = largest_speed * sin;
        point.affine = Mat3::zeros();
        point.affine.m11 = largest_speed * wave_number * cos;
    }
    scene
}

fn frequency(cells: u32) -> Result<Answer<1>, CaseError> {
    let mut run = Run::start(scene(cells))?;
    let mut before = (0.0, share_of_mode(&run.simulation));
    let mut crossings = Vec::new();
    run.watch(f64::INFINITY, |simulation, report| {
        if report.step_ended {
            let (time, last) = before;
            let share = share_of_mode(simulation);
            if last * share < 0.0 {
                crossings.push(time + (report.time_s - time) * last / (last - share));
            }
            before = (report.time_s, share);
        }
        ControlFlow::Continue(())
    })?;
    match crossings[..] {
        [first, .., last] => {
            let halves = (crossings.len() - 1) as f64;
            Ok(run.answer([PI * halves / (last - first)]))
        }
        _ => Err(CaseError::Never("the bar did not swing")),
    }
}

fn share_of_mode(simulation: &Simulation) -> f64 {
    let mut sum = 0.0;
    simulation.visit_points(None, |point| {
        let shape = (FRAC_PI_2 * point.position.x / LENGTH).sin();
        sum += point.mass * point.velocity.x * shape;
    });
    sum
}
