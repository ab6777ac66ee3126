//! Shares of the step that its stages take.

use super::Effort;
use super::scenes::{self, Collapse, IN_THE_FLOW_S};
use super::stopwatch::{Length, Runner};
use crate::cli::columns::table;
use crate::cli::failure::Failure;
use crate::cli::machine::cores;
use scree_solver::StepStage;
use serde::Serialize;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Sub-steps of the collapse, and time of the channel [s], per repeat.
const QUICK: (u64, f64) = (64, 0.01);

/// Shares of the stages in some scenes.
#[derive(Debug, Serialize)]
pub(super) struct Shares {
    threads: usize,
    scenes: Vec<Scene>,
}

#[derive(Debug, Serialize)]
struct Scene {
    scene: &'static str,
    stages: Vec<Share>,
}

#[derive(Debug, Serialize)]
struct Share {
    stage: String,
    share: f64,
}

/// Time spent in each stage.
#[derive(Debug)]
struct Clock {
    since: Instant,
    spent: [Duration; StepStage::ALL.len()],
}

impl Clock {
    fn zero() -> Self {
        Self {
            since: Instant::now(),
            spent: Default::default(),
        }
    }

    fn done(&mut self, stage: StepStage) {
        let now = Instant::now();
        if let Some(place) = StepStage::ALL.iter().position(|one| *one == stage) {
            self.spent[place] += now - self.since;
        }
        self.since = now;
    }

    fn shares(&self) -> Vec<Share> {
        let total: Duration = self.spent.iter().sum();
        let share = |(stage, spent): (&StepStage, &Duration)| Share {
            stage: format!("{stage:?}").to_lowercase(),
            share: spent.as_secs_f64() / total.as_secs_f64(),
        };
        StepStage::ALL.iter().zip(&self.spent).map(share).collect()
    }
}

/// Measures the shares in the collapse and in the channel with its cube.
pub(super) fn measure(effort: &Effort) -> Result<Shares, Failure> {
    let collapse = Collapse::of(effort.points).scenario()?;
    let collapse = Runner::new(&collapse, cores())?.warmed_up()?;
    let (substeps, time_s) = QUICK;
    let repeats = effort.repeats;
    let in_collapse = watch(collapse, Length::Substeps(substeps * u64::from(repeats)))?;
    let channel = Runner::new(&scenes::channel(true, effort.channel_cell_m())?, cores())?
        .skipped_to(IN_THE_FLOW_S.0)?;
    let in_channel = watch(channel, Length::Simulated(time_s * f64::from(repeats)))?;
    let scenes = vec![
        Scene {
            scene: "s200k",
            stages: in_collapse,
        },
        Scene {
            scene: "channel",
            stages: in_channel,
        },
    ];
    Ok(Shares {
        threads: cores(),
        scenes,
    })
}

fn watch(mut runner: Runner, length: Length) -> Result<Vec<Share>, Failure> {
    let clock = Arc::new(Mutex::new(Clock::zero()));
    let watched = Arc::clone(&clock);
    runner.simulation.time_stages(Box::new(move |stage| {
        // No code panics while it is locked.
        let mut clock = watched.lock().unwrap_or_else(PoisonError::into_inner);
        clock.done(stage);
    }));
    *clock.lock().unwrap_or_else(PoisonError::into_inner) = Clock::zero();
    runner.lap(length)?;
    let clock = clock.lock().unwrap_or_else(PoisonError::into_inner);
    Ok(clock.shares())
}

impl Shares {
    /// Table for people.
    pub(super) fn table(&self) -> String {
        let title = format!("stages: shares of the step [%], {} threads", self.threads);
        let rows = StepStage::ALL.iter().enumerate().map(|(place, _)| {
            let share = |scene: usize| {
                let share = self.scenes[scene].stages[place].share;
                format!("{:.1}", 100.0 * share)
            };
            let stage = self.scenes[0].stages[place].stage.clone();
            [stage, share(0), share(1)]
        });
        table(
            &title,
            ["stage", self.scenes[0].scene, self.scenes[1].scene],
            rows,
        )
    }
}
