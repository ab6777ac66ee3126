//! Numbers of the nodes in reach of a block's points.

use super::StencilRows;
use crate::grid::{TILE, TILE_NODES, in_tile};
use crate::kernel::WIDTH;
use crate::mpm::lanes::{MOST_LANES, NODE_NUMBERS, ROW, Real, Row};
use crate::mpm::stencil::weights;
use fearless_simd::prelude::*;

/// Four numbers of each node in reach of one block's points, and room for a row that starts at
/// the last node, to a multiple of the lanes of a vector.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Tile<R>(pub [R; TILE_NUMBERS]);

/// Numbers of a tile.
const TILE_NUMBERS: usize = NODE_NUMBERS * (TILE_NODES + 4).next_multiple_of(MOST_LANES);
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

    /// The nine rows of the stencil with this lowest node.
    #[inline(always)]
    pub(super) fn rows<S: Simd>(&self, simd: S, base: u32) -> StencilRows<S, R> {
        let reach = &self.0[NODE_NUMBERS * base as usize..][..REACH];
        let mut rows = [[R::Row::<S>::zero(simd); WIDTH]; WIDTH];
        for a in 0..WIDTH {
            for b in 0..WIDTH {
                rows[a][b] = R::Row::load(simd, &reach[row_at(a, b)..][..ROW]);
            }
        }
        rows
    }

    /// Adds to the nine rows of the stencil with this lowest node.
    #[inline(always)]
    pub(super) fn add_rows<S: Simd>(&mut self, simd: S, base: u32, rows: &StencilRows<S, R>) {
        let reach = &mut self.0[NODE_NUMBERS * base as usize..][..REACH];
        for a in 0..WIDTH {
            for b in 0..WIDTH {
                let row = &mut reach[row_at(a, b)..][..ROW];
                R::Row::<S>::load(simd, row).plus(rows[a][b]).store(row);
            }
        }
    }
}

const fn row_at(a: usize, b: usize) -> usize {
    NODE_NUMBERS * (a * TILE + b) * TILE
}
