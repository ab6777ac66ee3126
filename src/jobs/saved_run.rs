//! A run's state as bytes: the simulation's own, and what the recorder and the
//! stopwatch know besides.

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
pub struct Spent {
    /// Wall time [s].
    pub wall_s: f64,
    /// Sub-steps summed over the points that took part.
    pub point_steps: u64,
}

/// Head before the simulation's own bytes.
#[derive(Serialize, Deserialize)]
struct Head {
    /// Another build may round otherwise.
    commit: String,
    /// So do instructions that multiply and add in one: [`Instructions::fuse`].
    fused: bool,
    recorder: Recorder,
    spent: Spent,
}

/// Why a saved state can't be gone on from.
#[derive(Debug, Error)]
pub enum SavedRunError {
    /// The simulation's part.
    #[error(transparent)]
    Restore(#[from] RestoreError),
    /// What stands before it.
    #[error("the head of the saved state can't be read")]
    Head,
    /// It was saved by another build of this version.
    #[error("the state was saved by a build of commit {0}")]
    OtherBuild(String),
    /// It was saved on a processor with other instructions.
    #[error("the state was saved {0} fused multiply-add, and this processor would round otherwise")]
    OtherInstructions(&'static str),
}

/// Bytes from which [`restore`] makes the run again: a head, then the simulation.
///
/// # Errors
/// The simulation stands amid a step, or has failed.
pub fn save(
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

/// The run of this scenario as it was saved.
///
/// # Errors
/// Bytes of something else: another version, another scenario, no state at all.
pub fn restore(
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

    const SCENARIO: &str = r#"{"channel": {"inclination_deg": 30, "incline_length_m": 0.4,
        "runout_length_m": 0.4, "width_m": 0.1}, "flow": null, "duration_s": 0.1,
        "bodies": [{"shape": {"cube": {"side_m": 0.04}}}]}"#;

    #[test]
    fn a_run_comes_back_as_it_was_and_only_to_its_own_scenario_and_build() {
        let scenario = Scenario::from_json(SCENARIO).unwrap();
        let simulation = Simulation::new(&scenario, 1).unwrap();
        let recorder = Recorder::new(&scenario);
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
        // Head's length, then the commit's length, then the commit.
        other_build[5] ^= 1;
        let refused = restore(&scenario, 1, &other_build);
        assert!(matches!(refused, Err(SavedRunError::OtherBuild(_))));
        let mut other_instructions = bytes.clone();
        // Behind the commit.
        other_instructions[5 + COMMIT.len()] ^= 1;
        let refused = restore(&scenario, 1, &other_instructions);
        assert!(matches!(refused, Err(SavedRunError::OtherInstructions(_))));
    }

    #[test]
    fn bytes_that_are_cut_off_are_no_run() {
        let scenario = Scenario::from_json(SCENARIO).unwrap();
        let simulation = Simulation::new(&scenario, 1).unwrap();
        let recorder = Recorder::new(&scenario);
        let bytes = save(&simulation, &recorder, Spent::default()).unwrap();
        for length in 0..bytes.len() {
            assert!(restore(&scenario, 1, &bytes[..length]).is_err(), "{length}");
        }
    }
}
