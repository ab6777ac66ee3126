//! The fast path: blocks of points in single precision, a whole sub-step in one
//! pass over them.

use super::{Bounds, Finished, Flow, OffendingPoint, SavedFlow, StepEnd, StepStart, Substep};
use crate::contact::point_body::{
    self, Around, ContactTime, CouplingGrid, FlowLoad, Loads, PenetratingPoint,
    PenetrationCorrection,
};
use crate::diagnostics::Totals;
use crate::fast::blocks::{Block, Blocks};
use crate::fast::instructions::Instructions;
use crate::fast::nodes::Nodes;
use crate::fast::packing::Packing;
use crate::fast::passes::{self, EndTiles, Ending, PARTS, Shown};
use crate::fast::redistribution::NoShiftZone;
use crate::fast::rows::Tile;
use crate::fast::stress::Law;
use crate::fast::totals;
use crate::grid::{BLOCK, BlockKey};
use crate::points::Point;
use crate::redistribution::{self, Shifting};
use crate::rigid::Body;
use crate::simulation::setup::Setup;
use crate::simulation::stages::{StageEnds, StepStage};
use crate::strain_rate_smoothing::StrainRateSmoothing;
use crate::walls::{Boundary, Impulse, Plane};
use fearless_simd::{Level, dispatch};
use rayon::prelude::*;

mod access;

use access::{Access, Place};

/// A flow on the fast path.
#[derive(Debug)]
pub(in crate::simulation) struct FastFlow {
    blocks: Blocks,
    nodes: Nodes,
    /// Contributions of each block to its nodes at a transfer: mass and momentum, then the
    /// residual.
    momentum: Vec<Tile>,
    /// Forces of the current sub-step, for the next one.
    forces: Vec<Tile>,
    boundary: Boundary,
    /// Impulse of joining nodes with their images at the transfer, until it is reported.
    from_joining: Impulse,
    loads: Loads<Place>,
    packing: Packing,
    law: Law,
    no_shift_zones: Vec<NoShiftZone>,
    level: Level,
    /// Speed of the fastest point [m/s].
    fastest: f64,
    /// True if a point has a non-finite quantity.
    flawed: bool,
    /// V ρ_c/m − 1 of the densest point.
    lowest_dilation: f64,
}

impl FastFlow {
    /// A flow of these points.
    pub(super) fn new(points: &[Point], given: &Setup) -> Self {
        let packing = packing(given);
        let blocks = Blocks::of(points.iter().map(|point| packing.pack(point)));
        Self::restored(blocks, given)
    }

    /// A flow restored between two steps.
    pub(super) fn restored(blocks: Blocks, given: &Setup) -> Self {
        let packing = packing(given);
        let base = given.walls.base.iter();
        let mut flow = Self {
            blocks,
            nodes: Nodes::new(given.lattice),
            momentum: Vec::new(),
            forces: Vec::new(),
            boundary: Boundary::default(),
            from_joining: Impulse::default(),
            loads: Loads::default(),
            packing,
            law: Law::of(&packing.material, &given.lattice.spacing),
            no_shift_zones: base
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
        for block in self.blocks.occupied_mut() {
            block.note_end(totals::end_of(block), Shifting::default());
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
        self.lowest_dilation = f64::from(dilations.fold(0.0, f32::min));
    }

    fn largest_speed(&self) -> f64 {
        let blocks = self.blocks.occupied().iter();
        let speeds = blocks.map(|block| block.end().fastest);
        f64::from(speeds.fold(0.0, f32::max))
    }

    /// Adds the forces of bodies to those of stress.
    fn add_contact_forces(&mut self) {
        for (place, force) in &self.loads.on_points {
            let block = place.block as usize;
            let position = self.blocks.occupied()[block].position(place.slot as usize);
            let force = force.map(|part| part as f32);
            self.forces[block].push_at(&position, &force.into());
        }
    }

    /// Gathers the nodes' motion at the points, in parallel.
    fn pass(&mut self, dt: f64) {
        let (nodes, law, level) = (&self.nodes, &self.law, self.level);
        let dt = dt as f32;
        self.blocks
            .occupied_mut()
            .par_iter_mut()
            .zip(&mut self.forces)
            .enumerate()
            .for_each(|(place, (block, force))| {
                dispatch!(level, simd => {
                    let mut motion = Tile::EMPTY;
                    nodes.motion_tile(simd, place, &mut motion);
                    passes::substep(simd, block, law, dt, &motion, force);
                });
            });
    }

    /// Moves points that crossed a periodic boundary to its other end.
    fn wrap_periodic(&mut self, given: &Setup) {
        let vertical_walls = &given.walls.vertical_walls;
        if !vertical_walls.is_periodic() {
            return;
        }
        for block in self.blocks.occupied_mut() {
            let first = f64::from(block.key[0]) * BLOCK as f64;
            for slot in 0..block.count() {
                let [x, y, z] = block.position(slot);
                if let Some(cells) = vertical_walls.periodic_shift(first + f64::from(x)) {
                    block.shift(slot, &[x + cells as f32, y, z]);
                }
            }
        }
    }

    /// Scatters the points' strain rates to the nodes. The tiles of forces are free until there are
    /// forces.
    fn scatter_strain_rates(&mut self) {
        for part in PARTS {
            let level = self.level;
            self.blocks
                .occupied_mut()
                .par_iter_mut()
                .zip(&mut self.forces)
                .for_each(|(block, tile)| {
                    dispatch!(level, simd => passes::scatter_strain_rates(simd, block, part, tile));
                });
            self.nodes.take_strain_rates(part, &self.forces, level);
        }
    }

    /// Computes the residual transfer, the compressive strains and the first forces, and smooths
    /// strain rates.
    fn residual_transfer(&mut self, given: &Setup, strain_rate_smoothing: &StrainRateSmoothing) {
        let room = self.packing.material.bulk_density * given.lattice.spacing.product();
        let (nodes, law, level) = (&self.nodes, &self.law, self.level);
        self.blocks
            .occupied_mut()
            .par_iter_mut()
            .zip(&mut self.momentum)
            .zip(&mut self.forces)
            .enumerate()
            .for_each(|(place, ((block, rest), force))| {
                dispatch!(level, simd => {
                    let mut shown = Shown::NOTHING;
                    nodes.motion_tile(simd, place, &mut shown.motion);
                    for (part, tile) in PARTS.into_iter().zip(&mut shown.strain_rate) {
                        nodes.strain_rate_tile(simd, place, part, tile);
                    }
                    passes::smooth_strain_rates(simd, block, &shown, strain_rate_smoothing);
                    passes::residual_transfer(simd, block, law, &shown.motion, rest, force);
                });
            });
        self.nodes.take_rest(&self.momentum, room as f32, level);
    }

    fn penetration_correction(
        &mut self,
        bodies: &[Body],
        walls: &[Plane],
    ) -> (u64, Option<PenetratingPoint>) {
        let (mut count, mut stuck) = (0, None);
        for (which, (body, candidates)) in bodies.iter().zip(&self.loads.candidates).enumerate() {
            for candidate in candidates {
                let place = &candidate.place;
                let block = &mut self.blocks.occupied_mut()[place.block as usize];
                let slot = place.slot as usize;
                let position = self.packing.position(&block.key, &block.position(slot));
                match point_body::penetration_correction(&position, body, walls) {
                    None => {}
                    Some(PenetrationCorrection::To(outside)) => {
                        block.shift(slot, &self.packing.in_block(&block.key, &outside));
                        count += 1;
                    }
                    Some(PenetrationCorrection::NoRoom { depth }) => {
                        let here = PenetratingPoint {
                            point: block.get(slot).id,
                            body: which,
                            depth,
                        };
                        stuck = PenetratingPoint::deeper(stuck, here);
                    }
                }
            }
        }
        (count, stuck)
    }
}

fn packing(given: &Setup) -> Packing {
    let flow = given.flow.as_ref().expect("a run with points has a flow");
    Packing {
        lattice: given.lattice,
        material: flow.material,
    }
}

impl Flow for FastFlow {
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
        self.momentum.resize(count, Tile::EMPTY);
        self.forces.resize(count, Tile::EMPTY);
        let (law, level) = (&self.law, self.level);
        self.blocks
            .occupied_mut()
            .par_iter_mut()
            .zip(&mut self.momentum)
            .for_each(|(block, momentum)| {
                dispatch!(level, simd => passes::transfer(simd, block, law, momentum));
            });
        self.nodes.take_momentum(&self.momentum, level);
        self.scatter_strain_rates();
        stages.done(StepStage::P2g);
        given.walls.find_boundary(&self.nodes, &mut self.boundary);
        given.walls.reflect(&mut self.boundary, &mut self.nodes);
        self.boundary.smooth_strain_rates(&mut self.nodes);
        stages.done(StepStage::Search);
        self.residual_transfer(given, &start.strain_rate_smoothing);
        self.from_joining = given.walls.join(&mut self.boundary, &mut self.nodes);
        stages.done(StepStage::P2g);
        redistribution::exclude_volume(&self.boundary, bodies, &mut self.nodes);
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
            dt: end.dt as f32,
            redistribution: &end.redistribution,
            no_shift_zones: &self.no_shift_zones,
            roomiest: (given.lattice.largest_point_volume() * self.packing.material.bulk_density)
                as f32,
        };
        self.blocks
            .occupied_mut()
            .par_iter_mut()
            .enumerate()
            .for_each(|(place, block)| {
                dispatch!(level, simd => {
                    let mut tiles = EndTiles::EMPTY;
                    nodes.motion_tile(simd, place, &mut tiles.motion);
                    nodes.displacement_tile(simd, place, &mut tiles.displacement);
                    nodes.fullness_tile(simd, place, &mut tiles.twist);
                    tiles.cross();
                    passes::finish(simd, block, &ending, &tiles);
                });
            });
        // Before points migrate to other blocks.
        self.sum_up_ends();
        let blocks = self.blocks.occupied().iter();
        let spread = blocks.fold(Shifting::default(), |sum, block| sum.plus(&block.spread()));
        let (penetration_correction, stuck) = self.penetration_correction(bodies, &given.planes);
        self.wrap_periodic(given);
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
        let Bounds {
            planes, tolerance, ..
        } = *bounds;
        let densest = self.packing.material.bulk_density / (1.0 + self.lowest_dilation);
        let every = self.flawed || densest > bounds.densest;
        let lattice = &self.packing.lattice;
        let behind = |plane: &Plane, block: &Block| {
            let height = |slot| {
                let position = block.position(slot);
                plane.height(&self.packing.position(&block.key, &position))
            };
            lowest(plane, lattice, &block.key) < -tolerance
                && (0..block.count()).any(|slot| height(slot) < -tolerance)
        };
        let suspect = |block: &&Block| every || planes.iter().any(|plane| behind(plane, block));
        let suspects = self.blocks.occupied().iter().filter(suspect);
        let mut points = suspects.flat_map(|block| {
            (0..block.count()).map(|slot| self.packing.unpack(&block.key, &block.get(slot)))
        });
        points.find_map(|point| OffendingPoint::of(&point, bounds))
    }

    fn remove_outflow(&mut self, end: f64, given: &Setup) -> Option<(u64, Totals)> {
        let packing = self.packing;
        let mut gone = Vec::new();
        let near_end = |key: &BlockKey| {
            let last = packing
                .lattice
                .position(key.map(|k| (k + 1) * BLOCK as i32));
            last.x + packing.lattice.spacing.x > end
        };
        self.blocks.take_out(near_end, |key, point| {
            let beyond = packing.position(key, &point.position).x > end;
            if beyond {
                gone.push(packing.unpack(key, point));
            }
            beyond
        });
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
        let of_block = |block: &Block| dispatch!(level, _simd => totals::of_block(block, packing, &given.gravity));
        // A tree of its own, so that the sums do not depend on the threads.
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

    fn saved(&self) -> SavedFlow {
        SavedFlow::Fast(self.blocks.clone())
    }

    fn limit_instructions(&mut self, instructions: Instructions) {
        self.level = instructions.level();
    }

    fn bytes(&self) -> (usize, usize) {
        let tiles = self.momentum.capacity() + self.forces.capacity();
        let grid = self.nodes.bytes() + tiles * size_of::<Tile>();
        (self.blocks.bytes(), grid)
    }
}

/// Sums over the blocks, half by half.
fn sum_up(blocks: &[Block], of: &(impl Fn(&Block) -> Totals + Sync)) -> Totals {
    match blocks {
        [] => Totals::default(),
        [block] => of(block),
        _ => {
            let (low, high) = blocks.split_at(blocks.len() / 2);
            let (low, high) = rayon::join(|| sum_up(low, of), || sum_up(high, of));
            low.plus(&high)
        }
    }
}

/// Height above a plane of the lowest possible place of a point of this block [m].
fn lowest(plane: &Plane, lattice: &crate::kernel::Lattice, key: &BlockKey) -> f64 {
    let first = lattice.position(key.map(|k| k * BLOCK as i32)) + lattice.spacing * 0.5;
    let size = lattice.spacing * BLOCK as f64;
    let corner = plane.normal.zip_zip_map(
        &first,
        &size,
        |n, low, size| if n > 0.0 { low } else { low + size },
    );
    plane.height(&corner)
}
