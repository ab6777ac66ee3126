//! How long a run will take on this machine: its own first steps, timed.

use scree_solver::plan::{self, Cost, Plan, Stage};
use scree_solver::scenario::{Approach, Scenario};
use scree_solver::{SetupError, Simulation, StepError};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};
use thiserror::Error;
use utoipa::ToSchema;

/// How long the steps of one share are timed.
const TIMED_FOR: Duration = Duration::from_millis(400);
/// Steps before timing starts: they touch all memory for the first time.
const WARM_UP: u64 = 2;
/// Steps that are timed at least.
const FEWEST_STEPS: u64 = 3;
/// A larger run is timed with coarser cells, and counted in point-steps.
const MOST_POINTS: f64 = 200_000.0;
/// A sub-step of a flow that has spread over one of its start: its points lie in
/// more blocks. Not yet fitted to runs (`scree bench --only forecast`).
const SPREADING: f64 = 1.0;
/// How far a forecast may be off, as a share.
const UNCERTAINTY: f64 = 0.3;

/// A run's plan, and how long it will take here.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Planned {
    /// The plan.
    pub plan: Plan,
    /// How long the run will take.
    pub wall_time: WallTime,
}

/// How long a run will take on this machine.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct WallTime {
    /// Expected [s].
    pub expected_s: f64,
    /// At least, most likely [s].
    pub low_s: f64,
    /// At most, most likely: to the end of the duration [s].
    pub high_s: f64,
    /// Threads that this holds for.
    pub threads: usize,
}

/// Why there is no forecast.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ForecastError {
    /// The scenario can't be set up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// Its first steps can't be taken.
    #[error(transparent)]
    Step(#[from] StepError),
}

/// Plans a scenario's run and times its first steps on so many threads; takes about
/// a second.
///
/// # Errors
/// It can't be set up, or can't take its first steps.
pub fn forecast(scenario: &Scenario, threads: usize) -> Result<Planned, ForecastError> {
    let plan = plan::of(scenario)?;
    let wall_time = time(scenario, &plan.cost, threads)?;
    Ok(Planned { plan, wall_time })
}

fn time(scenario: &Scenario, cost: &Cost, threads: usize) -> Result<WallTime, ForecastError> {
    let timed = coarsened(scenario, cost);
    let (mut expected, mut longest) = (0.0, 0.0);
    for (place, stage) in cost.stages.iter().enumerate() {
        let mut timed = timed.clone();
        if place > 0 {
            timed.numerics.approach = Approach::Full;
        }
        let per_substep = seconds_per_substep(&timed, stage, threads)?;
        let spreading = if stage.points > 0 { SPREADING } else { 1.0 };
        expected += stage.expected_substeps as f64 * per_substep * spreading;
        longest += stage.substeps as f64 * per_substep * spreading;
    }
    Ok(WallTime {
        expected_s: expected,
        low_s: expected * (1.0 - UNCERTAINTY),
        high_s: longest * (1.0 + UNCERTAINTY),
        threads,
    })
}

/// The scenario with cells so large that timing it is no matter.
fn coarsened(scenario: &Scenario, cost: &Cost) -> Scenario {
    let mut coarse = scenario.clone();
    let more = cost.points as f64 / MOST_POINTS;
    if more > 1.0 {
        let cell_size_m = cost.cell_size_m * more.cbrt();
        coarse.numerics.cell_size_m = Some(cell_size_m.min(scenario.channel.width_m));
    }
    coarse
}

/// What a sub-step of a stage takes, by the first ones of this scenario.
fn seconds_per_substep(
    timed: &Scenario,
    stage: &Stage,
    threads: usize,
) -> Result<f64, ForecastError> {
    let mut simulation = Simulation::new(timed, threads)?;
    let computed = simulation.computed_points().max(1) as f64;
    let mut timing = Timing::default();
    simulation.run(f64::INFINITY, |simulation, report| {
        if simulation.share() != stage.share {
            ControlFlow::Break(())
        } else if report.step_ended {
            timing.count(report.steps, report.substeps)
        } else {
            ControlFlow::Continue(())
        }
    })?;
    Ok(timing.per_substep * (stage.points.max(1) as f64 / computed))
}

/// A stopwatch that starts after the first steps.
#[derive(Debug, Default)]
struct Timing {
    /// When, and how many steps and sub-steps had been taken by then.
    began: Option<(Instant, u64, u64)>,
    /// Mean since then [s].
    per_substep: f64,
}

impl Timing {
    fn count(&mut self, steps: u64, substeps: u64) -> ControlFlow<()> {
        let Some((began, first_step, first_substep)) = self.began else {
            if steps >= WARM_UP {
                self.began = Some((Instant::now(), steps, substeps));
            }
            return ControlFlow::Continue(());
        };
        let passed = began.elapsed();
        self.per_substep = passed.as_secs_f64() / (substeps - first_substep) as f64;
        if passed >= TIMED_FOR && steps >= first_step + FEWEST_STEPS {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}
