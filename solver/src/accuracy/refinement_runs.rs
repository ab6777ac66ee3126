//! Runs behind an interval (docs/method.md, section 13).

use crate::error::SetupError;
use crate::record::Role;
use crate::scenario::{Accuracy, Ground, Scenario};
use crate::simulation::PreparedScene;

/// A refinement run's cell size over the answer's, and the range within which a run that is
/// done already serves as well.
struct RefinementRange {
    factor: f64,
    least: f64,
    most: f64,
}

/// Cells of a refinement run over those of the answer, at most.
pub(super) const FARTHEST: f64 = 2.7;
/// Largest cells first: with the reduced-stiffness run together 0.19 of the answer's cost. More
/// runs do not make intervals narrower.
const COARSE: RefinementRange = RefinementRange {
    factor: 2.5,
    least: 2.1,
    most: FARTHEST,
};
/// The finer refinement run, which has a reduced-stiffness run beside it.
const FINE: RefinementRange = RefinementRange {
    factor: 1.75,
    least: 1.45,
    most: 2.1,
};
/// Sound speed of the reduced-stiffness run over the answer's: it costs half as much.
pub(super) const STIFFNESS_RATIO: f64 = 0.5;
/// Cells across the thinnest body, at least.
const FEWEST_PER_BODY: f64 = 0.75;
/// Cells across the release, at least.
const FEWEST_PER_RELEASE: f64 = 1.0;

/// A run to be made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StudyRun {
    /// Its purpose.
    pub role: Role,
    /// Cell size [m].
    pub cell_size_m: f64,
}

/// Lengths of a scene that bound its cells, and the cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ResolvedLengths {
    /// Least width of the thinnest body [m]; `None` without bodies.
    pub(super) thinnest_m: Option<f64>,
    /// Thickness of the release, or 0 without a flow [m].
    pub(super) release_m: f64,
    /// Width of the channel, or of the terrain [m].
    pub(super) width_m: f64,
    /// Cells of the plain answer [m].
    pub(super) cell_size_m: f64,
    /// √(K/ρ) of the plain answer [m/s], or 0 without a flow.
    pub(super) sound_speed_m_s: f64,
    /// True if the scenario gives the stiffness of its material.
    pub(super) stiffness_is_given: bool,
}

impl ResolvedLengths {
    pub(super) fn of(scenario: &Scenario) -> Result<Self, SetupError> {
        let prepared = PreparedScene::of(scenario)?;
        let bodies = 0..scenario.bodies.len();
        let flow = scenario.flow.as_ref();
        Ok(Self {
            thinnest_m: bodies
                .map(|body| scenario.shape_of(body).least_width())
                .reduce(f64::min),
            release_m: scenario.release_thickness_m().unwrap_or_default(),
            width_m: match &scenario.ground {
                Ground::Channel(channel) => channel.width_m,
                Ground::Terrain(terrain) => {
                    terrain.extent().into_iter().fold(f64::INFINITY, f64::min)
                }
            },
            cell_size_m: prepared.cell_size_m(),
            sound_speed_m_s: prepared.sound_speed_m_s().unwrap_or(0.0),
            stiffness_is_given: flow.is_some_and(|flow| flow.material.youngs_modulus_pa.is_some()),
        })
    }

    /// The largest cells that are of use [m].
    pub(super) fn coarsest(&self) -> f64 {
        let of_body = self.thinnest_m.unwrap_or(f64::INFINITY) / FEWEST_PER_BODY;
        of_body
            .min(self.release_m / FEWEST_PER_RELEASE)
            .min(self.width_m)
    }

    /// Length that its cells are compared with [m]: the width of the thinnest body, or the
    /// thickness of the release without bodies.
    pub(super) fn across_m(&self) -> f64 {
        self.thinnest_m.unwrap_or(self.release_m)
    }

    /// Cells across the thinnest body.
    pub(super) fn cells_per_body(&self, cell_size_m: f64) -> Option<f64> {
        self.thinnest_m.map(|thinnest| thinnest / cell_size_m)
    }
}

/// The refinement runs that an answer needs beside runs that are done, cheap ones first. A run
/// with too large cells is left out, but the finer one never is.
pub(super) fn refinement_runs(lengths: &ResolvedLengths, done: &[StudyRun]) -> Vec<StudyRun> {
    let coarser = |cell_size_m: f64| StudyRun {
        role: Role::Coarser,
        cell_size_m,
    };
    let mut study_runs = Vec::new();
    let size = COARSE.factor * lengths.cell_size_m;
    if size <= lengths.coarsest() && COARSE.among(done, lengths).is_none() {
        study_runs.push(coarser(size));
    }
    let fine = FINE.among(done, lengths).unwrap_or_else(|| {
        let fine = coarser(FINE.factor * lengths.cell_size_m);
        study_runs.push(fine);
        fine
    });
    if !lengths.stiffness_is_given && !has_reduced_stiffness_run(done, lengths) {
        study_runs.push(StudyRun {
            role: Role::ReducedStiffness,
            ..fine
        });
    }
    study_runs
}

impl RefinementRange {
    /// A done run that serves here.
    fn among(&self, done: &[StudyRun], lengths: &ResolvedLengths) -> Option<StudyRun> {
        let serves = |study_run: &&StudyRun| {
            let factor = study_run.cell_size_m / lengths.cell_size_m;
            study_run.role != Role::ReducedStiffness && (self.least..=self.most).contains(&factor)
        };
        done.iter().find(serves).copied()
    }
}

/// True if a reduced-stiffness run with similar cells is done: its share of an interval is
/// small.
fn has_reduced_stiffness_run(done: &[StudyRun], lengths: &ResolvedLengths) -> bool {
    let mut reduced_stiffness = done
        .iter()
        .filter(|study_run| study_run.role == Role::ReducedStiffness);
    reduced_stiffness.any(|study_run| study_run.cell_size_m <= FARTHEST * lengths.cell_size_m)
}

/// True if a run's records may be those of the answer: those of the finest run of a target.
pub(super) fn may_be_the_answer(given: &Scenario, study_run: StudyRun) -> bool {
    match study_run.role {
        Role::Answer => true,
        Role::Coarser => given.accuracy.target.is_some(),
        Role::ReducedStiffness => false,
    }
}

/// The scenario of a run. That of an answer which keeps its cells is the given one, word for
/// word.
pub(super) fn scenario_of(
    given: &Scenario,
    lengths: &ResolvedLengths,
    study_run: StudyRun,
) -> Scenario {
    let mut scenario = given.clone();
    if study_run.role == Role::Answer && given.accuracy.target.is_none() {
        return scenario;
    }
    scenario.numerics.cell_size_m = Some(study_run.cell_size_m);
    scenario.accuracy = Accuracy {
        error_bars: false,
        target: None,
        quantity: None,
        ..given.accuracy
    };
    if study_run.role == Role::ReducedStiffness {
        scenario.numerics.sound_speed_m_s = Some(STIFFNESS_RATIO * lengths.sound_speed_m_s);
    }
    if !may_be_the_answer(given, study_run) {
        scenario.flow_snapshots = 0;
    }
    scenario
}
