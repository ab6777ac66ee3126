//! Sums over the 27 nodes of points, row by row.
//!
//! Three nodes along z with four numbers each, and a fourth node of weight zero, form a row of
//! sixteen numbers. A stencil has nine rows; points of one cell have the same nine, which then
//! stay in registers.

use super::chunk::LANES;
use super::stencil::{Stencils, weights};
use crate::grid::{TILE, TILE_NODES, in_tile};
use crate::kernel::WIDTH;
use fearless_simd::{f32x4, f32x16, mask32x16, prelude::*};

/// Four numbers of each node in the stencils of one block's points, and room for a row that
/// starts at the last node.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Tile(pub [f32; Tile::LENGTH]);

/// Four numbers for each of sixteen points.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Quads(pub [f32; 4 * LANES]);

/// Floats of a row.
const ROW: usize = 16;
/// Floats from the lowest node of a stencil to the end of its last row.
const REACH: usize = 4 * in_tile(WIDTH - 1, WIDTH - 1, 0) + ROW;

impl Tile {
    const LENGTH: usize = 4 * (TILE_NODES + 4);
    /// All zero.
    pub const EMPTY: Self = Self([0.0; Self::LENGTH]);

    /// The four numbers of a node.
    pub fn node_mut(&mut self, place: usize) -> &mut [f32] {
        &mut self.0[4 * place..4 * place + 4]
    }

    /// Adds a force [N] at a place in the block of the tile.
    pub fn push_at(&mut self, position: &[f32; 3], force: &[f32; 3]) {
        let (base, weight) = weights(position);
        for a in 0..WIDTH {
            for b in 0..WIDTH {
                for c in 0..WIDTH {
                    let w = weight[0][a] * weight[1][b] * weight[2][c];
                    let node = self.node_mut(in_tile(base[0] + a, base[1] + b, base[2] + c));
                    for (sum, part) in node[1..].iter_mut().zip(force) {
                        *sum += w * part;
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn reach(&self, base: u32) -> &[f32] {
        &self.0[4 * base as usize..][..REACH]
    }

    #[inline(always)]
    fn reach_mut(&mut self, base: u32) -> &mut [f32] {
        &mut self.0[4 * base as usize..][..REACH]
    }
}

impl Quads {
    /// All zero.
    pub const EMPTY: Self = Self([0.0; 4 * LANES]);

    #[inline(always)]
    fn of_lane<S: Simd>(&self, simd: S, lane: usize) -> f32x16<S> {
        f32x16::block_splat(f32x4::from_slice(simd, &self.0[4 * lane..4 * lane + 4]))
    }

    #[inline(always)]
    fn set_lane<S: Simd>(&mut self, lane: usize, value: f32x4<S>) {
        value.store_slice(&mut self.0[4 * lane..4 * lane + 4]);
    }

    /// The four numbers, each of all sixteen points.
    #[inline(always)]
    pub fn spread<S: Simd>(&self, simd: S) -> [f32x16<S>; 4] {
        let mut parts = [f32x16::splat(simd, 0.0); 4];
        for (part, values) in parts.iter_mut().zip(self.0.chunks_exact(LANES)) {
            *part = f32x16::from_slice(simd, values);
        }
        let [a, b, c, d] = parts;
        let (even_low, odd_low) = a.deinterleave(b);
        let (even_high, odd_high) = c.deinterleave(d);
        let (first, third) = even_low.deinterleave(even_high);
        let (second, fourth) = odd_low.deinterleave(odd_high);
        [first, second, third, fourth]
    }

    /// Sets the four numbers, each of all sixteen points.
    #[inline(always)]
    pub fn gathered<S: Simd>(&mut self, [first, second, third, fourth]: [f32x16<S>; 4]) {
        let (even_low, even_high) = first.interleave(third);
        let (odd_low, odd_high) = second.interleave(fourth);
        let (a, b) = even_low.interleave(odd_low);
        let (c, d) = even_high.interleave(odd_high);
        for (part, values) in self.0.chunks_exact_mut(LANES).zip([a, b, c, d]) {
            values.store_slice(part);
        }
    }
}

const fn row_at(a: usize, b: usize) -> usize {
    4 * (a * TILE + b) * TILE
}

type Rows<S> = [[f32x16<S>; WIDTH]; WIDTH];

/// Weights along z, repeated over a row.
struct AlongZ<S: Simd> {
    second: mask32x16<S>,
    third: mask32x16<S>,
    beyond: mask32x16<S>,
}

impl<S: Simd> AlongZ<S> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        Self {
            second: mask32x16::from_bitmask(simd, 0x00f0),
            third: mask32x16::from_bitmask(simd, 0x0f00),
            beyond: mask32x16::from_bitmask(simd, 0xf000),
        }
    }

    /// The three numbers of one lane, each four times, and four zeros.
    #[inline(always)]
    fn spread(&self, simd: S, values: &[[f32; LANES]; WIDTH], lane: usize) -> f32x16<S> {
        let [first, second, third] = each(simd, values, lane);
        let lower = self.second.select(second, first);
        let upper = self.third.select(third, lower);
        self.beyond.select(f32x16::splat(simd, 0.0), upper)
    }
}

/// The three numbers of one lane, each sixteen times.
#[inline(always)]
fn each<S: Simd>(simd: S, values: &[[f32; LANES]; WIDTH], lane: usize) -> [f32x16<S>; WIDTH] {
    [
        f32x16::splat(simd, values[0][lane]),
        f32x16::splat(simd, values[1][lane]),
        f32x16::splat(simd, values[2][lane]),
    ]
}

/// Weighted sum of three rows.
#[inline(always)]
fn weighted<S: Simd>(rows: &[f32x16<S>; WIDTH], weight: &[f32x16<S>; WIDTH]) -> f32x16<S> {
    let sum = rows[1].mul_add(weight[1], rows[0] * weight[0]);
    rows[2].mul_add(weight[2], sum)
}

/// Weighted sums of three rows each.
#[inline(always)]
fn weighted_each<S: Simd>(rows: &Rows<S>, weight: &[f32x16<S>; WIDTH]) -> [f32x16<S>; WIDTH] {
    [
        weighted(&rows[0], weight),
        weighted(&rows[1], weight),
        weighted(&rows[2], weight),
    ]
}

/// Sums the four nodes of a row.
#[inline(always)]
fn over_nodes<S: Simd>(row: f32x16<S>) -> f32x4<S> {
    let (low, high) = row.split();
    let (even, odd) = (low + high).split();
    even + odd
}

/// Σ w q and Σ w q δ of a nodal quantity q of four numbers, for sixteen points;
/// zero in lanes without a point.
pub struct Moments {
    /// Σ w q.
    pub zeroth: Quads,
    /// Σ w q δ along x, y and z [cells].
    pub first: [Quads; 3],
}

impl Moments {
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
        stencils: &Stencils,
        count: usize,
        tile: &Tile,
    ) {
        let along_z = AlongZ::new(simd);
        let mut lane = 0;
        while lane < count {
            let rows = loaded(simd, tile, stencils.base[lane]);
            let end = lane + stencils.run(lane, count);
            for lane in lane..end {
                self.gather_point::<S, ZEROTH>(simd, stencils, lane, &rows, &along_z);
            }
            lane = end;
        }
        for lane in count..LANES {
            for first in &mut self.first {
                first.set_lane(lane, f32x4::splat(simd, 0.0));
            }
            if ZEROTH {
                self.zeroth.set_lane(lane, f32x4::splat(simd, 0.0));
            }
        }
    }

    #[inline(always)]
    fn gather_point<S: Simd, const ZEROTH: bool>(
        &mut self,
        simd: S,
        stencils: &Stencils,
        lane: usize,
        rows: &Rows<S>,
        along_z: &AlongZ<S>,
    ) {
        let (wx, lx) = (
            each(simd, &stencils.weight[0], lane),
            each(simd, &stencils.lever[0], lane),
        );
        let plain = weighted_each(rows, &each(simd, &stencils.weight[1], lane));
        let levered = weighted_each(rows, &each(simd, &stencils.lever[1], lane));
        let weight = along_z.spread(simd, &stencils.weight[2], lane);
        let lever = along_z.spread(simd, &stencils.lever[2], lane);
        let sum = weighted(&plain, &wx);
        self.first[0].set_lane(lane, over_nodes(weighted(&plain, &lx) * weight));
        self.first[1].set_lane(lane, over_nodes(weighted(&levered, &wx) * weight));
        self.first[2].set_lane(lane, over_nodes(sum * lever));
        if ZEROTH {
            self.zeroth.set_lane(lane, over_nodes(sum * weight));
        }
    }
}

/// Σ w q of a nodal quantity of four numbers, for the first `count` points.
#[inline(always)]
pub fn gather_mean<S: Simd>(
    simd: S,
    stencils: &Stencils,
    count: usize,
    tile: &Tile,
    mean: &mut Quads,
) {
    let along_z = AlongZ::new(simd);
    let mut lane = 0;
    while lane < count {
        let rows = loaded(simd, tile, stencils.base[lane]);
        let end = lane + stencils.run(lane, count);
        for lane in lane..end {
            let over_y = weighted_each(&rows, &each(simd, &stencils.weight[1], lane));
            let sum = weighted(&over_y, &each(simd, &stencils.weight[0], lane));
            let weight = along_z.spread(simd, &stencils.weight[2], lane);
            mean.set_lane(lane, over_nodes(sum * weight));
        }
        lane = end;
    }
    for lane in count..LANES {
        mean.set_lane(lane, f32x4::splat(simd, 0.0));
    }
}

/// Adds w q of a quantity of four numbers of the first `count` points to a tile.
#[inline(always)]
pub fn scatter_mean<S: Simd>(
    simd: S,
    stencils: &Stencils,
    count: usize,
    given: &Quads,
    tile: &mut Tile,
) {
    let along_z = AlongZ::new(simd);
    let mut lane = 0;
    while lane < count {
        let end = lane + stencils.run(lane, count);
        let mut rows = [[f32x16::splat(simd, 0.0); WIDTH]; WIDTH];
        for lane in lane..end {
            let weight = along_z.spread(simd, &stencils.weight[2], lane);
            let row = given.of_lane(simd, lane) * weight;
            let wx = each(simd, &stencils.weight[0], lane);
            let wy = each(simd, &stencils.weight[1], lane);
            for b in 0..WIDTH {
                let column = row * wy[b];
                for a in 0..WIDTH {
                    rows[a][b] = column.mul_add(wx[a], rows[a][b]);
                }
            }
        }
        add_rows(simd, &rows, tile.reach_mut(stencils.base[lane]));
        lane = end;
    }
}

#[inline(always)]
fn add_rows<S: Simd>(simd: S, rows: &Rows<S>, reach: &mut [f32]) {
    for a in 0..WIDTH {
        for b in 0..WIDTH {
            let row = &mut reach[row_at(a, b)..][..ROW];
            let sum = f32x16::from_slice(simd, row) + rows[a][b];
            sum.store_slice(row);
        }
    }
}

#[inline(always)]
fn loaded<S: Simd>(simd: S, tile: &Tile, base: u32) -> Rows<S> {
    let reach = tile.reach(base);
    let mut rows = [[f32x16::splat(simd, 0.0); WIDTH]; WIDTH];
    for a in 0..WIDTH {
        for b in 0..WIDTH {
            rows[a][b] = f32x16::from_slice(simd, &reach[row_at(a, b)..][..ROW]);
        }
    }
    rows
}

/// Contributions of sixteen points to their nodes: constant + Σ slope δ, weighted.
pub struct Given {
    /// Independent of the node.
    pub constant: Quads,
    /// Per cell along x, y and z.
    pub slope: [Quads; 3],
}

impl Given {
    /// All zero.
    pub const NOTHING: Self = Self {
        constant: Quads::EMPTY,
        slope: [Quads::EMPTY; 3],
    };

    /// Adds the contributions of the first `count` points to a tile; without `CONSTANT` the slopes
    /// only.
    #[inline(always)]
    pub fn scatter<S: Simd, const CONSTANT: bool>(
        &self,
        simd: S,
        stencils: &Stencils,
        count: usize,
        tile: &mut Tile,
    ) {
        let along_z = AlongZ::new(simd);
        let mut lane = 0;
        while lane < count {
            let end = lane + stencils.run(lane, count);
            let mut rows = [[f32x16::splat(simd, 0.0); WIDTH]; WIDTH];
            for lane in lane..end {
                self.scatter_point::<S, CONSTANT>(simd, stencils, lane, &mut rows, &along_z);
            }
            add_rows(simd, &rows, tile.reach_mut(stencils.base[lane]));
            lane = end;
        }
    }

    #[inline(always)]
    fn scatter_point<S: Simd, const CONSTANT: bool>(
        &self,
        simd: S,
        stencils: &Stencils,
        lane: usize,
        rows: &mut Rows<S>,
        along_z: &AlongZ<S>,
    ) {
        let weight = along_z.spread(simd, &stencils.weight[2], lane);
        let lever = along_z.spread(simd, &stencils.lever[2], lane);
        let mut plain = self.slope[2].of_lane(simd, lane) * lever;
        if CONSTANT {
            plain = self.constant.of_lane(simd, lane).mul_add(weight, plain);
        }
        let along_x = self.slope[0].of_lane(simd, lane) * weight;
        let along_y = self.slope[1].of_lane(simd, lane) * weight;
        let (wx, lx) = (
            each(simd, &stencils.weight[0], lane),
            each(simd, &stencils.lever[0], lane),
        );
        let (wy, ly) = (
            each(simd, &stencils.weight[1], lane),
            each(simd, &stencils.lever[1], lane),
        );
        for b in 0..WIDTH {
            let column = along_y.mul_add(ly[b], plain * wy[b]);
            let levered = along_x * wy[b];
            for a in 0..WIDTH {
                rows[a][b] = levered.mul_add(lx[a], column.mul_add(wx[a], rows[a][b]));
            }
        }
    }
}

#[cfg(test)]
mod tests;
