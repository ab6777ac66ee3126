//! Samples at given times, independent of the steps of a run.

use super::means::Means;
use super::mode::{Movement, mode};
use super::motion::Motion;
use super::outcome::BodyHistory;
use super::submergence::submerged_fraction;
use super::{BodySample, Mode, Sample};
use crate::rigid::Body;
use crate::scenario::Scenario;
use crate::simulation::{Simulation, SubstepReport};
use serde::{Deserialize, Serialize};

/// Takes samples during a run: bodies within the sub-step that contains a sample's time, the
/// flow round them at the end of its step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Sampling {
    times: Times,
    /// End of the last sub-step [s].
    time: f64,
    /// Means of each body since the last sample.
    means: Vec<Means>,
    /// Samples of the current step.
    waiting: Vec<Sample>,
}

/// Sample times: the multiples of an interval, and the end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Times {
    interval: f64,
    duration: f64,
    /// Index of the next one.
    next: u64,
    /// The last one taken [s].
    last: f64,
}

impl Times {
    /// The next one [s]; `None` after the end.
    fn next(&self) -> Option<f64> {
        let before = self.next.checked_sub(1);
        if before.is_some_and(|k| self.time(k) == self.duration) {
            return None;
        }
        Some(self.time(self.next))
    }

    fn time(&self, k: u64) -> f64 {
        let time = k as f64 * self.interval;
        // The end may miss a whole number of intervals by rounding only.
        if time >= self.duration - 1e-9 * self.interval {
            self.duration
        } else {
            time
        }
    }
}

impl Sampling {
    pub(super) fn of(scenario: &Scenario) -> Self {
        Self {
            times: Times {
                interval: scenario.sample_interval_s,
                duration: scenario.duration_s,
                next: 0,
                last: 0.0,
            },
            time: 0.0,
            means: vec![Means::default(); scenario.bodies.len()],
            waiting: Vec::new(),
        }
    }

    /// The sample of time 0.
    pub(super) fn start(
        &mut self,
        simulation: &Simulation,
        histories: &[BodyHistory],
    ) -> Vec<Sample> {
        self.sample(simulation, histories, 0.0, &now(simulation));
        self.finished(simulation)
    }

    /// Adds one sub-step, and takes the samples due within it; `histories` are those before it.
    pub(super) fn take_in(
        &mut self,
        simulation: &Simulation,
        report: &SubstepReport,
        histories: &[BodyHistory],
    ) {
        let now = now(simulation);
        let (start, dt) = (self.time, report.time_s - self.time);
        let mut taken = 0.0;
        while let Some(due) = self.times.next().filter(|due| *due <= report.time_s) {
            let passed = ((due - start) / dt).min(1.0);
            self.add_up(simulation, (passed - taken) * report.substep_s);
            let pairs = histories.iter().zip(&now);
            let between: Vec<Motion> = pairs
                .map(|(history, now)| history.last().towards(now, passed, dt))
                .collect();
            self.sample(simulation, histories, due, &between);
            taken = passed;
        }
        self.add_up(simulation, (1.0 - taken) * report.substep_s);
        self.time = report.time_s;
    }

    /// The samples of a step that has ended.
    pub(super) fn finished(&mut self, simulation: &Simulation) -> Vec<Sample> {
        let mut samples = std::mem::take(&mut self.waiting);
        if samples.is_empty() {
            return samples;
        }
        for (place, body) in simulation.bodies().iter().enumerate() {
            let submerged_fraction = submerged_fraction(simulation, body);
            for sample in &mut samples {
                sample.bodies[place].submerged_fraction = submerged_fraction;
            }
        }
        samples
    }

    /// The sample of a run that ends now, between two steps; none if it has just been
    /// taken.
    pub(super) fn end(
        &mut self,
        simulation: &Simulation,
        histories: &[BodyHistory],
    ) -> Vec<Sample> {
        if self.times.last < self.time {
            self.sample(simulation, histories, self.time, &now(simulation));
        }
        self.finished(simulation)
    }

    /// Adds `dt` [s] of the current sub-step to the means.
    fn add_up(&mut self, simulation: &Simulation, dt: f64) {
        for (place, means) in self.means.iter_mut().enumerate() {
            let flow = simulation.flow_load(place).load;
            means.take_in(&flow, &simulation.body_report(place), dt);
        }
    }

    fn sample(
        &mut self,
        simulation: &Simulation,
        histories: &[BodyHistory],
        time_s: f64,
        motions: &[Motion],
    ) {
        let weight = |body: &Body, motion: &Motion| {
            let at = motion.position;
            let normal = simulation.bed().normal(at.x, at.y);
            normal * (-simulation.gravity().dot(&normal) * body.mass)
        };
        let pairs = simulation.bodies().iter().zip(motions).zip(histories);
        let pairs = pairs.zip(&self.means).enumerate();
        let sampled = pairs.map(|(place, (((body, motion), history), means))| BodySample {
            touching_points: simulation.flow_load(place).touching_points,
            mode: mode(
                body,
                &Movement {
                    at_rest: history.is_at_rest(body, motion),
                    rolls: history.rolls(),
                    means,
                    weight: weight(body, motion),
                },
            ),
            ..body_sample(motion, means)
        });
        let bodies = sampled.collect();
        self.waiting.push(Sample { time_s, bodies });
        self.means.fill(Means::default());
        self.times.next += 1;
        self.times.last = time_s;
    }
}

fn now(simulation: &Simulation) -> Vec<Motion> {
    simulation.bodies().iter().map(Motion::of).collect()
}

/// The part of a sample that depends on motion and means only.
fn body_sample(motion: &Motion, means: &Means) -> BodySample {
    let q = motion.orientation;
    BodySample {
        position_m: motion.position.into(),
        orientation: [q.w, q.i, q.j, q.k],
        velocity_m_s: motion.velocity.into(),
        angular_velocity_rad_s: motion.angular_velocity.into(),
        flow_force_n: means.mean(&means.flow.force).into(),
        flow_torque_nm: means.mean(&means.flow.torque).into(),
        wall_force_n: means.mean(&means.wall.force).into(),
        wall_torque_nm: means.mean(&means.wall.torque).into(),
        body_force_n: means.mean(&means.bodies.force).into(),
        body_torque_nm: means.mean(&means.bodies.torque).into(),
        touching_points: 0,
        submerged_fraction: 0.0,
        mode: Mode::Resting,
    }
}
