//! The simulation: the step of docs/method.md, and the run (order of the stages:
//! docs/architecture.md).

mod clock;
mod flow;
mod guards;
mod saved;
mod setup;
mod stages;
mod step;

use crate::bed::Bed;
use crate::body_energy::BodyEnergy;
use crate::cancellation::Cancellation;
use crate::contact::body_body::ContactPair;
use crate::contact::island::{self, BodyReport};
use crate::contact::point_body::{Around, FlowLoad};
use crate::diagnostics::{Audit, FlowMoments};
use crate::error::{RestoreError, SaveError, SetupError, StepError};
use crate::math::Vec3;
use crate::mpm::instructions::Instructions;
use crate::points::{Part, Point, PointMotion};
use crate::rigid::Body;
use crate::scenario::Scenario;
use crate::stability::Pace;
use crate::walls::RigidWalls;
use clock::Clock;
use flow::Flow;
use rayon::ThreadPool;
use rayon::prelude::*;
use stages::StageEnds;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Bytes of a point that may touch a body, and of its contact.
pub(crate) const CANDIDATE_BYTES: usize = flow::CANDIDATE_BYTES;

pub use clock::Timing;
pub use guards::Guards;
pub use setup::{
    Columns, Division, Expected, GivenFlow, Outlet, PreparedScene, Reductions, Scene, Setup, Share,
    Shares, TerrainColumns,
};
pub use stages::{StageTimer, StepStage};

/// A run in progress: its set-up, state and scratch memory.
#[derive(Debug)]
pub struct Simulation {
    given: Setup,
    /// Longest stable sub-step for the contacts of its bodies with points [s].
    contact_substep: f64,
    state: State,
    scratch: Scratch,
    pool: Arc<ThreadPool>,
    /// Error that ended the run.
    failed: Option<StepError>,
    cancellation: Cancellation,
}

/// State in a checkpoint.
#[derive(Debug)]
struct State {
    clock: Clock,
    flow: Box<dyn Flow>,
    bodies: Vec<Body>,
    /// Contact histories of the bodies.
    contact_pairs: Vec<ContactPair>,
    audit: Audit,
    /// Balance of every body's energy.
    energies: Vec<BodyEnergy>,
    /// Sums of the flow, updated from audit to audit for gravity's torque.
    moments: FlowMoments,
}

/// Scratch memory of a step; its content between two steps is irrelevant.
#[derive(Debug)]
struct Scratch {
    body_reports: Vec<BodyReport>,
    /// The current step.
    in_hand: Option<StepInHand>,
    stages: StageEnds,
}

/// A step some of whose sub-steps are done.
#[derive(Debug)]
struct StepInHand {
    pace: Pace,
    /// End of the stretch of the run in which it lies [s].
    until: f64,
    /// Simulated time at its start [s].
    start: f64,
    done: u32,
}

/// Report of one acoustic sub-step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SubstepReport {
    /// Simulated time at its end [s].
    pub time_s: f64,
    /// Its length [s].
    pub substep_s: f64,
    /// Sub-steps so far, this one included.
    pub substeps: u64,
    /// Steps (transfers) finished so far.
    pub steps: u64,
    /// Points computed in it.
    pub points: u64,
    /// True if this sub-step ended a step: the points' own state is up to date.
    pub step_ended: bool,
}

/// Reason for which a run returned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Ending {
    /// It reached the given time.
    Reached,
    /// The observer asked it to stop, or it was cancelled.
    Interrupted,
}

impl Simulation {
    /// Sets up a scenario on `threads` solver threads.
    ///
    /// # Errors
    /// Too many points for one run, a reduction that the scene does not allow, or threads that
    /// can't be started.
    pub fn new(scenario: &Scenario, threads: usize) -> Result<Self, SetupError> {
        Self::of(PreparedScene::of(scenario)?, threads)
    }

    /// Sets up a prepared scene on `threads` solver threads.
    ///
    /// # Errors
    /// Threads that can't be started.
    pub fn of(prepared: PreparedScene, threads: usize) -> Result<Self, SetupError> {
        Self::of_scene(prepared.scene(), threads)
    }

    /// Sets up a scene on `threads` solver threads. Only a scenario's scene can be restored once
    /// saved.
    ///
    /// # Errors
    /// Threads that can't be started.
    pub fn of_scene(scene: Scene, threads: usize) -> Result<Self, SetupError> {
        let pool = start_threads(threads)?;
        let flow = flow::start(scene.points, &scene.given, scene.precision, scene.shares);
        let mut simulation = Self::assemble(scene.given, flow, scene.bodies, pool);
        simulation.state.clock.volume_left_out = scene.volume_left_out;
        simulation.start_audit();
        Ok(simulation)
    }

    fn assemble(
        given: Setup,
        flow: Box<dyn Flow>,
        mut bodies: Vec<Body>,
        pool: Arc<ThreadPool>,
    ) -> Self {
        let contact_pairs = island::meet(&mut bodies);
        island::hold(&mut bodies, &given.gravity);
        let flow_given = given.flow.as_ref();
        let contact_substep =
            flow_given.map_or(f64::INFINITY, |flow| flow.contact_substep(&bodies));
        let scratch = Scratch {
            body_reports: vec![BodyReport::default(); bodies.len()],
            in_hand: None,
            stages: StageEnds::default(),
        };
        let state = State {
            clock: Clock::start(flow.count() as u64),
            flow,
            bodies,
            contact_pairs,
            audit: Audit::default(),
            energies: Vec::new(),
            moments: FlowMoments::default(),
        };
        Self {
            given,
            contact_substep,
            state,
            scratch,
            pool,
            failed: None,
            cancellation: Cancellation::default(),
        }
    }

    /// Goes on with this number of solver threads; the results do not depend on it.
    ///
    /// # Errors
    /// Threads that can't be started; those before stay.
    pub fn set_threads(&mut self, threads: usize) -> Result<(), SetupError> {
        if threads != self.threads() {
            self.pool = start_threads(threads)?;
        }
        Ok(())
    }

    /// Ends the run within a sub-step once this is asked; it is interrupted then.
    pub fn cancel_with(&mut self, cancellation: Cancellation) {
        self.cancellation = cancellation;
    }

    /// Runs to the first step end at or after `until_s` (never beyond the scenario's duration),
    /// calling `observe` after every sub-step. On `Break` it returns at once; a later call
    /// continues from there.
    ///
    /// Neither `until_s` nor the place of an interruption changes the division of the run into
    /// steps: the bits are those of one call.
    ///
    /// # Errors
    /// A state that can't be advanced: see [`StepError`]. Every later call gives the same error.
    pub fn run(
        &mut self,
        until_s: f64,
        observe: impl FnMut(&Simulation, &SubstepReport) -> ControlFlow<()> + Send,
    ) -> Result<Ending, StepError> {
        let pool = Arc::clone(&self.pool);
        pool.install(|| self.run_here(until_s, observe))
    }

    fn run_here(
        &mut self,
        until_s: f64,
        mut observe: impl FnMut(&Simulation, &SubstepReport) -> ControlFlow<()>,
    ) -> Result<Ending, StepError> {
        if let Some(error) = &self.failed {
            return Err(error.clone());
        }
        let until = until_s.min(self.given.timing.duration);
        while self.state.clock.time < until || self.scratch.in_hand.is_some() {
            if self.cancellation.is_asked() {
                return Ok(Ending::Interrupted);
            }
            let report = match self.advance() {
                Ok(report) => report,
                Err(error) => {
                    self.failed = Some(error.clone());
                    return Err(error);
                }
            };
            // What a sub-step left that was given up is nothing to be observed.
            if self.cancellation.is_asked() || observe(self, &report).is_break() {
                return Ok(Ending::Interrupted);
            }
        }
        Ok(Ending::Reached)
    }

    /// Simulated time [s].
    pub fn time_s(&self) -> f64 {
        self.state.clock.time
    }

    /// The material points, in no particular order. They are unpacked for this,
    /// and within a step only identity, mass and position at the transfer are defined.
    pub fn points(&self) -> Vec<Point> {
        let mut points = Vec::with_capacity(self.state.flow.count());
        self.visit_points(None, |point| points.push(*point));
        points
    }

    /// Number of material points.
    pub fn point_count(&self) -> usize {
        self.state.flow.count()
    }

    /// Number of computed points; the others are their images.
    pub fn computed_points(&self) -> usize {
        self.state.flow.computed()
    }

    /// Visits the material points, those within a box if one is given; within a step with the
    /// fields that [`Simulation::points`] defines.
    pub fn visit_points(&self, within: Option<&Around>, mut visit: impl FnMut(&Point)) {
        self.state.flow.visit(within, &mut visit);
    }

    /// Folds the motions of the material points on all threads: each is added to one of some sums,
    /// which are joined. Neither must depend on the order.
    pub fn fold_motions<T: Send>(
        &self,
        none: impl Fn() -> T + Sync,
        add: impl Fn(&mut T, &PointMotion) + Sync,
        join: impl Fn(T, T) -> T,
    ) -> T {
        let of_part = |part: Part| {
            let mut sum = none();
            let flow = &self.state.flow;
            flow.visit_motions(part, &mut |point| add(&mut sum, point));
            sum
        };
        let parts = Part::all(self.pool.current_num_threads());
        let sums: Vec<T> = self.pool.install(|| parts.map(of_part).collect());
        sums.into_iter().reduce(join).unwrap_or_else(none)
    }

    /// Visits the computed points, each with the mass of itself and its images [kg]: enough for what
    /// does not depend on y.
    pub fn visit_computed_points(&self, mut visit: impl FnMut(&Point, f64)) {
        let flow = &self.state.flow;
        let images = flow.count() as f64 / flow.computed().max(1) as f64;
        flow.visit_computed(&mut |point| visit(point, point.mass * images));
    }

    /// Speed of the fastest point after the last step [m/s].
    pub fn fastest_m_s(&self) -> f64 {
        self.state.flow.fastest()
    }

    /// Share of the flow that is computed now.
    pub fn share(&self) -> Share {
        self.state.flow.share()
    }

    /// Bytes allocated for points and for the grid.
    pub fn bytes(&self) -> (usize, usize) {
        self.state.flow.bytes()
    }

    /// The bodies, in the scenario's order.
    pub fn bodies(&self) -> &[Body] {
        &self.state.bodies
    }

    /// Load of the flow on a body in the current sub-step.
    pub fn flow_load(&self, body: usize) -> FlowLoad {
        self.state
            .flow
            .on_bodies()
            .get(body)
            .copied()
            .unwrap_or_default()
    }

    /// Report of the current sub-step on a body.
    pub fn body_report(&self, body: usize) -> BodyReport {
        self.scratch.body_reports[body]
    }

    /// Contact pairs of the bodies, with overlaps and histories.
    pub fn contact_pairs(&self) -> &[ContactPair] {
        &self.state.contact_pairs
    }

    /// The audit so far.
    pub fn audit(&self) -> &Audit {
        &self.state.audit
    }

    /// Balance of a body's energy so far; zero for a fixed or prescribed body.
    pub fn body_energy(&self, body: usize) -> &BodyEnergy {
        &self.state.energies[body]
    }

    /// Gravity [m/s²].
    pub fn gravity(&self) -> Vec3 {
        self.given.gravity
    }

    /// Speed of a fall from the highest place and the fastest throw together [m/s]; infinite if
    /// unknown.
    pub fn speed_given(&self) -> f64 {
        self.given.guards.speed_given
    }

    /// The bed.
    pub fn bed(&self) -> &dyn Bed {
        self.given.walls.bed.as_ref()
    }

    /// The walls as bodies and points meet them.
    pub fn rigid_walls(&self) -> RigidWalls<'_> {
        self.given.rigid_walls()
    }

    /// Open ends of the ground.
    pub fn outlet(&self) -> &Outlet {
        &self.given.outlet
    }

    /// Node distances [m].
    pub fn spacing(&self) -> Vec3 {
        self.given.lattice.spacing
    }

    /// Cell size h [m].
    pub fn cell_size_m(&self) -> f64 {
        self.given.lattice.spacing.x
    }

    /// √(K/ρ) in use [m/s]; `None` without a flow.
    pub fn sound_speed_m_s(&self) -> Option<f64> {
        self.given.flow.as_ref().map(|flow| flow.limits.sound_speed)
    }

    /// Radius of a point's sphere, R_p [m]; 0 without a flow.
    pub fn point_radius_m(&self) -> f64 {
        self.given
            .flow
            .as_ref()
            .map_or(0.0, |flow| flow.sphere.radius)
    }

    /// Distance of neighbouring points [m]; 0 without a flow.
    pub fn point_spacing_m(&self) -> f64 {
        self.given
            .flow
            .as_ref()
            .map_or(0.0, |flow| flow.sphere.spacing)
    }

    /// Calls `watch` whenever a stage of the step is done, for timing.
    pub fn time_stages(&mut self, watch: StageTimer) {
        self.scratch.stages.tell(watch);
    }

    /// Limits the kernels to these instructions; the best available ones are the default.
    pub fn limit_instructions(&mut self, instructions: Instructions) {
        self.state.flow.limit_instructions(instructions);
    }

    /// Threads in use.
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Time of the next release [s], if one is still to come.
    pub fn next_release_s(&self) -> Option<f64> {
        let later = self.given.later.as_ref();
        later.and_then(|later| later.next_after(self.state.clock.time))
    }

    /// Material points at the start.
    pub fn released_points(&self) -> u64 {
        self.state.clock.released_points
    }

    /// Volume of the release not placed because a body is there [m³].
    pub fn excluded_volume_m3(&self) -> f64 {
        self.state.clock.volume_left_out
    }

    /// Steps, sub-steps, and sub-steps summed over points, so far.
    pub fn counts(&self) -> (u64, u64, u64) {
        let clock = &self.state.clock;
        (clock.steps, clock.substeps, clock.point_steps)
    }

    /// The whole state between two steps as bytes.
    ///
    /// # Errors
    /// Within a step, while the points' motion is on the grid: interrupt a run where
    /// [`SubstepReport::step_ended`] is true. A run that has failed can't be saved.
    pub fn save(&self) -> Result<Vec<u8>, SaveError> {
        if let Some(error) = &self.failed {
            return Err(SaveError::Failed(error.clone()));
        }
        if self.cancellation.is_asked() {
            return Err(SaveError::Cancelled);
        }
        match &self.scratch.in_hand {
            None => Ok(saved::save(self)),
            Some(_) => Err(SaveError::AmidStep {
                time_s: self.time_s(),
            }),
        }
    }

    /// Restores a saved state: the run continues with the same bits.
    ///
    /// # Errors
    /// Bytes that are no state of this solver version, or of another scenario.
    pub fn restore(
        scenario: &Scenario,
        threads: usize,
        saved: &[u8],
    ) -> Result<Self, RestoreError> {
        saved::restore(scenario, threads, saved)
    }
}

fn start_threads(threads: usize) -> Result<Arc<ThreadPool>, SetupError> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map(Arc::new)
        .map_err(|error| SetupError::Threads {
            threads,
            reason: error.to_string(),
        })
}
