//! Forecast of the wall time of a run on this machine, from its first steps.

use scree_solver::accuracy::ConvergenceStudy;
use scree_solver::plan::{Cost, Plan, Stage};
use scree_solver::record::Role;
use scree_solver::scenario::{Approach, Scenario, Source};
use scree_solver::simulation::PreparedScene;
use scree_solver::{Cancellation, SetupError, Simulation, StepError};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};
use thiserror::Error;
use utoipa::ToSchema;

/// Time for which the steps of one share are timed.
const TIMED_FOR: Duration = Duration::from_millis(400);
/// The same for a refinement run, which is a small part of the whole.
const COMPANION_TIMED_FOR: Duration = Duration::from_millis(100);
/// Steps before the timing starts: they touch all memory for the first time.
const WARM_UP: u64 = 2;
/// Minimum number of timed steps.
const FEWEST_STEPS: u64 = 3;
/// Largest number of points that is timed; a larger run is timed with coarser cells, and scaled by
/// point-steps.
const MOST_POINTS: f64 = 200_000.0;
/// Cost of a sub-step of a flow that has spread, over that at its start: its points lie in
/// more blocks. Fitted to randomly drawn scenes that ended at their expected time.
const SPREADING: f64 = 1.2;
/// Relative uncertainty of a forecast.
const UNCERTAINTY: f64 = 0.3;

/// Plan of a run, the runs behind its uncertainty intervals, and the wall time of all on this
/// machine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Planned {
    /// The plan.
    pub plan: Plan,
    /// Runs made before that of the answer; with a target, the first ones.
    pub refinement_runs: Vec<PlannedRefinementRun>,
    /// Wall time of all runs.
    pub wall_time: WallTime,
}

/// A planned run behind uncertainty intervals.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct PlannedRefinementRun {
    /// Purpose of the run.
    pub role: Role,
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Sub-steps summed over its points, for the whole duration.
    pub point_steps: u64,
    /// Expected wall time [s].
    pub expected_s: f64,
}

/// Forecast of the wall time of a run on this machine, with its refinement runs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct WallTime {
    /// Expected wall time [s]; null with a target, whose cells are found by its first runs.
    #[schema(required = true)]
    pub expected_s: Option<f64>,
    /// Lower bound of the likely wall time [s].
    pub low_s: f64,
    /// Upper bound of the likely wall time [s]: for the whole duration, or a target's whole budget.
    pub high_s: f64,
    /// Number of solver threads of the forecast.
    pub threads: usize,
}

/// Reason why there is no forecast.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ForecastError {
    /// The scenario can't be set up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The first steps fail.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The forecast was cancelled.
    #[error("the forecast was cancelled")]
    Cancelled,
}

/// Times the first steps of a prepared scene's run, of which this is the plan, on this number of
/// threads; takes about a second.
///
/// # Errors
/// A refinement run can't be set up, the first steps of a run fail, or the forecast is cancelled.
pub fn forecast(
    scenario: &Scenario,
    plan: Plan,
    threads: usize,
    cancellation: &Cancellation,
) -> Result<Planned, ForecastError> {
    let refinement_runs = refinement_runs(scenario, (threads, cancellation))?;
    let first: f64 = refinement_runs.iter().map(|run| run.expected_s).sum();
    let answer = Span::of(scenario, &plan.cost, (threads, cancellation), TIMED_FOR)?;
    let target = scenario.accuracy.target;
    let (expected, longest) = if target.is_some() {
        let per_point_step = answer.longest / plan.cost.point_steps.max(1) as f64;
        (first, scenario.accuracy.budget_point_steps * per_point_step)
    } else {
        (first + answer.expected, first + answer.longest)
    };
    let wall_time = WallTime {
        expected_s: target.is_none().then_some(expected),
        low_s: expected * (1.0 - UNCERTAINTY),
        high_s: longest.max(expected) * (1.0 + UNCERTAINTY),
        threads,
    };
    Ok(Planned {
        plan,
        refinement_runs,
        wall_time,
    })
}

/// The runs made before that of the answer.
fn refinement_runs(
    scenario: &Scenario,
    (threads, cancellation): (usize, &Cancellation),
) -> Result<Vec<PlannedRefinementRun>, ForecastError> {
    let convergence_study = ConvergenceStudy::of(scenario)?;
    let before = convergence_study
        .to_do()
        .filter(|study_run| study_run.role != Role::Answer);
    before
        .map(|study_run| {
            let scenario = convergence_study.scenario_of(study_run);
            let cost = Cost::of(&PreparedScene::of(&scenario)?);
            let span = Span::of(
                &scenario,
                &cost,
                (threads, cancellation),
                COMPANION_TIMED_FOR,
            )?;
            Ok(PlannedRefinementRun {
                role: study_run.role,
                cell_size_m: study_run.cell_size_m,
                point_steps: cost.point_steps,
                expected_s: span.expected,
            })
        })
        .collect()
}

/// Wall time of one run.
struct Span {
    /// To the expected end [s].
    expected: f64,
    /// To the end of the duration [s].
    longest: f64,
}

impl Span {
    fn of(
        scenario: &Scenario,
        cost: &Cost,
        means: (usize, &Cancellation),
        timed_for: Duration,
    ) -> Result<Self, ForecastError> {
        let timed = coarsened(scenario, cost);
        let mut span = Self {
            expected: 0.0,
            longest: 0.0,
        };
        for (place, stage) in cost.stages.iter().enumerate() {
            let mut timed = timed.clone();
            if place > 0 {
                timed.numerics.approach = Approach::Full;
            }
            let per_substep = seconds_per_substep(&timed, stage, means, timed_for)?;
            let spreading = if stage.points > 0 { SPREADING } else { 1.0 };
            span.expected += stage.expected_substeps as f64 * per_substep * spreading;
            span.longest += stage.substeps as f64 * per_substep * spreading;
        }
        Ok(span)
    }
}

/// The scenario with cells so large, or a release so short, that its timing is cheap.
fn coarsened(scenario: &Scenario, cost: &Cost) -> Scenario {
    let mut coarse = scenario.clone();
    let more = cost.points as f64 / MOST_POINTS;
    if more > 1.0 {
        let [x, y] = scenario.extents();
        let narrowest = (x.end - x.start).min(y.end - y.start);
        let cell_size_m = (cost.cell_size_m * more.cbrt()).min(narrowest);
        coarse.numerics.cell_size_m = Some(cell_size_m);
        // A narrow channel allows no larger cells.
        let fewer = (cell_size_m / cost.cell_size_m).powi(3);
        if let Some(Source::Channel { volume_m3, .. }) =
            coarse.flow.as_mut().map(|flow| &mut flow.source)
        {
            *volume_m3 *= (fewer / more).min(1.0);
        }
    }
    coarse
}

/// Wall time of a sub-step of a stage, measured on the first ones of this scenario.
fn seconds_per_substep(
    timed: &Scenario,
    stage: &Stage,
    (threads, cancellation): (usize, &Cancellation),
    timed_for: Duration,
) -> Result<f64, ForecastError> {
    if cancellation.is_asked() {
        return Err(ForecastError::Cancelled);
    }
    let mut simulation = Simulation::new(timed, threads)?;
    simulation.cancel_with(cancellation.clone());
    let computed = simulation.computed_points().max(1) as f64;
    let mut timing = Timing::lasting(timed_for);
    simulation.run(f64::INFINITY, |simulation, report| {
        if simulation.share() != stage.share {
            ControlFlow::Break(())
        } else if report.step_ended {
            timing.count(report.steps, report.substeps)
        } else {
            ControlFlow::Continue(())
        }
    })?;
    if cancellation.is_asked() {
        return Err(ForecastError::Cancelled);
    }
    Ok(timing.per_substep * (stage.points.max(1) as f64 / computed))
}

/// A stopwatch that starts after the first steps.
#[derive(Debug)]
struct Timing {
    lasts: Duration,
    /// Start of the timing, and the numbers of steps and sub-steps taken before it.
    began: Option<(Instant, u64, u64)>,
    /// Mean wall time of a sub-step since the start of the timing [s].
    per_substep: f64,
}

impl Timing {
    fn lasting(lasts: Duration) -> Self {
        Self {
            lasts,
            began: None,
            per_substep: 0.0,
        }
    }

    fn count(&mut self, steps: u64, substeps: u64) -> ControlFlow<()> {
        let Some((began, first_step, first_substep)) = self.began else {
            if steps >= WARM_UP {
                self.began = Some((Instant::now(), steps, substeps));
            }
            return ControlFlow::Continue(());
        };
        let passed = began.elapsed();
        self.per_substep = passed.as_secs_f64() / (substeps - first_substep) as f64;
        if passed >= self.lasts && steps >= first_step + FEWEST_STEPS {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}
