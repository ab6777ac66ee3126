//! Transfer from points to grid (P2G): mass and momentum, strain rates, and the residual of
//! both transfers (docs/method.md, equations 8, 8a, 39 and 42a).

use super::blocks::Block;
use super::chunk::Chunk;
use super::constitutive::Law;
use super::deformation::at_transfer;
use super::lanes::{Real, Splat, load, load_each};
use super::rows::{LinearFields, MomentSums, Moments, Quads, Tile, gather_mean, scatter_mean};
use super::stencil::Stencils;
use super::strain_rate_smoothing::{StrainRateSmoothing, smooth_strain_rates};
use super::stress_update::set_force;
use fearless_simd::prelude::*;

/// Scatters mass and momentum to a tile (equation 8), and the strain rates of the points times
/// their masses to two more (equation 42a): xx, yy, zz, xy, and xz, yz.
#[inline(always)]
pub fn scatter_momentum<S: Simd, R: Real>(
    simd: S,
    block: &mut Block<R>,
    law: &Law<R>,
    momentum: &mut Tile<R>,
    strain_rate: [&mut Tile<R>; 2],
) {
    let [first, second] = strain_rate;
    (*momentum, *first, *second) = (Tile::EMPTY, Tile::EMPTY, Tile::EMPTY);
    let none = Splat::<S, R>::new(simd).of(0.0);
    let mut fields = LinearFields::ZERO;
    let mut quantity = Quads::EMPTY;
    let mut runs = 0;
    for (chunk, count) in block.chunks_mut() {
        let stencils = Stencils::of(simd, &chunk.position);
        runs += stencils.runs(count);
        set_momentum(simd, &stencils, chunk, law, &mut fields);
        fields.scatter(simd, &stencils, count, momentum);
        let mass = load::<S, R>(simd, &chunk.mass);
        let [xx, yy, zz, xy, xz, yz] = chunk.strain_rate(simd);
        quantity.set::<S>([mass * xx, mass * yy, mass * zz, mass * xy]);
        scatter_mean(simd, &stencils, count, &quantity, first);
        quantity.set::<S>([mass * xz, mass * yz, none, none]);
        scatter_mean(simd, &stencils, count, &quantity, second);
    }
    block.note_runs(runs);
}

/// State of the nodes in the tile of a block of points after the first transfer.
pub struct TransferTiles<R> {
    /// Mass and velocity.
    pub motion: Tile<R>,
    /// Mean strain rate, in two sets of components.
    pub strain_rate: [Tile<R>; 2],
}

impl<R: Real> TransferTiles<R> {
    /// All zero.
    pub const EMPTY: Self = Self {
        motion: Tile::EMPTY,
        strain_rate: [Tile::EMPTY; 2],
    };
}

/// Scatters the compressive strains and the part of the momentum that the nodes do not show to a
/// tile, and to another the force of stress (equations 9 and 39); smooths the strain rates of the
/// points (equation 42a) and starts their deformation anew.
#[inline(always)]
pub fn residual_transfer<S: Simd, R: Real>(
    simd: S,
    block: &mut Block<R>,
    law: &Law<R>,
    nodes: &TransferTiles<R>,
    smoothing: &StrainRateSmoothing,
    [residual, force]: [&mut Tile<R>; 2],
) {
    (*residual, *force) = (Tile::EMPTY, Tile::EMPTY);
    let mut moment_sums = MomentSums::EMPTY;
    let mut mean_sums = Quads::EMPTY;
    let mut fields = LinearFields::ZERO;
    let [first, second] = &nodes.strain_rate;
    for (chunk, count) in block.chunks_mut() {
        let stencils = Stencils::of(simd, &chunk.position);
        let first = gather_mean(simd, &stencils, count, first, &mut mean_sums);
        let second = gather_mean(simd, &stencils, count, second, &mut mean_sums);
        smooth_strain_rates(simd, chunk, &first, &second, smoothing);
        let moments = moment_sums.gather(simd, &stencils, count, &nodes.motion);
        set_residual(simd, &stencils, chunk, law, &moments, &mut fields);
        fields.scatter(simd, &stencils, count, residual);
        chunk.gradient = [[R::ZEROS; 3]; 3];
        let state = at_transfer(simd, chunk, law);
        set_force(simd, &stencils, &state, chunk, law, &mut fields);
        fields.scatter(simd, &stencils, count, force);
    }
}

/// Sets m and m v, and m C d with d in cells.
#[inline(always)]
fn set_momentum<S: Simd, R: Real>(
    simd: S,
    stencils: &Stencils<R>,
    chunk: &Chunk<R>,
    law: &Law<R>,
    fields: &mut LinearFields<R>,
) {
    let number = Splat::<S, R>::new(simd);
    let none = number.of(0.0);
    let mass = load::<S, R>(simd, &chunk.mass);
    let [x, y, z] = times::<S, R>(simd, &chunk.velocity, mass);
    let mut slope = [[none; 4]; 3];
    for axis in 0..3 {
        let spacing = number.all(R::of(4.0) / law.gradient[axis]);
        let [x, y, z] = times::<S, R>(simd, &chunk.gradient[axis], mass * spacing);
        slope[axis] = [none, x, y, z];
    }
    fields.set(simd, stencils, &[mass, x, y, z], &slope);
}

/// Sets m min(φ, 0), and the residual of v and C.
#[inline(always)]
fn set_residual<S: Simd, R: Real>(
    simd: S,
    stencils: &Stencils<R>,
    chunk: &Chunk<R>,
    law: &Law<R>,
    moments: &Moments<S, R>,
    fields: &mut LinearFields<R>,
) {
    let number = Splat::<S, R>::new(simd);
    let none = number.of(0.0);
    let mass = load::<S, R>(simd, &chunk.mass);
    let compressive = load::<S, R>(simd, &chunk.volumetric_strain).min(none);
    let [_, vx, vy, vz] = moments.zeroth;
    let [x, y, z] = load_each::<S, R, 3>(simd, &chunk.velocity);
    let value = [
        mass * compressive,
        (x - vx) * mass,
        (y - vy) * mass,
        (z - vz) * mass,
    ];
    let mut slope = [[none; 4]; 3];
    for axis in 0..3 {
        // C h, of which the nodes show 4 Σ w v δ.
        let spacing = number.all(R::of(4.0) / law.gradient[axis]);
        let four = number.of(4.0);
        let [_, lx, ly, lz] = moments.first[axis];
        let [x, y, z] = load_each::<S, R, 3>(simd, &chunk.gradient[axis]);
        slope[axis] = [
            none,
            (x * spacing - lx * four) * mass,
            (y * spacing - ly * four) * mass,
            (z * spacing - lz * four) * mass,
        ];
    }
    fields.set(simd, stencils, &value, &slope);
}

#[inline(always)]
fn times<S: Simd, R: Real>(
    simd: S,
    vector: &[R::Lanes; 3],
    factor: R::Vector<S>,
) -> [R::Vector<S>; 3] {
    [
        load::<S, R>(simd, &vector[0]) * factor,
        load::<S, R>(simd, &vector[1]) * factor,
        load::<S, R>(simd, &vector[2]) * factor,
    ]
}
