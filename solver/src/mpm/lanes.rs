//! Precisions of the flow, and the vectors that its kernels compute with: one text of every
//! formula serves sixteen points side by side in single precision and eight in double.

use fearless_simd::prelude::*;
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

    /// Row of which each node has its place from the middle one of a stencil, four times.
    fn places(simd: S) -> Self;

    /// Sum of two rows.
    fn plus(self, other: Self) -> Self;

    /// Difference of two rows.
    fn minus(self, other: Self) -> Self;

    /// The row times a factor, the same in every lane.
    fn scaled(self, factor: R::Vector<S>) -> Self;

    /// The row times a factor, the same in every lane, plus another row.
    fn scaled_plus(self, factor: R::Vector<S>, other: Self) -> Self;

    /// Product of two rows, number by number.
    fn times(self, other: Self) -> Self;

    /// Product of two rows, number by number, plus a third.
    fn times_plus(self, factor: Self, other: Self) -> Self;

    /// The three nodes of a stencil.
    fn nodes(self) -> [R::Quad<S>; 3];
}

/// A 3 × 3 matrix of each point of a chunk, `[row][column]`.
pub type Matrix<S, R> = [[<R as Real>::Vector<S>; 3]; 3];

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

mod double;
mod single;
