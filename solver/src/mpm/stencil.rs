//! Kernel weights of a chunk (docs/method.md, equation 7).

use super::lanes::{Real, Splat, load};
use crate::grid::{BLOCK, TILE};
use crate::kernel::WIDTH;
use fearless_simd::prelude::*;

/// Stencils of the points of a chunk.
pub struct Stencils<R: Real> {
    /// Products of the weights along x and y.
    pub across: [[R::Lanes; WIDTH]; WIDTH],
    /// Weights along z.
    pub along: [R::Lanes; WIDTH],
    /// Distance of the points from the middle nodes along x, y and z [cells].
    pub offset: [R::Lanes; 3],
    /// Place in the tile of the lowest node.
    pub base: R::Ids,
}

impl<R: Real> Stencils<R> {
    /// Stencils of points at these positions in their block [cells].
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, position: &[R::Lanes; 3]) -> Self {
        let number = Splat::<S, R>::new(simd);
        let mut weight = [[number.of(0.0); WIDTH]; 3];
        let mut offsets = [R::ZEROS; 3];
        let mut place = number.of(0.0);
        for axis in 0..3 {
            let x = load::<S, R>(simd, &position[axis]);
            let base = lowest_node::<S, R>(simd, x);
            place = place * number.of(TILE as f64) + base;
            let f = x - base;
            let (low, mid, high) = (number.of(1.5) - f, f - number.of(1.0), f - number.of(0.5));
            weight[axis] = [
                number.of(0.5) * low * low,
                number.of(0.75) - mid * mid,
                number.of(0.5) * high * high,
            ];
            offsets[axis] = mid.to_array();
        }
        let mut across = [[R::ZEROS; WIDTH]; WIDTH];
        let mut along = [R::ZEROS; WIDTH];
        for a in 0..WIDTH {
            for b in 0..WIDTH {
                across[a][b] = (weight[0][a] * weight[1][b]).to_array();
            }
            along[a] = weight[2][a].to_array();
        }
        Self {
            across,
            along,
            offset: offsets,
            base: R::indices(place),
        }
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

    /// Number of lanes from `lane` on that, below `end`, have its lowest node.
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

/// Weights of the nodes of one settled point, axis by axis, and the lowest of these nodes in
/// its tile.
pub fn weights<R: Real>(position: &[R; 3]) -> ([usize; 3], [[R; WIDTH]; 3]) {
    let number = R::of;
    let mut base = [0; 3];
    let mut weight = [[R::ZERO; WIDTH]; 3];
    for axis in 0..3 {
        let x = position[axis];
        let lowest = x - number(0.5);
        base[axis] = (lowest.to_f64() as usize).min(BLOCK - 1);
        let f = x - number(base[axis] as f64);
        weight[axis] = [
            number(0.5) * (number(1.5) - f) * (number(1.5) - f),
            number(0.75) - (f - number(1.0)) * (f - number(1.0)),
            number(0.5) * (f - number(0.5)) * (f - number(0.5)),
        ];
    }
    (base, weight)
}

/// Lowest node of settled points, along one axis. A position that is not a number is taken for
/// node 0, so that it can do no harm until it is found.
#[inline(always)]
fn lowest_node<S: Simd, R: Real>(simd: S, x: R::Vector<S>) -> R::Vector<S> {
    let number = Splat::<S, R>::new(simd);
    let base = (x - number.of(0.5)).floor();
    base.max_precise(number.of(0.0))
        .min(number.of((BLOCK - 1) as f64))
}

#[cfg(test)]
mod tests;
