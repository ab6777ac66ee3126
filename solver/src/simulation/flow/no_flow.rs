//! The flow of a run of bodies alone: none.

use super::offending_point::{Bounds, OffendingPoint};
use super::saved_flow::SavedFlow;
use super::stages::{Finished, Flow, StepEnd, StepStart, Substep};
use crate::contact::point_body::{Around, FlowLoad};
use crate::diagnostics::Totals;
use crate::mpm::instructions::Instructions;
use crate::mpm::redistribution::Shifting;
use crate::points::{Part, Point, PointMotion};
use crate::rigid::Body;
use crate::simulation::setup::Setup;
use crate::simulation::stages::StageEnds;
use crate::walls::Impulse;

/// No flow.
#[derive(Debug)]
pub(super) struct NoFlow;

impl Flow for NoFlow {
    fn count(&self) -> usize {
        0
    }

    fn fastest(&self) -> f64 {
        0.0
    }

    fn transfer(&mut self, _: &Setup, _: &[Body], _: &StepStart, _: &mut StageEnds) {}

    fn substep(&mut self, _: &Setup, _: &[Body], _: Substep, _: &mut StageEnds) -> Impulse {
        Impulse::default()
    }

    fn on_bodies(&self) -> &[FlowLoad] {
        &[]
    }

    fn finish(&mut self, _: &Setup, _: &[Body], _: &StepEnd, _: &mut StageEnds) -> Finished {
        Finished {
            penetration_correction: 0,
            stuck: None,
            spread: Shifting::default(),
        }
    }

    fn offending_point(&self, _: &Bounds) -> Option<OffendingPoint> {
        None
    }

    fn add(&mut self, _: Vec<Point>) {}

    fn remove_outflow(&mut self, _: &Setup) -> Option<(u64, Totals)> {
        None
    }

    fn totals(&self, _: &Setup) -> Totals {
        Totals::default()
    }

    fn visit(&self, _: Option<&Around>, _: &mut dyn FnMut(&Point)) {}

    fn visit_motions(&self, _: Part, _: &mut dyn FnMut(&PointMotion)) {}

    fn saved(&self) -> SavedFlow {
        SavedFlow::None
    }

    fn limit_instructions(&mut self, _: Instructions) {}

    fn bytes(&self) -> (usize, usize) {
        (0, 0)
    }
}
