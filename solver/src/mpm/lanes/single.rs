//! Single precision: sixteen points side by side.

use super::{Real, Row};
use fearless_simd::{f32x4, f32x8, f32x16, mask32x16, prelude::*, u32x16};

impl Real for f32 {
    const LANES: usize = 16;
    const ZERO: Self = 0.0;
    const ZEROS: [Self; 16] = [0.0; 16];
    const NO_IDS: [u32; 16] = [0; 16];
    const SMALLEST: f64 = Self::MIN_POSITIVE as f64;
    const NO_SUMS: [f64; 16] = [0.0; 16];

    type Lanes = [Self; 16];
    type Ids = [u32; 16];
    type Sums = [f64; 16];
    type Vector<S: Simd> = f32x16<S>;
    type Quad<S: Simd> = f32x4<S>;
    type TwoNodes<S: Simd> = f32x8<S>;
    type Row<S: Simd> = SingleRow<S>;

    #[inline(always)]
    fn of(value: f64) -> Self {
        value as Self
    }

    #[inline(always)]
    fn indices<S: Simd>(values: f32x16<S>) -> [u32; 16] {
        let whole: u32x16<S> = values.to_int();
        whole.into()
    }

    scalar_functions!();
}

/// Places of the nodes of a row from the middle one of its stencil.
const PLACES: [f32; 16] = [
    -1.0, -1.0, -1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0,
];

/// Row in single precision, one vector.
#[derive(Clone, Copy)]
pub struct SingleRow<S: Simd>(f32x16<S>);

impl<S: Simd> Row<S, f32> for SingleRow<S> {
    #[inline(always)]
    fn zero(simd: S) -> Self {
        Self(f32x16::splat(simd, 0.0))
    }

    #[inline(always)]
    fn load(simd: S, numbers: &[f32]) -> Self {
        Self(f32x16::from_slice(simd, numbers))
    }

    #[inline(always)]
    fn store(self, numbers: &mut [f32]) {
        self.0.store_slice(numbers);
    }

    #[inline(always)]
    fn repeated(quad: f32x4<S>) -> Self {
        Self(f32x16::block_splat(quad))
    }

    #[inline(always)]
    fn along_z(simd: S, [first, second, third]: [f32; 3]) -> Self {
        let [first, second, third] = [
            f32x16::splat(simd, first),
            f32x16::splat(simd, second),
            f32x16::splat(simd, third),
        ];
        let lower = mask32x16::from_bitmask(simd, 0x00f0).select(second, first);
        let upper = mask32x16::from_bitmask(simd, 0x0f00).select(third, lower);
        let beyond = mask32x16::from_bitmask(simd, 0xf000);
        Self(beyond.select(f32x16::splat(simd, 0.0), upper))
    }

    #[inline(always)]
    fn places(simd: S) -> Self {
        Self(f32x16::from_slice(simd, &PLACES))
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }

    #[inline(always)]
    fn scaled(self, factor: f32x16<S>) -> Self {
        Self(self.0 * factor)
    }

    #[inline(always)]
    fn scaled_plus(self, factor: f32x16<S>, other: Self) -> Self {
        Self(self.0.mul_add(factor, other.0))
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, other: Self) -> Self {
        Self(self.0.mul_add(factor.0, other.0))
    }

    #[inline(always)]
    fn nodes(self) -> [f32x4<S>; 3] {
        let (lower, upper) = self.0.split();
        let (first, second) = lower.split();
        [first, second, upper.split().0]
    }
}
