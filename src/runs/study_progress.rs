//! Progress of all runs of a convergence study together.

use super::progress::Progress;
use scree_solver::SetupError;
use scree_solver::accuracy::{ConvergenceStudy, StudyRun};
use scree_solver::plan::Cost;
use scree_solver::simulation::PreparedScene;

/// Work of the run that a target may require after the last known one, over that one's: what cells of
/// 0.7 times the size take.
const FURTHER: f64 = 4.0;

/// Expected work of the runs that are still to be made [point-steps].
#[derive(Debug, Clone, Copy, Default)]
struct Ahead {
    current: f64,
    /// Runs after it that are known to be needed.
    later: f64,
    /// The run that a target may require after them.
    further: f64,
}

/// Progress of a study: the wall time of the current run, and that of later ones from its pace.
#[derive(Debug, Default)]
pub(super) struct StudyProgress {
    ahead: Ahead,
    /// Wall time of the runs before the current one [s].
    before_s: f64,
    /// Wall time of the current run so far [s].
    current_s: f64,
    /// Wall time of a point-step in the run before [s].
    pace_before: Option<f64>,
    /// Fraction reported last: it never decreases, though a target may require more runs.
    told: f64,
}

impl StudyProgress {
    /// Progress of a study of which this fraction was reported.
    pub(super) fn from(told: f64) -> Self {
        Self {
            told,
            ..Self::default()
        }
    }

    /// Fraction reported last.
    pub(super) fn told(&self) -> f64 {
        self.told
    }

    /// Begins the next run of the study, or goes on with it.
    ///
    /// # Errors
    /// The solver can't set up a run that is still to be made.
    pub(super) fn begin_run(&mut self, study: &ConvergenceStudy) -> Result<(), SetupError> {
        let runs: Vec<_> = study.to_do().collect();
        // A study of one run needs no weights.
        let needs_weights = runs.len() > 1 || study.has_a_target();
        let ahead = match runs.split_first() {
            Some((current, later)) if needs_weights => {
                let later: Result<Vec<f64>, _> =
                    later.iter().map(|run| work(study, *run)).collect();
                let (current, later) = (work(study, *current)?, later?);
                let last = later.last().unwrap_or(&current);
                Ahead {
                    current,
                    later: later.iter().sum(),
                    further: if study.has_a_target() {
                        FURTHER * last
                    } else {
                        0.0
                    },
                }
            }
            _ => Ahead::default(),
        };
        let outcomes = study.done().filter_map(|done| done.as_ref().ok());
        self.before_s = outcomes.map(|outcome| outcome.cost.wall_s).sum();
        let is_known = self.current_s > 0.0 && self.ahead.current > 0.0;
        self.pace_before = is_known.then(|| self.current_s / self.ahead.current);
        self.current_s = 0.0;
        self.ahead = ahead;
        Ok(())
    }

    /// Notes the wall time of the current run so far [s].
    pub(super) fn spent(&mut self, wall_s: f64) {
        self.current_s = wall_s;
    }

    /// Progress of the study at this progress of the current run. The time left is that of the runs
    /// known to be needed; the fraction allows for a further one for a target.
    pub(super) fn at(&mut self, run: &Progress) -> Progress {
        let passed = self.before_s + self.current_s;
        let is_over = run.fraction >= 1.0;
        let of_run = run.eta_s.or(is_over.then_some(0.0));
        let pace = match of_run {
            Some(left) => Some((self.current_s + left) / self.ahead.current),
            None => self.pace_before,
        };
        let left = match (of_run, pace) {
            (of_run, _) if self.ahead.later == 0.0 => of_run,
            (Some(left), Some(pace)) => Some(left + pace * self.ahead.later),
            (None, Some(pace)) => {
                let planned = pace * (self.ahead.current + self.ahead.later);
                Some((planned - self.current_s).max(0.0))
            }
            (_, None) => None,
        };
        let further = match pace {
            Some(pace) if self.ahead.further > 0.0 => pace * self.ahead.further,
            _ => 0.0,
        };
        let fraction = match left {
            Some(left) if passed + left > 0.0 => passed / (passed + left + further),
            None if self.ahead.later + self.ahead.further == 0.0 => run.fraction,
            _ => 0.0,
        };
        self.told = fraction.clamp(self.told, 1.0);
        let is_over = is_over && self.ahead.later == 0.0;
        Progress {
            fraction: self.told,
            eta_s: left.filter(|_| !is_over),
            ..*run
        }
    }
}

/// Expected work of a run [point-steps].
fn work(study: &ConvergenceStudy, run: StudyRun) -> Result<f64, SetupError> {
    let prepared = PreparedScene::of(&study.scenario_of(run))?;
    Ok(Cost::of(&prepared).work_to_the_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(fraction: f64, eta_s: Option<f64>) -> Progress {
        Progress {
            fraction,
            eta_s,
            ..Progress::default()
        }
    }

    fn study(current: f64, later: f64) -> StudyProgress {
        StudyProgress {
            ahead: Ahead {
                current,
                later,
                further: 0.0,
            },
            ..StudyProgress::default()
        }
    }

    // A run of 10 s, then one of thrice its work.
    #[test]
    fn later_runs_take_as_much_longer_as_they_have_work() {
        let mut study = study(1.0, 3.0);
        assert_eq!(study.at(&run(0.1, None)).eta_s, None, "no pace is known");
        study.spent(5.0);
        let half = study.at(&run(0.5, Some(5.0)));
        assert_eq!((half.fraction, half.eta_s), (5.0 / 40.0, Some(35.0)));
        study.spent(10.0);
        let over = study.at(&run(1.0, None));
        assert_eq!((over.fraction, over.eta_s), (0.25, Some(30.0)));
    }

    #[test]
    fn the_pace_of_the_run_before_counts_until_there_is_another() {
        let mut study = study(3.0, 1.0);
        study.before_s = 10.0;
        study.pace_before = Some(10.0);
        study.spent(1.0);
        assert_eq!(study.at(&run(0.0, None)).eta_s, Some(39.0));
    }

    #[test]
    fn the_last_run_tells_its_own_time_and_ends_with_one() {
        let mut study = study(1.0, 0.0);
        study.before_s = 10.0;
        study.spent(30.0);
        let told = study.at(&run(0.75, Some(10.0)));
        assert_eq!((told.fraction, told.eta_s), (0.8, Some(10.0)));
        // A longer outlook does not take back what was told.
        assert_eq!(study.at(&run(0.75, Some(60.0))).fraction, 0.8);
        let end = study.at(&run(1.0, None));
        assert_eq!((end.fraction, end.eta_s), (1.0, None));
    }
    // 10 s of a run after which a target may require another, of four times its work.
    #[test]
    fn a_target_may_require_a_further_run() {
        let mut study = study(1.0, 0.0);
        study.ahead.further = FURTHER;
        study.spent(5.0);
        let half = study.at(&run(0.5, Some(5.0)));
        assert_eq!((half.fraction, half.eta_s), (5.0 / 50.0, Some(5.0)));
        study.spent(10.0);
        let over = study.at(&run(1.0, None));
        assert_eq!((over.fraction, over.eta_s), (0.2, None));
    }

    #[test]
    fn a_restored_study_goes_on_from_what_was_told() {
        let mut study = StudyProgress {
            told: 0.4,
            ..study(1.0, 3.0)
        };
        assert_eq!(study.at(&run(0.0, None)).fraction, 0.4);
    }
}
