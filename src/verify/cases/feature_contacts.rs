//! Case 7: contacts of vertices, edges and faces between bodies.
//!
//! **Sliding.** A cube that stands on a vertex slides over another one at a constant
//! depth below the level of its top: over the face, across a rim, or along a rim and across
//! its end, a vertex. The contact follows from the geometry: over the face the distance of the
//! cores is
//! d = R − δ, at c beyond the rim it is √(d² + c²), so energy and force are those of *one*
//! Hertz contact (Hertz 1882) throughout,
//!
//! U/U₀ = ((R − √(d² + c²))/δ)^2.5,   F/F₀ = ((R − √(d² + c²))/δ)^1.5,
//!
//! 1 on the face, continuous over rim and vertex. Tolerance: 1e-9.
//!
//! **Colliding.** A cube and a tetrahedron collide at 1 m/s, with random orientations and
//! spins, without damping and friction. Energy, momentum and angular
//! momentum are conserved (Newton 1687). Tolerances: 1e-6 of the energy in steps of
//! 10 µs and less (an impact takes some 3 ms) and in the solver's own steps, and
//! 1e-12 of the momenta at every step. No order is asked for: the sequence of contacts
//! in a tumbling collision depends on the step.

use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Cost, Run};
use crate::verify::scenes::{body, on_vertex, thrown_down};
use crate::verify::{Case, Effort, How};
use scree_solver::contact::body_body::{ContactPair, Contacts, Separation, pair_law};
use scree_solver::contact::law::ContactLaw;
use scree_solver::math::Vec3;
use scree_solver::rigid::{Body, InverseInertia};
use scree_solver::shape::{ConvexPolyhedron, SpheroPolyhedron};
use scree_solver::simulation::{Scene, Simulation};
use serde_json::json;
use std::ops::ControlFlow;
use std::time::Instant;

pub(super) const CASE: Case = Case {
    name: "feature-contacts",
    number: "7",
    title: "contacts of vertices, edges and faces between bodies",
    source: "one Hertz contact all along (Hertz 1882); conservation in an undamped collision",
    how: How::Runs(run),
};

const SIDE: f64 = 0.04;
const RADIUS: f64 = 0.004;
/// Depth below the level of the top [m].
const OVERLAP: f64 = 2e-4;
/// Half the side of the core's top [m].
const RIM: f64 = 0.5 * SIDE - RADIUS;

fn run(effort: Effort, findings: &mut Findings) {
    for (word, along_rim) in [("rim", false), ("vertex", true)] {
        for beyond in [-5e-3f64, -1e-6, 0.0, 1e-6, 2e-4, 5e-4, 1e-3] {
            let resolution = Resolution::named(format!("{:.3} mm past the {word}", beyond * 1e3));
            let distance = 2.0 * RADIUS - OVERLAP;
            let left = 2.0 * RADIUS - distance.hypot(beyond.max(0.0));
            let share = left.max(0.0) / OVERLAP;
            let questions = [("energy", 2.5), ("force", 1.5)].map(|(what, power)| {
                let quantity = format!("{what} over one contact's");
                let question = Question::new(quantity, "", share.powf(power));
                question.by(Error::Absolute).within(1e-9)
            });
            findings.take(&resolution, questions, slid(beyond, along_rim));
        }
    }
    let collisions = *effort.take(&[10, 100], 1).last().unwrap_or(&10);
    for step in [2e-5, 1e-5, 5e-6] {
        let resolution = Resolution::sized(format!("{:.0} µs", step * 1e6), step);
        let mut energy = question("energy");
        if step < 2e-5 {
            energy = energy.within(1e-6);
        }
        let momenta = ["momentum", "angular momentum"].map(|what| question(what).within(1e-12));
        let [linear, angular] = momenta;
        let answer = collided(collisions, step);
        findings.take(&resolution, [energy, linear, angular], answer);
    }
    let energy = question("energy, own steps").within(1e-6);
    let answer = collided(collisions, 1.0).map(|answer| Answer {
        values: [answer.values[0]],
        cost: answer.cost,
    });
    findings.take(
        &Resolution::named("as the solver chooses"),
        [energy],
        answer,
    );
}

fn question(of: &str) -> Question {
    Question::new(format!("largest change of {of}"), "", 0.0).by(Error::Absolute)
}

/// A cube about the origin, without damping and friction.
fn cube(orientation: [f64; 4]) -> Result<Body, CaseError> {
    let mut body = body(&json!({"shape": {"cube": {"side_m": SIDE}},
        "sphero_radius_m": RADIUS, "contact_modulus_pa": 1e8, "restitution": 1.0,
        "friction": 0.0, "orientation": orientation,
        "position": {"downstream_m": 0.5, "elevation_m": 0.5}}))?;
    body.state.position = Vec3::zeros();
    Ok(body)
}

/// A cube on a vertex over one that lies flat.
struct Slide {
    below: Body,
    above: Body,
    law: ContactLaw,
    /// Height of the upper centre [m].
    height: f64,
}

impl Slide {
    fn new() -> Result<Self, CaseError> {
        let (below, above) = (cube([1.0, 0.0, 0.0, 0.0])?, cube(on_vertex())?);
        let reach = above.shape.extent_along(&above.to_body(&-Vec3::z()));
        Ok(Self {
            law: pair_law(&below, &above),
            height: 0.5 * SIDE + reach - OVERLAP,
            below,
            above,
        })
    }

    /// Energy and force on the upper cube over those of one contact, `beyond` a rim
    /// of the top or, along it, beyond its end.
    fn at(&mut self, beyond: f64, along_rim: bool) -> (f64, Vec3) {
        let across = if along_rim { RIM } else { 0.3 * RIM };
        self.above.state.position = Vec3::new(RIM + beyond, across, self.height);
        let mut contact_pair = ContactPair::new([0, 1]);
        let both = [&self.below, &self.above];
        let mut found = Contacts::default();
        contact_pair.find(both, &self.law, &mut Separation::default(), &mut found);
        contact_pair.touch(both, &self.law, &mut found, 0.0);
        (
            contact_pair.energy / self.law.elastic_energy(OVERLAP),
            contact_pair.push.force / self.law.elastic_force(OVERLAP),
        )
    }
}

/// For a picture: distance from 1 mm before a rim on [mm]; energy, upward force and
/// outward force over energy and force of one contact on the face.
///
/// # Errors
/// The scene is refused.
pub fn slide_over_a_rim() -> Result<Vec<(f64, [f64; 3])>, CaseError> {
    let mut slide = Slide::new()?;
    let place = |n: i32| {
        let beyond = 2e-5 * f64::from(n);
        let (energy, force) = slide.at(beyond, false);
        (beyond * 1e3 + 1.0, [energy, force.z, force.x])
    };
    Ok((-50..=100).map(place).collect())
}

fn slid(beyond: f64, along_rim: bool) -> Result<Answer<2>, CaseError> {
    let started = Instant::now();
    let (energy, force) = Slide::new()?.at(beyond, along_rim);
    Ok(Answer {
        values: [energy, force.norm()],
        cost: Cost {
            wall_s: started.elapsed().as_secs_f64(),
            point_steps_per_s: None,
        },
    })
}

/// Largest relative changes of energy, momentum and angular momentum, over this number of
/// collisions in steps no longer than `step` [s].
fn collided(collisions: u32, step: f64) -> Result<Answer<3>, CaseError> {
    let mut numbers = Numbers(0.3);
    let mut worst = [0.0f64; 3];
    let mut cost = Cost::default();
    for _ in 0..collisions {
        let answer = collision(&mut numbers, step)?;
        for (worst, value) in worst.iter_mut().zip(answer.values) {
            *worst = worst.max(value);
        }
        cost.wall_s += answer.cost.wall_s;
    }
    Ok(Answer {
        values: worst,
        cost,
    })
}

fn collision(numbers: &mut Numbers, step: f64) -> Result<Answer<3>, CaseError> {
    let mut run = Run::start(flying(numbers, step)?)?;
    let start = totals(&run.simulation);
    let mut touched = false;
    run.watch(0.1, |simulation, _| {
        touched |= simulation.contact_pairs().iter().any(ContactPair::touches);
        ControlFlow::Continue(())
    })?;
    if !touched {
        return Err(CaseError::Never("the bodies flew past each other"));
    }
    let end = totals(&run.simulation);
    let momentum = run.simulation.bodies()[1].mass;
    Ok(run.answer([
        (end.energy / start.energy - 1.0).abs(),
        (end.linear - start.linear).norm() / momentum,
        (end.angular - start.angular).norm() / (momentum * APART),
    ]))
}

/// Distance at the start [m].
const APART: f64 = 0.09;

fn flying(numbers: &mut Numbers, step: f64) -> Result<Scene, CaseError> {
    let mut scene = thrown_down(&json!({}))?;
    scene.given.planes.clear();
    scene.given.timing.longest_substep = step;
    scene.bodies = vec![cube(numbers.orientation())?, cube(numbers.orientation())?];
    tetrahedron(&mut scene.bodies[1])?;
    for body in &mut scene.bodies {
        let spin = numbers.vector() * 10.0;
        body.state.angular_momentum = body.to_world(&(body.inertia * body.to_body(&spin)));
    }
    let way = numbers.vector().normalize();
    let thrown = &mut scene.bodies[1];
    thrown.state.position = way * APART + numbers.vector() * 0.01;
    thrown.state.momentum = way * -thrown.mass;
    Ok(scene)
}

/// Makes a body a rounded regular tetrahedron of the same density, with a core of 5 cm
/// edge length.
fn tetrahedron(body: &mut Body) -> Result<(), CaseError> {
    let density = body.mass / body.shape.volume();
    let corner = 0.05 / 8f64.sqrt();
    let vertices = [[1., 1., 1.], [1., -1., -1.], [-1., 1., -1.], [-1., -1., 1.]];
    let loops = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    let vertices = vertices.map(|v| Vec3::from(v) * corner).to_vec();
    let refused = |error: scree_solver::shape::ShapeError| CaseError::Scene(error.to_string());
    let core = ConvexPolyhedron::new(vertices, loops.map(Vec::from).to_vec()).map_err(refused)?;
    body.shape = SpheroPolyhedron::from_core(core, RADIUS).map_err(refused)?;
    body.mass = density * body.shape.volume();
    body.inertia = body.shape.unit_inertia() * density;
    let inverse = InverseInertia::of(&body.inertia);
    body.inverse_inertia = inverse.ok_or(CaseError::Never("a solid without inertia"))?;
    Ok(())
}

struct Sums {
    energy: f64,
    linear: Vec3,
    angular: Vec3,
}

fn totals(simulation: &Simulation) -> Sums {
    let bodies = simulation.bodies();
    let held = simulation
        .contact_pairs()
        .iter()
        .map(|contact_pair| contact_pair.energy);
    let about_origin =
        |body: &Body| body.state.position.cross(&body.state.momentum) + body.state.angular_momentum;
    Sums {
        energy: bodies.iter().map(Body::kinetic_energy).sum::<f64>() + held.sum::<f64>(),
        linear: bodies.iter().map(|body| body.state.momentum).sum(),
        angular: bodies.iter().map(about_origin).sum(),
    }
}

/// Numbers in −1 … 1 that look random (Weyl's sequence).
struct Numbers(f64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = (self.0 + 0.754_877_666_246_692_7).fract();
        (self.0 * 12.345).fract() * 2.0 - 1.0
    }

    fn orientation(&mut self) -> [f64; 4] {
        let mut q = [0.0; 4].map(|_: f64| self.next());
        let length = q.iter().map(|part| part * part).sum::<f64>().sqrt();
        q.iter_mut().for_each(|part| *part /= length);
        q
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }
}
