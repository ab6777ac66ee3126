//! Double precision: eight points side by side.

use super::{ROW, Real, Row};
use fearless_simd::{f64x4, f64x8, mask64x8, prelude::*, u64x8};

impl Real for f64 {
    const LANES: usize = 8;
    const ZERO: Self = 0.0;
    const ZEROS: [Self; 8] = [0.0; 8];
    const NO_IDS: [u32; 8] = [0; 8];
    const SMALLEST: f64 = Self::MIN_POSITIVE;
    const NO_SUMS: [f64; 8] = [0.0; 8];

    type Lanes = [Self; 8];
    type Ids = [u32; 8];
    type Sums = [f64; 8];
    type Vector<S: Simd> = f64x8<S>;
    type Quad<S: Simd> = f64x4<S>;
    type TwoNodes<S: Simd> = f64x8<S>;
    type Row<S: Simd> = DoubleRow<S>;

    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn indices<S: Simd>(values: f64x8<S>) -> [u32; 8] {
        let whole: u64x8<S> = values.to_int();
        let whole: [u64; 8] = whole.into();
        let mut indices = [0; 8];
        for (index, whole) in indices.iter_mut().zip(whole) {
            *index = whole as u32;
        }
        indices
    }

    scalar_functions!();
}

/// Row in double precision, two vectors.
#[derive(Clone, Copy)]
pub struct DoubleRow<S: Simd>([f64x8<S>; 2]);

impl<S: Simd> Row<S, f64> for DoubleRow<S> {
    #[inline(always)]
    fn zero(simd: S) -> Self {
        Self([f64x8::splat(simd, 0.0); 2])
    }

    #[inline(always)]
    fn load(simd: S, numbers: &[f64]) -> Self {
        let (low, high) = numbers.split_at(ROW / 2);
        Self([f64x8::from_slice(simd, low), f64x8::from_slice(simd, high)])
    }

    #[inline(always)]
    fn store(self, numbers: &mut [f64]) {
        let (low, high) = numbers.split_at_mut(ROW / 2);
        self.0[0].store_slice(low);
        self.0[1].store_slice(high);
    }

    #[inline(always)]
    fn repeated(quad: f64x4<S>) -> Self {
        Self([quad.combine(quad); 2])
    }

    #[inline(always)]
    fn along_z(simd: S, [first, second, third]: [f64; 3]) -> Self {
        let upper = mask64x8::from_bitmask(simd, 0xf0);
        Self([
            upper.select(f64x8::splat(simd, second), f64x8::splat(simd, first)),
            upper.select(f64x8::splat(simd, 0.0), f64x8::splat(simd, third)),
        ])
    }

    #[inline(always)]
    fn places(simd: S) -> Self {
        let number = |place| f64x4::splat(simd, place);
        Self([
            number(-1.0).combine(number(0.0)),
            number(1.0).combine(number(2.0)),
        ])
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self([self.0[0] - other.0[0], self.0[1] - other.0[1]])
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self([self.0[0] + other.0[0], self.0[1] + other.0[1]])
    }

    #[inline(always)]
    fn scaled(self, factor: f64x8<S>) -> Self {
        Self([self.0[0] * factor, self.0[1] * factor])
    }

    #[inline(always)]
    fn scaled_plus(self, factor: f64x8<S>, other: Self) -> Self {
        Self([
            self.0[0].mul_add(factor, other.0[0]),
            self.0[1].mul_add(factor, other.0[1]),
        ])
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        Self([self.0[0] * other.0[0], self.0[1] * other.0[1]])
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, other: Self) -> Self {
        Self([
            self.0[0].mul_add(factor.0[0], other.0[0]),
            self.0[1].mul_add(factor.0[1], other.0[1]),
        ])
    }

    #[inline(always)]
    fn nodes(self) -> [f64x4<S>; 3] {
        let (first, second) = self.0[0].split();
        [first, second, self.0[1].split().0]
    }
}
