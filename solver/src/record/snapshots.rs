//! Snapshots of the flow.

use super::{FlowSnapshot, SNAPSHOT_POINTS};
use crate::scenario::Scenario;
use crate::simulation::Simulation;
use serde::{Deserialize, Serialize};

/// Takes snapshots, each at the end of the step that contains its time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Snapshots {
    /// Remaining times, last first [s].
    times: Vec<f64>,
}

impl Snapshots {
    /// Snapshot times at equal intervals over the run.
    pub(super) fn of(scenario: &Scenario) -> Self {
        let count = scenario.flow_snapshots;
        let last = f64::from(count.saturating_sub(1).max(1));
        let time = |n: u32| scenario.duration_s * (f64::from(n) / last);
        Self {
            times: (0..count).rev().map(time).collect(),
        }
    }

    /// The snapshot that is due, between two steps.
    pub(super) fn due(&mut self, simulation: &Simulation) -> Option<FlowSnapshot> {
        let mut due = false;
        while self
            .times
            .pop_if(|time| *time <= simulation.time_s())
            .is_some()
        {
            due = true;
        }
        due.then(|| snapshot(simulation))
    }

    /// The last snapshot of a run that ends now; none if no more were due.
    pub(super) fn end(&mut self, simulation: &Simulation) -> Option<FlowSnapshot> {
        let due = !self.times.is_empty();
        self.times.clear();
        due.then(|| snapshot(simulation))
    }
}

/// The flow now, thinned evenly by identity.
fn snapshot(simulation: &Simulation) -> FlowSnapshot {
    let points = simulation.point_count();
    let thinning = points.div_ceil(SNAPSHOT_POINTS).max(1) as u32;
    let mut kept = Vec::new();
    simulation.visit_points(None, |point| {
        if point.id.is_multiple_of(thinning) {
            kept.push(*point);
        }
    });
    kept.sort_unstable_by_key(|point| point.id);
    kept.truncate(SNAPSHOT_POINTS);
    FlowSnapshot {
        time_s: simulation.time_s(),
        points: points as u64,
        thinning,
        position_m: kept
            .iter()
            .map(|point| point.position.map(|x| x as f32).into())
            .collect(),
        speed_m_s: kept
            .iter()
            .map(|point| point.velocity.norm() as f32)
            .collect(),
    }
}
