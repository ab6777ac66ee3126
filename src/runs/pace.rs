//! Pace of a run: how much of its wall time is over, and how much is left.

use super::progress::Progress;
use super::saved_run::Spent;
use scree_solver::plan::Cost;
use scree_solver::record::Recorder;
use scree_solver::simulation::Share;
use scree_solver::{Simulation, SubstepReport};
use std::time::{Duration, Instant};

/// Least time between two reports of progress: often enough for a progress bar, rarely enough to
/// cost nothing.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(100);
/// Time between two outlooks over the time that one takes.
const OUTLOOK_PAUSE: u32 = 50;
/// Memory of the mean speed: at least so long [s], and this share of the time so far.
const MEMORY: (f64, f64) = (1.0, 0.3);

/// Counters and timers of a run.
pub(super) struct Pace {
    /// Cost of the attempts before this one.
    before: Spent,
    began: Instant,
    told: Instant,
    steps: u64,
    substeps: u64,
    point_steps: u64,
    simulated_time_s: f64,
    speed: Speed,
    ahead: Ahead,
    /// Last progress: its fraction never decreases.
    progress: Progress,
}

impl Pace {
    pub(super) fn new(recorder: &Recorder, before: Spent) -> Self {
        let now = Instant::now();
        Self {
            before,
            began: now,
            told: now,
            steps: 0,
            substeps: 0,
            point_steps: before.point_steps,
            simulated_time_s: 0.0,
            speed: Speed::default(),
            ahead: Ahead::of(&recorder.plan().cost, recorder.duration_s(), now),
            progress: Progress::default(),
        }
    }

    pub(super) fn count(&mut self, report: &SubstepReport, share: Share) {
        self.simulated_time_s = report.time_s;
        self.steps = report.steps;
        self.substeps = report.substeps;
        self.point_steps += report.points;
        if report.step_ended {
            self.speed.note(self.wall_s(), report.time_s, share);
        }
    }

    /// Wall time of all attempts [s].
    pub(super) fn wall_s(&self) -> f64 {
        self.before.wall_s + self.began.elapsed().as_secs_f64()
    }

    pub(super) fn spent(&self) -> Spent {
        Spent {
            wall_s: self.wall_s(),
            point_steps: self.point_steps,
        }
    }

    /// Progress, if a report is due.
    pub(super) fn due(&mut self, simulation: &Simulation, recorder: &Recorder) -> Option<Progress> {
        if self.told.elapsed() < PROGRESS_INTERVAL {
            return None;
        }
        self.told = Instant::now();
        let (wall, time) = (self.wall_s(), self.simulated_time_s);
        self.ahead.look(simulation, recorder);
        let left = self.ahead.wall_s(&self.speed, time);
        let (fraction, left) = match left {
            Some(left) => (wall / (wall + left).max(f64::MIN_POSITIVE), Some(left)),
            None => (self.ahead.share_done(time), self.progress.eta_s),
        };
        self.progress = self.counted(fraction.max(self.progress.fraction), left);
        Some(self.progress)
    }

    /// Progress at the end of the run, or where it is stopped.
    pub(super) fn last(&self, is_over: bool) -> Progress {
        if is_over {
            self.counted(1.0, None)
        } else {
            let so_far = self.ahead.share_done(self.simulated_time_s);
            let told = self.progress;
            let is_told = told.fraction > 0.0;
            self.counted(if is_told { told.fraction } else { so_far }, told.eta_s)
        }
    }

    fn counted(&self, fraction: f64, eta_s: Option<f64>) -> Progress {
        let wall_s = self.wall_s();
        Progress {
            fraction,
            simulated_time_s: self.simulated_time_s,
            steps: self.steps,
            substeps: self.substeps,
            point_steps_per_s: if wall_s > 0.0 {
                self.point_steps as f64 / wall_s
            } else {
                0.0
            },
            eta_s,
        }
    }
}

/// Steps at the start of a share that say nothing of its speed: they touch both copies of the points
/// for the first time.
const WARM_UP: u32 = 2;

/// Mean speed of a run while the same share of the flow is computed, from whole steps after the
/// first ones.
#[derive(Default)]
struct Speed {
    share: Option<Share>,
    /// Steps of the share so far, as long as they are left out.
    warm_up: u32,
    /// Wall time at the end of the last step that is left out, and wall and simulated time at the end
    /// of the last one [s].
    began: f64,
    last: (f64, f64),
    /// Wall time of a simulated second [s], if known.
    per_second: Option<f64>,
}

impl Speed {
    /// Notes wall and simulated time at the end of a step [s].
    fn note(&mut self, wall: f64, time: f64, share: Share) {
        if self.share != Some(share) {
            (self.share, self.warm_up) = (Some(share), 0);
            self.per_second = None;
        }
        if self.warm_up < WARM_UP {
            self.warm_up += 1;
            (self.began, self.last) = (wall, (wall, time));
            return;
        }
        let (passed, simulated) = (wall - self.last.0, time - self.last.1);
        self.last = (wall, time);
        let lately = passed / simulated;
        let elapsed = wall - self.began;
        let (least, share_of_all) = MEMORY;
        let memory = elapsed.min(least.max(share_of_all * elapsed));
        let mean = self.per_second.unwrap_or(lately);
        let weight = (passed / memory).min(1.0);
        self.per_second = Some(mean + weight * (lately - mean));
    }
}

/// Remaining stages of a run, and its expected end.
struct Ahead {
    /// Time at which the run is expected to end [s].
    end_s: f64,
    /// Share of the flow that is computed last, from when on [s], and its points over those before.
    last: Option<(Share, f64, f64)>,
    next_look: Instant,
}

impl Ahead {
    fn of(cost: &Cost, duration: f64, now: Instant) -> Self {
        let substeps: u64 = cost.stages.iter().map(|stage| stage.substeps).sum();
        let last = match &cost.stages[..] {
            [first, .., last] => {
                let from = duration * first.substeps as f64 / substeps.max(1) as f64;
                let more = last.points as f64 / first.points.max(1) as f64;
                Some((last.share, from, more))
            }
            _ => None,
        };
        Self {
            end_s: cost.expected_end_s,
            last,
            next_look: now,
        }
    }

    /// Looks at the state of the run, if that has not been done for a while.
    fn look(&mut self, simulation: &Simulation, recorder: &Recorder) {
        let began = Instant::now();
        if began >= self.next_look {
            self.end_s = recorder.expected_end_s(simulation);
            let ended = Instant::now();
            self.next_look = ended + (ended - began) * OUTLOOK_PAUSE;
        }
    }

    /// Share of the work that is done at this time, whatever the speed.
    fn share_done(&self, time: f64) -> f64 {
        let (from, more) = self
            .last
            .map_or((self.end_s, 1.0), |(_, from, more)| (from, more));
        let work_to = |time: f64| time.min(from) + more * (time - from).max(0.0);
        let all = work_to(self.end_s);
        if all > 0.0 {
            (work_to(time) / all).min(1.0)
        } else {
            0.0
        }
    }

    /// Wall time to the expected end [s], at this speed from this time on [s].
    fn wall_s(&self, speed: &Speed, time: f64) -> Option<f64> {
        let per_second = speed.per_second?;
        let left = (self.end_s - time).max(0.0);
        let later = match self.last {
            Some((share, from, more)) if speed.share != Some(share) => {
                let later = (self.end_s - from.max(time)).clamp(0.0, left);
                later * (more - 1.0)
            }
            _ => 0.0,
        };
        Some(per_second * (left + later))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ahead(last: Option<(Share, f64, f64)>) -> Ahead {
        Ahead {
            end_s: 2.0,
            last,
            next_look: Instant::now(),
        }
    }

    // Ten seconds of wall time a simulated one; from 1 s on half of the flow, thrice the slab.
    #[test]
    fn later_stages_take_as_many_times_longer_as_they_have_points() {
        let mut speed = Speed::default();
        speed.note(-9.0, -0.1, Share::Slab);
        speed.note(0.0, 0.0, Share::Slab);
        let two = ahead(Some((Share::Half, 1.0, 3.0)));
        assert_eq!(two.wall_s(&speed, 0.0), None, "no speed is known");
        speed.note(5.0, 0.5, Share::Slab);
        let close = |found: Option<f64>, wanted: f64| {
            assert!((found.unwrap() - wanted).abs() < 1e-9, "{found:?} {wanted}");
        };
        close(two.wall_s(&speed, 0.5), 5.0 + 30.0);
        close(ahead(None).wall_s(&speed, 0.5), 15.0);
        speed.note(6.0, 0.55, Share::Half);
        speed.note(6.0, 0.6, Share::Half);
        speed.note(9.0, 0.7, Share::Half);
        close(two.wall_s(&speed, 0.7), 1.3 * 30.0);
        close(Some(two.share_done(0.5)), 0.5 / 4.0);
        close(Some(ahead(None).share_done(0.5)), 0.25);
        close(two.wall_s(&speed, 2.5), 0.0);
    }
}
