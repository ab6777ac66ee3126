//! Files that a run leaves in its folder, by the way it ended.

use super::job::Job;
use super::recording::Recorded;
use crate::cli::failure::Failure;
use crate::cli::interrupts::Interrupts;
use crate::cli::results_folder::{Delivery, Place, ResultsFolder};
use scree_solver::record::Outcome;

impl Job {
    /// Writes the results of the completed run, and returns their paths; none without a folder.
    pub(super) fn completed(
        &self,
        recorded: &Recorded,
        outcome: &Outcome,
    ) -> Result<Option<String>, Failure> {
        self.deliver(recorded, outcome)
            .map_err(|failure| self.broken_off(&failure))
    }

    fn deliver(&self, recorded: &Recorded, outcome: &Outcome) -> Result<Option<String>, Failure> {
        let Some(folder) = &self.folder else {
            return Ok(None);
        };
        let mut delivery = folder.deliver(Place::Whole)?;
        self.write_scenario_and_trajectories(recorded, &mut delivery)?;
        let Recorded {
            samples,
            snapshots,
            maps,
        } = recorded;
        delivery.pictures(&self.scenario, (samples, snapshots, maps.as_ref()), outcome)?;
        delivery.terrain(&self.scenario, samples, outcome, maps.as_ref())?;
        delivery.outcome(outcome)?;
        delivery.finish().map(Some)
    }

    /// Writes the trajectories up to a numerical failure, and adds to the failure where they are.
    pub(super) fn failed(&self, recorded: &Recorded, failure: &Failure) -> Failure {
        let Some(folder) = &self.folder else {
            return Failure::Numerical(failure.to_string());
        };
        let place = folder.of(Place::Failed);
        let place = place.display();
        let written = self.deliver_failed(folder, recorded);
        let mut text = match written {
            Ok(()) => format!("{failure}\nthe trajectories until then are in {place}"),
            Err(error) => format!("{failure}\nthe trajectories until then are lost: {error}"),
        };
        if folder.has_results() {
            let path = folder.path().display();
            text.push_str(&format!("; {path} still has the results of an earlier run"));
        }
        Failure::Numerical(text)
    }

    fn deliver_failed(&self, folder: &ResultsFolder, recorded: &Recorded) -> Result<(), Failure> {
        let mut delivery = folder.deliver(Place::Failed)?;
        self.write_scenario_and_trajectories(recorded, &mut delivery)?;
        delivery.finish().map(|_| ())
    }

    fn write_scenario_and_trajectories(
        &self,
        recorded: &Recorded,
        delivery: &mut Delivery<'_>,
    ) -> Result<(), Failure> {
        delivery.scenario(&self.scenario, &self.maps)?;
        for body in 0..self.scenario.bodies.len() {
            delivery.trajectory(body, &recorded.samples, &self.formats)?;
        }
        Ok(())
    }

    /// Failure of a run that a signal stopped at this share of it.
    pub(super) fn stopped(&self, interrupts: &Interrupts, fraction: f64) -> Failure {
        let percent = (100.0 * fraction).floor();
        let kept = match &self.folder {
            // Only a computation about to fail has a state that can't be saved.
            Some(folder) if !folder.has_saved_state() => "its state can't be saved".to_owned(),
            Some(folder) => format!(
                "its state is saved, and `scree run --resume {}` continues it",
                folder.path().display()
            ),
            None => "nothing is kept, since no --out was given".to_owned(),
        };
        Failure::Stopped(
            interrupts.first(),
            format!(" at {percent} % of the run; {kept}"),
        )
    }

    /// Failure of the machine to keep results or state. The last state that was saved stays.
    pub(super) fn broken_off(&self, failure: &Failure) -> Failure {
        let folder = self.folder.as_ref();
        let how = match folder.filter(|folder| folder.has_saved_state()) {
            Some(folder) => format!(
                "\n`scree run --resume {}` continues from the state saved before",
                folder.path().display()
            ),
            None => String::new(),
        };
        Failure::Other(format!("{failure}{how}"))
    }

    /// Removes the saved state of a run that can't be set up, as it never will be.
    pub(super) fn given_up(&self, failure: Failure) -> Failure {
        match (&self.folder, &failure) {
            (Some(folder), Failure::Input(_)) => match folder.discard_partial() {
                Ok(()) => failure,
                Err(error) => Failure::Input(format!("{failure}\n{error}")),
            },
            _ => failure,
        }
    }
}
