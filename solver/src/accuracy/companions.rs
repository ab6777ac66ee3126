//! Which runs stand behind a band (docs/method.md, section 13).

use crate::error::SetupError;
use crate::record::Role;
use crate::scenario::{Accuracy, Scenario};
use crate::simulation::Simulation;

/// A companion's cell size over the answer's, and the range within which one that is done
/// already serves as well.
struct Place {
    factor: f64,
    least: f64,
    most: f64,
}

/// Cells of a companion over those of the answer, at most.
pub(super) const FARTHEST: f64 = 2.7;
/// Largest cells first: with the softer run together 0.19 of the answer's cost. More of
/// them make bands no narrower.
const COARSE: Place = Place {
    factor: 2.5,
    least: 2.1,
    most: FARTHEST,
};
/// The finer companion, beside which there is a softer run.
const FINE: Place = Place {
    factor: 1.75,
    least: 1.45,
    most: 2.1,
};
/// Sound speed of the softer run over the answer's: it costs half as much.
pub(super) const SOFTER: f64 = 0.5;
/// Cells across the thinnest body, at least.
const FEWEST_PER_BODY: f64 = 0.75;
/// Cells across the release, at least.
const FEWEST_PER_RELEASE: f64 = 1.0;

/// A run to be made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rung {
    /// What it is for.
    pub role: Role,
    /// Cell size [m].
    pub cell_size_m: f64,
}

impl Rung {
    /// Expected point-steps over those of another cell size: points go with the
    /// inverse cube of the cells, sub-steps with the inverse, and with the speed of
    /// sound.
    pub(super) fn cost_over(&self, cell_size_m: f64) -> f64 {
        let softer = match self.role {
            Role::Softer => SOFTER,
            Role::Coarser | Role::Answer => 1.0,
        };
        softer * (cell_size_m / self.cell_size_m).powi(4)
    }
}

/// What of a scene bounds its cells, and what they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extent {
    /// Least width of the thinnest body [m]; `None` without bodies.
    pub(super) thinnest_m: Option<f64>,
    /// Thickness of the release, or 0 without a flow [m].
    pub(super) release_m: f64,
    /// Width of the channel [m].
    pub(super) width_m: f64,
    /// Cells of the plain answer [m].
    pub(super) cell_size_m: f64,
    /// √(K/ρ) of the plain answer [m/s], or 0 without a flow.
    pub(super) sound_speed_m_s: f64,
    /// Whether the scenario names the stiffness of its material.
    pub(super) stiffness_is_given: bool,
}

impl Extent {
    pub(super) fn of(scenario: &Scenario) -> Result<Self, SetupError> {
        let (cell_size_m, sound_speed_m_s) = Simulation::resolution(scenario)?;
        let bodies = 0..scenario.bodies.len();
        let flow = scenario.flow.as_ref();
        Ok(Self {
            thinnest_m: bodies
                .map(|body| scenario.shape_of(body).least_width())
                .reduce(f64::min),
            release_m: flow.map_or(0.0, |flow| flow.release.height_m),
            width_m: scenario.channel.width_m,
            cell_size_m,
            sound_speed_m_s: sound_speed_m_s.unwrap_or(0.0),
            stiffness_is_given: flow.is_some_and(|flow| flow.material.youngs_modulus_pa.is_some()),
        })
    }

    /// The largest cells that tell anything [m].
    pub(super) fn coarsest(&self) -> f64 {
        let of_body = self.thinnest_m.unwrap_or(f64::INFINITY) / FEWEST_PER_BODY;
        of_body
            .min(self.release_m / FEWEST_PER_RELEASE)
            .min(self.width_m)
    }

    /// What its cells are to be compared with [m]: the width of the thinnest body, or the
    /// thickness of the release without bodies.
    pub(super) fn across_m(&self) -> f64 {
        self.thinnest_m.unwrap_or(self.release_m)
    }

    /// Cells across the thinnest body.
    pub(super) fn cells_per_body(&self, cell_size_m: f64) -> Option<f64> {
        self.thinnest_m.map(|thinnest| thinnest / cell_size_m)
    }
}

/// The companions that an answer needs beside runs that are done, cheap ones first. One
/// with too large cells is left out, but the finer never is.
pub(super) fn companions(extent: &Extent, done: &[Rung]) -> Vec<Rung> {
    let coarser = |cell_size_m: f64| Rung {
        role: Role::Coarser,
        cell_size_m,
    };
    let mut rungs = Vec::new();
    let size = COARSE.factor * extent.cell_size_m;
    if size <= extent.coarsest() && COARSE.among(done, extent).is_none() {
        rungs.push(coarser(size));
    }
    let fine = FINE.among(done, extent).unwrap_or_else(|| {
        let fine = coarser(FINE.factor * extent.cell_size_m);
        rungs.push(fine);
        fine
    });
    if !extent.stiffness_is_given && !has_a_softer(done, extent) {
        rungs.push(Rung {
            role: Role::Softer,
            ..fine
        });
    }
    rungs
}

impl Place {
    /// A done run that serves here.
    fn among(&self, done: &[Rung], extent: &Extent) -> Option<Rung> {
        let serves = |rung: &&Rung| {
            let factor = rung.cell_size_m / extent.cell_size_m;
            rung.role != Role::Softer && (self.least..=self.most).contains(&factor)
        };
        done.iter().find(serves).copied()
    }
}

/// Whether a softer run is done whose cells are near enough: it tells of a small share.
fn has_a_softer(done: &[Rung], extent: &Extent) -> bool {
    let mut softer = done.iter().filter(|rung| rung.role == Role::Softer);
    softer.any(|rung| rung.cell_size_m <= FARTHEST * extent.cell_size_m)
}

/// Whether a run's records may be those of the answer: of all runs that a target
/// takes, the finest one is.
pub(super) fn may_be_the_answer(given: &Scenario, rung: Rung) -> bool {
    match rung.role {
        Role::Answer => true,
        Role::Coarser => given.accuracy.target.is_some(),
        Role::Softer => false,
    }
}

/// The scenario of a run. That of an answer which keeps its cells is the one given,
/// word for word.
pub(super) fn scenario_of(given: &Scenario, extent: &Extent, rung: Rung) -> Scenario {
    let mut scenario = given.clone();
    if rung.role == Role::Answer && given.accuracy.target.is_none() {
        return scenario;
    }
    scenario.numerics.cell_size_m = Some(rung.cell_size_m);
    scenario.accuracy = Accuracy {
        error_bars: false,
        target: None,
        quantity: None,
        ..given.accuracy
    };
    if rung.role == Role::Softer {
        scenario.numerics.sound_speed_m_s = Some(SOFTER * extent.sound_speed_m_s);
    }
    if !may_be_the_answer(given, rung) {
        scenario.flow_snapshots = 0;
    }
    scenario
}
