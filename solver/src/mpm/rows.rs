//! Sums over the 27 nodes of points, row by row.
//!
//! Three nodes along z, four numbers each, and a fourth node of weight zero make a row of
//! sixteen numbers. The stencil of a point is nine rows; points of one cell have the same nine,
//! which then stay in registers.

use super::lanes::{MOST_LANES, NODE_NUMBERS, ROW, Real, Row, Splat};
use super::stencil::{Stencils, weights};
use crate::grid::{TILE, TILE_NODES, in_tile};
use crate::kernel::WIDTH;
use fearless_simd::prelude::*;

/// Four numbers of each node in reach of one block's points, and room for a row that starts at
/// the last node.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Tile<R>(pub [R; TILE_NUMBERS]);

/// Numbers of a tile.
pub const TILE_NUMBERS: usize = NODE_NUMBERS * (TILE_NODES + 4);
/// Numbers from the lowest node of a stencil to the end of its last row.
const REACH: usize = NODE_NUMBERS * in_tile(WIDTH - 1, WIDTH - 1, 0) + ROW;

impl<R: Real> Tile<R> {
    /// All zero.
    pub const EMPTY: Self = Self([R::ZERO; TILE_NUMBERS]);

    /// The four numbers of a node.
    pub fn node_mut(&mut self, place: usize) -> &mut [R] {
        &mut self.0[NODE_NUMBERS * place..][..NODE_NUMBERS]
    }

    /// Adds a force [N] at a place in the block of the tile.
    pub fn push_at(&mut self, position: &[R; 3], force: &[R; 3]) {
        let (base, weight) = weights(position);
        for a in 0..WIDTH {
            for b in 0..WIDTH {
                for c in 0..WIDTH {
                    let w = weight[0][a] * weight[1][b] * weight[2][c];
                    let node = self.node_mut(in_tile(base[0] + a, base[1] + b, base[2] + c));
                    for (sum, part) in node[1..].iter_mut().zip(force) {
                        *sum += w * *part;
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn reach(&self, base: u32) -> &[R] {
        &self.0[NODE_NUMBERS * base as usize..][..REACH]
    }

    #[inline(always)]
    fn reach_mut(&mut self, base: u32) -> &mut [R] {
        &mut self.0[NODE_NUMBERS * base as usize..][..REACH]
    }
}

/// Four numbers of each point of a chunk, point by point.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Quads<R>(pub [R; NODE_NUMBERS * MOST_LANES]);

impl<R: Real> Quads<R> {
    /// All zero.
    pub const EMPTY: Self = Self([R::ZERO; NODE_NUMBERS * MOST_LANES]);

    #[inline(always)]
    fn of_lane<S: Simd>(&self, simd: S, lane: usize) -> R::Row<S> {
        let numbers = &self.0[NODE_NUMBERS * lane..][..NODE_NUMBERS];
        R::Row::repeated(R::Quad::<S>::from_slice(simd, numbers))
    }

    #[inline(always)]
    fn set_lane<S: Simd>(&mut self, lane: usize, value: R::Quad<S>) {
        value.store_slice(&mut self.0[NODE_NUMBERS * lane..][..NODE_NUMBERS]);
    }

    #[inline(always)]
    fn clear_from<S: Simd>(&mut self, simd: S, lane: usize) {
        for lane in lane..R::LANES {
            self.set_lane::<S>(lane, R::Quad::<S>::simd_from(simd, R::ZERO));
        }
    }

    /// The four numbers, each of all points.
    #[inline(always)]
    pub fn transposed<S: Simd>(&self, simd: S) -> [R::Vector<S>; 4] {
        let mut parts = [Splat::<S, R>::new(simd).of(0.0); 4];
        for (part, values) in parts.iter_mut().zip(self.0.chunks_exact(R::LANES)) {
            *part = R::Vector::<S>::from_slice(simd, values);
        }
        let [a, b, c, d] = parts;
        let (even_low, odd_low) = a.deinterleave(b);
        let (even_high, odd_high) = c.deinterleave(d);
        let (first, third) = even_low.deinterleave(even_high);
        let (second, fourth) = odd_low.deinterleave(odd_high);
        [first, second, third, fourth]
    }

    /// Stores the four numbers, each of all points.
    #[inline(always)]
    pub fn set<S: Simd>(&mut self, [first, second, third, fourth]: [R::Vector<S>; 4]) {
        let (even_low, even_high) = first.interleave(third);
        let (odd_low, odd_high) = second.interleave(fourth);
        let (a, b) = even_low.interleave(odd_low);
        let (c, d) = even_high.interleave(odd_high);
        for (part, values) in self.0.chunks_exact_mut(R::LANES).zip([a, b, c, d]) {
            values.store_slice(part);
        }
    }
}

const fn row_at(a: usize, b: usize) -> usize {
    NODE_NUMBERS * (a * TILE + b) * TILE
}

/// The nine rows of a stencil.
type StencilRows<S, R> = [[<R as Real>::Row<S>; WIDTH]; WIDTH];

/// The three numbers of one lane, each in every lane.
#[inline(always)]
fn each<S: Simd, R: Real>(
    simd: S,
    values: &[R::Lanes; WIDTH],
    lane: usize,
) -> [R::Vector<S>; WIDTH] {
    let number = Splat::<S, R>::new(simd);
    [
        number.all(values[0][lane]),
        number.all(values[1][lane]),
        number.all(values[2][lane]),
    ]
}

/// The three numbers of one lane along z.
#[inline(always)]
fn along_z<S: Simd, R: Real>(simd: S, values: &[R::Lanes; WIDTH], lane: usize) -> R::Row<S> {
    R::Row::along_z(simd, [values[0][lane], values[1][lane], values[2][lane]])
}

/// Weighted sum of three rows.
#[inline(always)]
fn weighted<S: Simd, R: Real>(
    rows: &[R::Row<S>; WIDTH],
    weight: &[R::Vector<S>; WIDTH],
) -> R::Row<S> {
    let sum = rows[1].scaled_plus(weight[1], rows[0].scaled(weight[0]));
    rows[2].scaled_plus(weight[2], sum)
}

/// Weighted sums of three rows each.
#[inline(always)]
fn weighted_each<S: Simd, R: Real>(
    rows: &StencilRows<S, R>,
    weight: &[R::Vector<S>; WIDTH],
) -> [R::Row<S>; WIDTH] {
    [
        weighted::<S, R>(&rows[0], weight),
        weighted::<S, R>(&rows[1], weight),
        weighted::<S, R>(&rows[2], weight),
    ]
}

/// Σ w q and Σ w q δ of a nodal quantity q of four numbers, for the points of a chunk; zero in
/// lanes without a point.
pub struct Moments<R> {
    /// Σ w q.
    pub zeroth: Quads<R>,
    /// Σ w q δ along x, y and z [cells].
    pub first: [Quads<R>; 3],
}

impl<R: Real> Moments<R> {
    /// All zero.
    pub const EMPTY: Self = Self {
        zeroth: Quads::EMPTY,
        first: [Quads::EMPTY; 3],
    };

    /// Gathers the first moments of the first `count` points, and the zeroth if
    /// `ZEROTH`.
    #[inline(always)]
    pub fn gather<S: Simd, const ZEROTH: bool>(
        &mut self,
        simd: S,
        stencils: &Stencils<R>,
        count: usize,
        tile: &Tile<R>,
    ) {
        let mut lane = 0;
        while lane < count {
            let rows = load_rows::<S, R>(simd, tile, stencils.base[lane]);
            let end = lane + stencils.run(lane, count);
            for lane in lane..end {
                self.gather_point::<S, ZEROTH>(simd, stencils, lane, &rows);
            }
            lane = end;
        }
        for first in &mut self.first {
            first.clear_from(simd, count);
        }
        if ZEROTH {
            self.zeroth.clear_from(simd, count);
        }
    }

    #[inline(always)]
    fn gather_point<S: Simd, const ZEROTH: bool>(
        &mut self,
        simd: S,
        stencils: &Stencils<R>,
        lane: usize,
        rows: &StencilRows<S, R>,
    ) {
        let wx = each::<S, R>(simd, &stencils.weight[0], lane);
        let lx = each::<S, R>(simd, &stencils.lever[0], lane);
        let wy = each::<S, R>(simd, &stencils.weight[1], lane);
        let ly = each::<S, R>(simd, &stencils.lever[1], lane);
        let plain = weighted_each::<S, R>(rows, &wy);
        let levered = weighted_each::<S, R>(rows, &ly);
        let weight = along_z::<S, R>(simd, &stencils.weight[2], lane);
        let lever = along_z::<S, R>(simd, &stencils.lever[2], lane);
        let sum = weighted::<S, R>(&plain, &wx);
        let along_x = weighted::<S, R>(&plain, &lx).times(weight);
        let along_y = weighted::<S, R>(&levered, &wx).times(weight);
        self.first[0].set_lane(lane, along_x.sum_of_nodes());
        self.first[1].set_lane(lane, along_y.sum_of_nodes());
        self.first[2].set_lane(lane, sum.times(lever).sum_of_nodes());
        if ZEROTH {
            self.zeroth.set_lane(lane, sum.times(weight).sum_of_nodes());
        }
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
) {
    let mut lane = 0;
    while lane < count {
        let rows = load_rows::<S, R>(simd, tile, stencils.base[lane]);
        let end = lane + stencils.run(lane, count);
        for lane in lane..end {
            let wx = each::<S, R>(simd, &stencils.weight[0], lane);
            let wy = each::<S, R>(simd, &stencils.weight[1], lane);
            let over_y = weighted_each::<S, R>(&rows, &wy);
            let sum = weighted::<S, R>(&over_y, &wx);
            let weight = along_z::<S, R>(simd, &stencils.weight[2], lane);
            mean.set_lane(lane, sum.times(weight).sum_of_nodes());
        }
        lane = end;
    }
    mean.clear_from(simd, count);
}

/// Adds w q of a quantity of four numbers of the first `count` points to a tile.
#[inline(always)]
pub fn scatter_mean<S: Simd, R: Real>(
    simd: S,
    stencils: &Stencils<R>,
    count: usize,
    quantity: &Quads<R>,
    tile: &mut Tile<R>,
) {
    let mut lane = 0;
    while lane < count {
        let end = lane + stencils.run(lane, count);
        let mut rows = [[R::Row::<S>::zero(simd); WIDTH]; WIDTH];
        for lane in lane..end {
            let weight = along_z::<S, R>(simd, &stencils.weight[2], lane);
            let row = quantity.of_lane(simd, lane).times(weight);
            let wx = each::<S, R>(simd, &stencils.weight[0], lane);
            let wy = each::<S, R>(simd, &stencils.weight[1], lane);
            for b in 0..WIDTH {
                let column = row.scaled(wy[b]);
                for a in 0..WIDTH {
                    rows[a][b] = column.scaled_plus(wx[a], rows[a][b]);
                }
            }
        }
        add_rows::<S, R>(simd, &rows, tile.reach_mut(stencils.base[lane]));
        lane = end;
    }
}

#[inline(always)]
fn add_rows<S: Simd, R: Real>(simd: S, rows: &StencilRows<S, R>, reach: &mut [R]) {
    for a in 0..WIDTH {
        for b in 0..WIDTH {
            let row = &mut reach[row_at(a, b)..][..ROW];
            R::Row::<S>::load(simd, row).plus(rows[a][b]).store(row);
        }
    }
}

#[inline(always)]
fn load_rows<S: Simd, R: Real>(simd: S, tile: &Tile<R>, base: u32) -> StencilRows<S, R> {
    let reach = tile.reach(base);
    let mut rows = [[R::Row::<S>::zero(simd); WIDTH]; WIDTH];
    for a in 0..WIDTH {
        for b in 0..WIDTH {
            rows[a][b] = R::Row::load(simd, &reach[row_at(a, b)..][..ROW]);
        }
    }
    rows
}

/// Quantities of the points of a chunk that vary linearly about each: constant + Σ slope δ.
pub struct LinearFields<R> {
    /// Value at the point.
    pub constant: Quads<R>,
    /// Slopes along x, y and z [1/cell].
    pub slope: [Quads<R>; 3],
}

impl<R: Real> LinearFields<R> {
    /// All zero.
    pub const ZERO: Self = Self {
        constant: Quads::EMPTY,
        slope: [Quads::EMPTY; 3],
    };

    /// Scatters the fields of the first `count` points to a tile, weighted; without `CONSTANT`
    /// the slopes alone.
    #[inline(always)]
    pub fn scatter<S: Simd, const CONSTANT: bool>(
        &self,
        simd: S,
        stencils: &Stencils<R>,
        count: usize,
        tile: &mut Tile<R>,
    ) {
        let mut lane = 0;
        while lane < count {
            let end = lane + stencils.run(lane, count);
            let mut rows = [[R::Row::<S>::zero(simd); WIDTH]; WIDTH];
            for lane in lane..end {
                self.scatter_point::<S, CONSTANT>(simd, stencils, lane, &mut rows);
            }
            add_rows::<S, R>(simd, &rows, tile.reach_mut(stencils.base[lane]));
            lane = end;
        }
    }

    #[inline(always)]
    fn scatter_point<S: Simd, const CONSTANT: bool>(
        &self,
        simd: S,
        stencils: &Stencils<R>,
        lane: usize,
        rows: &mut StencilRows<S, R>,
    ) {
        let weight = along_z::<S, R>(simd, &stencils.weight[2], lane);
        let lever = along_z::<S, R>(simd, &stencils.lever[2], lane);
        let mut plain = self.slope[2].of_lane(simd, lane).times(lever);
        if CONSTANT {
            plain = self.constant.of_lane(simd, lane).times_plus(weight, plain);
        }
        let along_x = self.slope[0].of_lane(simd, lane).times(weight);
        let along_y = self.slope[1].of_lane(simd, lane).times(weight);
        let wx = each::<S, R>(simd, &stencils.weight[0], lane);
        let lx = each::<S, R>(simd, &stencils.lever[0], lane);
        let wy = each::<S, R>(simd, &stencils.weight[1], lane);
        let ly = each::<S, R>(simd, &stencils.lever[1], lane);
        for b in 0..WIDTH {
            let column = along_y.scaled_plus(ly[b], plain.scaled(wy[b]));
            let levered = along_x.scaled(wy[b]);
            for a in 0..WIDTH {
                rows[a][b] = levered.scaled_plus(lx[a], column.scaled_plus(wx[a], rows[a][b]));
            }
        }
    }
}

#[cfg(test)]
mod tests;
