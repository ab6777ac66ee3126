//! Stages of a flow's step, in either precision and for a share of the flow or the whole.

use super::offending_point::{Bounds, OffendingPoint};
use super::saved_flow::SavedFlow;
use crate::contact::point_body::{Around, FlowLoad, PenetratingPoint, Reach};
use crate::diagnostics::Totals;
use crate::mpm::instructions::Instructions;
use crate::mpm::redistribution::{RedistributionRates, Shifting};
use crate::mpm::strain_rate_smoothing::StrainRateSmoothing;
use crate::points::{Part, Point, PointMotion};
use crate::rigid::Body;
use crate::simulation::setup::{Setup, Share};
use crate::simulation::stages::StageEnds;
use crate::walls::Impulse;
use std::fmt::Debug;

/// A granular flow: its points, its grid, and the forces of bodies on it.
pub(in crate::simulation) trait Flow: Debug + Send + Sync {
    /// Points in the flow.
    fn count(&self) -> usize;

    /// Points of it that are computed; the others are their images.
    fn computed(&self) -> usize {
        self.count()
    }

    /// The share of it that is computed.
    fn share(&self) -> Share {
        Share::Whole
    }

    /// Speed of the fastest point after the last step [m/s].
    fn fastest(&self) -> f64;

    /// Begins a step: scatters mass and momentum to a new grid, finds the nodes at walls and the
    /// points within reach of bodies, and smooths strain rates.
    fn transfer(
        &mut self,
        given: &Setup,
        bodies: &[Body],
        start: &StepStart,
        stages: &mut StageEnds,
    );

    /// One sub-step: forces of bodies and stress, momentum, walls, strain (the
    /// last strain of a step may wait for [`Flow::finish`]). Returns the impulse
    /// of the walls.
    fn substep(
        &mut self,
        given: &Setup,
        bodies: &[Body],
        substep: Substep,
        stages: &mut StageEnds,
    ) -> Impulse;

    /// Load of the flow on each body in the current sub-step; empty before the first.
    fn on_bodies(&self) -> &[FlowLoad];

    /// Ends a step: gathers the motion at the points, redistributes them, and applies the
    /// penetration correction.
    fn finish(
        &mut self,
        given: &Setup,
        bodies: &[Body],
        end: &StepEnd,
        stages: &mut StageEnds,
    ) -> Finished;

    /// An offending point after a step, if there is one.
    fn offending_point(&self, bounds: &Bounds) -> Option<OffendingPoint>;

    /// Adds points between two steps.
    fn add(&mut self, points: Vec<Point>);

    /// Removes the points beyond the open ends; `None` if there are none.
    fn remove_outflow(&mut self, given: &Setup) -> Option<(u64, Totals)>;

    /// Sums over the points.
    fn totals(&self, given: &Setup) -> Totals;

    /// Visits the points, those within a box if one is given, in any order.
    fn visit(&self, within: Option<&Around>, visit: &mut dyn FnMut(&Point));

    /// Visits the motions of a part of the points in any order.
    fn visit_motions(&self, part: Part, visit: &mut dyn FnMut(&PointMotion));

    /// Visits the computed points in any order.
    fn visit_computed(&self, visit: &mut dyn FnMut(&Point)) {
        self.visit(None, visit);
    }

    /// The part of it in a checkpoint.
    fn saved(&self) -> SavedFlow;

    /// Limits it to these instructions.
    fn limit_instructions(&mut self, instructions: Instructions);

    /// Bytes allocated for points and for the grid.
    fn bytes(&self) -> (usize, usize);
}

/// The start of a step.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulation) struct StepStart {
    /// Distance from bodies within which points are candidates.
    pub reach: Reach,
    /// Smoothing of the points' strain rates in it.
    pub strain_rate_smoothing: StrainRateSmoothing,
}

/// A sub-step of a flow.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulation) struct Substep {
    /// Its length [s].
    pub dt: f64,
    /// Elapsed share of its step, 0..1.
    pub passed: f64,
    /// True if its step ends with it.
    pub last: bool,
}

/// The end of a step.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulation) struct StepEnd {
    /// Length of its last sub-step [s].
    pub dt: f64,
    /// Rates of particle redistribution after it.
    pub redistribution: RedistributionRates,
}

/// Changes of points at the end of a step other than their motion with the nodes.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulation) struct Finished {
    /// Penetration corrections to a body's surface.
    pub penetration_correction: u64,
    /// The deepest point that stays inside a body because no position is free.
    pub stuck: Option<PenetratingPoint>,
    /// Changes of the points' sums by particle shifting.
    pub spread: Shifting,
}
