//! Precisions of the flow, and the vectors that its kernels compute with: one text of every
//! formula serves sixteen points side by side in single precision and eight in double.

use fearless_simd::{
    f32x4, f32x8, f32x16, f64x4, f64x8, mask32x16, mask64x8, prelude::*, u32x16, u64x8,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;
use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

/// Nodes of a row along z: three of a stencil, and a fourth of weight zero.
pub const ROW_NODES: usize = 4;
/// Numbers of a node.
pub const NODE_NUMBERS: usize = 4;
/// Numbers of a row.
pub const ROW: usize = ROW_NODES * NODE_NUMBERS;

/// Most points of a chunk, those in single precision.
pub const MOST_LANES: usize = 16;

/// Precision of a flow: f32, or f64.
pub trait Real:
    SimdFloatElement + Serialize + DeserializeOwned + Send + Sync + 'static + Into<f64>
{
    /// Points of a chunk.
    const LANES: usize;
    /// 0.
    const ZERO: Self;
    /// Zero in every lane.
    const ZEROS: Self::Lanes;
    /// No identity in any lane.
    const NO_IDS: Self::Ids;
    /// Least positive number of full precision.
    const SMALLEST: f64;

    /// One number of each point of a chunk.
    type Lanes: Copy
        + Debug
        + PartialEq
        + Send
        + Sync
        + Serialize
        + DeserializeOwned
        + AsRef<[Self]>
        + AsMut<[Self]>
        + Index<usize, Output = Self>
        + IndexMut<usize>;
    /// Identities of the points of a chunk.
    type Ids: Copy
        + Debug
        + PartialEq
        + Send
        + Sync
        + Serialize
        + DeserializeOwned
        + Index<usize, Output = u32>
        + IndexMut<usize>;
    /// Sums in double precision of each lane.
    type Sums: Copy + Index<usize, Output = f64> + IndexMut<usize> + AsRef<[f64]>;
    /// A sum of zero in every lane.
    const NO_SUMS: Self::Sums;

    /// Vector of one number of each point of a chunk.
    type Vector<S: Simd>: SimdFloat<S, Element = Self, Array = Self::Lanes>;
    /// Vector of the four numbers of a node.
    type Quad<S: Simd>: SimdFloat<S, Element = Self>;
    /// Vector of the eight numbers of two nodes.
    type TwoNodes<S: Simd>: SimdFloat<S, Element = Self>;
    /// Vectors of the sixteen numbers of a row.
    type Row<S: Simd>: Row<S, Self>;

    /// Nearest number of this precision.
    fn of(value: f64) -> Self;

    /// Whole numbers of at most 2²⁰, lane by lane.
    fn indices<S: Simd>(values: Self::Vector<S>) -> Self::Ids;

    /// The number in double precision.
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.into()
    }

    /// The larger of two numbers; the other one if one is not a number.
    fn max(self, other: Self) -> Self;

    /// The smaller of two numbers; the other one if one is not a number.
    fn min(self, other: Self) -> Self;

    /// Square root.
    fn sqrt(self) -> Self;

    /// Largest number below this one.
    fn below(self) -> Self;

    /// Largest whole number not above this one.
    fn floor(self) -> Self;

    /// True unless it is infinite or not a number.
    fn is_finite(self) -> bool;
}

/// Sixteen numbers of a row: four nodes along z, four numbers each.
pub trait Row<S: Simd, R: Real>: Copy {
    /// All zero.
    fn zero(simd: S) -> Self;

    /// Row of these [`ROW`] numbers.
    fn load(simd: S, numbers: &[R]) -> Self;

    /// Stores the row into [`ROW`] numbers.
    fn store(self, numbers: &mut [R]);

    /// Row of which every node has the same numbers.
    fn repeated(quad: R::Quad<S>) -> Self;

    /// Row of which each node has one of three numbers four times, the fourth node zeros.
    fn along_z(simd: S, nodes: [R; 3]) -> Self;

    /// Sum of two rows.
    fn plus(self, other: Self) -> Self;

    /// The row times a factor, the same in every lane.
    fn scaled(self, factor: R::Vector<S>) -> Self;

    /// The row times a factor, the same in every lane, plus another row.
    fn scaled_plus(self, factor: R::Vector<S>, other: Self) -> Self;

    /// Product of two rows, number by number.
    fn times(self, other: Self) -> Self;

    /// Product of two rows, number by number, plus a third.
    fn times_plus(self, factor: Self, other: Self) -> Self;

    /// Sum over the four nodes.
    fn sum_of_nodes(self) -> R::Quad<S>;
}

/// Vectors with the same number in every lane. A closure would not be compiled for the
/// instructions of `S`.
#[derive(Clone, Copy)]
pub struct Splat<S: Simd, R: Real> {
    simd: S,
    precision: PhantomData<R>,
}

impl<S: Simd, R: Real> Splat<S, R> {
    /// Vectors of this instruction set.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        Self {
            simd,
            precision: PhantomData,
        }
    }

    /// A number rounded to the precision, in every lane.
    #[inline(always)]
    pub fn of(self, value: f64) -> R::Vector<S> {
        self.all(R::of(value))
    }

    /// A number of the precision in every lane.
    #[inline(always)]
    pub fn all(self, value: R) -> R::Vector<S> {
        R::Vector::<S>::simd_from(self.simd, value)
    }
}

/// Vector of the numbers of a chunk.
#[inline(always)]
pub fn load<S: Simd, R: Real>(simd: S, lanes: &R::Lanes) -> R::Vector<S> {
    R::Vector::<S>::load_array_ref(simd, lanes)
}

/// Vectors of several numbers of a chunk.
#[inline(always)]
pub fn load_each<S: Simd, R: Real, const N: usize>(
    simd: S,
    lanes: &[R::Lanes; N],
) -> [R::Vector<S>; N] {
    let mut loaded = [Splat::<S, R>::new(simd).of(0.0); N];
    for (vector, of) in loaded.iter_mut().zip(lanes) {
        *vector = load::<S, R>(simd, of);
    }
    loaded
}

macro_rules! scalar_functions {
    () => {
        #[inline(always)]
        fn max(self, other: Self) -> Self {
            self.max(other)
        }

        #[inline(always)]
        fn min(self, other: Self) -> Self {
            self.min(other)
        }

        #[inline(always)]
        fn sqrt(self) -> Self {
            self.sqrt()
        }

        fn below(self) -> Self {
            self.next_down()
        }

        fn floor(self) -> Self {
            self.floor()
        }

        fn is_finite(self) -> bool {
            self.is_finite()
        }
    };
}

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
    fn sum_of_nodes(self) -> f32x4<S> {
        let (low, high) = self.0.split();
        let (even, odd) = (low + high).split();
        even + odd
    }
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
    fn sum_of_nodes(self) -> f64x4<S> {
        let (even, odd) = (self.0[0] + self.0[1]).split();
        even + odd
    }
}
