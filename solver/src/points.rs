//! The material points: the state of the flow (docs/method.md, equations 2 and 11).

use crate::grid::{BlockKey, block_of};
use crate::kernel::Lattice;
use crate::material::Material;
use crate::math::{Mat3, Sym3, Vec3, inverted};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A material point between two steps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Identity, constant over the run.
    pub id: u32,
    /// Mass [kg].
    pub mass: f64,
    /// Volume [m³].
    pub volume: f64,
    /// Position [m].
    pub position: Vec3,
    /// Velocity [m/s].
    pub velocity: Vec3,
    /// Affine velocity about the position, C [1/s].
    pub affine: Mat3,
    /// Cauchy stress, tension positive [Pa].
    pub stress: Sym3,
}

impl Point {
    /// ρ = m/V [kg/m³].
    pub fn density(&self) -> f64 {
        self.mass / self.volume
    }

    /// Angular momentum about the origin, the affine motion included [kg m²/s];
    /// `kernel_moment` is h²/4 per axis [m²].
    pub fn angular_momentum(&self, kernel_moment: &Vec3) -> Vec3 {
        self.mass * (self.position.cross(&self.velocity) + self.spin(kernel_moment))
    }

    /// Angular momentum of the affine motion per mass, Σ_a (h_a²/4) e_a × C e_a.
    fn spin(&self, kernel_moment: &Vec3) -> Vec3 {
        let b = self.affine * Mat3::from_diagonal(kernel_moment);
        Vec3::new(b.m32 - b.m23, b.m13 - b.m31, b.m21 - b.m12)
    }

    /// Kinetic energy, the affine motion included [J].
    pub fn kinetic_energy(&self, kernel_moment: &Vec3) -> f64 {
        let affine: f64 = (0..3)
            .map(|axis| kernel_moment[axis] * self.affine.column(axis).norm_squared())
            .sum();
        0.5 * self.mass * (self.velocity.norm_squared() + affine)
    }

    /// Elastic energy p²V/2K + s:s V/4G [J].
    pub fn elastic_energy(&self, material: &Material) -> f64 {
        let pressure = -self.stress.trace() / 3.0;
        let shear = self.stress.deviator().equivalent_shear();
        0.5 * self.volume
            * (pressure * pressure / material.bulk_modulus + shear * shear / material.shear_modulus)
    }

    /// Name of the first non-finite quantity, if any.
    pub fn non_finite(&self) -> Option<&'static str> {
        let finite = [
            ("position", self.position.sum().is_finite()),
            ("velocity", self.velocity.sum().is_finite()),
            ("affine velocity", self.affine.sum().is_finite()),
            ("volume", self.volume.is_finite() && self.volume > 0.0),
            ("stress", self.stress.is_finite()),
        ];
        finite
            .into_iter()
            .find_map(|(name, finite)| (!finite).then_some(name))
    }
}

/// A point's state within one step, while the weights stay constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deformation {
    /// Deformation since the transfer, F̂.
    pub gradient: Mat3,
    /// Its inverse; NaN once the point has turned inside out, which ends the run.
    pub inverse: Mat3,
    /// Volume over that at the transfer, det F̂.
    pub volume_ratio: f64,
    /// Velocity gradient with respect to the present positions, L [1/s].
    pub velocity_gradient: Mat3,
    /// Volume at the transfer [m³].
    pub transfer_volume: f64,
    /// Smoothed part of the effective strain rate [1/s], a deviator.
    pub shared: Sym3,
}

impl Deformation {
    /// State at a transfer.
    pub fn start(point: &Point) -> Self {
        Self {
            gradient: Mat3::identity(),
            inverse: Mat3::identity(),
            volume_ratio: 1.0,
            velocity_gradient: Mat3::zeros(),
            transfer_volume: point.volume,
            shared: Sym3::default(),
        }
    }

    /// min(1, det F̂) F̂⁻¹: the inverse, except for a point that has been compressed: its kernel
    /// keeps its size, and would carry a steeper gradient as far as before.
    pub fn inverse_at_most(&self) -> Mat3 {
        self.inverse * self.volume_ratio.min(1.0)
    }

    /// F̂ ← F̂ + Δt Σ v_i ⊗ ∇w_i, with the velocity gradient L = (Σ v_i ⊗ ∇w_i) F̂⁻¹.
    pub fn advance(&mut self, gradient_at_transfer: &Mat3, dt: f64) {
        self.velocity_gradient = gradient_at_transfer * self.inverse;
        self.gradient += gradient_at_transfer * dt;
        let (determinant, inverse) = inverted(&self.gradient);
        self.volume_ratio = determinant;
        self.inverse = if determinant > 0.0 { inverse } else { INVALID };
    }
}

const INVALID: Mat3 = {
    const N: f64 = f64::NAN;
    Mat3::new(N, N, N, N, N, N, N, N, N)
};

/// Volume V = V_transfer det F̂ and stress of every point after a sub-step, on
/// cells of this size [m].
pub fn update_stress(
    points: &mut [Point],
    deformations: &[Deformation],
    material: &Material,
    cell_size: f64,
    dt: f64,
) {
    let bulk_viscosity = material.bulk_viscosity(cell_size);
    points
        .par_iter_mut()
        .zip(deformations)
        .for_each(|(point, deformation)| {
            point.volume = deformation.transfer_volume * deformation.volume_ratio;
            point.stress = material.stress(
                &point.stress,
                &(deformation.velocity_gradient + deformation.shared.matrix()),
                point.density(),
                bulk_viscosity,
                dt,
            );
        });
}

/// Re-sorts the points by block (their order within a block is kept) and returns the occupied
/// blocks.
pub fn sort_by_block(points: &mut Vec<Point>, lattice: &Lattice) -> Vec<(BlockKey, Range<usize>)> {
    let mut order: Vec<(BlockKey, u32)> = points
        .iter()
        .zip(0u32..)
        .map(|(point, place)| (block_of(lattice.base(&point.position)), place))
        .collect();
    // Stable, so that the order depends on the state alone; nearly sorted, so that it costs
    // little.
    order.sort_by_key(|(key, _)| *key);
    if order.iter().zip(0u32..).any(|((_, from), to)| *from != to) {
        *points = order
            .iter()
            .map(|(_, from)| points[*from as usize])
            .collect();
    }
    let mut occupied: Vec<(BlockKey, Range<usize>)> = Vec::new();
    for (place, (key, _)) in order.iter().enumerate() {
        match occupied.last_mut() {
            Some((last, range)) if last == key => range.end = place + 1,
            _ => occupied.push((*key, place..place + 1)),
        }
    }
    occupied
}
