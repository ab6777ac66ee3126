//! Points side by side, the unit that the kernels compute with.

use super::lanes::{Real, Splat, load_each};
use fearless_simd::prelude::*;
use serde::{Deserialize, Serialize};

/// Points of a block side by side, number by number. Lanes beyond the block's last point hold
/// [`Packed::none`]: they have no mass and no stress, and stay where they are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(bound = "")]
#[repr(C, align(64))]
pub struct Chunk<R: Real> {
    /// Position from the block's first node [cells], 0.5 … 4.5 when settled.
    pub position: [R::Lanes; 3],
    /// Velocity [m/s].
    pub velocity: [R::Lanes; 3],
    /// Between steps the affine velocity C [1/s], within a step the deformation
    /// since the transfer less one, F̂ − 1; column by column.
    pub gradient: [[R::Lanes; 3]; 3],
    /// Deviator of the Cauchy stress, xx yy zz xy xz yz [Pa].
    pub deviator: [R::Lanes; 6],
    /// Volumetric strain φ = V ρ_c/m − 1 at the transfer. Small, so that the pressure keeps all
    /// digits.
    pub volumetric_strain: R::Lanes,
    /// Mass [kg].
    pub mass: R::Lanes,
    /// Identity, kept for life.
    pub id: R::Ids,
    /// Strain rate that strain-rate smoothing adds to a point's own within a step, as the
    /// deviator [1/s].
    #[serde(skip, default = "no_strain_rate::<R>")]
    pub smoothing: [R::Lanes; 6],
}

fn no_strain_rate<R: Real>() -> [R::Lanes; 6] {
    [R::ZEROS; 6]
}

/// One point of a chunk, as it migrates between blocks; fields as in [`Chunk`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Packed<R> {
    /// See [`Chunk::position`].
    pub position: [R; 3],
    /// See [`Chunk::velocity`].
    pub velocity: [R; 3],
    /// See [`Chunk::gradient`].
    pub gradient: [[R; 3]; 3],
    /// See [`Chunk::deviator`].
    pub deviator: [R; 6],
    /// See [`Chunk::volumetric_strain`].
    pub volumetric_strain: R,
    /// See [`Chunk::mass`].
    pub mass: R,
    /// See [`Chunk::id`].
    pub id: u32,
}

impl<R: Real> Packed<R> {
    /// No point.
    pub fn none() -> Self {
        Self {
            position: [R::of(2.5); 3],
            velocity: [R::ZERO; 3],
            gradient: [[R::ZERO; 3]; 3],
            deviator: [R::ZERO; 6],
            volumetric_strain: R::ZERO,
            mass: R::ZERO,
            id: 0,
        }
    }
}

impl<R: Real> Chunk<R> {
    /// No points.
    pub fn empty() -> Self {
        let mut chunk = Self {
            position: [R::ZEROS; 3],
            velocity: [R::ZEROS; 3],
            gradient: [[R::ZEROS; 3]; 3],
            deviator: [R::ZEROS; 6],
            volumetric_strain: R::ZEROS,
            mass: R::ZEROS,
            id: R::NO_IDS,
            smoothing: [R::ZEROS; 6],
        };
        for lane in 0..R::LANES {
            chunk.set(lane, &Packed::none());
        }
        chunk
    }

    /// D = sym C of the points between steps: xx yy zz xy xz yz.
    #[inline(always)]
    pub fn strain_rate<S: Simd>(&self, simd: S) -> [R::Vector<S>; 6] {
        let half = Splat::<S, R>::new(simd).of(0.5);
        // Column by column.
        let [x, y, z] = &self.gradient;
        let [xx, yx, zx] = load_each::<S, R, 3>(simd, x);
        let [xy, yy, zy] = load_each::<S, R, 3>(simd, y);
        let [xz, yz, zz] = load_each::<S, R, 3>(simd, z);
        [
            xx,
            yy,
            zz,
            half * (xy + yx),
            half * (xz + zx),
            half * (yz + zy),
        ]
    }

    /// The point in a lane.
    pub fn get(&self, lane: usize) -> Packed<R> {
        let [x, y, z] = &self.gradient;
        Packed {
            position: take::<R, 3>(&self.position, lane),
            velocity: take::<R, 3>(&self.velocity, lane),
            gradient: [
                take::<R, 3>(x, lane),
                take::<R, 3>(y, lane),
                take::<R, 3>(z, lane),
            ],
            deviator: take::<R, 6>(&self.deviator, lane),
            volumetric_strain: self.volumetric_strain[lane],
            mass: self.mass[lane],
            id: self.id[lane],
        }
    }

    /// Puts a point into a lane.
    pub fn set(&mut self, lane: usize, point: &Packed<R>) {
        put::<R, 3>(&mut self.position, lane, &point.position);
        put::<R, 3>(&mut self.velocity, lane, &point.velocity);
        for (of, column) in self.gradient.iter_mut().zip(&point.gradient) {
            put::<R, 3>(of, lane, column);
        }
        put::<R, 6>(&mut self.deviator, lane, &point.deviator);
        self.volumetric_strain[lane] = point.volumetric_strain;
        self.mass[lane] = point.mass;
        self.id[lane] = point.id;
    }
}

/// A point's numbers from a lane.
pub fn take<R: Real, const N: usize>(lanes: &[R::Lanes; N], lane: usize) -> [R; N] {
    let mut values = [R::ZERO; N];
    for (value, of) in values.iter_mut().zip(lanes) {
        *value = of[lane];
    }
    values
}

/// Puts a point's numbers into a lane.
pub fn put<R: Real, const N: usize>(lanes: &mut [R::Lanes; N], lane: usize, values: &[R; N]) {
    for (of, value) in lanes.iter_mut().zip(values) {
        of[lane] = *value;
    }
}
