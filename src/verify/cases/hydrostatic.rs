//! Case 8: a column at rest under its weight.
//!
//! A layer without ends stands on the floor between smooth sides, one cell apart.
//! Statics gives the vertical stress everywhere:
//!
//! σ_zz = −g × mass above / area,
//!
//! even after settlement, since mass is counted by points. It starts in that
//! state, compressed accordingly, and oscillates because the equilibrium of the grid
//! differs slightly; stresses are averaged over the second half of the run. Tolerances: order
//! 1.8 in the L2 error of the profile over its value at the bottom; the floor
//! carries the weight within 1 %.
//!
//! The error lies in the uppermost cell: its two layers of points share their
//! load unevenly, since the kernel of the nodes above them is cut, and one has
//! the excess that the other lacks. So the profile is shown without that cell too,
//! and as means over whole cells.

use crate::verify::blocks::{Block, PER_CELL, elastic};
use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run};
use crate::verify::scenes::{GRAVITY, mean_velocity};
use crate::verify::{Case, Effort, How};
use scree_solver::Simulation;
use scree_solver::material::{Material, Yielding};
use scree_solver::math::Sym3;
use scree_solver::scenario::Precision;
use scree_solver::simulation::Scene;
use std::ops::ControlFlow;

pub(super) const CASE: Case = Case {
    name: "hydrostatic",
    number: "8b",
    title: "vertical stress in a column at rest",
    source: "σ_zz = −g × mass above / area (statics)",
    how: How::Runs(run),
};

const HEIGHT: f64 = 0.08;
const DENSITY: f64 = 1500.0;
const DURATION: f64 = 0.8;
/// Start of the averaging of stresses [s].
const FROM: f64 = 0.4;
/// Layers of points per cell.
const LAYERS: usize = 2;

/// Cells over the height.
const CELLS: [u32; 4] = [4, 8, 16, 32];

fn run(effort: Effort, findings: &mut Findings) {
    for (precision, word) in [(Precision::Double, "double"), (Precision::Single, "single")] {
        let whole = format!("σ_zz off, L2, {word}");
        let cellwise = format!("σ_zz off by whole cells, L2, {word}");
        let below = format!("σ_zz off below the top cell, L2, {word}");
        let over = Error::Over {
            of: "of the bottom's",
            size: DENSITY * GRAVITY * HEIGHT,
        };
        for &cells in effort.take(&CELLS, 3) {
            let size = HEIGHT / f64::from(cells);
            let resolution = Resolution::sized(format!("{cells} cells"), size);
            let questions = [
                Question::new(&whole, "Pa", 0.0).by(over),
                Question::new(&below, "Pa", 0.0).by(over),
                Question::new(&cellwise, "Pa", 0.0).by(over),
                Question::new(format!("weight the floor carries, {word}"), "", 1.0).within(0.01),
            ];
            findings.take(&resolution, questions, rest(cells, precision));
        }
        findings.take_order(&whole, 1e-5, Some(1.8));
        findings.take_order(&below, 1e-5, None);
        findings.take_order(&cellwise, 1e-5, None);
    }
}

fn material() -> Material {
    // Sound speed ten times √(g H), ν = 0.3.
    let bulk_modulus = DENSITY * 100.0 * GRAVITY * HEIGHT;
    Material {
        yielding: Yielding::Granular {
            static_friction: 0.5,
            limiting_friction: 0.5,
            reference_inertial_number: 0.3,
            grain_diameter: 1e-3,
            grain_density: 2500.0,
        },
        ..elastic(DENSITY, 1.2 * bulk_modulus, 0.3)
    }
}

fn scene(cells: u32, precision: Precision) -> Scene {
    let block = Block {
        cell: HEIGHT / f64::from(cells),
        at: [0, 0, 0],
        cells: [4, 1, cells],
        cells_across: 1,
        per_cell: PER_CELL,
        endless: true,
        material: material(),
        gravity: GRAVITY,
        expected_speed: (GRAVITY * HEIGHT).sqrt(),
        precision,
        duration: DURATION,
    };
    let mut scene = block.scene();
    let layers = layers_at_rest(cells, &block.material);
    for point in &mut scene.points {
        let layer = &layers[point.id as usize % layers.len()];
        point.position.z = layer.height;
        point.stress = layer.stress;
        point.volume *= layer.compression;
    }
    scene
}

/// A layer of points in equilibrium.
struct Layer {
    /// Height of its middle [m].
    height: f64,
    stress: Sym3,
    /// Volume over that without stress.
    compression: f64,
}

/// The layers under each other's weight, lowest first. Heights follow from the
/// volumes: points compressed according to their stress, but at the distances of unstressed
/// points, would carry p/K too much.
fn layers_at_rest(cells: u32, material: &Material) -> Vec<Layer> {
    // Ratio of lateral to vertical stress of an elastic bed, ν/(1 − ν).
    let lateral = 0.3 / 0.7;
    let count = cells as usize * LAYERS;
    let thickness = HEIGHT / count as f64;
    let mut bottom = 0.0;
    let layer = |number: usize| {
        let above = HEIGHT - (number as f64 + 0.5) * thickness;
        let pressed = DENSITY * GRAVITY * above;
        let pressure = (1.0 + 2.0 * lateral) * pressed / 3.0;
        let compression = DENSITY / material.density(pressure);
        let height = bottom + 0.5 * thickness * compression;
        bottom += thickness * compression;
        let stress = Sym3 {
            xx: -lateral * pressed,
            yy: -lateral * pressed,
            zz: -pressed,
            ..Sym3::default()
        };
        Layer {
            height,
            stress,
            compression,
        }
    };
    (0..count).map(layer).collect()
}

fn rest(cells: u32, precision: Precision) -> Result<Answer<4>, CaseError> {
    let layers = cells as usize * LAYERS;
    let mut run = Run::start(scene(cells, precision))?;
    run.to(FROM)?;
    let (start, from) = (mean_velocity(&run.simulation).z, run.simulation.time_s());
    let (mut sums, mut count) = (vec![0.0; layers], 0.0);
    run.watch(DURATION, |simulation, report| {
        if report.step_ended {
            add_stresses(simulation, &mut sums);
            count += 1.0;
        }
        ControlFlow::Continue(())
    })?;
    let (end, to) = (mean_velocity(&run.simulation).z, run.simulation.time_s());
    let carried = 1.0 + (end - start) / (GRAVITY * (to - from));
    let per_layer = count * run.simulation.point_count() as f64 / layers as f64;
    let off = |(layer, sum): (usize, &f64)| {
        let above = HEIGHT * (1.0 - (layer as f64 + 0.5) / layers as f64);
        sum / per_layer + DENSITY * GRAVITY * above
    };
    let off: Vec<f64> = sums.iter().enumerate().map(off).collect();
    let mean = |cell: &[f64]| cell.iter().sum::<f64>() / LAYERS as f64;
    let whole_cells: Vec<f64> = off.chunks_exact(LAYERS).map(mean).collect();
    let values = [
        root_mean_square(&off),
        root_mean_square(&off[..layers - LAYERS]),
        root_mean_square(&whole_cells),
        carried,
    ];
    Ok(run.answer(values))
}

/// Adds the vertical stress of every point to its layer's; points are numbered
/// upward first.
fn add_stresses(simulation: &Simulation, sums: &mut [f64]) {
    let layers = sums.len();
    simulation.visit_points(None, |point| {
        sums[point.id as usize % layers] += point.stress.zz;
    });
}

fn root_mean_square(values: &[f64]) -> f64 {
    let squares: f64 = values.iter().map(|value| value * value).sum();
    (squares / values.len() as f64).sqrt()
}
