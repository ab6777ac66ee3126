//! Samples at their own times, whatever steps a run takes.

use super::means::Means;
use super::mode::mode;
use super::motion::Motion;
use super::submergence::submerged_fraction;
use super::{BodySample, Sample};
use crate::rigid::Body;
use crate::scenario::Scenario;
use crate::simulation::{Simulation, SubstepReport};
use serde::{Deserialize, Serialize};

/// Takes samples as a run goes by: bodies within the sub-step that holds a sample's
/// time, the flow round them where its step ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Sampling {
    times: Times,
    /// End of the last sub-step [s].
    time: f64,
    /// Per body, then.
    last: Vec<Motion>,
    /// Per body, since the last sample.
    means: Vec<Means>,
    /// Samples of the step in hand.
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
            last: Vec::new(),
            means: vec![Means::default(); scenario.bodies.len()],
            waiting: Vec::new(),
        }
    }

    /// The sample of time 0.
    pub(super) fn start(&mut self, simulation: &Simulation) -> Vec<Sample> {
        self.last = simulation.bodies().iter().map(Motion::of).collect();
        self.sample(simulation, 0.0, &self.last.clone());
        self.finished(simulation)
    }

    /// Takes one sub-step in, and the samples due within it.
    pub(super) fn take_in(&mut self, simulation: &Simulation, report: &SubstepReport) {
        let now: Vec<Motion> = simulation.bodies().iter().map(Motion::of).collect();
        let (start, dt) = (self.time, report.time_s - self.time);
        let mut taken = 0.0;
        while let Some(due) = self.times.next().filter(|due| *due <= report.time_s) {
            let passed = ((due - start) / dt).min(1.0);
            self.add_up(simulation, (passed - taken) * report.substep_s);
            let pairs = self.last.iter().zip(&now);
            let between: Vec<Motion> = pairs
                .map(|(last, now)| last.towards(now, passed, dt))
                .collect();
            self.sample(simulation, due, &between);
            taken = passed;
        }
        self.add_up(simulation, (1.0 - taken) * report.substep_s);
        (self.time, self.last) = (report.time_s, now);
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
    pub(super) fn end(&mut self, simulation: &Simulation) -> Vec<Sample> {
        if self.times.last < self.time {
            self.sample(simulation, self.time, &self.last.clone());
        }
        self.finished(simulation)
    }

    /// Adds `dt` [s] of the present sub-step to the means.
    fn add_up(&mut self, simulation: &Simulation, dt: f64) {
        for (place, means) in self.means.iter_mut().enumerate() {
            let flow = simulation.flow_load(place).load;
            means.take_in(&flow, &simulation.body_report(place), dt);
        }
    }

    fn sample(&mut self, simulation: &Simulation, time_s: f64, motions: &[Motion]) {
        let bodies = simulation.bodies().iter().zip(motions).zip(&mut self.means);
        let sampled = bodies
            .enumerate()
            .map(|(place, ((body, motion), means))| BodySample {
                touching_points: simulation.flow_load(place).touching_points,
                ..body_sample(body, motion, &std::mem::take(means))
            });
        let bodies = sampled.collect();
        self.waiting.push(Sample { time_s, bodies });
        self.times.next += 1;
        self.times.last = time_s;
    }
}

/// What is known of a body without looking at the flow.
fn body_sample(body: &Body, motion: &Motion, means: &Means) -> BodySample {
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
        mode: mode(body, motion, means),
    }
}
