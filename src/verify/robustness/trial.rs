//! One robustness scene, run and checked.

use crate::verify::run::{CaseError, scenario_of};
use scree_solver::contact::point_body::Around;
use scree_solver::math::Vec3;
use scree_solver::simulation::Scene;
use scree_solver::{Simulation, StepError};
use serde::{Serialize, Serializer};
use serde_json::Value;
use std::fmt;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// Largest relative error of mass: rounding only.
const MASS: f64 = 1e-9;
/// Largest relative error of linear momentum (case 14).
const MOMENTUM: f64 = 1e-6;
/// Largest rise of the mechanical energy, over the sum of the initial and the largest
/// kinetic energy.
const ENERGY: f64 = 0.02;
/// Largest overlap of point and body δ/(R_p + r): at 1 the point is at the core.
const OVERLAP: f64 = 1.0;
/// Overlap of bodies over the sphero radius beyond which a run ends.
const BODY_OVERLAP: f64 = 0.9;
/// Largest speed, over that of a fall from the highest place and the fastest throw together:
/// an elastic impact on a lighter body at most doubles it.
const SPEED: f64 = 2.0;
/// Distance by which a point of single precision may miss the surface [cells].
const ROUNDING: f64 = 1e-4;
/// Cost of a sub-step and of a body sub-step, in point-steps.
const OF_ITSELF: u64 = 300;
const OF_A_BODY: u64 = 200;
/// Multiple of the budget at which a step is broken off.
const PATIENCE: u64 = 4;
/// Number of checks of points and bodies during a run.
const LOOKS: u32 = 8;

/// A scene and its budget.
#[derive(Debug, Clone)]
pub struct Trial {
    /// Name within its family.
    pub name: String,
    /// The scenario.
    pub scenario: Value,
    /// Change to the scene that no scenario can express.
    pub alter: Option<fn(&mut Scene)>,
    /// Required end.
    pub asked: Asked,
    /// Budget in point-steps, including the cost of sub-steps and body sub-steps; none:
    /// unlimited.
    pub budget: Option<u64>,
    /// Allowed rise of the mechanical energy, over the sum of the initial
    /// and the largest kinetic energy.
    pub energy_made: f64,
}

/// Required end of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asked {
    /// Finished.
    Finish,
    /// Finished, or with a typed error: the scene is beyond the limits of the computation.
    Orderly,
    /// Refused before it starts.
    Refusal,
}

impl Trial {
    /// A scene that must finish.
    pub fn new(name: impl Into<String>, scenario: Value) -> Self {
        Self {
            name: name.into(),
            scenario,
            alter: None,
            asked: Asked::Finish,
            budget: None,
            energy_made: ENERGY,
        }
    }

    /// The same scene with another required end.
    #[must_use]
    pub fn asking(mut self, asked: Asked) -> Self {
        self.asked = asked;
        self
    }

    /// The same scene with a change that no scenario can express.
    #[must_use]
    pub fn altered(mut self, alter: fn(&mut Scene)) -> Self {
        self.alter = Some(alter);
        self
    }

    /// Sets the scene up.
    pub(super) fn start(&self) -> Result<Simulation, CaseError> {
        let scenario = scenario_of(&self.scenario)?;
        Ok(match self.alter {
            None => Simulation::new(&scenario, 1)?,
            Some(alter) => {
                let mut scene = Scene::whole(&scenario)?;
                alter(&mut scene);
                Simulation::of_scene(scene, 1)?
            }
        })
    }
}

/// End of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum Ended {
    /// At the end of its duration, or of its budget.
    Finished,
    /// By a guard of the solver.
    Failed(StepError),
    /// Refused before it began.
    Refused(String),
    /// Panicked, which must never happen.
    Panicked(String),
}

impl Ended {
    /// True if the run finished.
    pub fn is_finished(&self) -> bool {
        *self == Self::Finished
    }
}

impl fmt::Display for Ended {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finished => write!(to, "finished"),
            Self::Failed(error) => write!(to, "{error}"),
            Self::Refused(why) => write!(to, "refused: {why}"),
            Self::Panicked(words) => write!(to, "PANIC: {words}"),
        }
    }
}

impl Serialize for Ended {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Figures found by the checks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Figures {
    /// Points at the start.
    pub points: u64,
    /// Sub-steps taken.
    pub substeps: u64,
    /// Relative error of mass.
    pub mass: f64,
    /// Linear momentum residual.
    pub momentum: f64,
    /// Angular momentum residual.
    pub angular_momentum: f64,
    /// Largest rise of the energy over the energy scale.
    pub energy: f64,
    /// Largest overlap of point and body over R_p + r.
    pub overlap: f64,
    /// Largest overlap of bodies with walls and each other over r.
    pub body_overlap: f64,
    /// Largest number of points in the core of a body at any check.
    pub inside: u64,
    /// Number of penetration corrections to a body's surface.
    pub penetration_correction: u64,
    /// Points that left through the open end.
    pub left: u64,
    /// Points that are neither present nor left.
    pub lost: u64,
    /// Largest speed over the largest that falling and throwing give; for a light body over
    /// half of the speed that the energy of all bodies could give it.
    pub speed: f64,
    /// True if every position and velocity is finite.
    pub finite: bool,
}

/// A comparison made by a family: ends of its runs, and figures with their
/// bounds.
#[derive(Debug, Clone)]
pub struct Special {
    /// Ends of its runs.
    pub ended: Ended,
    /// Comparisons made.
    pub compared: Vec<Compared>,
}

/// A figure with its bound.
#[derive(Debug, Clone, Serialize)]
pub struct Compared {
    /// Quantity compared.
    pub what: String,
    /// Value found.
    pub found: f64,
    /// Largest size allowed; none: only reported.
    pub bound: Option<f64>,
}

/// A robustness test and its result.
#[derive(Debug, Clone, Serialize)]
pub struct TrialReport {
    /// Family and name.
    pub case: String,
    /// End of the run.
    pub ended: Ended,
    /// Figures found; none if the run did not start.
    pub figures: Option<Figures>,
    /// Largest stable step over the chosen one; a lower bound if it is the last tried.
    pub safety: Option<f64>,
    /// Findings of comparisons.
    pub compared: Vec<Compared>,
    /// Wall time [s].
    pub wall_s: f64,
    /// Rules broken; none if the result is valid.
    pub broken: Vec<String>,
}

impl TrialReport {
    /// True if no rule is broken.
    pub fn is_valid(&self) -> bool {
        self.broken.is_empty()
    }
}

/// Runs a scene to its end.
pub fn run(family: &str, trial: &Trial) -> TrialReport {
    let started = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(|| watched(trial)));
    let (ended, figures) = outcome.unwrap_or_else(|panic| (Ended::Panicked(words(&*panic)), None));
    TrialReport {
        case: format!("{family}: {}", trial.name),
        broken: broken((trial.asked, trial.energy_made), &ended, figures.as_ref()),
        ended,
        figures,
        safety: None,
        compared: Vec::new(),
        wall_s: started.elapsed().as_secs_f64(),
    }
}

/// Makes a comparison.
pub fn compared(family: &str, name: &str, compare: fn() -> Special) -> TrialReport {
    let started = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(compare));
    let special = outcome.unwrap_or_else(|panic| Special {
        ended: Ended::Panicked(words(&*panic)),
        compared: Vec::new(),
    });
    let mut broken = broken((Asked::Finish, ENERGY), &special.ended, None);
    for one in &special.compared {
        let within = one.bound.is_none_or(|bound| one.found.abs() <= bound);
        if !within || !one.found.is_finite() {
            broken.push(one.what.clone());
        }
    }
    TrialReport {
        case: format!("{family}: {name}"),
        ended: special.ended,
        figures: None,
        safety: None,
        compared: special.compared,
        wall_s: started.elapsed().as_secs_f64(),
        broken,
    }
}

fn words(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("without words").to_owned()
}

fn watched(trial: &Trial) -> (Ended, Option<Figures>) {
    let mut simulation = match trial.start() {
        Ok(simulation) => simulation,
        Err(error) => return (Ended::Refused(error.to_string()), None),
    };
    let mut figures = Figures {
        points: simulation.released_points(),
        finite: true,
        ..Figures::default()
    };
    let duration = trial.scenario["duration_s"].as_f64().unwrap_or(0.0);
    let (mut spent, mut amid_step) = (0, false);
    let mut ended = Ended::Finished;
    look(&simulation, &mut figures);
    for part in 1..=LOOKS {
        let until = duration * f64::from(part) / f64::from(LOOKS);
        let went = simulation.run(until, |simulation, report| {
            let bodies = 0..simulation.bodies().len();
            let own = bodies.map(|body| u64::from(simulation.body_report(body).substeps));
            spent += OF_ITSELF + report.points + OF_A_BODY * own.sum::<u64>();
            amid_step = !report.step_ended;
            let over = |times| trial.budget.is_some_and(|budget| spent > times * budget);
            if over(PATIENCE) || over(1) && report.step_ended {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        if let Err(error) = went {
            ended = Ended::Failed(error);
            break;
        }
        // In the middle of a step the points' motion is still on the grid.
        if !amid_step {
            look(&simulation, &mut figures);
        }
        if trial.budget.is_some_and(|budget| spent > budget) {
            break;
        }
    }
    close_books(&simulation, &mut figures);
    (ended, Some(figures))
}

/// Checks every point and body.
fn look(simulation: &Simulation, figures: &mut Figures) {
    let mut fastest = 0.0f64;
    let mut finite = true;
    simulation.visit_points(None, |point| {
        fastest = fastest.max(point.velocity.norm());
        finite &= point.position.sum().is_finite() && point.velocity.sum().is_finite();
    });
    let (mut inside, slack) = (0, ROUNDING * simulation.cell_size_m());
    let free = simulation.bodies().iter().filter(|body| body.is_free());
    let free_mass: f64 = free.map(|body| body.mass).sum();
    for body in simulation.bodies() {
        // Speed of the energy without rotation: the speed of a rotating corner
        // depends on the shape. Heavy bodies may give a light one all of their energy.
        let speed = (2.0 * body.kinetic_energy() / body.mass).sqrt();
        let lighter = ((free_mass / body.mass).sqrt() / SPEED).max(1.0);
        fastest = fastest.max(speed / lighter);
        finite &= body.non_finite().is_none();
        let radius = body.shape.sphero_radius();
        simulation.visit_points(Some(&Around::body(body, 0.0)), |point| {
            let deep = body.distance_to(&point.position) + radius < -slack;
            inside += u64::from(deep);
        });
    }
    figures.inside = figures.inside.max(inside);
    figures.finite &= finite;
    figures.speed = figures.speed.max(fastest / simulation.speed_given());
}

fn close_books(simulation: &Simulation, figures: &mut Figures) {
    let audit = simulation.audit();
    let present = simulation.point_count() as u64 + audit.points_outflow;
    figures.substeps = simulation.counts().1;
    figures.mass = audit.mass_error;
    figures.momentum = audit.momentum_residual;
    figures.angular_momentum = audit.angular_momentum_residual;
    figures.energy = if audit.energy_rise() > 0.0 {
        audit.energy_rise() / audit.energy_scale()
    } else {
        0.0
    };
    figures.overlap = audit.deepest_overlap_ratio;
    figures.body_overlap = audit.deepest_body_overlap_ratio;
    figures.penetration_correction = audit.penetration_corrections;
    figures.left = audit.points_outflow;
    figures.lost = simulation.released_points().abs_diff(present);
}

/// Rules broken by a run with this required end and this allowed rise of energy.
fn broken(
    (asked, energy_made): (Asked, f64),
    ended: &Ended,
    figures: Option<&Figures>,
) -> Vec<String> {
    let mut broken = Vec::new();
    let as_asked = match (asked, ended) {
        (_, Ended::Panicked(_)) => false,
        (Asked::Refusal, ended) => matches!(ended, Ended::Refused(_)),
        (Asked::Orderly, ended) => !matches!(ended, Ended::Refused(_)),
        (Asked::Finish, ended) => ended.is_finished(),
    };
    if !as_asked {
        broken.push("its end".to_owned());
    }
    // The results of a run that ended early are no answer.
    let Some(found) = figures.filter(|_| ended.is_finished()) else {
        return broken;
    };
    let bounds = [
        ("mass", found.mass, MASS),
        ("momentum", found.momentum, MOMENTUM),
        ("energy", found.energy, energy_made),
        ("points inside a body", found.inside as f64, 0.0),
        ("points lost", found.lost as f64, 0.0),
        ("overlap of points", found.overlap, OVERLAP),
        ("overlap of bodies", found.body_overlap, BODY_OVERLAP),
        ("speed", found.speed, SPEED),
        ("a number", f64::from(u8::from(!found.finite)), 0.0),
    ];
    for (what, value, bound) in bounds {
        if value.is_nan() || value > bound {
            broken.push(what.to_owned());
        }
    }
    broken
}

/// Centre of mass of the flow [m].
pub(super) fn centre(simulation: &Simulation) -> Vec3 {
    let (mut mass, mut first) = (0.0, Vec3::zeros());
    simulation.visit_points(None, |point| {
        mass += point.mass;
        first += point.position * point.mass;
    });
    first / mass
}
