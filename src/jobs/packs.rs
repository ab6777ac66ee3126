//! Packs: jobs that a worker claims at once, since a claim for each would take too much of the time
//! that they take.

use super::store::Pack;
use std::time::Duration;

/// Time that the jobs of a pack should take together [s]. The last of them waits that long for a
/// worker, and when the queue runs empty the others wait for this one.
const TIME_OF_PACK_S: f64 = 2.0;

/// Largest number of jobs in a pack.
const JOBS_AT_MOST: u32 = 32;

/// Weight of the last job in the rate of the worker.
const WEIGHT_OF_LAST: f64 = 0.2;

/// Size of a worker's next pack, by the planned work and the wall time of its jobs so far.
#[derive(Debug, Default)]
pub(super) struct Packs {
    /// Planned work done in a second [point-steps]; `None` before the first job.
    rate: Option<f64>,
}

impl Packs {
    /// The next pack.
    pub(super) fn next(&self) -> Pack {
        match self.rate {
            Some(rate) => Pack {
                jobs: JOBS_AT_MOST,
                // A cast to an integer has the nearest value that it can have.
                work: (rate * TIME_OF_PACK_S) as u64,
            },
            None => Pack::SINGLE,
        }
    }

    /// Takes a job's planned work and its wall time into account.
    pub(super) fn note(&mut self, planned_work: u64, took: Duration) {
        let last = planned_work as f64 / took.as_secs_f64().max(1e-6);
        self.rate = Some(
            self.rate
                .map_or(last, |rate| rate + WEIGHT_OF_LAST * (last - rate)),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pack_has_the_work_of_its_time() {
        let mut packs = Packs::default();
        assert_eq!(packs.next(), Pack::SINGLE);
        packs.note(1_000, Duration::from_secs(1));
        assert_eq!(packs.next().work, 2_000);
        for _ in 0..100 {
            packs.note(1_000, Duration::from_millis(500));
        }
        assert!((3_990..=4_000).contains(&packs.next().work));
    }

    #[test]
    fn a_job_without_a_plan_makes_no_pack() {
        let mut packs = Packs::default();
        packs.note(0, Duration::ZERO);
        assert_eq!(packs.next().work, 0);
    }
}
