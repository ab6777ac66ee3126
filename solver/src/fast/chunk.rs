//! Chunks: sixteen points side by side, the unit of computation of the fast path.

use serde::{Deserialize, Serialize};

/// Points of a chunk.
pub const LANES: usize = 16;

/// One number of each of a chunk's points.
pub type Lanes = [f32; LANES];

/// Sixteen points, stored value by value. Lanes beyond the block's last point hold
/// [`Packed::NONE`]: they have no mass and no stress, and stay where they are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[repr(C, align(64))]
pub struct Chunk {
    /// Position from the block's first node [cells], 0.5 … 4.5 after a rebin.
    pub position: [Lanes; 3],
    /// Velocity [m/s].
    pub velocity: [Lanes; 3],
    /// Between steps the affine velocity C [1/s], within a step the deformation
    /// since the transfer less one, F̂ − 1; column by column.
    pub gradient: [[Lanes; 3]; 3],
    /// Deviator of the Cauchy stress, xx yy zz xy xz yz [Pa].
    pub deviator: [Lanes; 6],
    /// V ρ_c/m − 1 at the transfer: how much larger a point's volume is than
    /// with the grains just touching. Small, so that the pressure keeps all
    /// digits.
    pub volumetric_strain: Lanes,
    /// Mass [kg].
    pub mass: Lanes,
    /// Identity, constant over the run.
    pub id: [u32; LANES],
    /// Smoothed part of a point's effective strain rate within a step, as the deviator [1/s].
    #[serde(skip)]
    pub shared: [Lanes; 6],
}

/// One point of a chunk, as it migrates between blocks; fields as in [`Chunk`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Packed {
    /// See [`Chunk::position`].
    pub position: [f32; 3],
    /// See [`Chunk::velocity`].
    pub velocity: [f32; 3],
    /// See [`Chunk::gradient`].
    pub gradient: [[f32; 3]; 3],
    /// See [`Chunk::deviator`].
    pub deviator: [f32; 6],
    /// See [`Chunk::volumetric_strain`].
    pub volumetric_strain: f32,
    /// See [`Chunk::mass`].
    pub mass: f32,
    /// See [`Chunk::id`].
    pub id: u32,
}

impl Packed {
    /// No point.
    pub const NONE: Self = Self {
        position: [2.5; 3],
        velocity: [0.0; 3],
        gradient: [[0.0; 3]; 3],
        deviator: [0.0; 6],
        volumetric_strain: 0.0,
        mass: 0.0,
        id: 0,
    };
}

impl Chunk {
    /// No points.
    pub const EMPTY: Self = Self {
        position: [[Packed::NONE.position[0]; LANES]; 3],
        velocity: [[0.0; LANES]; 3],
        gradient: [[[0.0; LANES]; 3]; 3],
        deviator: [[0.0; LANES]; 6],
        volumetric_strain: [0.0; LANES],
        mass: [0.0; LANES],
        id: [0; LANES],
        shared: [[0.0; LANES]; 6],
    };

    /// The point in a lane.
    pub fn get(&self, lane: usize) -> Packed {
        let [x, y, z] = &self.gradient;
        Packed {
            position: take(&self.position, lane),
            velocity: take(&self.velocity, lane),
            gradient: [take(x, lane), take(y, lane), take(z, lane)],
            deviator: take(&self.deviator, lane),
            volumetric_strain: self.volumetric_strain[lane],
            mass: self.mass[lane],
            id: self.id[lane],
        }
    }

    /// Puts a point into a lane.
    pub fn set(&mut self, lane: usize, point: &Packed) {
        put(&mut self.position, lane, &point.position);
        put(&mut self.velocity, lane, &point.velocity);
        for (of, column) in self.gradient.iter_mut().zip(&point.gradient) {
            put(of, lane, column);
        }
        put(&mut self.deviator, lane, &point.deviator);
        self.volumetric_strain[lane] = point.volumetric_strain;
        self.mass[lane] = point.mass;
        self.id[lane] = point.id;
    }
}

/// A point's numbers from a lane.
pub fn take<const N: usize>(lanes: &[Lanes; N], lane: usize) -> [f32; N] {
    let mut values = [0.0; N];
    for (value, of) in values.iter_mut().zip(lanes) {
        *value = of[lane];
    }
    values
}

/// Puts a point's numbers into a lane.
pub fn put<const N: usize>(lanes: &mut [Lanes; N], lane: usize, values: &[f32; N]) {
    for (of, value) in lanes.iter_mut().zip(values) {
        of[lane] = *value;
    }
}
