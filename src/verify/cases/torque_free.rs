//! Case 5: boxes free of torque.
//!
//! A rounded box of sides 1 : 2 : 3 tumbles about its middle axis. Energy and
//! angular momentum are constant, and the angular velocity in body axes is given
//! by Jacobi's elliptic functions (Jacobi 1849; Landau & Lifshitz, Mechanics,
//! §37): with I₁ < I₂ < I₃ and 2 E I₂ < M²,
//!
//! ω₁ ∝ cn τ, ω₂ ∝ sn τ, ω₃ ∝ dn τ,  τ = t √((I₃ − I₂)(M² − 2 E I₁)/(I₁ I₂ I₃)),
//! k² = (I₂ − I₁)(2 E I₃ − M²)/((I₃ − I₂)(M² − 2 E I₁)).
//!
//! Twice per period 4 K(k) the spin about the middle axis changes its sign: the
//! box flips. Tolerances: order 1.9 in the step for spin and energy; the angular
//! momentum to rounding; the flip within 1 % of a period at the finest step. The
//! end is not at a symmetric instant of the period, where errors cancel.
//!
//! Its second part is a slender box that spins fast, [`slender`].

use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run};
use crate::verify::scenes::thrown_down;
use crate::verify::{Case, Effort, How};
use scree_solver::math::Vec3;
use scree_solver::rigid::{Body, InverseInertia};
use scree_solver::shape::SpheroPolyhedron;
use scree_solver::simulation::{Guards, Scene};
use serde_json::json;
use std::f64::consts::FRAC_PI_2;
use std::ops::ControlFlow;

mod slender;

pub(super) const CASE: Case = Case {
    name: "torque-free",
    number: "5",
    title: "a box of 1 : 2 : 3 tumbles about its middle axis, one of 1 : 1 : 20 spins",
    source: "Jacobi's elliptic functions and the symmetric top (Landau & Lifshitz, Mechanics, §33, §37)",
    how: How::Runs(run),
};

/// Spin about the axis of the largest inertia [rad/s].
const SPIN: f64 = 100.0;
/// Fraction of the distance to the separatrix.
const NEAR: f64 = 0.95;
/// End, in periods.
const PERIODS: f64 = 1.3;
/// Steps per period.
const STEPS: [u32; 5] = [600, 1200, 2400, 4800, 9600];

fn run(effort: Effort, findings: &mut Findings) {
    run_tumbling(effort, findings);
    slender::run(findings);
}

fn run_tumbling(effort: Effort, findings: &mut Findings) {
    let top = match body() {
        Ok(body) => Top::of(&body),
        Err(error) => {
            let question = Question::new("spin at the end", "rad/s", 0.0);
            return findings.take(&Resolution::named("none"), [question], Err(error));
        }
    };
    let steps = effort.take(&STEPS, 4);
    for &count in steps {
        let spin = top.spin(PERIODS * top.period()).norm();
        let over = |of, size| Error::Over { of, size };
        let zero = |quantity, unit| Question::new(quantity, unit, 0.0);
        let mut questions = [
            zero("spin, off at the end", "rad/s").by(over("of it", spin)),
            zero("energy drift", "J").by(over("of it", top.energy)),
            zero("angular momentum drift", "kg m²/s")
                .by(over("of it", top.momentum_squared.sqrt()))
                .within(1e-12),
            Question::new("time of the flip", "s", 0.5 * top.period())
                .by(over("periods", top.period())),
        ];
        if Some(&count) == steps.last() {
            questions[3].tolerance = Some(0.01);
        }
        let step = top.period() / f64::from(count);
        let resolution = Resolution::sized(format!("T/{count}"), step);
        findings.take(&resolution, questions, tumble(&top, step));
    }
    for quantity in ["spin, off at the end", "energy drift"] {
        findings.take_order(quantity, 1e-11, Some(1.9));
    }
    findings.take_order("time of the flip", 1e-9, None);
}

/// Error of the spin at the end, drift of energy and of angular momentum, time of the
/// flip.
fn tumble(top: &Top, step: f64) -> Result<Answer<4>, CaseError> {
    let end = PERIODS * top.period();
    let mut run = Run::start(scene(body()?, step, end)?)?;
    let start = run.simulation.bodies()[0].state.angular_momentum;
    let mut before = (0.0, 0.0);
    let mut flip = None;
    run.watch(end, |simulation, report| {
        let middle = spin_of(&simulation.bodies()[0])[MIDDLE];
        let (time, last) = before;
        if flip.is_none() && last * middle < 0.0 {
            flip = Some(time + (report.time_s - time) * last / (last - middle));
        }
        before = (report.time_s, middle);
        ControlFlow::Continue(())
    })?;
    let flip = flip.ok_or(CaseError::Never("the box never flipped"))?;
    let body = &run.simulation.bodies()[0];
    let off = (spin_of(body) - top.spin(end)).norm();
    let energy = body.kinetic_energy() - top.energy;
    let momentum = (body.state.angular_momentum - start).norm();
    Ok(run.answer([off, energy.abs(), momentum, flip]))
}

/// Axes of the box by their inertia: the longest side has the least.
const LEAST: usize = 2;
const MIDDLE: usize = 1;
const LARGEST: usize = 0;

fn spin_of(body: &Body) -> Vec3 {
    body.to_body(&body.angular_velocity())
}

fn body() -> Result<Body, CaseError> {
    let body = free_box([0.02, 0.04, 0.06], 0.002)?;
    let spin = Top::start(&body.inertia.diagonal());
    Ok(spinning(body, spin))
}

/// A rounded box of 1000 kg/m³ that does not move.
fn free_box(sides_m: [f64; 3], radius_m: f64) -> Result<Body, CaseError> {
    let mut scene = thrown_down(&json!({}))?;
    let mut body = scene.bodies.remove(0);
    let shape = SpheroPolyhedron::cuboid(sides_m, radius_m)
        .map_err(|error| CaseError::Scene(error.to_string()))?;
    let density = 1000.0;
    body.mass = density * shape.volume();
    body.inertia = shape.unit_inertia() * density;
    body.inverse_inertia = InverseInertia::of(&body.inertia)
        .ok_or_else(|| CaseError::Scene("a box without inertia".to_owned()))?;
    body.shape = shape;
    body.state.momentum = Vec3::zeros();
    body.state.springs.clear();
    Ok(body)
}

/// The same with a spin in body axes [rad/s].
fn spinning(mut body: Body, spin: Vec3) -> Body {
    body.state.angular_momentum = body.to_world(&(body.inertia * spin));
    body
}

fn scene(body: Body, step: f64, end: f64) -> Result<Scene, CaseError> {
    let mut scene = thrown_down(&json!({}))?;
    scene.bodies = vec![body];
    scene.given.planes.clear();
    scene.given.guards = Guards::ANY_SPEED;
    scene.given.timing.longest_substep = step;
    scene.given.timing.duration = end;
    Ok(scene)
}

/// The exact motion.
struct Top {
    energy: f64,
    momentum_squared: f64,
    /// Largest spins about the axes.
    amplitude: Vec3,
    /// τ over t [1/s].
    rate: f64,
    modulus: f64,
}

impl Top {
    /// Spin at the start: none about the middle axis, and about the axis of least inertia
    /// `NEAR` times the spin on the separatrix.
    fn start(inertia: &Vec3) -> Vec3 {
        let [i1, i2, i3] = [LEAST, MIDDLE, LARGEST].map(|axis| inertia[axis]);
        let least = NEAR * SPIN * (i3 * (i3 - i2) / (i1 * (i2 - i1))).sqrt();
        let mut spin = Vec3::zeros();
        (spin[LEAST], spin[LARGEST]) = (least, SPIN);
        spin
    }

    fn of(body: &Body) -> Self {
        let inertia = body.inertia.diagonal();
        let spin = Self::start(&inertia);
        let [i1, i2, i3] = [LEAST, MIDDLE, LARGEST].map(|axis| inertia[axis]);
        let momentum_squared = inertia.component_mul(&spin).norm_squared();
        let twice_energy = inertia.component_mul(&spin).dot(&spin);
        let below = twice_energy * i3 - momentum_squared;
        let above = momentum_squared - twice_energy * i1;
        let mut amplitude = spin;
        amplitude[MIDDLE] = (below / (i2 * (i3 - i2))).sqrt();
        Self {
            energy: 0.5 * twice_energy,
            momentum_squared,
            amplitude,
            rate: ((i3 - i2) * above / (i1 * i2 * i3)).sqrt(),
            modulus: ((i2 - i1) * below / ((i3 - i2) * above)).sqrt(),
        }
    }

    /// Period of the spin [s]: 4 K(k) in τ.
    fn period(&self) -> f64 {
        let complement = (1.0 - self.modulus * self.modulus).sqrt();
        4.0 * FRAC_PI_2 / mean(1.0, complement) / self.rate
    }

    /// Spin in body axes at a time [rad/s].
    fn spin(&self, time: f64) -> Vec3 {
        let [sn, cn, dn] = jacobi(self.rate * time, self.modulus);
        let mut factor = Vec3::zeros();
        (factor[LEAST], factor[MIDDLE], factor[LARGEST]) = (cn, self.hand() * sn, dn);
        self.amplitude.component_mul(&factor)
    }

    /// The axes in the order least, middle, largest are a left-handed frame.
    fn hand(&self) -> f64 {
        -1.0
    }
}

/// Arithmetic-geometric mean (Abramowitz & Stegun 17.6).
fn mean(mut a: f64, mut b: f64) -> f64 {
    while (a - b).abs() > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

/// sn, cn and dn by descending means (Abramowitz & Stegun 16.4).
fn jacobi(argument: f64, modulus: f64) -> [f64; 3] {
    let mut levels = vec![(1.0, modulus)];
    let (mut a, mut b) = (1.0, (1.0 - modulus * modulus).sqrt());
    while levels[levels.len() - 1].1 > 1e-16 && levels.len() < 20 {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        levels.push((a, c));
    }
    let doublings = levels.len() as i32 - 1;
    let mut phase = 2f64.powi(doublings) * a * argument;
    for &(a, c) in levels[1..].iter().rev() {
        phase = 0.5 * (phase + (c / a * phase.sin()).asin());
    }
    let (sn, cn) = phase.sin_cos();
    [sn, cn, (1.0 - (modulus * sn).powi(2)).sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    // Abramowitz & Stegun, example 16.4: sn(0.20 | m 0.81) = 0.19762.
    #[test]
    fn jacobis_functions_are_those_of_the_tables() {
        let [sn, cn, dn] = jacobi(0.2, 0.9);
        assert!((sn - 0.197_62).abs() < 5e-6, "{sn}");
        assert!((cn * cn + sn * sn - 1.0).abs() < 1e-15);
        assert!((dn * dn + 0.81 * sn * sn - 1.0).abs() < 1e-15);
        // A modulus of 0 leaves sine and cosine.
        assert!((jacobi(PI / 6.0, 0.0)[0] - 0.5).abs() < 1e-15);
    }
}
