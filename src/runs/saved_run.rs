//! A run's state as bytes: the state of the simulation, preceded by those of the recorder and the
//! stopwatch.

use super::headed;
use scree_solver::record::Recorder;
use scree_solver::scenario::Scenario;
use scree_solver::{Instructions, RestoreError, SaveError, Simulation};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Commit this program was built from.
pub const COMMIT: &str = env!("BUILD_COMMIT");

/// Cost of a run so far.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Spent {
    /// Wall time [s].
    pub wall_s: f64,
    /// Sub-steps summed over the points that took part.
    pub point_steps: u64,
}

/// Header before the simulation's own bytes.
#[derive(Serialize, Deserialize)]
struct Head {
    /// Commit of the build; another build may round otherwise.
    commit: String,
    /// True if multiply-adds are fused, which also changes rounding: [`Instructions::fuse`].
    fused: bool,
    recorder: Recorder,
    spent: Spent,
}

/// Reason why a saved state can't be resumed.
#[derive(Debug, Error)]
pub enum SavedRunError {
    /// The simulation's part can't be read.
    #[error(transparent)]
    Restore(#[from] RestoreError),
    /// The header can't be read.
    #[error("the head of the saved state can't be read")]
    Head,
    /// It was saved by another build of this version.
    #[error("the state was saved by a build of commit {0}")]
    OtherBuild(String),
    /// It was saved on a processor with other instructions.
    #[error("the state was saved {0} fused multiply-add, and this processor would round otherwise")]
    OtherInstructions(&'static str),
}

/// Bytes from which [`restore`] restores the run: a header, then the simulation.
///
/// # Errors
/// The simulation is in the middle of a step, or has failed.
pub(super) fn save(
    simulation: &Simulation,
    recorder: &Recorder,
    spent: Spent,
) -> Result<Vec<u8>, SaveError> {
    let simulation = simulation.save()?;
    let head = Head {
        commit: COMMIT.to_owned(),
        fused: Instructions::detected().fuse(),
        recorder: recorder.clone(),
        spent,
    };
    Ok(headed::joined(&head, &simulation))
}

/// Restores the run of this scenario.
///
/// # Errors
/// The bytes are of another version or another scenario, or no state at all.
pub(super) fn restore(
    scenario: &Scenario,
    threads: usize,
    bytes: &[u8],
) -> Result<(Simulation, Recorder, Spent), SavedRunError> {
    let (head, simulation): (Head, &[u8]) = headed::parted(bytes).ok_or(SavedRunError::Head)?;
    if head.commit != COMMIT {
        return Err(SavedRunError::OtherBuild(head.commit));
    }
    if head.fused != Instructions::detected().fuse() {
        let how = if head.fused { "with" } else { "without" };
        return Err(SavedRunError::OtherInstructions(how));
    }
    let simulation = Simulation::restore(scenario, threads, simulation)?;
    Ok((simulation, head.recorder, head.spent))
}

#[cfg(test)]
mod tests {
    use super::*;
    use scree_solver::simulation::PreparedScene;

    const SCENARIO: &str = r#"{"channel": {"inclination_deg": 30, "incline_length_m": 0.4,
        "runout_length_m": 0.4, "width_m": 0.1}, "flow": null, "duration_s": 0.1,
        "bodies": [{"shape": {"cube": {"side_m": 0.04}}}]}"#;

    #[test]
    fn a_run_comes_back_as_it_was_and_only_to_its_own_scenario_and_build() {
        let scenario = Scenario::from_json(SCENARIO).unwrap();
        let prepared = PreparedScene::of(&scenario).unwrap();
        let recorder = Recorder::of(&prepared);
        let simulation = Simulation::of(prepared, 1).unwrap();
        let spent = Spent {
            wall_s: 1.5,
            point_steps: 7,
        };
        let bytes = save(&simulation, &recorder, spent).unwrap();
        let (again, same_recorder, same_spent) = restore(&scenario, 1, &bytes).unwrap();
        assert_eq!(again.save(), simulation.save());
        assert_eq!((same_recorder, same_spent), (recorder, spent));

        let mut other = scenario.clone();
        other.duration_s = 0.2;
        assert!(restore(&other, 1, &bytes).is_err());
        let mut other_build = bytes.clone();
        // Length of the header, then length of the commit, then the commit.
        other_build[5] ^= 1;
        let refused = restore(&scenario, 1, &other_build);
        assert!(matches!(refused, Err(SavedRunError::OtherBuild(_))));
        let mut other_instructions = bytes.clone();
        // The byte after the commit.
        other_instructions[5 + COMMIT.len()] ^= 1;
        let refused = restore(&scenario, 1, &other_instructions);
        assert!(matches!(refused, Err(SavedRunError::OtherInstructions(_))));
    }

    #[test]
    fn bytes_that_are_cut_off_are_no_run() {
        let scenario = Scenario::from_json(SCENARIO).unwrap();
        let prepared = PreparedScene::of(&scenario).unwrap();
        let recorder = Recorder::of(&prepared);
        let simulation = Simulation::of(prepared, 1).unwrap();
        let bytes = save(&simulation, &recorder, Spent::default()).unwrap();
        for length in 0..bytes.len() {
            assert!(restore(&scenario, 1, &bytes[..length]).is_err(), "{length}");
        }
    }
}
