//! The plain path: every stage separately, in double precision.

use super::{Bounds, Finished, Flow, OffendingPoint, SavedFlow, StepEnd, StepStart, Substep};
use crate::contact::point_body::{
    self, Around, ContactTime, CouplingGrid, FlowLoad, Loads, Moving, PenetratingPoint,
    PenetrationCorrection, PointAccess,
};
use crate::diagnostics::Totals;
use crate::fast::instructions::Instructions;
use crate::grid::Grid;
use crate::kernel::PointStencil;
use crate::math::Vec3;
use crate::points::{self, Deformation, Point};
use crate::redistribution::{self, Shifting};
use crate::rigid::Body;
use crate::simulation::setup::Setup;
use crate::simulation::stages::{StageEnds, StepStage};
use crate::transfer;
use crate::walls::{Boundary, Impulse};
use rayon::prelude::*;

#[derive(Debug)]
pub(in crate::simulation) struct PlainFlow {
    points: Vec<Point>,
    deformations: Vec<Deformation>,
    grid: Grid,
    boundary: Boundary,
    /// Impulse of joining nodes with their images at the transfer, until it is reported.
    from_joining: Impulse,
    loads: Loads<Place>,
    /// Force of bodies on every point [N].
    contact_forces: Vec<Vec3>,
}

/// Place of a point in memory.
#[derive(Debug, Clone, Copy)]
struct Place {
    point: usize,
    block: usize,
}

struct Access<'a> {
    points: &'a [Point],
    grid: &'a Grid,
}

impl PointAccess for Access<'_> {
    type Place = Place;

    fn find_within(&self, around: &Around, found: &mut Vec<Place>) {
        for (place, block) in self.grid.point_blocks().iter().enumerate() {
            if !around.meets(self.grid.lattice(), &block.key) {
                continue;
            }
            let inside = block.points.clone();
            let inside = inside.filter(|point| around.holds(&self.points[*point].position));
            found.extend(inside.map(|point| Place {
                point,
                block: place,
            }));
        }
    }

    fn resting(&self, place: Place) -> Vec3 {
        self.points[place.point].position
    }

    fn stencil(&self, place: Place) -> PointStencil {
        let stencil = self
            .grid
            .lattice()
            .stencil(&self.points[place.point].position);
        let block = &self.grid.point_blocks()[place.block];
        self.grid.stencil_at(block, &stencil)
    }

    fn moving(&self, place: Place) -> Moving {
        let point = &self.points[place.point];
        let stencil = self.grid.lattice().stencil(&point.position);
        let block = &self.grid.point_blocks()[place.block];
        let (velocity, displacement) = self.grid.motion_at(block, &stencil);
        Moving {
            position: point.position + displacement,
            velocity,
        }
    }
}

impl PlainFlow {
    pub(super) fn new(points: Vec<Point>, given: &Setup) -> Self {
        Self {
            points,
            deformations: Vec::new(),
            grid: Grid::new(given.lattice),
            boundary: Boundary::default(),
            from_joining: Impulse::default(),
            loads: Loads::default(),
            contact_forces: Vec::new(),
        }
    }

    /// Moves points that crossed a periodic boundary to its other end.
    fn wrap_periodic(&mut self, given: &Setup) {
        let (vertical_walls, lattice) = (&given.walls.vertical_walls, &given.lattice);
        if !vertical_walls.is_periodic() {
            return;
        }
        for point in &mut self.points {
            let along = (point.position.x - lattice.origin.x) / lattice.spacing.x;
            if let Some(cells) = vertical_walls.periodic_shift(along) {
                point.position.x += f64::from(cells) * lattice.spacing.x;
            }
        }
    }

    fn totals_of(points: &[Point], given: &Setup) -> Totals {
        let Some(flow) = &given.flow else {
            return Totals::default();
        };
        let moment = given.lattice.kernel_moment();
        Totals::of_points(points, &flow.material, &moment, &given.gravity)
    }
}

impl Flow for PlainFlow {
    fn count(&self) -> usize {
        self.points.len()
    }

    fn fastest(&self) -> f64 {
        let speeds = self.points.iter().map(|point| point.velocity.norm());
        speeds.fold(0.0, f64::max)
    }

    fn transfer(
        &mut self,
        given: &Setup,
        bodies: &[Body],
        start: &StepStart,
        stages: &mut StageEnds,
    ) {
        let occupied = points::sort_by_block(&mut self.points, &given.lattice);
        self.grid.reset_around(&occupied);
        transfer::scatter_momentum(&self.points, &mut self.grid);
        transfer::scatter_strain_rates(&self.points, &mut self.grid);
        stages.done(StepStage::P2g);
        given.walls.find_boundary(&self.grid, &mut self.boundary);
        given.walls.reflect(&mut self.boundary, &mut self.grid);
        self.boundary.smooth_strain_rates(&mut self.grid);
        stages.done(StepStage::Search);
        if let Some(flow) = &given.flow {
            let density = flow.material.bulk_density;
            transfer::residual_transfer(&self.points, density, &mut self.grid);
            self.from_joining = given.walls.join(&mut self.boundary, &mut self.grid);
        }
        stages.done(StepStage::P2g);
        redistribution::exclude_volume(&self.boundary, bodies, &mut self.grid);
        self.deformations.clear();
        self.deformations
            .extend(self.points.iter().map(Deformation::start));
        transfer::smooth_strain_rates(
            &self.grid,
            &self.points,
            &start.strain_rate_smoothing,
            &mut self.deformations,
        );
        let access = Access {
            points: &self.points,
            grid: &self.grid,
        };
        self.loads.find_candidates(&access, bodies, start.reach);
        self.contact_forces.clear();
        self.contact_forces.resize(self.points.len(), Vec3::zeros());
        stages.done(StepStage::Search);
    }

    fn substep(
        &mut self,
        given: &Setup,
        bodies: &[Body],
        Substep { dt, passed, .. }: Substep,
        stages: &mut StageEnds,
    ) -> Impulse {
        let Some(flow) = &given.flow else {
            return Impulse::default();
        };
        for (place, _) in &self.loads.on_points {
            self.contact_forces[place.point] = Vec3::zeros();
        }
        let access = Access {
            points: &self.points,
            grid: &self.grid,
        };
        let grid = CouplingGrid {
            nodes: &self.grid,
            boundary: &self.boundary,
            partners: &given.partners,
        };
        let time = ContactTime { dt, passed };
        self.loads
            .evaluate(&access, &grid, bodies, flow.sphere, time);
        for (place, force) in &self.loads.on_points {
            self.contact_forces[place.point] += force;
        }
        stages.done(StepStage::Contact);
        transfer::scatter_forces(
            &self.points,
            &self.deformations,
            &self.contact_forces,
            &mut self.grid,
        );
        self.grid.advance_momentum(given.gravity, dt);
        stages.done(StepStage::GridUpdate);
        let from_walls =
            given
                .walls
                .constrain(&mut self.boundary, &mut self.grid, given.wall_pace(dt));
        stages.done(StepStage::Boundary);
        self.grid.displace(dt);
        transfer::gather_gradient(&self.grid, &self.points, dt, &mut self.deformations);
        points::update_stress(
            &mut self.points,
            &self.deformations,
            &flow.material,
            given.lattice.finest_spacing(),
            dt,
        );
        stages.done(StepStage::StressUpdate);
        from_walls.plus(&std::mem::take(&mut self.from_joining))
    }

    fn on_bodies(&self) -> &[FlowLoad] {
        &self.loads.on_bodies
    }

    fn finish(
        &mut self,
        given: &Setup,
        bodies: &[Body],
        end: &StepEnd,
        stages: &mut StageEnds,
    ) -> Finished {
        let spread = given.flow.as_ref().map_or_else(Shifting::default, |flow| {
            transfer::gather_motion(
                &self.grid,
                &self.deformations,
                &flow.material,
                &end.redistribution,
                &given.walls.base,
                &mut self.points,
            )
        });
        let (mut count, mut stuck) = (0, None);
        for (which, (body, candidates)) in bodies.iter().zip(&self.loads.candidates).enumerate() {
            for candidate in candidates {
                let place = &candidate.place;
                let point = &mut self.points[place.point];
                match point_body::penetration_correction(&point.position, body, &given.planes) {
                    None => {}
                    Some(PenetrationCorrection::To(outside)) => {
                        point.position = outside;
                        count += 1;
                    }
                    Some(PenetrationCorrection::NoRoom { depth }) => {
                        let here = PenetratingPoint {
                            point: point.id,
                            body: which,
                            depth,
                        };
                        stuck = PenetratingPoint::deeper(stuck, here);
                    }
                }
            }
        }
        self.wrap_periodic(given);
        stages.done(StepStage::G2p);
        Finished {
            penetration_correction: count,
            stuck,
            spread,
        }
    }

    fn offending_point(&self, bounds: &Bounds) -> Option<OffendingPoint> {
        let offending_point = |point: &Point| OffendingPoint::of(point, bounds);
        self.points.par_iter().find_map_first(offending_point)
    }

    fn remove_outflow(&mut self, end: f64, given: &Setup) -> Option<(u64, Totals)> {
        if self.points.iter().all(|point| point.position.x <= end) {
            return None;
        }
        let (stay, gone) = self
            .points
            .iter()
            .partition::<Vec<Point>, _>(|point| point.position.x <= end);
        self.points = stay;
        Some((gone.len() as u64, Self::totals_of(&gone, given)))
    }

    fn totals(&self, given: &Setup) -> Totals {
        Self::totals_of(&self.points, given)
    }

    fn visit(&self, within: Option<&Around>, visit: &mut dyn FnMut(&Point)) {
        let inside = |point: &&Point| within.is_none_or(|around| around.holds(&point.position));
        self.points.iter().filter(inside).for_each(visit);
    }

    fn saved(&self) -> SavedFlow {
        SavedFlow::Plain(self.points.clone())
    }

    fn limit_instructions(&mut self, _: Instructions) {}

    fn bytes(&self) -> (usize, usize) {
        let points = self.points.capacity() * size_of::<Point>()
            + self.deformations.capacity() * size_of::<Deformation>()
            + self.contact_forces.capacity() * size_of::<Vec3>();
        (points, self.grid.bytes())
    }
}
