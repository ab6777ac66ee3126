//! Case 10b: a cube held in a bed without friction.
//!
//! A bed whose grains slide freely on each other is a liquid, and a cube in it is
//! pushed up (Archimedes):
//!
//! F = ρ g V.
//!
//! The cube is fixed and frictionless, its faces on nodes, four cells of bed on every
//! side. Points that would overlap it are left out at the start; the bed then settles
//! into the remaining space, and the force is averaged over the second half of the run.
//! The gap between bed and cube adds to the force: with a gap s all round,
//! F = ρ g (L + 2 s)³; s is given in cells. The weight of the bed
//! left out for the cube is shown beside the force. No tolerance.

use crate::verify::beads;
use crate::verify::blocks::{Block, PER_CELL};
use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run};
use crate::verify::scenes::GRAVITY;
use crate::verify::stream::{SIDE, fixed_cube};
use crate::verify::{Case, Effort, How};
use scree_solver::material::{Material, Yielding};
use scree_solver::scenario::Precision;
use scree_solver::simulation::Scene;
use std::ops::ControlFlow;

pub(super) const CASE: Case = Case {
    name: "buried-body",
    number: "10b",
    title: "buoyancy of a cube in a bed without friction",
    source: "F = ρ g V (Archimedes)",
    how: How::Runs(run),
};

/// Cells per side of the cube.
const CELLS: [u32; 4] = [1, 2, 4, 8];
/// Cells of bed on every side of the cube.
const MARGIN: u32 = 4;
/// Length of the run, in √(depth/g): a liquid is damped only by the bulk's viscosity and the
/// transfers.
const DURATION: f64 = 32.0;
const QUICK_DURATION: f64 = 12.0;
/// Poisson's ratio of a liquid: isotropic pressure.
const LIQUID: f64 = 0.5;

fn run(effort: Effort, findings: &mut Findings) {
    let duration = match effort {
        Effort::Quick => QUICK_DURATION,
        Effort::Full => DURATION,
    };
    let force = "force over ρ g V";
    for &cells in effort.take(&CELLS, 2) {
        let label = format!("{cells} cells a side");
        let resolution = Resolution::sized(label, SIDE / f64::from(cells));
        let questions = [
            Question::new(force, "", 1.0),
            Question::new("s", "cells", 0.0).by(Error::Absolute),
            Question::new("left out over V", "", 1.0),
            Question::new("force, last quarter of the run over third", "", 1.0),
        ];
        findings.take(&resolution, questions, buoyancy(cells, duration));
    }
    findings.take_order(force, 1e-3, None);
    findings.take_limit(force);
}

fn block(cells: u32, duration: f64) -> Block {
    let wide = cells + 2 * MARGIN;
    let cell = SIDE / f64::from(cells);
    let depth = cell * f64::from(wide);
    let fall = (GRAVITY * depth).sqrt();
    Block {
        cell,
        at: [0, 0, 0],
        cells: [wide; 3],
        cells_across: wide,
        per_cell: PER_CELL,
        endless: true,
        material: liquid(10.0 * fall),
        gravity: GRAVITY,
        expected_speed: fall,
        precision: Precision::Single,
        duration: duration * (depth / GRAVITY).sqrt(),
    }
}

fn liquid(sound_speed: f64) -> Material {
    Material {
        yielding: Yielding::Granular {
            static_friction: 0.0,
            limiting_friction: 0.0,
            reference_inertial_number: beads::REFERENCE_INERTIAL_NUMBER,
            grain_diameter: beads::GRAIN_DIAMETER,
            grain_density: beads::GRAIN_DENSITY,
        },
        ..beads::with_sound_speed(sound_speed)
    }
}

/// The bed around the cube, and the mass left out for it [kg].
fn scene(block: &Block) -> Result<(Scene, f64), CaseError> {
    let mut scene = block.bed(LIQUID);
    let cube = fixed_cube(block.middle(), &scene)?;
    let sphere = scene.given.flow.as_ref();
    let radius = sphere.map_or(0.0, |flow| flow.sphere.radius);
    let mass = |scene: &Scene| scene.points.iter().map(|point| point.mass).sum::<f64>();
    let whole = mass(&scene);
    scene
        .points
        .retain(|point| cube.distance_to(&point.position) >= radius);
    scene.bodies.push(cube);
    let left_out = whole - mass(&scene);
    Ok((scene, left_out))
}

fn buoyancy(cells: u32, duration: f64) -> Result<Answer<4>, CaseError> {
    let block = block(cells, duration);
    let (scene, left_out) = scene(&block)?;
    let mut run = Run::start(scene)?;
    run.to(0.5 * block.duration)?;
    let third_quarter = mean_lift(&mut run, 0.75 * block.duration)?;
    let last_quarter = mean_lift(&mut run, block.duration)?;
    let displaced = block.material.bulk_density * SIDE.powi(3);
    let over = 0.5 * (third_quarter + last_quarter) / (displaced * GRAVITY);
    let stand_off = 0.5 * (over.cbrt() - 1.0) * f64::from(cells);
    let change = last_quarter / third_quarter;
    Ok(run.answer([over, stand_off, left_out / displaced, change]))
}

/// Mean upward force on the cube from the present time of the run until `to` [N].
fn mean_lift(run: &mut Run, to: f64) -> Result<f64, CaseError> {
    let (mut impulse, mut time) = (0.0, 0.0);
    run.watch(to, |simulation, report| {
        impulse += simulation.flow_load(0).load.force.z * report.substep_s;
        time += report.substep_s;
        ControlFlow::Continue(())
    })?;
    Ok(impulse / time)
}
