//! Quantities of points added to the nodes.

use super::StencilRows;
use super::quads::Quads;
use super::tile::Tile;
use crate::kernel::WIDTH;
use crate::mpm::lanes::{Real, Row, Splat, load};
use crate::mpm::stencil::Stencils;
use fearless_simd::prelude::*;

/// Quantities of the points of a chunk that vary linearly about each.
pub struct LinearFields<R> {
    /// Value at the middle node of the stencil.
    middle: Quads<R>,
    /// Slopes along x, y and z [1/cell].
    slope: [Quads<R>; 3],
}

impl<R: Real> LinearFields<R> {
    /// All zero.
    pub const ZERO: Self = Self {
        middle: Quads::EMPTY,
        slope: [Quads::EMPTY; 3],
    };

    /// Sets value at the point and slopes.
    #[inline(always)]
    pub fn set<S: Simd>(
        &mut self,
        simd: S,
        stencils: &Stencils<R>,
        value: &[R::Vector<S>; 4],
        slope: &[[R::Vector<S>; 4]; 3],
    ) {
        let mut middle = *value;
        for axis in 0..3 {
            let offset = load::<S, R>(simd, &stencils.offset[axis]);
            for (middle, slope) in middle.iter_mut().zip(slope[axis]) {
                *middle -= offset * slope;
            }
            self.slope[axis].set::<S>(slope[axis]);
        }
        self.middle.set::<S>(middle);
    }

    /// Adds the fields of the first `count` points to a tile, weighted.
    #[inline(always)]
    pub fn scatter<S: Simd>(
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
                self.scatter_point(simd, stencils, lane, &mut rows);
            }
            tile.add_rows(simd, stencils.base[lane], &rows);
            lane = end;
        }
    }

    #[inline(always)]
    fn scatter_point<S: Simd>(
        &self,
        simd: S,
        stencils: &Stencils<R>,
        lane: usize,
        rows: &mut StencilRows<S, R>,
    ) {
        let weight = along_z::<S, R>(simd, stencils, lane);
        let number = Splat::<S, R>::new(simd);
        let x = self.slope[0].of_lane(simd, lane).times(weight);
        let y = self.slope[1].of_lane(simd, lane).times(weight);
        let z = self.slope[2].of_lane(simd, lane);
        let middle = z.times_plus(R::Row::places(simd), self.middle.of_lane(simd, lane));
        let middle = middle.times(weight);
        let columns = [middle.minus(x), middle, middle.plus(x)];
        for a in 0..WIDTH {
            let values = [columns[a].minus(y), columns[a], columns[a].plus(y)];
            for b in 0..WIDTH {
                let across = number.all(stencils.across[a][b][lane]);
                rows[a][b] = values[b].scaled_plus(across, rows[a][b]);
            }
        }
    }
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
    let number = Splat::<S, R>::new(simd);
    let mut lane = 0;
    while lane < count {
        let end = lane + stencils.run(lane, count);
        let mut rows = [[R::Row::<S>::zero(simd); WIDTH]; WIDTH];
        for lane in lane..end {
            let weight = along_z::<S, R>(simd, stencils, lane);
            let row = quantity.of_lane(simd, lane).times(weight);
            for a in 0..WIDTH {
                for b in 0..WIDTH {
                    let across = number.all(stencils.across[a][b][lane]);
                    rows[a][b] = row.scaled_plus(across, rows[a][b]);
                }
            }
        }
        tile.add_rows(simd, stencils.base[lane], &rows);
        lane = end;
    }
}

/// Weights of a point's nodes along z, each four times.
#[inline(always)]
fn along_z<S: Simd, R: Real>(simd: S, stencils: &Stencils<R>, lane: usize) -> R::Row<S> {
    let [low, middle, high] = &stencils.along;
    R::Row::along_z(simd, [low[lane], middle[lane], high[lane]])
}
