//! Sums of the nodes at points.

use super::StencilRows;
use super::quads::Quads;
use super::tile::Tile;
use crate::kernel::WIDTH;
use crate::mpm::lanes::{Real, Row, Splat, load};
use crate::mpm::stencil::Stencils;
use fearless_simd::prelude::*;

/// Moments of a nodal quantity q of four numbers at the points of a chunk; zero in lanes without
/// a point.
pub struct Moments<S: Simd, R: Real> {
    /// Σ w q.
    pub zeroth: [R::Vector<S>; 4],
    /// Σ w q δ along x, y and z [cells].
    pub first: [[R::Vector<S>; 4]; 3],
}

/// The same sums point by point, about the middle node of each stencil.
pub struct MomentSums<R> {
    zeroth: Quads<R>,
    first: [Quads<R>; 3],
}

impl<R: Real> MomentSums<R> {
    /// All zero.
    pub const EMPTY: Self = Self {
        zeroth: Quads::EMPTY,
        first: [Quads::EMPTY; 3],
    };

    /// Gathers the moments of the first `count` points.
    #[inline(always)]
    pub fn gather<S: Simd>(
        &mut self,
        simd: S,
        stencils: &Stencils<R>,
        count: usize,
        tile: &Tile<R>,
    ) -> Moments<S, R> {
        let mut lane = 0;
        while lane < count {
            let rows = tile.rows(simd, stencils.base[lane]);
            let end = lane + stencils.run(lane, count);
            for lane in lane..end {
                self.gather_point(simd, stencils, lane, &rows);
            }
            lane = end;
        }
        self.zeroth.clear_from(simd, count);
        for first in &mut self.first {
            first.clear_from(simd, count);
        }
        self.about_points(simd, stencils)
    }

    #[inline(always)]
    fn gather_point<S: Simd>(
        &mut self,
        simd: S,
        stencils: &Stencils<R>,
        lane: usize,
        rows: &StencilRows<S, R>,
    ) {
        let columns = weighted_columns(simd, stencils, lane, rows);
        let ends = weighted_ends(simd, stencils, lane, rows);
        let along_x = columns[2].minus(columns[0]).nodes();
        let along_y = ends[1].minus(ends[0]).nodes();
        let [low, middle, high] = columns[0].plus(columns[1]).plus(columns[2]).nodes();
        let [wl, wm, wh] = along_z::<S, R>(simd, stencils, lane);
        let (low, high) = (low * wl, high * wh);
        self.zeroth.set_lane(lane, middle.mul_add(wm, low + high));
        self.first[2].set_lane(lane, high - low);
        self.first[0].set_lane(lane, mean_of::<S, R>(&along_x, &[wl, wm, wh]));
        self.first[1].set_lane(lane, mean_of::<S, R>(&along_y, &[wl, wm, wh]));
    }

    /// Moments about the points: Σ w q δ = Σ w q i − f Σ w q, with the places i of the nodes and f
    /// of the point from the middle node.
    #[inline(always)]
    fn about_points<S: Simd>(&self, simd: S, stencils: &Stencils<R>) -> Moments<S, R> {
        let zeroth = self.zeroth.transposed(simd);
        let mut first = [zeroth; 3];
        for axis in 0..3 {
            let offset = load::<S, R>(simd, &stencils.offset[axis]);
            first[axis] = self.first[axis].transposed(simd);
            for (first, zeroth) in first[axis].iter_mut().zip(zeroth) {
                *first -= offset * zeroth;
            }
        }
        Moments { zeroth, first }
    }
}

/// Gathers Σ w q of a nodal quantity of four numbers, for the first `count` points.
#[inline(always)]
pub fn gather_mean<S: Simd, R: Real>(
    simd: S,
    stencils: &Stencils<R>,
    count: usize,
    tile: &Tile<R>,
    mean: &mut Quads<R>,
) -> [R::Vector<S>; 4] {
    let mut lane = 0;
    while lane < count {
        let rows = tile.rows(simd, stencils.base[lane]);
        let end = lane + stencils.run(lane, count);
        for lane in lane..end {
            let columns = weighted_columns(simd, stencils, lane, &rows);
            let nodes = columns[0].plus(columns[1]).plus(columns[2]).nodes();
            let weight = along_z::<S, R>(simd, stencils, lane);
            mean.set_lane(lane, mean_of::<S, R>(&nodes, &weight));
        }
        lane = end;
    }
    mean.clear_from(simd, count);
    mean.transposed(simd)
}

/// Weighted sum of three nodes.
#[inline(always)]
fn mean_of<S: Simd, R: Real>(
    nodes: &[R::Quad<S>; WIDTH],
    weight: &[R::Quad<S>; WIDTH],
) -> R::Quad<S> {
    nodes[2].mul_add(weight[2], nodes[1].mul_add(weight[1], nodes[0] * weight[0]))
}

/// Weighted sum of three rows, each with the weight of one lane.
#[inline(always)]
fn weighted<S: Simd, R: Real>(
    simd: S,
    rows: [R::Row<S>; WIDTH],
    weight: [&R::Lanes; WIDTH],
    lane: usize,
) -> R::Row<S> {
    let number = Splat::<S, R>::new(simd);
    let sum = rows[0].scaled(number.all(weight[0][lane]));
    let sum = rows[1].scaled_plus(number.all(weight[1][lane]), sum);
    rows[2].scaled_plus(number.all(weight[2][lane]), sum)
}

/// Weighted sums over y of the rows of a stencil.
#[inline(always)]
fn weighted_columns<S: Simd, R: Real>(
    simd: S,
    stencils: &Stencils<R>,
    lane: usize,
    rows: &StencilRows<S, R>,
) -> [R::Row<S>; WIDTH] {
    let mut sums = rows[0];
    for a in 0..WIDTH {
        let [low, middle, high] = &stencils.across[a];
        sums[a] = weighted::<S, R>(simd, rows[a], [low, middle, high], lane);
    }
    sums
}

/// Weighted sums over x of the lowest and the highest rows of a stencil along y.
#[inline(always)]
fn weighted_ends<S: Simd, R: Real>(
    simd: S,
    stencils: &Stencils<R>,
    lane: usize,
    rows: &StencilRows<S, R>,
) -> [R::Row<S>; 2] {
    let mut sums = [rows[0][0]; 2];
    for (end, b) in [0, WIDTH - 1].into_iter().enumerate() {
        let along_x = [rows[0][b], rows[1][b], rows[2][b]];
        let [low, middle, high] = &stencils.across;
        sums[end] = weighted::<S, R>(simd, along_x, [&low[b], &middle[b], &high[b]], lane);
    }
    sums
}

/// Weights of a point's nodes along z.
#[inline(always)]
fn along_z<S: Simd, R: Real>(simd: S, stencils: &Stencils<R>, lane: usize) -> [R::Quad<S>; WIDTH] {
    let mut weights = [R::Quad::<S>::simd_from(simd, R::ZERO); WIDTH];
    for (weight, of) in weights.iter_mut().zip(&stencils.along) {
        *weight = R::Quad::<S>::simd_from(simd, of[lane]);
    }
    weights
}
