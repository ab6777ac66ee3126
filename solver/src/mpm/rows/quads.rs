//! Four numbers of each point of a chunk, from point by point to number by number and back.

use crate::mpm::lanes::{MOST_LANES, NODE_NUMBERS, Real, Row, Splat};
use fearless_simd::prelude::*;

/// Four numbers of each point of a chunk, point by point.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Quads<R>(pub [R; NODE_NUMBERS * MOST_LANES]);

impl<R: Real> Quads<R> {
    /// All zero.
    pub const EMPTY: Self = Self([R::ZERO; NODE_NUMBERS * MOST_LANES]);

    /// Row of which every node has the numbers of a point.
    #[inline(always)]
    pub(super) fn of_lane<S: Simd>(&self, simd: S, lane: usize) -> R::Row<S> {
        let numbers = &self.0[NODE_NUMBERS * lane..][..NODE_NUMBERS];
        R::Row::repeated(R::Quad::<S>::from_slice(simd, numbers))
    }

    /// Sets the numbers of a point.
    #[inline(always)]
    pub(super) fn set_lane<S: Simd>(&mut self, lane: usize, value: R::Quad<S>) {
        value.store_slice(&mut self.0[NODE_NUMBERS * lane..][..NODE_NUMBERS]);
    }

    /// Sets the numbers from a lane on to zero.
    #[inline(always)]
    pub(super) fn clear_from<S: Simd>(&mut self, simd: S, lane: usize) {
        for lane in lane..R::LANES {
            self.set_lane::<S>(lane, R::Quad::<S>::simd_from(simd, R::ZERO));
        }
    }

    /// The four numbers, each of all points.
    #[inline(always)]
    pub fn transposed<S: Simd>(&self, simd: S) -> [R::Vector<S>; 4] {
        transposed::<S, R>(simd, &self.0)
    }

    /// Stores the four numbers, each of all points.
    #[inline(always)]
    pub fn set<S: Simd>(&mut self, values: [R::Vector<S>; 4]) {
        store_transposed::<S, R>(values, &mut self.0);
    }
}

/// Four numbers of as many points or nodes as a vector has lanes, each of all.
#[inline(always)]
pub fn transposed<S: Simd, R: Real>(simd: S, numbers: &[R]) -> [R::Vector<S>; 4] {
    let mut parts = [Splat::<S, R>::new(simd).of(0.0); 4];
    for (part, values) in parts.iter_mut().zip(numbers.chunks_exact(R::LANES)) {
        *part = R::Vector::<S>::from_slice(simd, values);
    }
    let [a, b, c, d] = parts;
    let (even_low, odd_low) = a.deinterleave(b);
    let (even_high, odd_high) = c.deinterleave(d);
    let (first, third) = even_low.deinterleave(even_high);
    let (second, fourth) = odd_low.deinterleave(odd_high);
    [first, second, third, fourth]
}

/// Stores four numbers, each of all, one point or node after the other.
#[inline(always)]
pub fn store_transposed<S: Simd, R: Real>(
    [first, second, third, fourth]: [R::Vector<S>; 4],
    numbers: &mut [R],
) {
    let (even_low, even_high) = first.interleave(third);
    let (odd_low, odd_high) = second.interleave(fourth);
    let (a, b) = even_low.interleave(odd_low);
    let (c, d) = even_high.interleave(odd_high);
    for (part, values) in numbers.chunks_exact_mut(R::LANES).zip([a, b, c, d]) {
        values.store_slice(part);
    }
}
