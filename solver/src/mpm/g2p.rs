//! Transfer from grid to points (G2P): the last strain of a step, the motion of the points, and
//! their redistribution (docs/method.md, equations 12, 13 and 39–42c).

use super::blocks::Block;
use super::constitutive::Law;
use super::deformation::strain;
use super::lanes::{Matrix, NODE_NUMBERS, Real, Splat, load};
use super::redistribution::{
    NoShiftZone, PointState, RedistributionRates, ShiftingSums, TerrainZone, redistribute,
};
use super::rows::{MomentSums, Moments, Quads, Tile, gather_mean, store_transposed, transposed};
use super::stencil::Stencils;
use super::stress_update::velocity_gradient;
use super::totals::EndSums;
use crate::grid::first_node;
use crate::kernel::Lattice;
use crate::math::Vec3;
use fearless_simd::prelude::*;

/// State of the nodes in the tile of a block of points at the end of a step.
pub struct EndTiles<R> {
    /// Excess volume fraction and velocity.
    pub motion: Tile<R>,
    /// Mean compressive strain and displacement.
    pub displacement: Tile<R>,
    /// Volume fraction at first, then displacement × velocity.
    pub twist: Tile<R>,
}

impl<R: Real> EndTiles<R> {
    /// All zero.
    pub const EMPTY: Self = Self {
        motion: Tile::EMPTY,
        displacement: Tile::EMPTY,
        twist: Tile::EMPTY,
    };

    /// Fills in excess volume fraction, 0 to 1, and twist of the nodes.
    #[inline(always)]
    pub fn cross<S: Simd>(&mut self, simd: S) {
        let number = Splat::<S, R>::new(simd);
        let (none, one) = (number.of(0.0), number.of(1.0));
        let nodes = NODE_NUMBERS * R::LANES;
        let motion = self.motion.0.chunks_exact_mut(nodes);
        let others = self.displacement.0.chunks_exact(nodes);
        let twist = self.twist.0.chunks_exact_mut(nodes);
        for ((motion, displacement), twist) in motion.zip(others).zip(twist) {
            let [volume_fraction, ..] = transposed::<S, R>(simd, twist);
            let [_, vx, vy, vz] = transposed::<S, R>(simd, motion);
            let [_, ux, uy, uz] = transposed::<S, R>(simd, displacement);
            let excess = (volume_fraction - one).max(none).min(one);
            store_transposed::<S, R>([excess, vx, vy, vz], motion);
            let across = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
            let [x, y, z] = across;
            store_transposed::<S, R>([volume_fraction, x, y, z], twist);
        }
    }
}

/// End of a step.
#[derive(Debug, Clone, Copy)]
pub struct Ending<'a, R: Real> {
    /// Law of the points' material.
    pub law: &'a Law<R>,
    /// Lattice of the nodes.
    pub lattice: &'a Lattice,
    /// Length of the last sub-step [s].
    pub dt: R,
    /// Rates of redistribution.
    pub redistribution: &'a RedistributionRates,
    /// Zones at the planes of the bed.
    pub no_shift_zones: &'a [NoShiftZone<R>],
    /// Zones on a terrain, if the bed is one.
    pub terrain_zone: Option<TerrainZone<'a>>,
    /// Mass that fills the largest volume a point can have [kg].
    pub largest_volume_mass: R,
}

/// Takes the points through the last sub-step of a step and moves them with the nodes (equations
/// 12 and 13), then redistributes them.
#[inline(always)]
pub fn gather_motion<S: Simd, R: Real>(
    simd: S,
    block: &mut Block<R>,
    ending: &Ending<R>,
    nodes: &EndTiles<R>,
) {
    let Ending {
        law,
        lattice,
        dt,
        redistribution,
        no_shift_zones,
        terrain_zone,
        largest_volume_mass,
    } = *ending;
    let number = Splat::<S, R>::new(simd);
    let spacing = &lattice.spacing;
    let (mut moment_sums, mut mean_sums) = (MomentSums::EMPTY, Quads::EMPTY);
    let mut sums = EndSums::none(simd);
    let mut spread = ShiftingSums::NONE;
    let key = block.key;
    let on_terrain = terrain_zone.and_then(|zone| zone.in_block::<R>(&key));
    for (chunk, count) in block.chunks_mut() {
        let stencils = Stencils::of(simd, &chunk.position);
        let moments = moment_sums.gather(simd, &stencils, count, &nodes.motion);
        let (displacement, twist) = (&nodes.displacement, &nodes.twist);
        let displacement = gather_mean(simd, &stencils, count, displacement, &mut mean_sums);
        let twist = gather_mean(simd, &stencils, count, twist, &mut mean_sums);
        let a = velocity_gradient(simd, &moments, law);
        let strained = strain(simd, chunk, &a, law, dt);
        let [excess_volume_fraction, vx, vy, vz] = moments.zeroth;
        let [mean_compression, ux, uy, uz] = displacement;
        let [_, tx, ty, tz] = twist;
        let on_displaced = strained.deformed.undone_at_most(simd, &a);
        // Of Σ w v_i (d_i + u_i − u_p)ᵀ only the skew part counts: the displacement of the
        // nodes adds u_p × v_p − Σ w u_i × v_i.
        let added = [
            uy * vz - uz * vy - tx,
            uz * vx - ux * vz - ty,
            ux * vy - uy * vx - tz,
        ];
        let affine = with_angular_momentum::<S, R>(simd, &on_displaced, &a, &added, spacing);
        let (arriving, mut moved) = ([vx, vy, vz], [ux, uy, uz]);
        for axis in 0..3 {
            moved[axis] *= number.of(1.0 / spacing[axis]);
        }
        let seen = PointState {
            volumetric_strain: strained.volumetric_strain,
            compression_at_transfer: load::<S, R>(simd, &chunk.volumetric_strain)
                .min(number.of(0.0)),
            mean_compression,
            excess_volume_fraction,
            slope: excess_volume_fraction_gradient(simd, &moments),
        };
        let mut position = moved;
        for axis in 0..3 {
            position[axis] += load::<S, R>(simd, &chunk.position[axis]);
        }
        let mut redistributed = redistribute::<S, R>(simd, redistribution, &seen, &moved);
        let mut velocity = arriving;
        for no_shift_zone in no_shift_zones {
            let here = no_shift_zone.of_chunk(simd, &key, &position);
            let shift = &mut redistributed.shift;
            here.keep_off(simd, spacing, &moved, shift, &mut velocity);
        }
        if let Some(here) = on_terrain.and_then(|zones| zones.of_chunk(simd, &position)) {
            let shift = &mut redistributed.shift;
            here.keep_off(simd, spacing, &moved, shift, &mut velocity);
        }
        let change = [0, 1, 2].map(|axis| velocity[axis] - arriving[axis]);
        spread.stop(simd, chunk, &position, &change, spacing);
        for part in &mut chunk.deviator {
            let before = load::<S, R>(simd, part);
            *part = redistributed.rise.mul_add(before, before).to_array();
        }
        let mass = load::<S, R>(simd, &chunk.mass);
        let largest_strain = number.all(largest_volume_mass) / mass - number.of(1.0);
        chunk.volumetric_strain = redistributed
            .volumetric_strain
            .min(largest_strain)
            .to_array();
        spread.add(simd, chunk, &redistributed.shift, &velocity, spacing);
        for axis in 0..3 {
            chunk.velocity[axis] = velocity[axis].to_array();
            chunk.position[axis] = (position[axis] + redistributed.shift[axis]).to_array();
            for row in 0..3 {
                chunk.gradient[axis][row] = affine[row][axis].to_array();
            }
        }
        sums.add(chunk);
    }
    let origin = lattice.position(first_node(key));
    block.note_end(sums.end(), spread.total(&origin));
}

/// Gradient of the excess volume fraction, per axis [1/cell].
#[inline(always)]
fn excess_volume_fraction_gradient<S: Simd, R: Real>(
    simd: S,
    moments: &Moments<S, R>,
) -> [R::Vector<S>; 3] {
    let number = Splat::<S, R>::new(simd);
    let mut slope = [number.of(0.0); 3];
    for axis in 0..3 {
        let [along, ..] = moments.first[axis];
        slope[axis] = along * number.of(4.0);
    }
    slope
}

/// Matrix `gradient` with the skew part that keeps the angular momentum (equation 13);
/// `plain` is the gradient at the transfer positions.
#[inline(always)]
fn with_angular_momentum<S: Simd, R: Real>(
    simd: S,
    gradient: &Matrix<S, R>,
    plain: &Matrix<S, R>,
    added: &[R::Vector<S>; 3],
    spacing: &Vec3,
) -> Matrix<S, R> {
    let number = Splat::<S, R>::new(simd);
    let moment = spacing.component_mul(spacing) * 0.25;
    let mut affine = *gradient;
    for (axis, (i, j)) in [(2, (0, 1)), (1, (0, 2)), (0, (1, 2))] {
        let symmetric = number.of(0.5) * (gradient[i][j] + gradient[j][i]);
        // (v uᵀ)_ij − (v uᵀ)_ji is −(u × v) for (0, 1) and (1, 2), + for (0, 2).
        let sign = if axis == 1 { -1.0 } else { 1.0 };
        let turned = plain[i][j] * number.of(moment[j]) - plain[j][i] * number.of(moment[i]);
        let wanted = number.of(sign).mul_add(added[axis], turned);
        let skew = (wanted - symmetric * number.of(moment[j] - moment[i]))
            * number.of(1.0 / (moment[i] + moment[j]));
        affine[i][j] = symmetric + skew;
        affine[j][i] = symmetric - skew;
    }
    affine
}
