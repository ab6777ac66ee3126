//! A step: a transfer at the speed of the flow, sub-steps at the speed of sound, a gather.

use super::flow::{StepEnd, StepStart, Substep};
use super::stages::StepStage;
use super::{Simulation, StepInHand, SubstepReport};
use crate::body_energy::BodyEnergy;
use crate::contact::island::{self, Surroundings};
use crate::contact::point_body::impulse_on_flow;
use crate::diagnostics::{Audit, FlowMoments, Totals};
use crate::error::StepError;
use crate::method::METHOD;
use crate::mpm::redistribution::RedistributionRates;
use crate::mpm::strain_rate_smoothing::StrainRateSmoothing;
use crate::rigid::{Body, Load};
use crate::stability::{self, Pace};

/// Number of body sub-steps above which the sub-step is shortened.
const MANY_BODY_SUBSTEPS: f64 = 10_000.0;

impl Simulation {
    /// Computes one sub-step, of the current step or of a new one.
    pub(super) fn advance(&mut self) -> Result<SubstepReport, StepError> {
        let mut step = match self.scratch.in_hand.take() {
            Some(step) => step,
            None => self.begin_step()?,
        };
        let dt = step.pace.substep;
        let passed = f64::from(step.done) / f64::from(step.pace.count);
        step.done += 1;
        let last = step.done == step.pace.count;
        self.substep(Substep { dt, passed, last });
        if self.cancellation.is_asked() {
            return Ok(self.report(dt));
        }
        self.look_at_body_steps(dt)?;
        let clock = &mut self.state.clock;
        clock.time = step.start + f64::from(step.done) * dt;
        clock.substeps += 1;
        clock.point_steps += self.state.flow.computed() as u64;
        if step.done < step.pace.count {
            self.scratch.in_hand = Some(step);
            return Ok(self.report(dt));
        }
        self.end_step(&step)?;
        Ok(self.report(dt))
    }

    fn begin_step(&mut self) -> Result<StepInHand, StepError> {
        let until = self.stretch_end();
        let pace = self.pace(until - self.state.clock.time)?;
        let start = StepStart {
            reach: self.given.contact_reach(&self.state.bodies, &pace),
            strain_rate_smoothing: match &self.given.flow {
                Some(flow) if flow.material.is_granular() => {
                    let fastest = self.state.flow.fastest();
                    StrainRateSmoothing::at(flow.limits.governing_speed(fastest))
                }
                _ => StrainRateSmoothing::NONE,
            },
        };
        let (state, stages) = (&mut self.state, &mut self.scratch.stages);
        state
            .flow
            .transfer(&self.given, &state.bodies, &start, stages);
        Ok(StepInHand {
            until,
            pace,
            start: self.state.clock.time,
            done: 0,
        })
    }

    /// Sub-steps at the speed of sound in one step of the flow.
    fn pace(&self, remaining: f64) -> Result<Pace, StepError> {
        let (clock, timing) = (&self.state.clock, &self.given.timing);
        let flow = self.given.flow.as_ref();
        let Some(flow) = flow.filter(|_| self.state.flow.count() > 0) else {
            let longest = METHOD.time_step.without_flow.min(timing.longest_substep);
            let longest = self.for_bodies(longest, longest);
            return Ok(stability::pace_without_flow(longest, remaining));
        };
        let flow_speed = self.state.flow.fastest();
        let body_speeds = self.state.bodies.iter().map(Body::speed_ahead);
        let body_speed = body_speeds.fold(0.0, f64::max);
        // A body faster than the flow must not jump over points either.
        let fastest = flow_speed.max(body_speed);
        let substep = flow
            .limits
            .substep(fastest)
            .min(flow.limits.body_substep(body_speed))
            .min(self.contact_substep)
            .min(timing.longest_substep);
        let step = flow.limits.division(substep, fastest).step();
        let substep = self.for_bodies(substep, step);
        let limit = flow.limits.shortest_substep();
        if flow.limits.substep(flow_speed) < limit {
            return Err(StepError::TimeStepCollapse {
                time_s: clock.time,
                substep_s: flow.limits.substep(flow_speed),
                speed_m_s: flow_speed,
                limit_s: limit,
            });
        }
        Ok(flow.limits.pace(substep, fastest, remaining))
    }

    /// A sub-step no longer than this [s] in which no body needs too many of its own, also at the
    /// end of a `step` [s] that starts now.
    fn for_bodies(&self, longest: f64, step: f64) -> f64 {
        let around = self.given.surroundings(self.state.clock.time);
        let (bodies, contact_pairs) = (&self.state.bodies, &self.state.contact_pairs);
        let most = island::substeps_ahead(bodies, contact_pairs, &around, longest, step);
        if most > MANY_BODY_SUBSTEPS {
            longest * (MANY_BODY_SUBSTEPS / most)
        } else {
            longest
        }
    }

    /// Computes one sub-step at the speed of sound.
    fn substep(&mut self, substep: Substep) {
        let dt = substep.dt;
        let (given, state, scratch) = (&self.given, &mut self.state, &mut self.scratch);
        if state.flow.count() > 0 {
            let from_walls = state
                .flow
                .substep(given, &state.bodies, substep, &mut scratch.stages);
            let (on_bodies, bodies) = (state.flow.on_bodies(), &state.bodies);
            let from_bodies = impulse_on_flow(on_bodies, bodies, dt, Body::is_free);
            let from_barriers = impulse_on_flow(on_bodies, bodies, dt, |body| !body.is_free());
            let weight = state.moments.weight(&given.gravity, dt);
            for from_outside in [&from_walls, &from_barriers, &weight] {
                state.audit.exchange(from_outside);
                state.moments.momentum += from_outside.linear;
            }
            state.moments.momentum += from_bodies.linear;
            for (body, on) in bodies.iter().zip(on_bodies) {
                state.audit.give(body.work_against(&on.load, dt));
            }
            state.moments.first_moment += state.moments.momentum * dt;
        }
        let on_bodies = state.flow.on_bodies();
        let flow = |body: usize| on_bodies.get(body).map_or_else(Load::default, |on| on.load);
        let around = Surroundings {
            cancellation: Some(&self.cancellation),
            ..given.surroundings(state.clock.time)
        };
        let (bodies, contact_pairs) = (&mut state.bodies, &mut state.contact_pairs);
        let reports = &mut scratch.body_reports;
        island::advance(bodies, contact_pairs, reports, flow, &around, dt);
        for report in &scratch.body_reports {
            state.audit.exchange(&report.wall);
            state.audit.exchange(&report.barrier);
            state.audit.exchange(&report.gravity);
            state.audit.give(report.work);
            state.audit.meet_solid(report.deepest_overlap_ratio);
        }
        let reports = state.bodies.iter().zip(&scratch.body_reports);
        for (energy, (body, report)) in state.energies.iter_mut().zip(reports) {
            energy.take_in(&report.energy, body, &given.gravity);
        }
        for flow in on_bodies {
            state.audit.meet(flow.deepest_overlap_ratio);
        }
        scratch.stages.done(StepStage::RigidBodies);
    }

    /// Gathers the motion at the points and checks the result.
    fn end_step(&mut self, step: &StepInHand) -> Result<(), StepError> {
        let pace = &step.pace;
        let state = &mut self.state;
        let stages = &mut self.scratch.stages;
        let duration = pace.substep * f64::from(pace.count);
        let fastest = state.flow.fastest();
        let end = StepEnd {
            dt: pace.substep,
            redistribution: match &self.given.flow {
                Some(flow) if flow.material.is_granular() => {
                    RedistributionRates::after(flow.limits.travel(duration, fastest))
                }
                _ => RedistributionRates::NONE,
            },
        };
        let finished = state.flow.finish(&self.given, &state.bodies, &end, stages);
        state.audit.penetration_corrections += finished.penetration_correction;
        state.audit.spread(&finished.spread.angular);
        state.audit.exchange(&finished.spread.stopped);
        state.moments.first_moment += finished.spread.first_moment;
        state.moments.momentum += finished.spread.stopped.linear;
        let clock = &mut state.clock;
        clock.steps += 1;
        let timing = self.given.timing;
        if pace.reaches_end {
            clock.time = step.until;
        }
        self.look_for_culprits(finished.stuck.as_ref())?;
        self.remove_what_left();
        self.release_what_is_due();
        self.scratch.stages.done(StepStage::Checks);
        let since = self.state.clock.substeps - self.state.clock.last_audit;
        if pace.reaches_end || since >= timing.audit_interval {
            self.check_audit();
            self.look_at_body_energies()?;
            self.look_at_energy()?;
            self.scratch.stages.done(StepStage::Audit);
        }
        Ok(())
    }

    fn report(&self, substep_s: f64) -> SubstepReport {
        let clock = &self.state.clock;
        SubstepReport {
            time_s: clock.time,
            substep_s,
            substeps: clock.substeps,
            steps: clock.steps,
            points: self.state.flow.computed() as u64,
            step_ended: self.scratch.in_hand.is_none(),
        }
    }

    /// Releases what is due after the start, and counts it.
    fn release_what_is_due(&mut self) {
        let time = self.state.clock.time;
        let Some(later) = self.given.later.as_ref().filter(|_| time > 0.0) else {
            return;
        };
        let (points, left_out) = later.release_at(time, &self.given, &self.state.bodies);
        let state = &mut self.state;
        state.clock.volume_left_out += left_out;
        state.clock.released_points += points.len() as u64;
        // By what is kept of the points: their own numbers are rounded there.
        let before = state.flow.totals(&self.given);
        state.flow.add(points);
        let come = state.flow.totals(&self.given).less(&before);
        state.audit.enter(&come);
        state.moments.gain(&come);
    }

    /// Time at which the present stretch of the run ends [s]: at the next release, or with the run.
    fn stretch_end(&self) -> f64 {
        self.next_release_s()
            .unwrap_or(f64::INFINITY)
            .min(self.given.timing.duration)
    }

    /// Removes points beyond the open ends, and counts them.
    fn remove_what_left(&mut self) {
        let state = &mut self.state;
        if let Some((count, totals)) = state.flow.remove_outflow(&self.given) {
            state.audit.leave(count, &totals);
            state.moments.lose(&totals);
        }
    }

    fn check_audit(&mut self) {
        let state = &mut self.state;
        let flow = state.flow.totals(&self.given);
        let bodies = Totals::of_bodies(&state.bodies, &self.given.gravity);
        let at_points = state.flow.on_bodies().iter().map(|load| load.energy);
        let at_bodies = state
            .contact_pairs
            .iter()
            .map(|contact_pair| contact_pair.energy);
        let held = at_points.sum::<f64>() + at_bodies.sum::<f64>();
        state.audit.check(&flow, &bodies, held);
        state.clock.last_audit = state.clock.substeps;
        self.state.moments = FlowMoments::of(&flow);
    }

    /// Begins the audit from the current state.
    pub(super) fn start_audit(&mut self) {
        let flow = self.state.flow.totals(&self.given);
        let bodies = Totals::of_bodies(&self.state.bodies, &self.given.gravity);
        self.state.audit = Audit::start(&flow, &bodies);
        self.state.moments = FlowMoments::of(&flow);
        let (bodies, contact_pairs) = (&self.state.bodies, &self.state.contact_pairs);
        self.state.energies = BodyEnergy::of(bodies, contact_pairs, &self.given.gravity);
    }
}
