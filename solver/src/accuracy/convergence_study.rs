//! The runs that an answer needs, one after the other, and the answer made from them.

use super::error_bars::{StudyOutcomes, interval_of, relative, value_of};
use super::refinement_runs::{
    self, FARTHEST, ResolvedLengths, STIFFNESS_RATIO, StudyRun, scenario_of,
};
use super::target::{self, NextRun, Progress};
use crate::error::SetupError;
use crate::record::{AccuracyReport, Cost, Outcome, Role, RunCost, TargetReport};
use crate::scenario::Scenario;
use std::collections::VecDeque;

/// Least number of refinement runs behind an interval.
const FEWEST_NEAR: usize = 2;

/// All runs for one scenario: the answer alone, or refinement runs before it, or as many runs
/// as a target takes. The caller takes the [`next`](Self::next) run, computes [its
/// scenario](Self::scenario_of) and hands in the [outcome](Self::take), until no run is next.
#[derive(Debug)]
pub struct ConvergenceStudy {
    given: Scenario,
    lengths: ResolvedLengths,
    to_do: VecDeque<StudyRun>,
    done: Vec<FinishedRun>,
    /// Reason for which a target won't be met; `None` while it may.
    given_up: Option<String>,
}

#[derive(Debug)]
struct FinishedRun {
    study_run: StudyRun,
    outcome: Result<Outcome, String>,
}

impl FinishedRun {
    /// Outcome of a run that may be the answer or a refinement run of one.
    fn grid(&self) -> Option<&Outcome> {
        let counts = self.study_run.role != Role::ReducedStiffness;
        self.outcome.as_ref().ok().filter(|_| counts)
    }
}

impl ConvergenceStudy {
    /// The study that a scenario asks for.
    ///
    /// # Errors
    /// Too many points for one run.
    pub fn of(scenario: &Scenario) -> Result<Self, SetupError> {
        let lengths = ResolvedLengths::of(scenario)?;
        let accuracy = &scenario.accuracy;
        let plain = StudyRun {
            role: Role::Answer,
            cell_size_m: lengths.cell_size_m,
        };
        let to_do = match (accuracy.target, accuracy.error_bars) {
            (Some(_), _) => target::pilots(&lengths),
            (None, true) => [refinement_runs::refinement_runs(&lengths, &[]), vec![plain]].concat(),
            (None, false) => vec![plain],
        };
        Ok(Self {
            given: scenario.clone(),
            lengths,
            to_do: to_do.into(),
            done: Vec::new(),
            given_up: None,
        })
    }

    /// The run to be made now; `None` if all are done.
    pub fn next(&self) -> Option<StudyRun> {
        self.to_do.front().copied()
    }

    /// All runs that are known to be still needed, in order.
    pub fn to_do(&self) -> impl Iterator<Item = StudyRun> {
        self.to_do.iter().copied()
    }

    /// Outcomes of the runs that are done, in order.
    pub fn done(&self) -> impl Iterator<Item = &Result<Outcome, String>> {
        self.done.iter().map(|done| &done.outcome)
    }

    /// True if there is an outcome that may be the answer.
    pub fn has_an_answer(&self) -> bool {
        self.finest().is_some()
    }

    /// Cells of the finest run so far that may be the answer [m].
    pub fn finest(&self) -> Option<f64> {
        let grids = self.done.iter().filter(|done| done.grid().is_some());
        grids
            .map(|done| done.study_run.cell_size_m)
            .reduce(f64::min)
    }

    /// The scenario of a run. That of an answer whose cells are not chosen here is the given one,
    /// word for word, so its answer has the same bits.
    pub fn scenario_of(&self, study_run: StudyRun) -> Scenario {
        scenario_of(&self.given, &self.lengths, study_run)
    }

    /// True if a target chooses the cells.
    pub fn has_a_target(&self) -> bool {
        self.given.accuracy.target.is_some()
    }

    /// True if a run's records may be those of the answer.
    pub fn may_be_the_answer(&self, study_run: StudyRun) -> bool {
        refinement_runs::may_be_the_answer(&self.given, study_run)
    }

    /// True if there may be an answer without this run.
    pub fn can_do_without(&self, study_run: StudyRun) -> bool {
        self.has_a_target() || study_run.role != Role::Answer
    }

    /// Adds the outcome of the current run; a refinement run that could not be computed is left out
    /// of the intervals.
    pub fn take(&mut self, outcome: Result<Outcome, String>) {
        let Some(study_run) = self.to_do.pop_front() else {
            return;
        };
        self.done.push(FinishedRun { study_run, outcome });
        if self.to_do.is_empty() && self.has_a_target() {
            self.go_on();
        }
    }

    /// The answer with its intervals; `None` if no run was one.
    pub fn finish(self) -> Option<Outcome> {
        let mut answer = self.with_error_bars()?;
        if self.given.accuracy.is_asked_for() {
            answer.accuracy = Some(self.report(&answer));
        }
        Some(answer)
    }

    /// The finest outcome so far, with intervals if they are asked for.
    fn with_error_bars(&self) -> Option<Outcome> {
        let mut grids: Vec<&Outcome> = self.done.iter().filter_map(FinishedRun::grid).collect();
        grids.sort_by(|a, b| a.cost.cell_size_m.total_cmp(&b.cost.cell_size_m));
        let (answer, coarser) = grids.split_first()?;
        let coarser = near(answer, coarser);
        let mut with_error_bars = (*answer).clone();
        if self.given.accuracy.is_asked_for() {
            let runs = StudyOutcomes {
                answer,
                coarser: coarser.to_vec(),
                reduced_stiffness: self.reduced_stiffness().next_back(),
                across_m: self.lengths.across_m(),
            };
            for (index, body) in with_error_bars.bodies.iter_mut().enumerate() {
                body.error_bars = Some(runs.body(index));
            }
            with_error_bars.flow.error_bars = Some(runs.flow());
        }
        Some(with_error_bars)
    }

    /// Every reduced-stiffness run and the run it is compared with, in order.
    fn reduced_stiffness(&self) -> impl DoubleEndedIterator<Item = [&Outcome; 2]> {
        let is_softer = |done: &&FinishedRun| done.study_run.role == Role::ReducedStiffness;
        self.done
            .iter()
            .filter(is_softer)
            .filter_map(|reduced_stiffness| {
                let beside = self.done.iter().find(|done| {
                    done.study_run.role != Role::ReducedStiffness
                        && done.study_run.cell_size_m == reduced_stiffness.study_run.cell_size_m
                })?;
                Some([
                    reduced_stiffness.outcome.as_ref().ok()?,
                    beside.outcome.as_ref().ok()?,
                ])
            })
    }

    /// Change of the target quantity with half the sound speed, over the value, for every
    /// reduced-stiffness run in order.
    fn softness(&self, answer: &Outcome) -> Vec<f64> {
        let accuracy = &self.given.accuracy;
        let Some((_, quantity)) = accuracy.goal() else {
            return Vec::new();
        };
        let value = |outcome: &Outcome| value_of(outcome, quantity, accuracy.body);
        let share = |pair: [&Outcome; 2]| {
            let [reduced_stiffness, beside] = pair.map(value);
            Some(((reduced_stiffness? - beside?) / value(answer)?).abs())
        };
        let shares = self.reduced_stiffness().filter_map(share);
        shares.filter(|share| share.is_finite()).collect()
    }

    fn report(&self, answer: &Outcome) -> AccuracyReport {
        let costs = || {
            self.done
                .iter()
                .filter_map(|done| done.outcome.as_ref().ok())
        };
        let over_its_own = |of: fn(&Cost) -> f64| {
            let all: f64 = costs().map(|outcome| of(&outcome.cost)).sum();
            let own = of(&answer.cost);
            (own > 0.0).then(|| (all - own) / own)
        };
        AccuracyReport {
            runs: self
                .done
                .iter()
                .map(|done| self.cost_of(done, answer))
                .collect(),
            extra_cost: over_its_own(|cost| cost.point_steps as f64).unwrap_or(0.0),
            extra_wall_cost: over_its_own(|cost| cost.wall_s),
            target: self.verdict(answer),
        }
    }

    fn cost_of(&self, done: &FinishedRun, answer: &Outcome) -> RunCost {
        let StudyRun { role, cell_size_m } = done.study_run;
        let is_answer = done
            .grid()
            .is_some_and(|grid| grid.cost.cell_size_m == answer.cost.cell_size_m);
        let reduced_stiffness = role == Role::ReducedStiffness;
        let cost = done.outcome.as_ref().ok().map(|outcome| &outcome.cost);
        RunCost {
            role: match (reduced_stiffness, is_answer) {
                (true, _) => Role::ReducedStiffness,
                (false, true) => Role::Answer,
                (false, false) => Role::Coarser,
            },
            cell_size_m,
            cells_per_body: self.lengths.cells_per_body(cell_size_m),
            sound_speed_m_s: self.lengths.sound_speed_m_s
                * if reduced_stiffness {
                    STIFFNESS_RATIO
                } else {
                    1.0
                },
            point_steps: cost.map(|cost| cost.point_steps),
            wall_s: cost.map(|cost| cost.wall_s),
            failure: done.outcome.as_ref().err().cloned(),
        }
    }

    fn verdict(&self, answer: &Outcome) -> Option<TargetReport> {
        let accuracy = &self.given.accuracy;
        let (asked, quantity) = accuracy.goal()?;
        let interval = interval_of(answer, quantity, accuracy.body);
        let reached = interval.as_ref().and_then(relative);
        let met = reached.is_some_and(|reached| reached <= asked);
        Some(TargetReport {
            quantity,
            body: quantity.is_of_a_body().then_some(accuracy.body),
            asked,
            reached,
            met,
            reason: self.given_up.clone().filter(|_| !met),
        })
    }

    /// Decides whether a finer run has to follow.
    fn go_on(&mut self) {
        let Some(answer) = self.with_error_bars() else {
            self.given_up = Some("no run could be computed".to_owned());
            return;
        };
        let accuracy = &self.given.accuracy;
        let Some((asked, quantity)) = accuracy.goal() else {
            return;
        };
        let last = self
            .done
            .last()
            .filter(|done| done.study_run.role != Role::ReducedStiffness);
        let failed = last.and_then(|last| last.outcome.as_ref().err());
        let spent = |done: &FinishedRun| done.outcome.as_ref().map_or(0, |o| o.cost.point_steps);
        let progress = Progress {
            asked,
            interval: interval_of(&answer, quantity, accuracy.body),
            softness: self.softness(&answer),
            cell_size_m: answer.cost.cell_size_m,
            cost: answer.cost.point_steps as f64,
            left: accuracy.budget_point_steps - self.done.iter().map(spent).sum::<u64>() as f64,
            failed: failed.cloned(),
        };
        match target::next(&progress, &self.given) {
            NextRun::Met => {}
            NextRun::Finer(cell_size_m) => {
                let lengths = ResolvedLengths {
                    cell_size_m,
                    ..self.lengths
                };
                let done: Vec<StudyRun> = self.done.iter().map(|done| done.study_run).collect();
                self.to_do
                    .extend(refinement_runs::refinement_runs(&lengths, &done));
                self.to_do.push_back(StudyRun {
                    role: Role::Answer,
                    cell_size_m,
                });
            }
            NextRun::GiveUp(reason) => self.given_up = Some(reason),
        }
    }
}

/// The coarser outcomes that are evidence of an answer's error: pilot runs of a target, far
/// coarser than the last run, only as long as there are no others.
fn near<'a>(answer: &Outcome, coarser: &'a [&'a Outcome]) -> &'a [&'a Outcome] {
    let limit = FARTHEST * answer.cost.cell_size_m;
    let near = coarser.partition_point(|of| of.cost.cell_size_m <= limit);
    if near >= FEWEST_NEAR {
        &coarser[..near]
    } else {
        coarser
    }
}

#[cfg(test)]
mod tests;
