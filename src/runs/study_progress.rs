//! Progress of all runs of a convergence study together.

use super::progress::Progress;
use scree_solver::SetupError;
use scree_solver::accuracy::ConvergenceStudy;
use scree_solver::plan::Cost;
use scree_solver::simulation::PreparedScene;

/// Expected work of the runs that are still to be made [point-steps].
#[derive(Debug, Clone, Copy, Default)]
struct Ahead {
    current: f64,
    later: f64,
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
    /// Begins the next run of the study, or goes on with it.
    ///
    /// # Errors
    /// The solver can't set up a run that is still to be made.
    pub(super) fn begin_run(&mut self, study: &ConvergenceStudy) -> Result<(), SetupError> {
        let mut runs = study.to_do();
        let current = runs.next();
        // A study of one run needs no weights.
        let later: Vec<_> = runs.collect();
        if later.is_empty() {
            self.begin(Ahead::default(), study);
            return Ok(());
        }
        let work = |run| -> Result<f64, SetupError> {
            let prepared = PreparedScene::of(&study.scenario_of(run))?;
            Ok(Cost::of(&prepared).work_to_the_end())
        };
        let ahead = Ahead {
            current: current.map_or(Ok(0.0), work)?,
            later: later.into_iter().map(work).sum::<Result<f64, _>>()?,
        };
        self.begin(ahead, study);
        Ok(())
    }

    fn begin(&mut self, ahead: Ahead, study: &ConvergenceStudy) {
        let outcomes = study.done().filter_map(|done| done.as_ref().ok());
        self.before_s = outcomes.map(|outcome| outcome.cost.wall_s).sum();
        let is_known = self.current_s > 0.0 && self.ahead.current > 0.0;
        self.pace_before = is_known.then(|| self.current_s / self.ahead.current);
        self.current_s = 0.0;
        self.ahead = ahead;
    }

    /// Notes the wall time of the current run so far [s].
    pub(super) fn spent(&mut self, wall_s: f64) {
        self.current_s = wall_s;
    }

    /// Progress of the study at this progress of the current run.
    pub(super) fn at(&mut self, run: &Progress) -> Progress {
        let passed = self.before_s + self.current_s;
        let left = self.left_s(run);
        let fraction = match left {
            Some(left) if passed + left > 0.0 => passed / (passed + left),
            _ if self.is_last() => run.fraction,
            _ => 0.0,
        };
        self.told = fraction.clamp(self.told, 1.0);
        Progress {
            fraction: self.told,
            eta_s: left.filter(|_| self.told < 1.0),
            ..*run
        }
    }

    fn is_last(&self) -> bool {
        self.ahead.later == 0.0
    }

    /// Remaining wall time of this run and those after it [s], if a pace is known.
    fn left_s(&self, run: &Progress) -> Option<f64> {
        let is_over = run.fraction >= 1.0;
        let left = run.eta_s.or(is_over.then_some(0.0));
        if self.is_last() {
            return left.filter(|left| *left > 0.0 || is_over);
        }
        let Ahead { current, later } = self.ahead;
        match left {
            Some(left) => Some(left + (self.current_s + left) * later / current),
            None => {
                (self.pace_before).map(|pace| (pace * (current + later) - self.current_s).max(0.0))
            }
        }
    }
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
            ahead: Ahead { current, later },
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
}
