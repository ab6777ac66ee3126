//! Progress of all runs of a convergence study together.

use super::progress::Progress;
use scree_solver::SetupError;
use scree_solver::accuracy::{ConvergenceStudy, StudyRun};
use scree_solver::plan::Cost;
use scree_solver::simulation::PreparedScene;
use std::collections::VecDeque;

/// Work of the run that a target may require after the last known one, over that one's: what cells of
/// 0.7 times the size take.
const FURTHER: f64 = 4.0;

/// Progress of a study: the wall time of the current run, and that of later ones from its pace.
#[derive(Debug, Default)]
pub(super) struct StudyProgress {
    /// Expected work of the runs that are still to be made, the current one first [point-steps];
    /// empty if there is only one.
    works: VecDeque<f64>,
    /// Work of the run that a target may require after them [point-steps].
    further: f64,
    /// Wall time of the runs before the current one [s].
    before_s: f64,
    /// Wall time of the current run so far [s].
    current_s: f64,
    /// Wall time of the current run at the pace of the one before it [s].
    expected_s: Option<f64>,
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
        let over = self.works.pop_front();
        // A study of one run needs no weights.
        if study.to_do().nth(1).is_some() || study.has_a_target() {
            for run in study.to_do().skip(self.works.len()) {
                self.works.push_back(work(study, run)?);
            }
        }
        let pace = over.filter(|work| *work > 0.0 && self.current_s > 0.0);
        let pace = pace.map(|work| self.current_s / work);
        self.expected_s = pace.zip(self.works.front()).map(|(pace, work)| pace * work);
        self.further = match self.works.back() {
            Some(last) if study.has_a_target() => FURTHER * last,
            _ => 0.0,
        };
        let outcomes = study.done().filter_map(|done| done.as_ref().ok());
        self.before_s = outcomes.map(|outcome| outcome.cost.wall_s).sum();
        self.current_s = 0.0;
        Ok(())
    }

    /// Notes the wall time of the current run so far [s].
    pub(super) fn spent(&mut self, wall_s: f64) {
        self.current_s = wall_s;
    }

    /// Progress of the study at this progress of the current run. The time left is that of the runs
    /// known to be needed; the fraction allows for a further one for a target.
    pub(super) fn at(&mut self, run: &Progress) -> Progress {
        let is_over = run.fraction >= 1.0;
        let of_run = run.eta_s.or(is_over.then_some(0.0)).or_else(|| {
            let expected = self.expected_s?;
            Some((expected - self.current_s).max(0.0))
        });
        let fraction = match of_run {
            Some(left) => {
                let passed = self.before_s + self.current_s;
                let whole = passed + left + self.takes(left, self.later() + self.further);
                if whole > 0.0 { passed / whole } else { 0.0 }
            }
            None if self.later() + self.further == 0.0 => run.fraction,
            None => 0.0,
        };
        self.told = fraction.clamp(self.told, 1.0);
        let left = of_run.map(|left| left + self.takes(left, self.later()));
        Progress {
            fraction: self.told,
            eta_s: left.filter(|_| !is_over || self.later() > 0.0),
            ..*run
        }
    }

    /// Work of the runs after the current one that are known to be needed [point-steps].
    fn later(&self) -> f64 {
        self.works.iter().skip(1).sum()
    }

    /// Wall time of other work [point-steps] at the pace of the current run, of which so much is
    /// left [s].
    fn takes(&self, left: f64, work: f64) -> f64 {
        match self.works.front() {
            Some(current) if work > 0.0 => (self.current_s + left) * work / current,
            _ => 0.0,
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
    use scree_solver::Scenario;

    fn run(fraction: f64, eta_s: Option<f64>) -> Progress {
        Progress {
            fraction,
            eta_s,
            ..Progress::default()
        }
    }

    fn study(works: &[f64]) -> StudyProgress {
        StudyProgress {
            works: works.iter().copied().collect(),
            ..StudyProgress::default()
        }
    }

    // A run of 10 s, then one of thrice its work.
    #[test]
    fn later_runs_take_as_much_longer_as_they_have_work() {
        let mut study = study(&[1.0, 3.0]);
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
        let mut study = study(&[3.0, 1.0]);
        study.before_s = 10.0;
        study.expected_s = Some(30.0);
        study.spent(1.0);
        assert_eq!(study.at(&run(0.0, None)).eta_s, Some(39.0));
    }

    #[test]
    fn the_last_run_tells_its_own_time_and_ends_with_one() {
        let mut study = study(&[1.0]);
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
        let mut study = study(&[1.0]);
        study.further = FURTHER;
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
            ..study(&[1.0, 3.0])
        };
        assert_eq!(study.at(&run(0.0, None)).fraction, 0.4);
    }

    #[test]
    fn the_fraction_grows_over_all_runs_of_a_study_to_one() {
        let document = r#"{"channel": {"inclination_deg": 40, "incline_length_m": 1, "runout_length_m": 2},
            "flow": {"volume_m3": 0.01}, "bodies": [{"shape": {"cube": {"side_m": 0.04}}}],
            "accuracy": {"error_bars": true}}"#;
        let scenario = Scenario::from_json(document).unwrap();
        let mut study = ConvergenceStudy::of(&scenario).unwrap();
        let (mut progress, mut shares) = (StudyProgress::default(), vec![0.0]);
        while study.next().is_some() {
            progress.begin_run(&study).unwrap();
            progress.spent(1.0);
            shares.push(progress.at(&run(0.5, Some(1.0))).fraction);
            progress.spent(2.0);
            shares.push(progress.at(&run(1.0, None)).fraction);
            study.take(Err("not computed".to_owned()));
        }
        assert!(shares.len() > 4, "{shares:?}");
        assert!(
            shares.is_sorted() && shares.last() == Some(&1.0),
            "{shares:?}"
        );
    }
}
