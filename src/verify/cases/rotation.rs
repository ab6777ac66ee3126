//! Case 1b: an elastic block spins.
//!
//! A cube of the elastic test law spins about an oblique axis, without gravity
//! and walls. Its angular momentum is constant, its energy never rises, and its
//! volume grows by the strain of the spin: by the virial theorem the mean of
//! tr σ is 2 E_kin/V, and the volume is therefore larger by
//!
//! ε = 2 E_kin/(3 K V) = ρ ω² ⟨r²⟩/(3 K),  ⟨r²⟩ = side²/6
//!
//! on average over its oscillation. It is a test of the frozen grid: a step turns the
//! block while its weights stay constant. The kernel spreads every point's mass by
//! h²/4 per axis, which adds to ⟨r²⟩: ε is too large by an error of order 2 in the
//! cell size. Tolerances: rounding, 1e-12, for the angular
//! momentum (the forces on displaced nodes are free of torque); the strain ε of the
//! spin for the volume; 1e-3 of the kinetic energy for its rise.

use crate::verify::blocks::{Block, PER_CELL, elastic};
use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run};
use crate::verify::{Case, Effort, How};
use scree_solver::Simulation;
use scree_solver::math::Vec3;
use scree_solver::scenario::Precision;
use scree_solver::simulation::Scene;
use std::ops::ControlFlow;

pub(super) const CASE: Case = Case {
    name: "rigid-rotation",
    number: "1b",
    title: "an elastic block spins freely about an oblique axis",
    source: "constant angular momentum; virial theorem for the mean stretch",
    how: How::Runs(run),
};

/// Duration of about one turn [s].
const DURATION: f64 = 0.6;
const SIDE: f64 = 0.1;
const DENSITY: f64 = 1500.0;

/// Travel per step [cells] and Courant number of the sub-step.
const STEPS: [[f64; 2]; 6] = [
    [0.2, 0.4],
    [0.2, 0.2],
    [0.2, 0.1],
    [0.4, 0.4],
    [0.1, 0.4],
    [0.05, 0.4],
];

/// Cells along a side.
const CELLS: [u32; 5] = [3, 4, 6, 9, 12];

fn spin() -> Vec3 {
    Vec3::new(1.0, 2.0, 3.0).normalize() * 10.0
}

fn run(effort: Effort, findings: &mut Findings) {
    let modulus = block(CELLS[0]).material.bulk_modulus;
    let stretch = DENSITY * spin().norm_squared() * SIDE * SIDE / (6.0 * 3.0 * modulus);
    for &[travel, courant] in effort.take(&STEPS, 4) {
        let questions = [
            Question::new("angular momentum kept", "", 1.0).within(1e-12),
            Question::new("volume gained", "", stretch).within(1.0),
            Question::new("rise of energy over kinetic", "", 0.0)
                .by(Error::Absolute)
                .within(1e-3),
        ];
        let label = format!("{travel} cells a step, Courant {courant}");
        let answer = turn(CELLS[1], travel, courant);
        findings.take(&Resolution::named(label), questions, answer);
    }
    let by_cells = "volume gained, by cells";
    for &cells in effort.take(&CELLS, 3) {
        let size = SIDE / f64::from(cells);
        let resolution = Resolution::sized(format!("{cells} cells a side"), size);
        let question = Question::new(by_cells, "", stretch).within(1.0);
        let answer = turn(cells, 0.2, 0.4).map(|answer| Answer {
            values: [answer.values[1]],
            cost: answer.cost,
        });
        findings.take(&resolution, [question], answer);
    }
    findings.take_order(by_cells, 1e-4, None);
}

fn block(cells: u32) -> Block {
    Block {
        cell: SIDE / f64::from(cells),
        at: [cells, cells, 4 * cells],
        cells: [cells; 3],
        cells_across: 3 * cells,
        per_cell: PER_CELL,
        endless: false,
        material: elastic(DENSITY, 1e6, 0.3),
        gravity: 0.0,
        expected_speed: 0.5,
        precision: Precision::Double,
        duration: DURATION,
    }
}

fn scene(cells: u32, travel: f64, courant: f64) -> Scene {
    let block = block(cells);
    let (middle, spin) = (block.middle(), spin());
    let mut scene = block.scene();
    for point in &mut scene.points {
        point.velocity = spin.cross(&(point.position - middle));
        point.affine = spin.cross_matrix();
    }
    if let Some(flow) = &mut scene.given.flow {
        flow.limits.courant = courant;
        flow.limits.flow_courant = travel;
    }
    scene
}

fn turn(cells: u32, travel: f64, courant: f64) -> Result<Answer<3>, CaseError> {
    let mut run = Run::start(scene(cells, travel, courant))?;
    let start = Sums::of(&run.simulation);
    let (mut volume, mut steps) = (0.0, 0.0);
    run.watch(DURATION, |simulation, report| {
        if report.step_ended {
            volume += Sums::of(simulation).volume;
            steps += 1.0;
        }
        ControlFlow::Continue(())
    })?;
    let end = Sums::of(&run.simulation);
    let off = (end.angular_momentum - start.angular_momentum).norm();
    let kept = 1.0 - off / start.angular_momentum.norm();
    let gained = volume / steps / start.volume - 1.0;
    let rise = run.simulation.audit().energy_residual();
    Ok(run.answer([kept, gained, rise]))
}

struct Sums {
    volume: f64,
    angular_momentum: Vec3,
}

impl Sums {
    fn of(simulation: &Simulation) -> Self {
        let moment = simulation.spacing().map(|h| 0.25 * h * h);
        let (mut volume, mut angular_momentum) = (0.0, Vec3::zeros());
        simulation.visit_points(None, |point| {
            volume += point.volume;
            angular_momentum += point.angular_momentum(&moment);
        });
        Self {
            volume,
            angular_momentum,
        }
    }
}
