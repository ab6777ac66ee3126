//! A flow of points in blocks, in either precision: the stages of a step over all blocks, in
//! parallel.

use super::offending_point::{Bounds, OffendingPoint};
use super::saved_flow::{Saved, SavedFlow};
use super::stages::{Finished, Flow, StepEnd, StepStart, Substep};
use crate::available_volume::exclude_volume;
use crate::contact::point_body::{Around, ContactTime, CouplingGrid, FlowLoad, Loads};
use crate::diagnostics::Totals;
use crate::grid::resize_list;
use crate::math::Vec3;
use crate::mpm::blocks::{Block, Blocks};
use crate::mpm::constitutive::Law;
use crate::mpm::g2p::{EndTiles, Ending, gather_motion};
use crate::mpm::instructions::Instructions;
use crate::mpm::lanes::Real;
use crate::mpm::nodes::Nodes;
use crate::mpm::p2g::{TransferTiles, residual_transfer, scatter_momentum};
use crate::mpm::packing::Packing;
use crate::mpm::redistribution::{NoShiftZone, Shifting, TerrainZone};
use crate::mpm::rows::Tile;
use crate::mpm::strain_rate_smoothing::StrainRateSmoothing;
use crate::mpm::stress_update::update_stress;
use crate::mpm::totals;
use crate::points::{Part, Point, PointMotion, Unloading};
use crate::rigid::Body;
use crate::simulation::setup::Setup;
use crate::simulation::stages::{StageEnds, StepStage};
use crate::walls::{Boundary, Impulse};
use fearless_simd::{Level, dispatch};
use rayon::prelude::*;

mod access;
mod corrections;
mod inspection;

use access::{Access, Place};
use corrections::{correct_penetration, take_outflow, wrap_periodic};
use inspection::{find_offending_point, sum_up};

/// Bytes of a point that may touch a body, and of its contact.
pub(in crate::simulation) const CANDIDATE_BYTES: usize = Loads::<Place>::CANDIDATE_BYTES;

/// A flow of points in blocks.
#[derive(Debug)]
pub(in crate::simulation) struct BlockFlow<R: Real> {
    blocks: Blocks<R>,
    nodes: Nodes<R>,
    /// Shares that each block gives its nodes at a transfer: mass and momentum, then the
    /// rest of it.
    momentum: Vec<Tile<R>>,
    /// Forces of the present sub-step, for the next; until there are some, strain rates.
    forces: Vec<Tile<R>>,
    /// Strain rates xz and yz.
    shear: Vec<Tile<R>>,
    boundary: Boundary,
    /// Impulse of joining nodes with their images at the transfer, until it is reported.
    from_joining: Impulse,
    loads: Loads<Place>,
    packing: Packing,
    law: Law<R>,
    no_shift_zones: Vec<NoShiftZone<R>>,
    level: Level,
    /// Speed of the fastest point [m/s].
    fastest: f64,
    /// True if a point has a non-finite quantity.
    flawed: bool,
    /// V ρ_c/m − 1 of the densest point.
    lowest_dilation: f64,
}

impl<R: Saved> BlockFlow<R> {
    /// A flow of these points.
    pub(super) fn new(points: Vec<Point>, given: &Setup) -> Self {
        let packing = packing(given);
        let points = Unloading::of(points);
        let blocks = Blocks::of(points.map(|point| packing.pack(&point)));
        Self::restored(blocks, given)
    }

    /// A flow as it was between two steps.
    pub(super) fn restored(blocks: Blocks<R>, given: &Setup) -> Self {
        let packing = packing(given);
        let planes = given.walls.bed.planes().iter();
        let mut flow = Self {
            blocks,
            nodes: Nodes::new(given.lattice),
            momentum: Vec::new(),
            forces: Vec::new(),
            shear: Vec::new(),
            boundary: Boundary::default(),
            from_joining: Impulse::default(),
            loads: Loads::default(),
            packing,
            law: Law::of(&packing.material, &given.lattice.spacing),
            no_shift_zones: planes
                .map(|plane| NoShiftZone::of(plane, &given.lattice))
                .collect(),
            level: Instructions::detected().level(),
            fastest: 0.0,
            flawed: false,
            lowest_dilation: 0.0,
        };
        flow.check_points();
        flow
    }

    /// Summarises the points for the next step.
    fn check_points(&mut self) {
        let level = self.level;
        for block in self.blocks.occupied_mut() {
            let end = dispatch!(level, simd => totals::end_of(simd, block));
            block.note_end(end, Shifting::default());
        }
        self.sum_up_ends();
    }

    /// Combines the summaries of the blocks.
    fn sum_up_ends(&mut self) {
        self.fastest = self.largest_speed();
        let mut blocks = self.blocks.occupied().iter();
        self.flawed = blocks.any(|block| !block.end().finite);
        let blocks = self.blocks.occupied().iter();
        let dilations = blocks.map(|block| block.end().lowest_dilation);
        self.lowest_dilation = dilations.fold(R::ZERO, R::min).to_f64();
    }

    fn largest_speed(&self) -> f64 {
        let blocks = self.blocks.occupied().iter();
        let speeds = blocks.map(|block| block.end().fastest);
        speeds.fold(R::ZERO, R::max).to_f64()
    }

    /// Adds the forces of bodies to those of stress.
    fn add_contact_forces(&mut self) {
        for (place, force) in &self.loads.on_points {
            let block = place.block as usize;
            let position = self.blocks.occupied()[block].position(place.slot as usize);
            let force = [0, 1, 2].map(|axis| R::of(force[axis]));
            self.forces[block].push_at(&position, &force);
        }
    }

    /// Gathers the nodes' motion at the points, in parallel.
    fn pass(&mut self, dt: f64) {
        let (nodes, law, level) = (&self.nodes, &self.law, self.level);
        let dt = R::of(dt);
        self.blocks
            .occupied_mut()
            .par_iter_mut()
            .zip(&mut self.forces)
            .enumerate()
            .for_each_init(
                || Tile::EMPTY,
                |motion, (place, (block, force))| {
                    dispatch!(level, simd => {
                        block.prefetch();
                        nodes.motion_tile(simd, place, motion);
                        update_stress(simd, block, law, dt, motion, force);
                    });
                },
            );
    }

    /// Scatters mass, momentum and strain rates of the points to the nodes. The tiles of forces are
    /// free until there are forces.
    fn scatter_momentum(&mut self) {
        let (law, level) = (&self.law, self.level);
        self.blocks
            .occupied_mut()
            .par_iter_mut()
            .zip(&mut self.momentum)
            .zip(&mut self.forces)
            .zip(&mut self.shear)
            .for_each(|(((block, momentum), first), second)| {
                let strain_rate = [first, second];
                dispatch!(level, simd => scatter_momentum(simd, block, law, momentum, strain_rate));
            });
        let strain_rate = [&*self.forces, &*self.shear];
        self.nodes.take_momentum(&self.momentum, strain_rate, level);
    }

    /// Computes the residual transfer, the compressive strains and the first forces, and smooths
    /// strain rates.
    fn residual_transfer(&mut self, given: &Setup, smoothing: &StrainRateSmoothing) {
        let kernel_mass = self.packing.material.bulk_density * given.lattice.spacing.product();
        let (nodes, law, level) = (&self.nodes, &self.law, self.level);
        self.blocks
            .occupied_mut()
            .par_iter_mut()
            .zip(&mut self.momentum)
            .zip(&mut self.forces)
            .enumerate()
            .for_each_init(
                || TransferTiles::EMPTY,
                |tiles, (place, ((block, rest), force))| {
                    dispatch!(level, simd => {
                        block.prefetch();
                        nodes.transfer_tiles(simd, place, tiles);
                        residual_transfer(simd, block, law, tiles, smoothing, [rest, force]);
                    });
                },
            );
        self.nodes
            .take_residual(&self.momentum, R::of(kernel_mass), level);
    }
}

fn packing(given: &Setup) -> Packing {
    let flow = given.flow.as_ref().expect("a run with points has a flow");
    Packing {
        lattice: given.lattice,
        material: flow.material,
    }
}

impl<R: Saved> Flow for BlockFlow<R> {
    fn count(&self) -> usize {
        self.blocks.count()
    }

    fn fastest(&self) -> f64 {
        self.fastest
    }

    fn transfer(
        &mut self,
        given: &Setup,
        bodies: &[Body],
        start: &StepStart,
        stages: &mut StageEnds,
    ) {
        let keys = self.blocks.occupied().iter().map(|block| block.key);
        self.nodes.lay_around(keys);
        let count = self.blocks.occupied().len();
        for tiles in [&mut self.momentum, &mut self.forces, &mut self.shear] {
            resize_list(tiles, count, Tile::EMPTY);
        }
        self.scatter_momentum();
        stages.done(StepStage::P2g);
        given.walls.find_boundary(&self.nodes, &mut self.boundary);
        given.walls.reflect(&mut self.boundary, &mut self.nodes);
        self.boundary.smooth_strain_rates(&mut self.nodes);
        stages.done(StepStage::Search);
        self.residual_transfer(given, &start.strain_rate_smoothing);
        self.from_joining = given.walls.join(&mut self.boundary, &mut self.nodes);
        stages.done(StepStage::P2g);
        exclude_volume(&self.boundary, bodies, &mut self.nodes);
        let access = Access {
            blocks: self.blocks.occupied(),
            nodes: &self.nodes,
            packing: &self.packing,
        };
        self.loads.find_candidates(&access, bodies, start.reach);
        stages.done(StepStage::Search);
    }

    fn substep(
        &mut self,
        given: &Setup,
        bodies: &[Body],
        Substep { dt, passed, last }: Substep,
        stages: &mut StageEnds,
    ) -> Impulse {
        let Some(flow) = &given.flow else {
            return Impulse::default();
        };
        let access = Access {
            blocks: self.blocks.occupied(),
            nodes: &self.nodes,
            packing: &self.packing,
        };
        let grid = CouplingGrid {
            nodes: &self.nodes,
            boundary: &self.boundary,
            partners: &given.partners,
        };
        let time = ContactTime { dt, passed };
        self.loads
            .evaluate(&access, &grid, bodies, flow.sphere, time);
        self.add_contact_forces();
        stages.done(StepStage::Contact);
        self.nodes
            .advance(&self.forces, &given.gravity, dt, self.level);
        stages.done(StepStage::GridUpdate);
        let from_walls =
            given
                .walls
                .constrain(&mut self.boundary, &mut self.nodes, given.wall_pace(dt));
        stages.done(StepStage::Boundary);
        if !last {
            self.pass(dt);
            stages.done(StepStage::StressUpdate);
        }
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
        let (nodes, level) = (&self.nodes, self.level);
        let ending = Ending {
            law: &self.law,
            lattice: &given.lattice,
            dt: R::of(end.dt),
            redistribution: &end.redistribution,
            no_shift_zones: &self.no_shift_zones,
            terrain_zone: (given.walls.bed.height_field())
                .map(|ground| TerrainZone::of(ground, &given.lattice)),
            largest_volume_mass: R::of(
                given.lattice.largest_point_volume() * self.packing.material.bulk_density,
            ),
        };
        self.blocks
            .occupied_mut()
            .par_iter_mut()
            .enumerate()
            .for_each_init(
                || EndTiles::EMPTY,
                |tiles, (place, block)| {
                    dispatch!(level, simd => {
                        block.prefetch();
                        nodes.motion_tile(simd, place, &mut tiles.motion);
                        nodes.displacement_tile(simd, place, &mut tiles.displacement);
                        nodes.volume_fraction_tile(simd, place, &mut tiles.twist);
                        tiles.cross(simd);
                        gather_motion(simd, block, &ending, tiles);
                    });
                },
            );
        // Before points migrate to other blocks.
        self.sum_up_ends();
        let blocks = self.blocks.occupied().iter();
        let spread = blocks.fold(Shifting::default(), |sum, block| sum.plus(&block.spread()));
        let (penetration_correction, stuck) = correct_penetration(
            &mut self.blocks,
            &self.packing,
            &self.loads.candidates,
            bodies,
            &given.rigid_walls(),
        );
        if let Some(vertical_walls) = &given.walls.vertical_walls {
            wrap_periodic(&mut self.blocks, vertical_walls);
        }
        stages.done(StepStage::G2p);
        self.blocks.settle();
        stages.done(StepStage::Rebin);
        Finished {
            penetration_correction,
            stuck,
            spread,
        }
    }

    fn offending_point(&self, bounds: &Bounds) -> Option<OffendingPoint> {
        let densest = self.packing.material.bulk_density / (1.0 + self.lowest_dilation);
        let every = self.flawed || densest > bounds.densest;
        find_offending_point(self.blocks.occupied(), &self.packing, every, bounds)
    }

    fn add(&mut self, points: Vec<Point>) {
        let packing = self.packing;
        let points = Unloading::of(points);
        self.blocks.add(points.map(|point| packing.pack(&point)));
        self.check_points();
    }

    fn remove_outflow(&mut self, given: &Setup) -> Option<(u64, Totals)> {
        let packing = self.packing;
        let gone = take_outflow(&mut self.blocks, &packing, &given.outlet);
        if gone.is_empty() {
            return None;
        }
        // The summary of the remaining points must not depend on those that left, or a saved run
        // would continue with other bits.
        self.check_points();
        let moment = packing.lattice.kernel_moment();
        let totals = Totals::of_points(&gone, &packing.material, &moment, &given.gravity);
        Some((gone.len() as u64, totals))
    }

    fn totals(&self, given: &Setup) -> Totals {
        let (packing, level) = (&self.packing, self.level);
        let of_block = |block: &Block<R>| dispatch!(level, _simd => totals::of_block(block, packing, &given.gravity));
        sum_up(self.blocks.occupied(), &of_block)
    }

    fn visit(&self, within: Option<&Around>, visit: &mut dyn FnMut(&Point)) {
        let lattice = &self.packing.lattice;
        for block in self.blocks.occupied() {
            if within.is_some_and(|around| !around.meets(lattice, &block.key)) {
                continue;
            }
            for slot in 0..block.count() {
                let point = self.packing.unpack(&block.key, &block.get(slot));
                if within.is_none_or(|around| around.holds(&point.position)) {
                    visit(&point);
                }
            }
        }
    }

    fn visit_motions(&self, part: Part, visit: &mut dyn FnMut(&PointMotion)) {
        let blocks = self.blocks.occupied();
        for block in &blocks[part.range(blocks.len())] {
            for slot in 0..block.count() {
                visit(&PointMotion {
                    mass: block.mass(slot).to_f64(),
                    position: self.packing.position(&block.key, &block.position(slot)),
                    velocity: Vec3::from(block.velocity(slot).map(R::to_f64)),
                });
            }
        }
    }

    fn saved(&self) -> SavedFlow {
        R::saved(self.blocks.clone())
    }

    fn limit_instructions(&mut self, instructions: Instructions) {
        self.level = instructions.level();
    }

    fn bytes(&self) -> (usize, usize) {
        let tiles = self.momentum.capacity() + self.forces.capacity() + self.shear.capacity();
        let grid = self.nodes.bytes()
            + tiles * size_of::<Tile<R>>()
            + self.boundary.bytes()
            + self.loads.bytes();
        (self.blocks.bytes(), grid)
    }
}
