//! Passes over a block of points: scatter mass, momentum and force to its tile, compute a
//! sub-step, gather the motion.

use super::blocks::Block;
use super::chunk::{Chunk, LANES, Lanes};
use super::redistribution::{NoShiftZone, PointState, ShiftingSums, redistribute};
use super::rows::{Given, Moments, Quads, Tile, gather_mean, scatter_mean};
use super::stencil::Stencils;
use super::stress::{self, Law, Matrix, Strained};
use super::totals::EndSums;
use crate::grid::BLOCK;
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::redistribution::{RedistributionRates, excess_volume_fraction};
use crate::strain_rate_smoothing::StrainRateSmoothing;
use fearless_simd::{f32x16, prelude::*};

/// State of the nodes of a block of points at the end of a step.
pub struct EndTiles {
    /// Excess volume fraction and velocity.
    pub motion: Tile,
    /// Mean compressive strain and displacement.
    pub displacement: Tile,
    /// First volume fraction, then displacement × velocity.
    pub twist: Tile,
}

impl EndTiles {
    /// All zero.
    pub const EMPTY: Self = Self {
        motion: Tile::EMPTY,
        displacement: Tile::EMPTY,
        twist: Tile::EMPTY,
    };

    /// Computes excess volume fraction and twist of the nodes.
    #[inline(always)]
    pub fn cross(&mut self) {
        let nodes = self
            .motion
            .0
            .chunks_exact_mut(4)
            .zip(self.displacement.0.chunks_exact(4));
        for (twist, (v, u)) in self.twist.0.chunks_exact_mut(4).zip(nodes) {
            v[0] = excess_volume_fraction(f64::from(twist[0])) as f32;
            twist[1] = u[2] * v[3] - u[3] * v[2];
            twist[2] = u[3] * v[1] - u[1] * v[3];
            twist[3] = u[1] * v[2] - u[2] * v[1];
        }
    }
}

/// End of a step.
#[derive(Debug, Clone, Copy)]
pub struct Ending<'a> {
    /// Law of the points' material.
    pub law: &'a Law,
    /// Lattice of the nodes.
    pub lattice: &'a Lattice,
    /// Length of the last sub-step [s].
    pub dt: f32,
    /// Rates of particle redistribution.
    pub redistribution: &'a RedistributionRates,
    /// The no-shift zones at the planes of the bed.
    pub no_shift_zones: &'a [NoShiftZone],
    /// Mass that fills the largest volume of a point [kg].
    pub roomiest: f32,
}

/// Scatters mass and momentum to a tile (equation 8).
#[inline(always)]
pub fn transfer<S: Simd>(simd: S, block: &mut Block, law: &Law, momentum: &mut Tile) {
    *momentum = Tile::EMPTY;
    let mut given = Given::NOTHING;
    let mut runs = 0;
    for (chunk, count) in block.chunks_mut() {
        let stencils = Stencils::of(simd, &chunk.position);
        runs += stencils.runs(count);
        give_momentum(simd, chunk, law, &mut given);
        given.scatter::<S, true>(simd, &stencils, count, momentum);
    }
    block.note_runs(runs);
}

/// Components of a strain rate that are scattered together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// xx, yy, zz and xy.
    First,
    /// xz and yz.
    Second,
}

/// Both parts.
pub const PARTS: [Part; 2] = [Part::First, Part::Second];

/// Motion of the nodes of a block of points at a transfer.
pub struct Shown {
    /// Mass and velocity.
    pub motion: Tile,
    /// Mean strain rate, part by part.
    pub strain_rate: [Tile; 2],
}

impl Shown {
    /// All zero.
    pub const NOTHING: Self = Self {
        motion: Tile::EMPTY,
        strain_rate: [Tile::EMPTY; 2],
    };
}

/// D = sym C of a chunk: xx yy zz xy xz yz.
#[inline(always)]
fn strain_rate<S: Simd>(simd: S, chunk: &Chunk) -> [f32x16<S>; 6] {
    // Column by column.
    let c = |row: usize, column: usize| f32x16::simd_from(simd, chunk.gradient[column][row]);
    let half = f32x16::splat(simd, 0.5);
    [
        c(0, 0),
        c(1, 1),
        c(2, 2),
        half * (c(0, 1) + c(1, 0)),
        half * (c(0, 2) + c(2, 0)),
        half * (c(1, 2) + c(2, 1)),
    ]
}

/// Scatters part of the points' strain rates times their masses to a tile (equation 42a).
#[inline(always)]
pub fn scatter_strain_rates<S: Simd>(simd: S, block: &mut Block, part: Part, tile: &mut Tile) {
    *tile = Tile::EMPTY;
    let none = f32x16::splat(simd, 0.0);
    let mut given = Quads::EMPTY;
    for (chunk, count) in block.chunks_mut() {
        let stencils = Stencils::of(simd, &chunk.position);
        let mass = f32x16::simd_from(simd, chunk.mass);
        let [xx, yy, zz, xy, xz, yz] = strain_rate(simd, chunk);
        given.gathered(match part {
            Part::First => [mass * xx, mass * yy, mass * zz, mass * xy],
            Part::Second => [mass * xz, mass * yz, none, none],
        });
        scatter_mean(simd, &stencils, count, &given, tile);
    }
}

/// Computes the smoothed part of the points' effective strain rates (equation 42a;
/// `strain_rate_smoothing.rs`).
#[inline(always)]
pub fn smooth_strain_rates<S: Simd>(
    simd: S,
    block: &mut Block,
    shown: &Shown,
    strain_rate_smoothing: &StrainRateSmoothing,
) {
    let (mut first, mut second) = (Quads::EMPTY, Quads::EMPTY);
    let full = strain_rate_smoothing.full_speed * strain_rate_smoothing.full_speed;
    let per_full = splat(simd, full.max(f64::from(f32::MIN_POSITIVE)).recip());
    for (chunk, count) in block.chunks_mut() {
        let stencils = Stencils::of(simd, &chunk.position);
        gather_mean(simd, &stencils, count, &shown.strain_rate[0], &mut first);
        gather_mean(simd, &stencils, count, &shown.strain_rate[1], &mut second);
        let [xx, yy, zz, xy] = first.spread(simd);
        let [xz, yz, ..] = second.spread(simd);
        let own = strain_rate(simd, chunk);
        let mut lacking = [xx, yy, zz, xy, xz, yz];
        for (part, own) in lacking.iter_mut().zip(own) {
            *part -= own;
        }
        let third = (lacking[0] + lacking[1] + lacking[2]) * splat(simd, 1.0 / 3.0);
        for part in &mut lacking[..3] {
            *part -= third;
        }
        let [x, y, z] = times(simd, &chunk.velocity, splat(simd, 1.0));
        let speed = x.mul_add(x, y.mul_add(y, z * z));
        let degree = (speed * per_full).min(splat(simd, 1.0));
        let share = splat(simd, strain_rate_smoothing.share) * degree;
        for (kept, part) in chunk.shared.iter_mut().zip(lacking) {
            *kept = (share * part).into();
        }
    }
}

/// Scatters the compressive strains and the residual of the nodes' `motion` to one tile, and
/// the force of stress to another (equations 9 and 39); resets the deformation.
#[inline(always)]
pub fn residual_transfer<S: Simd>(
    simd: S,
    block: &mut Block,
    law: &Law,
    motion: &Tile,
    rest: &mut Tile,
    force: &mut Tile,
) {
    (*rest, *force) = (Tile::EMPTY, Tile::EMPTY);
    let mut moments = Moments::EMPTY;
    let mut given = Given::NOTHING;
    for (chunk, count) in block.chunks_mut() {
        let stencils = Stencils::of(simd, &chunk.position);
        moments.gather::<S, true>(simd, &stencils, count, motion);
        give_rest(simd, chunk, law, &moments, &mut given);
        given.scatter::<S, true>(simd, &stencils, count, rest);
        chunk.gradient = [[[0.0; LANES]; 3]; 3];
        give_force(
            simd,
            &stress::at_transfer(simd, chunk, law),
            chunk,
            law,
            &mut given,
        );
        given.scatter::<S, false>(simd, &stencils, count, force);
    }
}

/// Computes a sub-step: the velocity gradient of the nodes strains the points, whose stress
/// acts on the nodes (equations 11, 2–6 and 9).
#[inline(always)]
pub fn substep<S: Simd>(
    simd: S,
    block: &mut Block,
    law: &Law,
    dt: f32,
    motion: &Tile,
    force: &mut Tile,
) {
    *force = Tile::EMPTY;
    let mut moments = Moments::EMPTY;
    let mut given = Given::NOTHING;
    for (chunk, count) in block.chunks_mut() {
        let stencils = Stencils::of(simd, &chunk.position);
        moments.gather::<S, false>(simd, &stencils, count, motion);
        let gradient = gradient(simd, &moments, law);
        let strained = stress::strain(simd, chunk, &gradient, law, dt);
        give_force(simd, &strained, chunk, law, &mut given);
        given.scatter::<S, false>(simd, &stencils, count, force);
    }
}

/// Computes the last sub-step of a step, and gathers the motion (equations 12 and 13).
#[inline(always)]
pub fn finish<S: Simd>(simd: S, block: &mut Block, ending: &Ending, nodes: &EndTiles) {
    let Ending {
        law,
        lattice,
        dt,
        redistribution,
        no_shift_zones,
        roomiest,
    } = *ending;
    let spacing = &lattice.spacing;
    let mut moments = Moments::EMPTY;
    let mut displacement = Quads::EMPTY;
    let mut twist = Quads::EMPTY;
    let mut sums = EndSums::NONE;
    let mut spread = ShiftingSums::NONE;
    let key = block.key;
    for (chunk, count) in block.chunks_mut() {
        let stencils = Stencils::of(simd, &chunk.position);
        moments.gather::<S, true>(simd, &stencils, count, &nodes.motion);
        gather_mean(
            simd,
            &stencils,
            count,
            &nodes.displacement,
            &mut displacement,
        );
        gather_mean(simd, &stencils, count, &nodes.twist, &mut twist);
        let a = gradient(simd, &moments, law);
        let strained = stress::strain(simd, chunk, &a, law, dt);
        let [excess_volume_fraction, vx, vy, vz] = moments.zeroth.spread(simd);
        let [mean_compression, ux, uy, uz] = displacement.spread(simd);
        let [_, tx, ty, tz] = twist.spread(simd);
        let on_displaced = strained.deformed.undone_at_most(simd, &a);
        // Of Σ w v_i (d_i + u_i − u_p)ᵀ only the skew part counts: the nodes' displacement adds u_p
        // × v_p − Σ w u_i × v_i.
        let added = [
            uy * vz - uz * vy - tx,
            uz * vx - ux * vz - ty,
            ux * vy - uy * vx - tz,
        ];
        let affine = with_angular_momentum(simd, &on_displaced, &a, &added, spacing);
        let (arriving, mut moved) = ([vx, vy, vz], [ux, uy, uz]);
        for axis in 0..3 {
            moved[axis] *= splat(simd, 1.0 / spacing[axis]);
        }
        let seen = PointState {
            volumetric_strain: strained.volumetric_strain,
            compression_at_transfer: f32x16::simd_from(simd, chunk.volumetric_strain)
                .min(f32x16::splat(simd, 0.0)),
            mean_compression,
            excess_volume_fraction,
            slope: crowding_slope(simd, &moments),
        };
        let mut position = moved;
        for axis in 0..3 {
            position[axis] += f32x16::simd_from(simd, chunk.position[axis]);
        }
        let mut redistributed = redistribute(simd, redistribution, &seen, &moved);
        let mut velocity = arriving;
        for no_shift_zone in no_shift_zones {
            let here = no_shift_zone.in_block(&key);
            here.keep_off(
                simd,
                &position,
                &moved,
                &mut redistributed.shift,
                &mut velocity,
            );
        }
        let change = [0, 1, 2].map(|axis| velocity[axis] - arriving[axis]);
        spread.stop(simd, chunk, &position, &change, spacing);
        for part in &mut chunk.deviator {
            let before = f32x16::simd_from(simd, *part);
            *part = redistributed.rise.mul_add(before, before).into();
        }
        let mass = f32x16::simd_from(simd, chunk.mass);
        let roomiest = f32x16::splat(simd, roomiest) / mass - f32x16::splat(simd, 1.0);
        chunk.volumetric_strain = redistributed.volumetric_strain.min(roomiest).into();
        spread.add(simd, chunk, &redistributed.shift, &velocity, spacing);
        for axis in 0..3 {
            chunk.velocity[axis] = velocity[axis].into();
            chunk.position[axis] = (position[axis] + redistributed.shift[axis]).into();
            for row in 0..3 {
                chunk.gradient[axis][row] = affine[row][axis].into();
            }
        }
        sums.add(chunk);
    }
    let origin = lattice.position(key.map(|along| along * BLOCK as i32));
    block.note_end(sums.end(), spread.total(&origin));
}

/// h ∇excess volume fraction, per axis [1/cell].
#[inline(always)]
fn crowding_slope<S: Simd>(simd: S, moments: &Moments) -> [f32x16<S>; 3] {
    let mut slope = [f32x16::splat(simd, 0.0); 3];
    for axis in 0..3 {
        let [along, ..] = moments.first[axis].spread(simd);
        slope[axis] = along * splat(simd, 4.0);
    }
    slope
}

/// A = Σ v_i ⊗ ∇w_i from the moments of mass and velocity.
#[inline(always)]
fn gradient<S: Simd>(simd: S, moments: &Moments, law: &Law) -> Matrix<S> {
    let mut gradient = [[f32x16::splat(simd, 0.0); 3]; 3];
    for axis in 0..3 {
        let factor = f32x16::splat(simd, law.gradient[axis]);
        let [_, x, y, z] = moments.first[axis].spread(simd);
        gradient[0][axis] = x * factor;
        gradient[1][axis] = y * factor;
        gradient[2][axis] = z * factor;
    }
    gradient
}

/// `gradient` with the skew part that conserves angular momentum (equation 13); `plain` is the
/// gradient at the transfer positions.
#[inline(always)]
fn with_angular_momentum<S: Simd>(
    simd: S,
    gradient: &Matrix<S>,
    plain: &Matrix<S>,
    added: &[f32x16<S>; 3],
    spacing: &Vec3,
) -> Matrix<S> {
    let moment = spacing.component_mul(spacing) * 0.25;
    let mut affine = *gradient;
    for (axis, (i, j)) in [(2, (0, 1)), (1, (0, 2)), (0, (1, 2))] {
        let symmetric = splat(simd, 0.5) * (gradient[i][j] + gradient[j][i]);
        // (v uᵀ)_ij − (v uᵀ)_ji is −(u × v) for (0, 1) and (1, 2), + for (0, 2).
        let sign = if axis == 1 { -1.0 } else { 1.0 };
        let turned = plain[i][j] * splat(simd, moment[j]) - plain[j][i] * splat(simd, moment[i]);
        let wanted = splat(simd, sign).mul_add(added[axis], turned);
        let skew = (wanted - symmetric * splat(simd, moment[j] - moment[i]))
            * splat(simd, 1.0 / (moment[i] + moment[j]));
        affine[i][j] = symmetric + skew;
        affine[j][i] = symmetric - skew;
    }
    affine
}

/// m and m v, and m C d with d in cells.
#[inline(always)]
fn give_momentum<S: Simd>(simd: S, chunk: &Chunk, law: &Law, given: &mut Given) {
    let none = f32x16::splat(simd, 0.0);
    let mass = f32x16::simd_from(simd, chunk.mass);
    let [x, y, z] = times(simd, &chunk.velocity, mass);
    given.constant.gathered([mass, x, y, z]);
    for axis in 0..3 {
        let spacing = f32x16::splat(simd, 4.0 / law.gradient[axis]);
        let [x, y, z] = times(simd, &chunk.gradient[axis], mass * spacing);
        given.slope[axis].gathered([none, x, y, z]);
    }
}

/// m min(φ, 0), and the residual of v and C.
#[inline(always)]
fn give_rest<S: Simd>(simd: S, chunk: &Chunk, law: &Law, moments: &Moments, given: &mut Given) {
    let none = f32x16::splat(simd, 0.0);
    let mass = f32x16::simd_from(simd, chunk.mass);
    let compressive = f32x16::simd_from(simd, chunk.volumetric_strain).min(none);
    let [_, vx, vy, vz] = moments.zeroth.spread(simd);
    let [x, y, z] = &chunk.velocity;
    given.constant.gathered([
        mass * compressive,
        (f32x16::simd_from(simd, *x) - vx) * mass,
        (f32x16::simd_from(simd, *y) - vy) * mass,
        (f32x16::simd_from(simd, *z) - vz) * mass,
    ]);
    for axis in 0..3 {
        // C h, whose value on the nodes is 4 Σ w v δ.
        let spacing = f32x16::splat(simd, 4.0 / law.gradient[axis]);
        let four = f32x16::splat(simd, 4.0);
        let [_, lx, ly, lz] = moments.first[axis].spread(simd);
        let [x, y, z] = &chunk.gradient[axis];
        given.slope[axis].gathered([
            none,
            (f32x16::simd_from(simd, *x) * spacing - lx * four) * mass,
            (f32x16::simd_from(simd, *y) * spacing - ly * four) * mass,
            (f32x16::simd_from(simd, *z) * spacing - lz * four) * mass,
        ]);
    }
}

#[inline(always)]
fn times<S: Simd>(simd: S, vector: &[Lanes; 3], factor: f32x16<S>) -> [f32x16<S>; 3] {
    [
        f32x16::simd_from(simd, vector[0]) * factor,
        f32x16::simd_from(simd, vector[1]) * factor,
        f32x16::simd_from(simd, vector[2]) * factor,
    ]
}

#[inline(always)]
fn splat<S: Simd>(simd: S, value: f64) -> f32x16<S> {
    f32x16::splat(simd, value as f32)
}

#[inline(always)]
fn give_force<S: Simd>(
    simd: S,
    strained: &Strained<S>,
    chunk: &Chunk,
    law: &Law,
    given: &mut Given,
) {
    let none = f32x16::splat(simd, 0.0);
    let force = strained.force(simd, chunk, law);
    for axis in 0..3 {
        given.slope[axis].gathered([none, force[0][axis], force[1][axis], force[2][axis]]);
    }
}

#[cfg(test)]
mod tests;
