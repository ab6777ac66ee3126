//! The service's documents, as the client reads them.

use crate::cli::failure::Failure;
use scree::results::TrajectoryColumns;
use scree_solver::record::{FlowSnapshot, Sample};
use scree_solver::scenario::Scenario;
use serde::Deserialize;

/// Trajectory document of one body.
#[derive(Debug, Deserialize)]
struct Trajectory {
    columns: TrajectoryColumns,
}

/// Records of a run, assembled from the service's documents.
#[derive(Debug, Default)]
pub(super) struct Recorded {
    pub(super) samples: Vec<Sample>,
    pub(super) snapshots: Vec<FlowSnapshot>,
}

impl Recorded {
    /// Adds the trajectory of the next body.
    ///
    /// # Errors
    /// The document is invalid, or its samples are not those of the bodies before.
    pub(super) fn add_trajectory(&mut self, document: &[u8]) -> Result<(), Failure> {
        let trajectory: Trajectory = serde_json::from_slice(document)
            .map_err(|error| Failure::other("the trajectory is not understood", error))?;
        let columns = trajectory.columns;
        if self.samples.is_empty() {
            let empty = |time_s: &f64| Sample {
                time_s: *time_s,
                bodies: Vec::new(),
            };
            self.samples = columns.time_s.iter().map(empty).collect();
        }
        if columns.len() != self.samples.len() {
            let reason = "the trajectories differ in length";
            return Err(Failure::Other(reason.to_owned()));
        }
        for (index, sample) in self.samples.iter_mut().enumerate() {
            sample.bodies.push(columns.sample(index).1);
        }
        Ok(())
    }

    /// Adds a snapshot, unless it equals the last one.
    pub(super) fn add_snapshot(&mut self, snapshot: FlowSnapshot) {
        let known = self
            .snapshots
            .last()
            .is_some_and(|last| last.time_s >= snapshot.time_s);
        if !known {
            self.snapshots.push(snapshot);
        }
    }
}

/// Times [s] of a scenario's snapshots; none without a flow.
pub(super) fn snapshot_times(scenario: &Scenario) -> Vec<f64> {
    if scenario.flow.is_none() {
        return Vec::new();
    }
    let intervals = scenario.flow_snapshots.saturating_sub(1).max(1);
    let time_s = |k: u32| scenario.duration_s * f64::from(k) / f64::from(intervals);
    (0..scenario.flow_snapshots).map(time_s).collect()
}
