//! A box of 1 : 1 : 20 that spins fast about its length, and precesses.
//!
//! Two of its moments of inertia are equal, so its rotation is known (Landau & Lifshitz,
//! Mechanics, §33): about the angular momentum H with |H|/I across its length, and additionally
//! about
//! its length with (1 − I_l/I) ω_l. Splitting integrates it exactly; only rounding over
//! some 80,000 sub-steps is left: 3e-14 if it accumulates at random. H is 42 times as large
//! across the length as along it, so a tilt changes the spin along it by 42 times as much,
//! and over 4,000 rad that amounts to 5e-9. Tolerances: twenty times that for the orientation, 1e-9
//! for the energy.

use super::{free_box, scene, spinning};
use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run};
use scree_solver::math::Vec3;
use scree_solver::rigid::Body;

/// Spin at the start, in body axes; z is along its length [rad/s].
const SPIN: Vec3 = Vec3::new(300.0, 300.0, 2000.0);
/// End [s].
const END: f64 = 2.0;
/// Step, which the body divides into its own [s].
const STEP: f64 = 1e-3;
const ORIENTATION: f64 = 1e-7;
const ENERGY: f64 = 1e-9;

pub(super) fn run(findings: &mut Findings) {
    let resolution = Resolution::named("own steps");
    let zero = |quantity, unit, tolerance| Question::new(quantity, unit, 0.0).within(tolerance);
    let over = |of, size| Error::Over { of, size };
    let start = match body() {
        Ok(body) => body,
        Err(error) => {
            let question = zero("slender: orientation, off at the end", "rad", ORIENTATION);
            return findings.take(&resolution, [question], Err(error));
        }
    };
    let angular_momentum = start.state.angular_momentum.norm();
    let questions = [
        zero("slender: orientation, off at the end", "rad", ORIENTATION).by(Error::Absolute),
        zero("slender: energy drift", "J", ENERGY).by(over("of it", start.kinetic_energy())),
        zero("slender: angular momentum drift", "kg m²/s", 1e-12)
            .by(over("of it", angular_momentum)),
    ];
    findings.take(&resolution, questions, spin(&start));
}

fn body() -> Result<Body, CaseError> {
    Ok(spinning(free_box([0.01, 0.01, 0.2], 0.001)?, SPIN))
}

fn spin(start: &Body) -> Result<Answer<3>, CaseError> {
    let mut run = Run::start(scene(start.clone(), STEP, END)?)?;
    run.to(END)?;
    let body = &run.simulation.bodies()[0];
    let energy = body.kinetic_energy() - start.kinetic_energy();
    let momentum = body.state.angular_momentum - start.state.angular_momentum;
    Ok(run.answer([off(start, body), energy.abs(), momentum.norm()]))
}

/// Largest angle between the axes of the two orientations, for two of the axes [rad].
fn off(start: &Body, end: &Body) -> f64 {
    let (across, along) = (start.inertia.m11, start.inertia.m33);
    let own = Vec3::z() * (SPIN.z * (1.0 - along / across) * END);
    let whole = start.state.angular_momentum * (END / across);
    let offs = [Vec3::x(), Vec3::z()].map(|axis| {
        let wanted = rotated(&start.to_world(&rotated(&axis, &own)), &whole);
        (end.to_world(&axis) - wanted).norm()
    });
    offs[0].max(offs[1])
}

/// A vector rotated about another, by its length as an angle [rad] (Rodrigues).
fn rotated(v: &Vec3, turn: &Vec3) -> Vec3 {
    let (sin, cos) = turn.norm().sin_cos();
    let about = turn.normalize();
    v * cos + about.cross(v) * sin + about * (about.dot(v) * (1.0 - cos))
}
