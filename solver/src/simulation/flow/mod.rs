//! The flow of a run and the stages of its step, in single or double precision.

mod block_flow;
mod images;
mod no_flow;
mod shared;

use super::setup::{Setup, Share, Shares};
use super::stages::StageEnds;
use crate::contact::point_body::{Around, FlowLoad, PenetratingPoint, Reach};
use crate::diagnostics::Totals;
use crate::mpm::blocks::Blocks;
use crate::mpm::instructions::Instructions;
use crate::mpm::redistribution::{RedistributionRates, Shifting};
use crate::mpm::strain_rate_smoothing::StrainRateSmoothing;
use crate::points::Point;
use crate::rigid::Body;
use crate::scenario::Precision;
use crate::walls::{Impulse, Plane};
use serde::{Deserialize, Serialize};
use std::fmt::Debug;

use block_flow::BlockFlow;
use no_flow::NoFlow;
use shared::SharedFlow;

/// A granular flow: its points, its grid, and the forces of bodies on it.
pub(super) trait Flow: Debug + Send + Sync {
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

    /// Removes the points beyond x = `end` [m]; `None` if there are none.
    fn remove_outflow(&mut self, end: f64, given: &Setup) -> Option<(u64, Totals)>;

    /// Sums over the points.
    fn totals(&self, given: &Setup) -> Totals;

    /// Visits the points, those within a box if one is given, in any order.
    fn visit(&self, within: Option<&Around>, visit: &mut dyn FnMut(&Point));

    /// The part of it in a checkpoint.
    fn saved(&self) -> SavedFlow;

    /// Limits it to these instructions.
    fn limit_instructions(&mut self, instructions: Instructions);

    /// Bytes allocated for points and for the grid.
    fn bytes(&self) -> (usize, usize);
}

/// The start of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepStart {
    /// Distance from bodies within which points are candidates.
    pub reach: Reach,
    /// Smoothing of the points' strain rates in it.
    pub strain_rate_smoothing: StrainRateSmoothing,
}

/// A sub-step of a flow.
#[derive(Debug, Clone, Copy)]
pub(super) struct Substep {
    /// Its length [s].
    pub dt: f64,
    /// Elapsed share of its step, 0..1.
    pub passed: f64,
    /// True if its step ends with it.
    pub last: bool,
}

/// The end of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepEnd {
    /// Length of its last sub-step [s].
    pub dt: f64,
    /// Rates of particle redistribution after it.
    pub redistribution: RedistributionRates,
}

/// Changes of points at the end of a step other than their motion with the nodes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Finished {
    /// Penetration corrections to a body's surface.
    pub penetration_correction: u64,
    /// The deepest point that stays inside a body because no position is free.
    pub stuck: Option<PenetratingPoint>,
    /// Changes of the points' sums by particle shifting.
    pub spread: Shifting,
}

/// Bounds of the points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds<'a> {
    /// The walls.
    pub planes: &'a [Plane],
    /// Largest distance of a point behind a wall [m].
    pub tolerance: f64,
    /// Largest density [kg/m³].
    pub densest: f64,
}

/// Fault of a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum OffendingPoint {
    /// A non-finite quantity.
    NonFinite {
        /// Identity of the point.
        point: u32,
        /// Name of the quantity.
        quantity: &'static str,
    },
    /// It is behind a wall.
    BehindWall {
        /// Identity of the point.
        point: u32,
        /// Name of the wall.
        wall: &'static str,
        /// Depth [m].
        depth_m: f64,
    },
    /// It is too dense.
    Crushed {
        /// Identity of the point.
        point: u32,
        /// Its density [kg/m³].
        density: f64,
    },
}

impl OffendingPoint {
    /// Fault of a point, if it has any.
    fn of(point: &Point, bounds: &Bounds) -> Option<Self> {
        if let Some(quantity) = point.non_finite() {
            return Some(Self::NonFinite {
                point: point.id,
                quantity,
            });
        }
        if point.density() > bounds.densest {
            return Some(Self::Crushed {
                point: point.id,
                density: point.density(),
            });
        }
        let behind = |plane: &&Plane| plane.height(&point.position) < -bounds.tolerance;
        bounds
            .planes
            .iter()
            .find(behind)
            .map(|plane| Self::BehindWall {
                point: point.id,
                wall: plane.name,
                depth_m: -plane.height(&point.position),
            })
    }
}

/// A flow between two steps in a checkpoint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum SavedFlow {
    /// None at all.
    None,
    /// In single precision.
    Single(Blocks<f32>),
    /// In double precision.
    Double(Blocks<f64>),
    /// A share of it.
    Share(Share, Box<SavedFlow>),
}

impl SavedFlow {
    /// The restored flow of a run that computes these shares of it.
    pub(super) fn restored(self, given: &Setup, shares: Option<Shares>) -> Box<dyn Flow> {
        match (self, shares) {
            (Self::None, _) => Box::new(NoFlow),
            (Self::Single(blocks), _) => Box::new(BlockFlow::restored(blocks, given)),
            (Self::Double(blocks), _) => Box::new(BlockFlow::restored(blocks, given)),
            (Self::Share(share, flow), Some(shares)) => {
                Box::new(SharedFlow::restored(*flow, share, shares, given))
            }
            (Self::Share(_, flow), None) => flow.restored(given, None),
        }
    }

    fn precision(&self) -> Precision {
        match self {
            Self::None | Self::Double(_) => Precision::Double,
            Self::Single(_) => Precision::Single,
            Self::Share(_, flow) => flow.precision(),
        }
    }
}

/// A flow of these points in the precision asked for, with these computed shares.
pub(super) fn start(
    points: &[Point],
    given: &Setup,
    precision: Precision,
    shares: Option<Shares>,
) -> Box<dyn Flow> {
    match shares {
        Some(shares) => Box::new(SharedFlow::start(points, shares, given, precision)),
        None => plainly(points, given, precision),
    }
}

/// A flow that is computed as a whole.
fn plainly(points: &[Point], given: &Setup, precision: Precision) -> Box<dyn Flow> {
    match (given.flow.is_some(), precision) {
        (false, _) => Box::new(NoFlow),
        (true, Precision::Single) => Box::new(BlockFlow::<f32>::new(points, given)),
        (true, Precision::Double) => Box::new(BlockFlow::<f64>::new(points, given)),
    }
}
