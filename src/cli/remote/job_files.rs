//! Files of a job, written as `scree run` writes them: all of them, or none.

use super::answer::understood;
use super::indented::indented;
use super::job::{self, ReceivedJob};
use super::transport::Transport;
use crate::cli::failure::Failure;
use crate::cli::results_folder::{
    Delivery, Formats, OUTCOME, PICTURES, PLAN, Place, ResultsFolder, SCENARIO, file_name, terrain,
};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::value::RawValue;
use uuid::Uuid;

/// Parts of a scenario that say which files there are.
#[derive(Deserialize)]
struct Scenario {
    terrain: Option<IgnoredAny>,
    #[serde(default)]
    bodies: Vec<IgnoredAny>,
}

/// Parts of an outcome that have files of their own.
#[derive(Deserialize)]
struct Outcome {
    plan: Option<Box<RawValue>>,
}

/// Files of a job that has ended.
pub(super) struct JobFiles<'a> {
    pub(super) transport: &'a Transport,
    pub(super) id: &'a Uuid,
    pub(super) job: &'a ReceivedJob,
    pub(super) formats: &'a Formats,
}

impl JobFiles<'_> {
    /// Fetches the results of a successful job; returns their paths, for people.
    ///
    /// # Errors
    /// No answer, a refusal, or a file that can't be written.
    pub(super) fn results(&self, folder: &ResultsFolder) -> Result<String, Failure> {
        let mut delivery = folder.deliver(Place::Whole)?;
        self.scenario_and_trajectories(&mut delivery)?;
        for picture in PICTURES {
            delivery.write(picture, &self.get(picture)?)?;
        }
        self.terrain(&mut delivery)?;
        if let Some(outcome) = &self.job.document.outcome {
            let parts: Outcome = understood(outcome.get())?;
            if let Some(plan) = &parts.plan {
                write(&mut delivery, PLAN, plan)?;
            }
            write(&mut delivery, OUTCOME, outcome)?;
        }
        delivery.finish()
    }

    /// Fetches the trajectories of a job up to its failure or dismissal; returns their paths, for
    /// people.
    ///
    /// # Errors
    /// As for [`JobFiles::results`].
    pub(super) fn until_failure(&self, folder: &ResultsFolder) -> Result<String, Failure> {
        let mut delivery = folder.deliver(Place::Failed)?;
        self.scenario_and_trajectories(&mut delivery)?;
        delivery.finish()
    }

    fn scenario_and_trajectories(&self, delivery: &mut Delivery<'_>) -> Result<(), Failure> {
        let scenario = &self.job.document.scenario;
        write(delivery, SCENARIO, scenario)?;
        let scenario: Scenario = understood(scenario.get())?;
        for body in 0..scenario.bodies.len() {
            for format in self.formats.each() {
                let path = format!("trajectory?body={body}&format={}", format.word());
                delivery.write(&file_name(body, format), &self.get(&path)?)?;
            }
        }
        Ok(())
    }

    /// Fetches maps, tracks and outlines of a job on a terrain, those that it has.
    fn terrain(&self, delivery: &mut Delivery<'_>) -> Result<(), Failure> {
        let scenario: Scenario = understood(self.job.document.scenario.get())?;
        if scenario.terrain.is_none() {
            return Ok(());
        }
        for (name, path) in terrain::files() {
            let path = format!("{}/{path}", job::path(self.id));
            if let Some(file) = self.transport.get_if_there(&path)? {
                delivery.write(&name, &file)?;
            }
        }
        Ok(())
    }

    fn get(&self, name: &str) -> Result<Vec<u8>, Failure> {
        let path = format!("{}/{name}", job::path(self.id));
        Ok(self.transport.get(&path)?)
    }
}

fn write(delivery: &mut Delivery<'_>, name: &str, json: &RawValue) -> Result<(), Failure> {
    let text = indented(json.get()) + "\n";
    delivery.write(name, text.as_bytes())
}
