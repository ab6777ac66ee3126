//! Case 13: a dam breaks on an incline.
//!
//! A layer of thickness h0 on a slope, with a base on which it slips, is released at one
//! end. For a shallow layer with friction at its base alone (Mangeney, Heinrich &
//! Roche 2000), with x counted down the slope from the dam,
//!
//! h = (2 c0 − x/t + mt/2)² / (9 g cos θ),  front at 2 c0 t + mt²/2,
//! c0 = √(g h0 cos θ),  m = g (sin θ − μ cos θ);
//!
//! the part that the dam break has not reached yet moves at u = mt (Coulomb). Tolerance: 2 % of
//! that speed. In a material with elasticity this speed jumps once, by about the lateral
//! stress over ρ c_P, when the wave from the opened end passes, since a slipping
//! base holds nothing more; so the acceleration in the second half of the
//! time, after the first such wave, has the same tolerance as well. The profile is
//! shown without a tolerance, since the theory neglects friction inside the
//! layer and vertical motion, and a dam is not shallow.
//!
//! The slope is a flat floor with inclined gravity. The internal friction exceeds
//! that of the floor, so the layer starts as one.

use crate::verify::beads;
use crate::verify::blocks::{Block, PER_CELL};
use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run};
use crate::verify::scenes::{GRAVITY, tilted_gravity};
use crate::verify::{Case, Effort, How};
use scree_solver::Simulation;
use scree_solver::bed::PlanarBed;
use scree_solver::scenario::Precision;
use scree_solver::simulation::Scene;
use std::collections::BTreeSet;
use std::sync::Arc;

pub(super) const CASE: Case = Case {
    name: "dam-break",
    number: "13",
    title: "a layer of glass beads let go on an incline",
    source: "similarity solution of a shallow layer (Mangeney, Heinrich & Roche 2000)",
    how: How::Runs(run),
};

const HEIGHT: f64 = 0.1;
const INCLINATION_DEG: f64 = 20.0;
/// Friction of the base.
const FRICTION: f64 = 0.3;
/// Length of the layer, in heights.
const LENGTH: u32 = 10;
/// Time of the comparison, in h0/c0.
const UNTIL: f64 = 3.0;
/// Range of the undisturbed part, in shares of the length.
const MIDDLE: (f64, f64) = (0.4, 0.6);
/// Share of the mass beyond the front, also in the theory.
const FRONT_SHARE: f64 = 1e-3;
/// Cells over the height.
const CELLS: [u32; 3] = [8, 16, 32];

/// The theory, at the time of the comparison.
struct Theory {
    time: f64,
    c0: f64,
    /// Acceleration [m/s²].
    m: f64,
    /// Gravity across the layer [m/s²].
    across: f64,
}

impl Theory {
    fn new() -> Self {
        let (sin, cos) = INCLINATION_DEG.to_radians().sin_cos();
        let across = GRAVITY * cos;
        let c0 = (across * HEIGHT).sqrt();
        Self {
            time: UNTIL * HEIGHT / c0,
            c0,
            m: GRAVITY * (sin - FRICTION * cos),
            across,
        }
    }

    fn front(&self) -> f64 {
        2.0 * self.c0 * self.time + 0.5 * self.m * self.time.powi(2)
    }

    /// Position of the front with its share of the mass beyond it: at a distance s from
    /// the tip, h = (s/t)²/(9 g cos θ).
    fn front_of_mass(&self) -> f64 {
        let beyond = FRONT_SHARE * f64::from(LENGTH) * HEIGHT * HEIGHT;
        self.front() - (27.0 * self.across * self.time.powi(2) * beyond).cbrt()
    }

    /// End of the part where the layer is undisturbed.
    fn tail(&self) -> f64 {
        -self.c0 * self.time + 0.5 * self.m * self.time.powi(2)
    }

    fn height(&self, x: f64) -> f64 {
        let root = 2.0 * self.c0 - x / self.time + 0.5 * self.m * self.time;
        root * root / (9.0 * self.across)
    }
}

fn run(effort: Effort, findings: &mut Findings) {
    let theory = Theory::new();
    let profile = "profile off, root mean square";
    for &cells in effort.take(&CELLS, 1) {
        let size = HEIGHT / f64::from(cells);
        let resolution = Resolution::sized(format!("{cells} cells over h0"), size);
        let over = Error::Over {
            of: "h0",
            size: HEIGHT,
        };
        let questions = [
            Question::new(
                "speed of the undisturbed part",
                "m/s",
                theory.m * theory.time,
            )
            .within(0.02),
            Question::new("its acceleration, second half", "m/s²", theory.m).within(0.02),
            Question::new(profile, "m", 0.0).by(over),
            Question::new("front at 0.1 % of the mass", "m", theory.front_of_mass()),
        ];
        findings.take(&resolution, questions, flow(cells, &theory));
    }
    findings.take_order(profile, 0.0, None);
    findings.take_limit("front at 0.1 % of the mass");
}

fn scene(cells: u32, theory: &Theory) -> Scene {
    let expected_speed = 2.0 * theory.c0;
    let block = Block {
        cell: HEIGHT / f64::from(cells),
        at: [0, 0, 0],
        cells: [LENGTH * cells, 1, cells],
        cells_across: 1,
        per_cell: PER_CELL,
        endless: false,
        material: beads::with_sound_speed(10.0 * expected_speed),
        gravity: theory.across,
        expected_speed,
        precision: Precision::Single,
        duration: theory.time,
    };
    let mut scene = block.bed(beads::POISSONS_RATIO);
    scene.given.gravity = tilted_gravity(INCLINATION_DEG);
    scene.given.walls.bed = Arc::new(PlanarBed::floor(FRICTION));
    scene
}

fn flow(cells: u32, theory: &Theory) -> Result<Answer<4>, CaseError> {
    let scene = scene(cells, theory);
    let length = f64::from(LENGTH) * HEIGHT;
    let middle = MIDDLE.0 * length..MIDDLE.1 * length;
    let within = scene
        .points
        .iter()
        .filter(|point| middle.contains(&point.position.x));
    let undisturbed: BTreeSet<u32> = within.map(|point| point.id).collect();
    let mut run = Run::start(scene)?;
    let along = |simulation: &Simulation| speed(simulation, &undisturbed);
    let acceleration = run.acceleration(0.5 * theory.time, f64::INFINITY, along)?;
    let fastest = along(&run.simulation);
    let mut places = Vec::new();
    run.simulation
        .visit_points(None, |point| places.push(point.position.x - length));
    places.sort_unstable_by(|a, b| b.total_cmp(a));
    let front = places[(FRONT_SHARE * places.len() as f64) as usize];
    let off = profile_off(&run.simulation, &places, theory);
    Ok(run.answer([fastest, acceleration, off, front]))
}

/// Mean speed of these points down the slope [m/s].
fn speed(simulation: &Simulation, points: &BTreeSet<u32>) -> f64 {
    let mut sum = 0.0;
    simulation.visit_points(None, |point| {
        if points.contains(&point.id) {
            sum += point.velocity.x;
        }
    });
    sum / points.len() as f64
}

/// Root mean square of the measured minus the theoretical height, between tail and front.
fn profile_off(simulation: &Simulation, places: &[f64], theory: &Theory) -> f64 {
    let (cell, tail) = (simulation.cell_size_m(), theory.tail());
    let bins = ((theory.front() - tail) / cell) as usize;
    // One cell wide.
    let area_of_point = cell * cell / f64::from(PER_CELL.pow(3));
    let mut heights = vec![0.0; bins];
    for x in places.iter().filter(|x| **x >= tail) {
        if let Some(height) = heights.get_mut(((x - tail) / cell) as usize) {
            *height += area_of_point / cell;
        }
    }
    let off = |(bin, height): (usize, &f64)| {
        let x = tail + (bin as f64 + 0.5) * cell;
        (height - theory.height(x)).powi(2)
    };
    let squares: f64 = heights.iter().enumerate().map(off).sum();
    (squares / bins as f64).sqrt()
}
