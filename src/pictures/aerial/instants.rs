//! Selection of the instants of the aerial view.

use scree_solver::record::{FlowSnapshot, Sample};

/// Number of panels of the picture.
const INSTANTS: usize = 6;

/// Weight of the bodies' travel relative to time in the selection.
const TRAVEL_WEIGHT: f64 = 0.7;

/// One panel: the flow and the bodies at one time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Instant<'a> {
    /// Simulated time [s].
    pub time_s: f64,
    /// Flow at this time.
    pub snapshot: Option<&'a FlowSnapshot>,
    /// Index of the sample nearest in time.
    pub sample: Option<usize>,
}

/// Six instants, or as many as there are.
pub(super) fn choose<'a>(samples: &[Sample], snapshots: &'a [FlowSnapshot]) -> Vec<Instant<'a>> {
    let nearest = |time_s: f64| {
        let gap = |index: &usize| (samples[*index].time_s - time_s).abs();
        (0..samples.len()).min_by(|a, b| gap(a).total_cmp(&gap(b)))
    };
    let progress = Progress::of(samples);
    if snapshots.is_empty() {
        let times: Vec<f64> = samples.iter().map(|s| s.time_s).collect();
        let at = |index| Instant {
            time_s: times[index],
            snapshot: None,
            sample: Some(index),
        };
        return progress.spread(&times).into_iter().map(at).collect();
    }
    let times: Vec<f64> = snapshots.iter().map(|s| s.time_s).collect();
    let at = |index: usize| Instant {
        time_s: times[index],
        snapshot: Some(&snapshots[index]),
        sample: nearest(times[index]),
    };
    progress.spread(&times).into_iter().map(at).collect()
}

/// Indices of the times [s] that the aerial view shows of a run with these samples.
pub fn shown_instants(samples: &[Sample], times_s: &[f64]) -> Vec<usize> {
    Progress::of(samples).spread(times_s)
}

/// Progress of a run, measured partly in time and partly in the bodies' travel, so that most panels
/// show motion.
struct Progress {
    /// Time [s] and share of the progress, both increasing.
    shares: Vec<(f64, f64)>,
}

impl Progress {
    fn of(samples: &[Sample]) -> Self {
        let mut travelled = 0.0;
        let mut shares: Vec<(f64, f64)> = Vec::with_capacity(samples.len());
        for (index, sample) in samples.iter().enumerate() {
            if let Some(before) = index.checked_sub(1).map(|i| &samples[i]) {
                travelled += travel(before, sample);
            }
            shares.push((sample.time_s, travelled));
        }
        let end = shares.last().map_or(0.0, |s| s.0);
        for (time, share) in &mut shares {
            let of_time = if end > 0.0 { *time / end } else { 0.0 };
            // If no body travels, time alone decides.
            let of_way = if travelled > 0.0 {
                *share / travelled
            } else {
                of_time
            };
            *share = TRAVEL_WEIGHT * of_way + (1.0 - TRAVEL_WEIGHT) * of_time;
        }
        Self { shares }
    }

    fn at(&self, time_s: f64) -> f64 {
        let after = self.shares.partition_point(|s| s.0 < time_s - 1e-9);
        self.shares
            .get(after)
            .or(self.shares.last())
            .map_or(time_s, |s| s.1)
    }

    /// Indices of at most six of these times, first and last among them,
    /// whose progress is spread as evenly as possible.
    fn spread(&self, times: &[f64]) -> Vec<usize> {
        if times.len() <= INSTANTS {
            return (0..times.len()).collect();
        }
        let progress: Vec<f64> = times.iter().map(|t| self.at(*t)).collect();
        let (first, last) = (progress[0], progress[times.len() - 1]);
        let mut chosen = vec![0];
        for panel in 1..INSTANTS {
            let wanted = first + (last - first) * panel as f64 / (INSTANTS - 1) as f64;
            // At least one after the previous one, with enough left for those to come.
            let free = chosen[panel - 1] + 1..=times.len() - (INSTANTS - panel);
            let gap = |index: &usize| (progress[*index] - wanted).abs();
            let best = free.clone().min_by(|a, b| gap(a).total_cmp(&gap(b)));
            chosen.push(if panel == INSTANTS - 1 {
                times.len() - 1
            } else {
                best.unwrap_or(*free.start())
            });
        }
        chosen
    }
}

/// Path length of all bodies' centres between two samples [m].
fn travel(before: &Sample, after: &Sample) -> f64 {
    let way = |(a, b): (
        &scree_solver::record::BodySample,
        &scree_solver::record::BodySample,
    )| {
        let [x, y, z] = [0, 1, 2].map(|i| b.position_m[i] - a.position_m[i]);
        x.hypot(y).hypot(z)
    };
    let ways = before.bodies.iter().zip(&after.bodies).map(way);
    ways.filter(|way| way.is_finite()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pictures::fixtures::{empty_snapshot, sliding_samples};

    /// The body travels only in the first second of three: most panels, not
    /// two of six, lie there; both ends are always shown.
    #[test]
    fn panels_gather_where_bodies_travel() {
        let samples = sliding_samples(1.0, 3.0);
        let snapshots: Vec<_> = (0..=30)
            .map(|k| empty_snapshot(0.1 * f64::from(k)))
            .collect();
        let times: Vec<f64> = choose(&samples, &snapshots)
            .iter()
            .map(|i| i.time_s)
            .collect();
        assert_eq!(times.len(), 6);
        assert_eq!((times[0], times[5]), (0.0, snapshots[30].time_s));
        assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
        let early = times.iter().filter(|time| **time <= 1.05).count();
        assert!(early >= 4, "{times:?}");
    }

    #[test]
    fn a_body_that_never_moves_spreads_over_time() {
        let samples = sliding_samples(0.0, 1.0);
        let times: Vec<f64> = choose(&samples, &[]).iter().map(|i| i.time_s).collect();
        assert_eq!(times, [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]);
    }
}
