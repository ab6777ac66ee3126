//! Snapshots of the flow.

use super::FlowSnapshot;
use crate::scenario::Scenario;
use crate::simulation::Simulation;
use serde::{Deserialize, Serialize};

/// Takes snapshots, each at the end of the step that contains its time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Snapshots {
    /// Remaining times, last first [s].
    times: Vec<f64>,
    /// Largest number of points in a snapshot.
    most_points: usize,
    /// Number of points per kept point; `None` before the first snapshot.
    thinning: Option<u32>,
}

impl Snapshots {
    /// Snapshot times at equal intervals over the run.
    pub(super) fn of(scenario: &Scenario) -> Self {
        let count = scenario.flow_snapshots;
        let last = f64::from(count.saturating_sub(1).max(1));
        let time = |n: u32| scenario.duration_s * (f64::from(n) / last);
        Self {
            times: (0..count).rev().map(time).collect(),
            most_points: scenario.flow_snapshot_points as usize,
            thinning: None,
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
        due.then(|| self.take(simulation))
    }

    /// The last snapshot of a run that ends now; none if no more were due.
    pub(super) fn end(&mut self, simulation: &Simulation) -> Option<FlowSnapshot> {
        let due = !self.times.is_empty();
        self.times.clear();
        due.then(|| self.take(simulation))
    }

    /// The flow now, thinned evenly by identity. Points never become more, so that the thinning of
    /// the first snapshot is enough for all, which then have the same points.
    fn take(&mut self, simulation: &Simulation) -> FlowSnapshot {
        let points = simulation.point_count();
        let needed = || points.div_ceil(self.most_points).max(1) as u32;
        let thinning = *self.thinning.get_or_insert_with(needed);
        let mut kept = Vec::new();
        simulation.visit_points(None, |point| {
            if point.id.is_multiple_of(thinning) {
                kept.push(*point);
            }
        });
        kept.sort_unstable_by_key(|point| point.id);
        kept.truncate(self.most_points);
        let positions = kept.iter().map(|point| point.position.map(|x| x as f32));
        let speeds = kept.iter().map(|point| point.velocity.norm() as f32);
        FlowSnapshot {
            time_s: simulation.time_s(),
            points: points as u64,
            thinning,
            point_id: kept.iter().map(|point| point.id).collect(),
            position_m: positions.map(Into::into).collect(),
            speed_m_s: speeds.collect(),
        }
    }
}
