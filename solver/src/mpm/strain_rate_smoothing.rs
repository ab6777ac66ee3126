//! Strain-rate smoothing (docs/method.md, equation 42a).
//!
//! Where points lie unevenly, the velocity gradient of each of them is off, by 3 % in steady
//! shear with eight points a cell. Shear stress follows the direction of the strain rate, so part
//! of it does not point against the flow, and friction comes out too weak. The mean strain rate
//! of the points around is off another way: so the effective strain rate of a point is a mixture
//! of its own and the mean.

use super::blocks::Block;
use super::chunk::Chunk;
use super::lanes::{Real, Splat, load_each};
use super::rows::{Quads, Tile, gather_mean};
use super::stencil::Stencils;
use crate::method::METHOD;
use fearless_simd::prelude::*;

/// Smoothing of strain rates in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainRateSmoothing {
    /// Share of the mean.
    pub share: f64,
    /// Speed from which on a point is smoothed fully [m/s].
    pub full_speed: f64,
}

impl StrainRateSmoothing {
    /// None at all: an elastic body keeps its own strain rates.
    pub const NONE: Self = Self {
        share: 0.0,
        full_speed: f64::MIN_POSITIVE,
    };

    /// Smoothing of a flow whose steps are governed by this speed [m/s].
    pub fn at(speed: f64) -> Self {
        Self {
            share: METHOD.smoothing.share,
            full_speed: METHOD.smoothing.slow * speed,
        }
    }
}

/// Mass, velocity and mean strain rate of the nodes in reach of a block's points.
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

/// D = sym C of the points of a chunk: xx yy zz xy xz yz.
#[inline(always)]
pub fn strain_rate<S: Simd, R: Real>(simd: S, chunk: &Chunk<R>) -> [R::Vector<S>; 6] {
    let half = Splat::<S, R>::new(simd).of(0.5);
    // Column by column.
    let [x, y, z] = &chunk.gradient;
    let [xx, yx, zx] = load_each::<S, R, 3>(simd, x);
    let [xy, yy, zy] = load_each::<S, R, 3>(simd, y);
    let [xz, yz, zz] = load_each::<S, R, 3>(simd, z);
    [
        xx,
        yy,
        zz,
        half * (xy + yx),
        half * (xz + zx),
        half * (yz + zy),
    ]
}

/// Finds the strain rates that smoothing adds to those of the points, deviators (equation 42a).
#[inline(always)]
pub fn smooth_strain_rates<S: Simd, R: Real>(
    simd: S,
    block: &mut Block<R>,
    nodes: &TransferTiles<R>,
    smoothing: &StrainRateSmoothing,
) {
    let number = Splat::<S, R>::new(simd);
    let mut sums = Quads::EMPTY;
    let full = smoothing.full_speed * smoothing.full_speed;
    let per_full = number.of(full.max(R::SMALLEST).recip());
    for (chunk, count) in block.chunks_mut() {
        let stencils = Stencils::of(simd, &chunk.position);
        let [first, second] = &nodes.strain_rate;
        let [xx, yy, zz, xy] = gather_mean(simd, &stencils, count, first, &mut sums);
        let [xz, yz, ..] = gather_mean(simd, &stencils, count, second, &mut sums);
        let own = strain_rate(simd, chunk);
        let mut lacking = [xx, yy, zz, xy, xz, yz];
        for (part, own) in lacking.iter_mut().zip(own) {
            *part -= own;
        }
        let third = (lacking[0] + lacking[1] + lacking[2]) * number.of(1.0 / 3.0);
        for part in &mut lacking[..3] {
            *part -= third;
        }
        let [x, y, z] = load_each::<S, R, 3>(simd, &chunk.velocity);
        let speed = x.mul_add(x, y.mul_add(y, z * z));
        let degree = (speed * per_full).min(number.of(1.0));
        let share = number.of(smoothing.share) * degree;
        for (kept, part) in chunk.smoothing.iter_mut().zip(lacking) {
            *kept = (share * part).to_array();
        }
    }
}

#[cfg(test)]
mod tests;
