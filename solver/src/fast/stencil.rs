//! Kernel weights of sixteen points (docs/method.md, equation 7).

use super::chunk::{LANES, Lanes};
use crate::grid::{BLOCK, TILE};
use crate::kernel::WIDTH;
use fearless_simd::{f32x16, prelude::*, u32x16};

/// The stencils of sixteen points, axis by axis and node by node.
pub struct Stencils {
    /// Weights w.
    pub weight: [[Lanes; WIDTH]; 3],
    /// w δ with the distance δ of node from point [cells].
    pub lever: [[Lanes; WIDTH]; 3],
    /// Place in the tile of the lowest node.
    pub base: [u32; LANES],
}

impl Stencils {
    /// Stencils of points at these positions in their block [cells].
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, position: &[Lanes; 3]) -> Self {
        let mut stencils = Self {
            weight: [[[0.0; LANES]; WIDTH]; 3],
            lever: [[[0.0; LANES]; WIDTH]; 3],
            base: [0; LANES],
        };
        let mut place = splat(simd, 0.0);
        for axis in 0..3 {
            let x = f32x16::simd_from(simd, position[axis]);
            let base = lowest_node(simd, x);
            place = place * splat(simd, TILE as f32) + base;
            let f = x - base;
            let (low, mid, high) = (
                splat(simd, 1.5) - f,
                f - splat(simd, 1.0),
                f - splat(simd, 0.5),
            );
            let weight = [
                splat(simd, 0.5) * low * low,
                splat(simd, 0.75) - mid * mid,
                splat(simd, 0.5) * high * high,
            ];
            let offset = [
                splat(simd, 0.0) - f,
                splat(simd, 1.0) - f,
                splat(simd, 2.0) - f,
            ];
            for node in 0..WIDTH {
                stencils.weight[axis][node] = weight[node].into();
                stencils.lever[axis][node] = (weight[node] * offset[node]).into();
            }
        }
        let place: u32x16<S> = place.to_int();
        stencils.base = place.into();
        stencils
    }

    /// Runs of points with the same lowest node among the first `count`.
    #[inline(always)]
    pub fn runs(&self, count: usize) -> u32 {
        let mut runs = 1;
        for lane in 1..count {
            runs += u32::from(self.base[lane] != self.base[lane - 1]);
        }
        runs
    }

    /// Number of consecutive lanes from `lane`, below `end`, with its lowest node.
    #[inline(always)]
    pub fn run(&self, lane: usize, end: usize) -> usize {
        let base = self.base[lane];
        let mut next = lane + 1;
        while next < end && self.base[next] == base {
            next += 1;
        }
        next - lane
    }
}

/// Weights of the stencil of one point inside its block, axis by axis, and the lowest of its
/// nodes in the tile.
pub fn weights(position: &[f32; 3]) -> ([usize; 3], [[f32; WIDTH]; 3]) {
    let base = position.map(|x| ((x - 0.5) as usize).min(BLOCK - 1));
    let mut weight = [[0.0; WIDTH]; 3];
    for axis in 0..3 {
        let f = position[axis] - base[axis] as f32;
        weight[axis] = [
            0.5 * (1.5 - f) * (1.5 - f),
            0.75 - (f - 1.0) * (f - 1.0),
            0.5 * (f - 0.5) * (f - 0.5),
        ];
    }
    (base, weight)
}

#[inline(always)]
fn splat<S: Simd>(simd: S, value: f32) -> f32x16<S> {
    f32x16::splat(simd, value)
}

/// Lowest node of the stencil of a point inside its block, along one axis. A non-finite
/// position gives node 0, so that it does no harm until it is found.
#[inline(always)]
fn lowest_node<S: Simd>(simd: S, x: f32x16<S>) -> f32x16<S> {
    let last = f32x16::splat(simd, (BLOCK - 1) as f32);
    let none = f32x16::splat(simd, 0.0);
    let base = (x - f32x16::splat(simd, 0.5)).floor();
    base.max_precise(none).min(last)
}

#[cfg(test)]
mod tests;
