//! One step: a transfer at the speed of the flow, sub-steps at the speed of
//! sound, one gather.

use super::{Simulation, StepInHand, SubstepReport};
use crate::contact::{body_wall, point_body};
use crate::diagnostics::{Audit, FlowMoments, Totals};
use crate::error::StepError;
use crate::points::{self, Deformation, Point};
use crate::rigid::Freedom;
use crate::stability::{self, Pace};
use crate::transfer;
use rayon::prelude::*;
use std::sync::Arc;

impl Simulation {
    /// Takes one sub-step, of the step in hand or of a new one.
    pub(super) fn advance(&mut self) -> Result<SubstepReport, StepError> {
        let mut step = match self.scratch.in_hand.take() {
            Some(step) => step,
            None => self.begin_step()?,
        };
        let dt = step.pace.substep;
        self.on_threads(|simulation| simulation.substep(dt));
        step.done += 1;
        let clock = &mut self.state.clock;
        clock.time = step.start + f64::from(step.done) * dt;
        clock.substeps += 1;
        clock.point_steps += self.state.points.len() as u64;
        if step.done < step.pace.count {
            self.scratch.in_hand = Some(step);
            return Ok(self.report(dt, None));
        }
        let sample = self.end_step(&step.pace)?;
        Ok(self.report(dt, sample))
    }

    fn begin_step(&mut self) -> Result<StepInHand, StepError> {
        let pace = self.pace()?;
        self.on_threads(|simulation| simulation.lay_grid(&pace));
        Ok(StepInHand {
            pace,
            start: self.state.clock.time,
            done: 0,
        })
    }

    /// Sub-steps at the speed of sound in one step of the flow.
    fn pace(&self) -> Result<Pace, StepError> {
        let clock = &self.state.clock;
        let remaining = self.given.timing.sample_time(clock.next_sample) - clock.time;
        let Some(flow) = &self.given.flow else {
            return Ok(stability::pace_without_flow(remaining));
        };
        if self.state.points.is_empty() {
            return Ok(stability::pace_without_flow(remaining));
        }
        let flow_speed = largest(self.state.points.iter().map(|p| p.velocity.norm()));
        let body_speed = largest(self.state.bodies.iter().map(|body| body.largest_speed()));
        // A body faster than the flow must not jump over points either.
        let fastest = flow_speed.max(body_speed);
        let substep = flow
            .limits
            .substep(fastest)
            .min(flow.contact_substep(&self.state.bodies));
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

    /// Transfers the points to a new grid.
    fn lay_grid(&mut self, pace: &Pace) {
        let (state, scratch) = (&mut self.state, &mut self.scratch);
        let occupied = points::sort_by_block(&mut state.points, &self.given.lattice);
        scratch.grid.reset_around(&occupied);
        transfer::scatter_momentum(&state.points, &mut scratch.grid);
        self.given
            .walls
            .find_boundary(&scratch.grid, &mut scratch.boundary);
        scratch.deformations.clear();
        scratch
            .deformations
            .extend(state.points.iter().map(Deformation::start));
        let reach = self.given.contact_reach(&state.bodies, pace);
        scratch
            .loads
            .find_candidates(&state.points, &scratch.grid, &state.bodies, reach);
    }

    /// One sub-step at the speed of sound.
    fn substep(&mut self, dt: f64) {
        let (given, state, scratch) = (&self.given, &mut self.state, &mut self.scratch);
        if let Some(flow) = &given.flow {
            let (grid, loads) = (&mut scratch.grid, &mut scratch.loads);
            loads.evaluate(&state.points, grid, &state.bodies, flow.sphere, dt);
            transfer::scatter_forces(&state.points, &scratch.deformations, &loads.on_points, grid);
            grid.advance_momentum(given.gravity, dt);
            let from_walls = given.walls.constrain(&scratch.boundary, grid);
            grid.displace(dt);
            transfer::gather_gradient(grid, &state.points, dt, &mut scratch.deformations);
            points::update_stress(&mut state.points, &scratch.deformations, &flow.material, dt);
            let from_bodies = loads.impulse_on_flow(&state.bodies, dt, Freedom::Free);
            let from_barriers = loads.impulse_on_flow(&state.bodies, dt, Freedom::Fixed);
            let weight = scratch.flow.weight(&given.gravity, dt);
            for from_outside in [&from_walls, &from_barriers, &weight] {
                state.audit.exchange(from_outside);
                scratch.flow.momentum += from_outside.linear;
            }
            scratch.flow.momentum += from_bodies.linear;
            scratch.flow.first_moment += scratch.flow.momentum * dt;
        }
        for (place, body) in state.bodies.iter_mut().enumerate() {
            let flow = scratch
                .loads
                .on_bodies
                .get(place)
                .copied()
                .unwrap_or_default();
            let report = body_wall::advance(body, &given.planes, &flow.load, &given.gravity, dt);
            state.audit.exchange(&report.wall);
            state.audit.exchange(&report.gravity);
            state.audit.deepest_overlap_ratio = state
                .audit
                .deepest_overlap_ratio
                .max(flow.deepest_overlap_ratio);
            scratch.body_reports[place] = report;
        }
    }

    /// Hands the motion back to the points and checks what came of it; returns
    /// the sample time reached, if any.
    fn end_step(&mut self, pace: &Pace) -> Result<Option<u64>, StepError> {
        self.on_threads(|simulation| {
            let (state, scratch) = (&mut simulation.state, &simulation.scratch);
            transfer::gather_motion(&scratch.grid, &scratch.deformations, &mut state.points);
            let put_back = point_body::put_back(&mut state.points, &scratch.grid, &state.bodies);
            state.audit.points_put_back += put_back;
        });
        let clock = &mut self.state.clock;
        clock.steps += 1;
        let mut sample = None;
        if pace.reaches {
            sample = Some(clock.next_sample);
            clock.time = self.given.timing.sample_time(clock.next_sample);
            clock.next_sample += 1;
        }
        self.look_for_culprits()?;
        self.remove_what_left();
        self.check_audit();
        Ok(sample)
    }

    fn report(&self, substep_s: f64, sample: Option<u64>) -> SubstepReport {
        let clock = &self.state.clock;
        SubstepReport {
            time_s: clock.time,
            substep_s,
            substeps: clock.substeps,
            steps: clock.steps,
            points: self.state.points.len() as u64,
            step_ended: self.scratch.in_hand.is_none(),
            sample,
        }
    }

    fn look_for_culprits(&self) -> Result<(), StepError> {
        let time_s = self.state.clock.time;
        for (body, state) in self.state.bodies.iter().enumerate() {
            if let Some(quantity) = state.non_finite() {
                return Err(StepError::NonFiniteBody {
                    time_s,
                    body,
                    quantity,
                });
            }
        }
        self.look_behind_walls()?;
        let sick = |point: &&Point| point.non_finite().is_some();
        if let Some(point) = self.state.points.par_iter().find_first(sick) {
            return Err(StepError::NonFinitePoint {
                time_s,
                point: point.id,
                quantity: point.non_finite().unwrap_or("state"),
            });
        }
        let tolerance = self.given.lattice.spacing.max();
        for plane in &self.given.planes {
            let behind = |point: &&Point| plane.height(&point.position) < -tolerance;
            if let Some(point) = self.state.points.par_iter().find_first(behind) {
                return Err(StepError::PointBehindWall {
                    time_s,
                    point: point.id,
                    wall: plane.name,
                    depth_m: -plane.height(&point.position),
                });
            }
        }
        Ok(())
    }

    /// A body whose core has gone through a wall was not held by its contacts.
    fn look_behind_walls(&self) -> Result<(), StepError> {
        let time_s = self.state.clock.time;
        for (place, body) in self.state.bodies.iter().enumerate() {
            for plane in &self.given.planes {
                let deepest = body.shape.extent_along(&body.to_body(&-plane.normal));
                let core =
                    plane.height(&body.state.position) - deepest + body.shape.sphero_radius();
                if body.freedom == Freedom::Free && core < 0.0 {
                    return Err(StepError::BodyBehindWall {
                        time_s,
                        body: place,
                        wall: plane.name,
                        depth_m: -core,
                    });
                }
            }
        }
        Ok(())
    }

    /// Takes points beyond the open end out, and counts them.
    fn remove_what_left(&mut self) {
        let end = self.given.open_end;
        if self
            .state
            .points
            .iter()
            .all(|point| point.position.x <= end)
        {
            return;
        }
        let (stay, gone) = self
            .state
            .points
            .iter()
            .partition::<Vec<Point>, _>(|point| point.position.x <= end);
        let totals = self.flow_totals(&gone);
        self.state.audit.leave(gone.len() as u64, &totals);
        self.state.points = stay;
    }

    fn flow_totals(&self, points: &[Point]) -> Totals {
        let Some(flow) = &self.given.flow else {
            return Totals::default();
        };
        let moment = self.given.lattice.kernel_moment();
        self.pool
            .install(|| Totals::of_points(points, &flow.material, &moment, &self.given.gravity))
    }

    fn check_audit(&mut self) {
        let flow = self.flow_totals(&self.state.points);
        let bodies = Totals::of_bodies(&self.state.bodies, &self.given.gravity);
        let held = self.scratch.loads.on_bodies.iter().map(|load| load.energy);
        self.state.audit.check(&flow, &bodies, held.sum());
        self.scratch.flow = FlowMoments::of(&flow);
    }

    /// Begins the audit from the present state.
    pub(super) fn start_audit(&mut self) {
        let flow = self.flow_totals(&self.state.points);
        let bodies = Totals::of_bodies(&self.state.bodies, &self.given.gravity);
        self.state.audit = Audit::start(&flow, &bodies);
        self.scratch.flow = FlowMoments::of(&flow);
    }

    /// Takes up the flow's sums of a state that comes with its audit.
    pub(super) fn resume_audit(&mut self) {
        let flow = self.flow_totals(&self.state.points);
        self.scratch.flow = FlowMoments::of(&flow);
    }

    /// Does `work` on the solver's threads.
    fn on_threads<R: Send>(&mut self, work: impl FnOnce(&mut Self) -> R + Send) -> R {
        let pool = Arc::clone(&self.pool);
        pool.install(|| work(self))
    }
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}
