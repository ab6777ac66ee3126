//! A flow with a computed share: every stage is that of the share, and every result that of the
//! whole flow (docs/method.md, section 12).

use super::images::{Images, load_of_both};
use super::offending_point::{Bounds, OffendingPoint};
use super::saved_flow::SavedFlow;
use super::stages::{Finished, Flow, StepEnd, StepStart, Substep};
use super::whole::{restore_whole, start_whole};
use crate::contact::point_body::{Around, FlowLoad};
use crate::diagnostics::Totals;
use crate::mpm::instructions::Instructions;
use crate::points::{Part, Point, PointMotion};
use crate::rigid::Body;
use crate::scenario::Precision;
use crate::simulation::setup::{Setup, Share, Shares, near_body};
use crate::simulation::stages::StageEnds;
use crate::walls::{Impulse, Plane, RigidWalls};

/// A flow with a computed share, which is later enlarged.
#[derive(Debug)]
pub(in crate::simulation) struct SharedFlow {
    flow: Box<dyn Flow>,
    shares: Shares,
    share: Share,
    /// Set-up of the share: narrower walls.
    given: Setup,
    /// All planes that bound it, its own mirror included.
    planes: Vec<Plane>,
    images: Images,
    precision: Precision,
    instructions: Option<Instructions>,
    on_bodies: Vec<FlowLoad>,
}

impl SharedFlow {
    /// A flow of the points of the first share.
    pub(super) fn start(
        points: Vec<Point>,
        shares: Shares,
        whole: &Setup,
        precision: Precision,
    ) -> Self {
        let mut shared = Self::of(shares.first, shares, whole, precision);
        shared.flow = start_whole(points, &shared.given, precision);
        shared
    }

    /// A share restored between two steps.
    pub(super) fn restored(saved: SavedFlow, share: Share, shares: Shares, whole: &Setup) -> Self {
        let precision = saved.precision();
        let mut shared = Self::of(share, shares, whole, precision);
        shared.flow = restore_whole(saved, &shared.given);
        shared
    }

    /// A share without points yet.
    fn of(share: Share, shares: Shares, whole: &Setup, precision: Precision) -> Self {
        let partners = match share {
            Share::Half => shares.partners.clone(),
            Share::Whole | Share::Slab => Vec::new(),
        };
        let given = whole.between(share.walls(whole), partners);
        let mut planes = whole.planes.clone();
        let vertical_walls = given.walls.vertical_walls.iter();
        planes.extend(vertical_walls.map(|walls| *walls.sides[1].plane()));
        Self {
            planes,
            flow: start_whole(Vec::new(), &given, precision),
            images: Images::of_share(share, &shares.columns, whole),
            share,
            shares,
            given,
            precision,
            instructions: None,
            on_bodies: Vec::new(),
        }
    }

    /// True if the flow has come so near to a body that it begins to vary across.
    fn meets_a_body(&self, bodies: &[Body]) -> bool {
        bodies.iter().any(|body| {
            let mut any = false;
            let near = near_body(body, &self.given.lattice);
            self.flow.visit(Some(&near), &mut |_| any = true);
            any
        })
    }

    /// Changes to the last share: its points are images of the current ones.
    fn widen(&mut self, whole: &Setup) {
        let wider = self.shares.last;
        let rows = wider.rows_across(&self.shares.columns, whole.walls.halves_across());
        let mut points = Vec::new();
        let mut take = |point: &Point| {
            if self.images.row(point) < rows {
                points.push(*point);
            }
        };
        self.visit(None, &mut take);
        let on_bodies = std::mem::take(&mut self.on_bodies);
        let instructions = self.instructions;
        let shares = self.shares.clone();
        *self = Self::of(wider, shares, whole, self.precision);
        self.on_bodies = on_bodies;
        self.flow = start_whole(points, &self.given, self.precision);
        instructions
            .into_iter()
            .for_each(|best| self.limit_instructions(best));
    }

    /// Sums up the loads of the whole flow on the bodies.
    fn sum_up_loads(&mut self) {
        let own = self.flow.on_bodies();
        self.on_bodies.clear();
        self.on_bodies.extend_from_slice(own);
        if self.share != Share::Half {
            return;
        }
        let partners = self.shares.partners.iter();
        for ((both, own), partner) in self.on_bodies.iter_mut().zip(own).zip(partners) {
            *both = load_of_both(own, &self.flow.on_bodies()[*partner]);
        }
    }

    fn count_of_images(&self) -> f64 {
        f64::from(self.images.count())
    }
}

impl Flow for SharedFlow {
    fn count(&self) -> usize {
        self.flow.count() * self.images.count() as usize
    }

    fn computed(&self) -> usize {
        self.flow.count()
    }

    fn share(&self) -> Share {
        self.share
    }

    fn fastest(&self) -> f64 {
        self.flow.fastest()
    }

    fn transfer(&mut self, _: &Setup, bodies: &[Body], start: &StepStart, stages: &mut StageEnds) {
        self.flow.transfer(&self.given, bodies, start, stages);
        self.sum_up_loads();
    }

    fn substep(
        &mut self,
        _: &Setup,
        bodies: &[Body],
        substep: Substep,
        stages: &mut StageEnds,
    ) -> Impulse {
        let from_walls = self.flow.substep(&self.given, bodies, substep, stages);
        self.sum_up_loads();
        from_walls.of_images(self.count_of_images())
    }

    fn on_bodies(&self) -> &[FlowLoad] {
        &self.on_bodies
    }

    fn finish(
        &mut self,
        whole: &Setup,
        bodies: &[Body],
        end: &StepEnd,
        stages: &mut StageEnds,
    ) -> Finished {
        let finished = self.flow.finish(&self.given, bodies, end, stages);
        let count = self.images.count();
        if self.share != self.shares.last && self.meets_a_body(bodies) {
            self.widen(whole);
        }
        Finished {
            penetration_correction: finished.penetration_correction * u64::from(count),
            stuck: finished.stuck,
            spread: finished.spread.of_images(f64::from(count)),
        }
    }

    fn offending_point(&self, bounds: &Bounds) -> Option<OffendingPoint> {
        self.flow.offending_point(&Bounds {
            walls: RigidWalls::planar(&self.planes),
            ..*bounds
        })
    }

    fn add(&mut self, points: Vec<Point>) {
        self.flow.add(points);
    }

    fn remove_outflow(&mut self, _: &Setup) -> Option<(u64, Totals)> {
        let (count, totals) = self.flow.remove_outflow(&self.given)?;
        let count = count * u64::from(self.images.count());
        Some((count, totals.of_images(self.count_of_images())))
    }

    fn totals(&self, _: &Setup) -> Totals {
        let totals = self.flow.totals(&self.given);
        totals.of_images(self.count_of_images())
    }

    fn visit(&self, within: Option<&Around>, visit: &mut dyn FnMut(&Point)) {
        for which in 0..self.images.count() {
            let around = within.map(|around| self.images.around(which, around));
            let mut show = |point: &Point| visit(&self.images.of(which, point));
            self.flow.visit(around.as_ref(), &mut show);
        }
    }

    fn visit_motions(&self, part: Part, visit: &mut dyn FnMut(&PointMotion)) {
        // Whoever divides the work does so on a terrain, where nothing is shared.
        if part.is_first() {
            self.visit(None, &mut |point| visit(&PointMotion::of(point)));
        }
    }

    fn visit_computed(&self, visit: &mut dyn FnMut(&Point)) {
        self.flow.visit_computed(visit);
    }

    fn saved(&self) -> SavedFlow {
        SavedFlow::Share(self.share, Box::new(self.flow.saved()))
    }

    fn limit_instructions(&mut self, instructions: Instructions) {
        self.instructions = Some(instructions);
        self.flow.limit_instructions(instructions);
    }

    fn bytes(&self) -> (usize, usize) {
        self.flow.bytes()
    }
}
