//! Executes all runs that a scenario's answer needs: the refinement runs of its intervals, then the
//! answer, or as many runs as its target takes.

use super::control::RunControl;
use super::progress::{Progress, Resources};
use super::run::{Run, RunEnd, RunError, Sink};
use super::saved_run::SavedRunError;
use super::saved_study::{self, SavedStudy};
use super::study_progress::StudyProgress;
use scree_solver::accuracy::{ConvergenceStudy, StudyRun};
use scree_solver::plan::Cost;
use scree_solver::record::{FlowMaps, Record};
use scree_solver::scenario::Scenario;
use scree_solver::simulation::PreparedScene;
use scree_solver::{SetupError, StepError};
use std::borrow::Cow;

/// Runs `scenario` on `threads` solver threads from its start to its end or until
/// `control` asks it to stop. The sink gets only the records of the answer, as they are made; if
/// a target chooses the cells of the answer, once the answer is found. Progress is that of
/// all runs together.
///
/// # Errors
/// See [`RunError`]; records that the sink has taken stay valid.
pub fn run<S: Sink>(
    scenario: &Scenario,
    threads: usize,
    control: &RunControl,
    sink: &mut S,
) -> Result<RunEnd, RunError<S::Error>> {
    Runs::afresh(scenario, threads)?.go(control, sink)
}

/// The runs of a scenario that needs several.
#[derive(Debug)]
pub struct Runs {
    convergence_study: ConvergenceStudy,
    threads: usize,
    /// Records of the finest run so far, if a target may still require a finer one.
    kept: Vec<Record>,
    /// Maps of its flow on a terrain.
    kept_maps: Option<FlowMaps>,
    /// The current run, resumed from its saved state, and its records if they are
    /// kept.
    begun: Option<(Run, Vec<Record>)>,
    /// Error of the last run that failed.
    failure: Option<StepError>,
    /// Fraction that was reported as done before.
    told: f64,
}

impl Runs {
    /// At the first run.
    ///
    /// # Errors
    /// The solver can't set the scenario up.
    pub fn afresh(scenario: &Scenario, threads: usize) -> Result<Self, SetupError> {
        Ok(Self {
            convergence_study: ConvergenceStudy::of(scenario)?,
            threads,
            kept: Vec::new(),
            kept_maps: None,
            begun: None,
            failure: None,
            told: 0.0,
        })
    }

    /// Restores the runs from a saved `state`.
    ///
    /// # Errors
    /// The bytes are not a state of this scenario and this build.
    pub fn restored(
        scenario: &Scenario,
        threads: usize,
        state: &[u8],
    ) -> Result<Self, SavedRunError> {
        let (saved, run) = saved_study::read(state)?;
        let SavedStudy {
            done,
            kept,
            kept_maps,
            of_run,
            fraction,
        } = saved;
        let mut runs = Self::afresh(scenario, threads).map_err(|_| SavedRunError::Head)?;
        let any_before = !done.is_empty();
        done.into_iter()
            .for_each(|done| runs.convergence_study.take(done));
        // If all runs failed so far, the last one is repeated to find its error again.
        let study_run = runs.convergence_study.next().ok_or(SavedRunError::Head)?;
        if any_before && !runs.convergence_study.has_an_answer() {
            return Err(SavedRunError::Head);
        }
        let run = Run::restored(&runs.convergence_study.scenario_of(study_run), threads, run)?;
        Ok(Self {
            kept: kept.into_owned(),
            kept_maps: kept_maps.into_owned(),
            told: fraction,
            begun: Some((run, of_run.into_owned())),
            ..runs
        })
    }

    /// Runs to the end or until `control` asks it to stop.
    ///
    /// # Errors
    /// See [`RunError`]; records that the sink has taken stay valid.
    pub fn go<S: Sink>(
        mut self,
        control: &RunControl,
        sink: &mut S,
    ) -> Result<RunEnd, RunError<S::Error>> {
        let mut whole = Whole {
            sink,
            kept: self.kept,
            kept_maps: self.kept_maps,
            progress: StudyProgress::from(self.told),
        };
        while let Some(study_run) = self.convergence_study.next() {
            whole.progress.begin_run(&self.convergence_study)?;
            let (run, kept) = match self.begun.take() {
                Some(begun) => begun,
                None => {
                    let scenario = self.convergence_study.scenario_of(study_run);
                    let prepared = PreparedScene::of(&scenario)?;
                    let planned = whole.sink.before_set_up(Cost::of(&prepared).memory_bytes);
                    planned.map_err(RunError::Sink)?;
                    (Run::of(prepared, self.threads)?, Vec::new())
                }
            };
            let mut part = Part {
                fate: Fate::of(&self.convergence_study, study_run),
                whole: &mut whole,
                convergence_study: &self.convergence_study,
                kept,
                maps: None,
            };
            let ended = run.go(control, &mut part);
            let Part {
                fate, kept, maps, ..
            } = part;
            match ended {
                Ok(RunEnd::Stopped) => return Ok(RunEnd::Stopped),
                Ok(RunEnd::Completed(outcome)) => {
                    self.convergence_study.take(Ok(*outcome));
                    let finest = self.convergence_study.finest() == Some(study_run.cell_size_m);
                    if fate == Fate::Kept && finest {
                        (whole.kept, whole.kept_maps) = (kept, maps);
                    }
                }
                Err(RunError::Step(error)) if self.convergence_study.can_do_without(study_run) => {
                    self.convergence_study.take(Err(error.to_string()));
                    self.failure = Some(error);
                }
                Err(error) => return Err(error),
            }
        }
        whole.hand_on_kept().map_err(RunError::Sink)?;
        match (self.convergence_study.finish(), self.failure) {
            (Some(answer), _) => Ok(RunEnd::Completed(Box::new(answer))),
            (None, Some(error)) => Err(error.into()),
            (None, None) => Ok(RunEnd::Stopped),
        }
    }
}

/// Destination of a run's records.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fate {
    /// Discarded: those of a refinement run.
    Dropped,
    /// Passed on at once: those of the answer.
    HandedOn,
    /// Kept: those of the answer unless a finer run follows.
    Kept,
}

impl Fate {
    fn of(convergence_study: &ConvergenceStudy, study_run: StudyRun) -> Self {
        match (
            convergence_study.may_be_the_answer(study_run),
            convergence_study.has_a_target(),
        ) {
            (false, _) => Self::Dropped,
            (true, false) => Self::HandedOn,
            (true, true) => Self::Kept,
        }
    }
}

/// All runs together, and the sink of their records.
struct Whole<'a, S> {
    sink: &'a mut S,
    kept: Vec<Record>,
    kept_maps: Option<FlowMaps>,
    progress: StudyProgress,
}

impl<S: Sink> Whole<'_, S> {
    fn hand_on_kept(&mut self) -> Result<(), S::Error> {
        let mut kept = std::mem::take(&mut self.kept).into_iter();
        kept.try_for_each(|record| self.sink.record(record))?;
        match self.kept_maps.take() {
            Some(maps) => self.sink.flow_maps(&maps),
            None => Ok(()),
        }
    }
}

/// The sink of one run.
struct Part<'a, 'b, S> {
    whole: &'a mut Whole<'b, S>,
    convergence_study: &'a ConvergenceStudy,
    fate: Fate,
    kept: Vec<Record>,
    maps: Option<FlowMaps>,
}

impl<S: Sink> Sink for Part<'_, '_, S> {
    type Error = S::Error;

    fn record(&mut self, record: Record) -> Result<(), S::Error> {
        match self.fate {
            Fate::Dropped => {}
            Fate::HandedOn => self.whole.sink.record(record)?,
            Fate::Kept => self.kept.push(record),
        }
        Ok(())
    }

    fn flow_maps(&mut self, maps: &FlowMaps) -> Result<(), S::Error> {
        match self.fate {
            Fate::Dropped => {}
            Fate::HandedOn => self.whole.sink.flow_maps(maps)?,
            Fate::Kept => self.maps = Some(maps.clone()),
        }
        Ok(())
    }

    fn progress(&mut self, run: &Progress) -> Result<(), S::Error> {
        let study = self.whole.progress.at(run);
        self.whole.sink.progress(&study)
    }

    fn resources(&mut self, used: &Resources) -> Result<(), S::Error> {
        self.whole.progress.spent(used.wall_s);
        self.whole.sink.resources(used)
    }

    fn wants_state(&mut self) -> bool {
        self.whole.sink.wants_state()
    }

    fn state(&mut self, time_s: f64, run: &[u8]) -> Result<(), S::Error> {
        let saved = SavedStudy {
            done: self.convergence_study.done().cloned().collect(),
            kept: Cow::Borrowed(&self.whole.kept),
            kept_maps: Cow::Borrowed(&self.whole.kept_maps),
            of_run: Cow::Borrowed(&self.kept),
            fraction: self.whole.progress.told(),
        };
        let state = saved_study::write(&saved, run);
        self.whole.sink.state(time_s, &state)
    }
}
