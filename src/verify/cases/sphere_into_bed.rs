//! Case 15: a sphere falls into a bed of grains.
//!
//! Its measured depth is (Uehara, Ambroso, Ojha & Durian 2003)
//!
//! d = (0.14/μ) (ρ_b/ρ)^½ D^⅔ H^⅓,
//!
//! ρ_b and D the sphere's density and diameter, ρ the bed's, μ its friction at
//! rest, H the whole drop, d included. Tolerance: 15 % of each exponent, from three
//! values of each quantity, with the others constant; H can't be held constant, so its effect is
//! removed with the exponent found for it. The prefactor is shown without a tolerance.
//!
//! The sphere is a cube whose core has a twenty-fifth of its side. It starts at the
//! surface, with the speed it would have there. The bed is of glass beads, five diameters
//! wide and four deep, with a periodic boundary along the channel.

use crate::verify::beads;
use crate::verify::blocks::{Block, PER_CELL};
use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::order::slope;
use crate::verify::run::{Answer, CaseError, Cost, Run};
use crate::verify::scenes::{GRAVITY, body};
use crate::verify::{Case, Effort, How};
use scree_solver::contact::law::damping_number;
use scree_solver::rigid::Body;
use scree_solver::scenario::Precision;
use scree_solver::simulation::Scene;
use serde_json::json;
use std::ops::ControlFlow;

pub(super) const CASE: Case = Case {
    name: "sphere-into-bed",
    number: "15",
    title: "depth a sphere comes to in a bed of glass beads",
    source: "d = (0.14/μ) (ρ_b/ρ)^½ D^⅔ H^⅓, measured (Uehara et al. 2003)",
    how: How::Runs(run),
};

/// A sphere and its fall to the surface.
#[derive(Debug, Clone, Copy)]
struct Drop {
    /// Density of the sphere [kg/m³].
    density: f64,
    /// Diameter of the sphere [m].
    diameter: f64,
    /// Fall to the surface [m].
    fall: f64,
}

/// Base drop; the others differ from it in one quantity.
const BASE: Drop = Drop {
    density: 2500.0,
    diameter: 0.02,
    fall: 0.1,
};
const DENSITIES: [f64; 2] = [1250.0, 5000.0];
const DIAMETERS: [f64; 2] = [0.012, 0.032];
const FALLS: [f64; 2] = [0.05, 0.2];
/// Cells per diameter.
const CELLS: [u32; 3] = [4, 6, 8];
/// Width and depth of the bed, in diameters.
const BED: [u32; 2] = [5, 4];
/// Upper bound of the duration [s].
const LONGEST: f64 = 0.5;

fn run(effort: Effort, findings: &mut Findings) {
    for &cells in effort.take(&CELLS, 1) {
        let label = format!("{cells} cells per diameter");
        let resolution = Resolution::sized(label, 1.0 / f64::from(cells));
        let exponent = |of: &str, exact: f64| {
            Question::new(format!("exponent of {of}"), "", exact).within(0.15)
        };
        let questions = [
            exponent("density", 0.5),
            exponent("diameter", 2.0 / 3.0),
            exponent("drop", 1.0 / 3.0),
            Question::new("prefactor × μ", "", 0.14),
            Question::new("depth over diameter, base", "", scaled(&BASE)),
        ];
        findings.take(&resolution, questions, exponents(cells));
    }
    for of in ["density", "diameter", "drop"] {
        findings.take_limit(&format!("exponent of {of}"));
    }
}

/// Depth over diameter by the formula: d³ ∝ d + fall, solved by iteration.
fn scaled(drop: &Drop) -> f64 {
    let mut depth = drop.diameter;
    for _ in 0..50 {
        depth = 0.14 * over_prefactor(drop, depth);
    }
    depth / drop.diameter
}

/// Depth over the prefactor [m].
fn over_prefactor(drop: &Drop, depth: f64) -> f64 {
    let density = (drop.density / beads::BULK_DENSITY).sqrt();
    let drop = drop.diameter.powf(2.0 / 3.0) * (drop.fall + depth).cbrt();
    density * drop / beads::FRICTION.0
}

/// The three exponents, the prefactor, and the depth of the base over its diameter.
fn exponents(cells: u32) -> Result<Answer<5>, CaseError> {
    let mut cost = Cost::default();
    let mut deep = |drop: Drop| -> Result<(Drop, f64), CaseError> {
        let answer = depth(&drop, cells)?;
        cost.wall_s += answer.cost.wall_s;
        Ok((drop, answer.values[0]))
    };
    let base = deep(BASE)?;
    let mut of_three = |others: [Drop; 2]| -> Result<[(Drop, f64); 3], CaseError> {
        Ok([deep(others[0])?, base, deep(others[1])?])
    };
    let falls = of_three(FALLS.map(|fall| Drop { fall, ..BASE }))?;
    let densities = of_three(DENSITIES.map(|density| Drop { density, ..BASE }))?;
    let diameters = of_three(DIAMETERS.map(|diameter| Drop { diameter, ..BASE }))?;
    let whole = |(drop, depth): &(Drop, f64)| (drop.fall + depth).ln();
    let of_drop = slope(&falls.map(|one| (whole(&one), one.1.ln())));
    let without_drop = |one: &(Drop, f64)| one.1.ln() - of_drop * whole(one);
    let of_density = slope(&densities.map(|one| (one.0.density.ln(), without_drop(&one))));
    let of_diameter = slope(&diameters.map(|one| (one.0.diameter.ln(), without_drop(&one))));
    let prefactor = base.1 / over_prefactor(&base.0, base.1);
    Ok(Answer {
        values: [
            of_density,
            of_diameter,
            of_drop,
            prefactor,
            base.1 / BASE.diameter,
        ],
        cost,
    })
}

/// Depth of the sphere's lowest point below the surface when it stops [m].
fn depth(drop: &Drop, cells: u32) -> Result<Answer<1>, CaseError> {
    let surface = f64::from(BED[1]) * drop.diameter;
    let mut run = Run::start(scene(drop, cells, surface)?)?;
    let mut stopped = false;
    run.watch(f64::INFINITY, |simulation, _| {
        if simulation.bodies()[0].velocity().z >= 0.0 {
            stopped = true;
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    })?;
    if !stopped {
        return Err(CaseError::Never("the sphere did not stop"));
    }
    let lowest = run.simulation.bodies()[0].state.position.z - 0.5 * drop.diameter;
    Ok(run.answer([surface - lowest]))
}

fn scene(drop: &Drop, cells: u32, surface: f64) -> Result<Scene, CaseError> {
    let speed = (2.0 * GRAVITY * drop.fall).sqrt();
    let [wide, deep] = BED.map(|diameters| diameters * cells);
    let block = Block {
        cell: drop.diameter / f64::from(cells),
        at: [0, 0, 0],
        cells: [wide, wide, deep],
        cells_across: wide,
        per_cell: PER_CELL,
        endless: true,
        material: beads::with_sound_speed(10.0 * speed),
        gravity: GRAVITY,
        expected_speed: speed,
        precision: Precision::Single,
        duration: LONGEST,
    };
    let mut scene = block.bed(beads::POISSONS_RATIO);
    let mut sphere = sphere(drop, speed)?;
    sphere.state.position = block.middle();
    sphere.state.position.z = surface + 0.5 * drop.diameter;
    if let Some(flow) = &scene.given.flow {
        sphere.flow_law = flow.contact_law(damping_number(0.0), beads::FRICTION.0);
    }
    scene.bodies.push(sphere);
    Ok(scene)
}

fn sphere(drop: &Drop, speed: f64) -> Result<Body, CaseError> {
    body(&json!({
        "shape": {"cube": {"side_m": drop.diameter}},
        "sphero_radius_m": 0.48 * drop.diameter,
        "density_kg_m3": drop.density,
        "position": {"downstream_m": 0.0, "elevation_m": 0.5},
        "velocity_m_s": [0.0, 0.0, -speed],
    }))
}
