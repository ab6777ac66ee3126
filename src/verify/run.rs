//! A timed run of a case.

use crate::machine::cores;
use scree_solver::scenario::{Scenario, ScenarioError};
use scree_solver::simulation::Scene;
use scree_solver::{SetupError, Simulation, StepError, SubstepReport};
use serde::Serialize;
use std::ops::ControlFlow;
use std::time::Instant;
use thiserror::Error;

/// Number of points from which a run uses all cores.
const MANY_POINTS: usize = 20_000;

/// Reason why a value could not be measured.
#[derive(Debug, Error)]
pub enum CaseError {
    /// The scene of the case is invalid.
    #[error("the scene is refused: {0}")]
    Scene(String),
    /// The scene can't be set up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The computation could not go on.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The event to be measured never happened.
    #[error("{0}")]
    Never(&'static str),
}

/// Values measured in one run, and its cost.
#[derive(Debug, Clone, Copy)]
pub struct Answer<const N: usize> {
    /// One value for each question.
    pub values: [f64; N],
    /// Cost of all of them together.
    pub cost: Cost,
}

/// Cost of a measurement.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Cost {
    /// Wall time [s].
    pub wall_s: f64,
    /// Point-steps per second of wall time; none without points.
    pub point_steps_per_s: Option<f64>,
}

/// A timed simulation.
#[derive(Debug)]
pub struct Run {
    /// The simulation.
    pub simulation: Simulation,
    started: Instant,
}

impl Run {
    /// Sets a scene up.
    ///
    /// # Errors
    /// The scene can't be set up.
    pub fn start(scene: Scene) -> Result<Self, CaseError> {
        let threads = if scene.points.len() < MANY_POINTS {
            1
        } else {
            cores()
        };
        let simulation = Simulation::of_scene(scene, threads)?;
        let started = Instant::now();
        Ok(Self {
            simulation,
            started,
        })
    }

    /// Runs to a time.
    ///
    /// # Errors
    /// The computation fails.
    pub fn to(&mut self, time_s: f64) -> Result<(), CaseError> {
        self.watch(time_s, |_, _| ControlFlow::Continue(()))
    }

    /// Runs to a time or until told to stop, and shows every sub-step.
    ///
    /// # Errors
    /// The computation fails.
    pub fn watch(
        &mut self,
        time_s: f64,
        look: impl FnMut(&Simulation, &SubstepReport) -> ControlFlow<()> + Send,
    ) -> Result<(), CaseError> {
        self.simulation.run(time_s, look)?;
        Ok(())
    }

    /// Mean change of a speed [m/s²] between the ends of the first steps after two
    /// times.
    ///
    /// # Errors
    /// The computation fails.
    pub fn acceleration(
        &mut self,
        from_s: f64,
        to_s: f64,
        speed: impl Fn(&Simulation) -> f64,
    ) -> Result<f64, CaseError> {
        self.to(from_s)?;
        let (start, first) = (self.simulation.time_s(), speed(&self.simulation));
        self.to(to_s)?;
        let (end, last) = (self.simulation.time_s(), speed(&self.simulation));
        Ok((last - first) / (end - start))
    }

    /// These values, with the cost of the run so far.
    pub fn answer<const N: usize>(&self, values: [f64; N]) -> Answer<N> {
        let wall_s = self.started.elapsed().as_secs_f64();
        let (_, _, point_steps) = self.simulation.counts();
        let rate = (point_steps > 0).then(|| point_steps as f64 / wall_s);
        let cost = Cost {
            wall_s,
            point_steps_per_s: rate,
        };
        Answer { values, cost }
    }
}

/// The scene of a scenario in JSON.
///
/// # Errors
/// The scenario is refused.
pub fn scene_of(document: &serde_json::Value) -> Result<Scene, CaseError> {
    Ok(Scene::whole(&scenario_of(document)?)?)
}

/// A scenario in JSON.
///
/// # Errors
/// The scenario is refused.
pub fn scenario_of(document: &serde_json::Value) -> Result<Scenario, CaseError> {
    let refused = |error: ScenarioError| CaseError::Scene(format!("{error:?}"));
    Scenario::from_json(&document.to_string()).map_err(refused)
}
