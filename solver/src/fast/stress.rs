//! Deformation and stress of sixteen points at a time: the formulas of
//! `points.rs` and `material.rs` (docs/method.md, equations 2–6 and 11).

use super::chunk::{Chunk, Lanes};
use crate::material::{Material, Yielding};
use crate::math::Vec3;
use fearless_simd::{f32x16, prelude::*};

/// Constants of a granular material for the fast path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law {
    /// 1/ρ_c [m³/kg].
    pub specific_volume: f32,
    bulk_modulus: f32,
    shear_modulus: f32,
    static_friction: f32,
    limiting_friction: f32,
    /// G I0/(d √ρ_s) [Pa^½/s].
    viscosity: f32,
    /// b ρ_c c_P h [Pa s].
    bulk_viscosity: f32,
    /// 4/h per axis [1/m]: ∇w is w δ times this, with δ in cells.
    pub gradient: [f32; 3],
}

/// A 3 × 3 matrix of each of sixteen points, `[row][column]`.
pub type Matrix<S> = [[f32x16<S>; 3]; 3];

impl Law {
    /// Law of a material on a lattice with this spacing [m]. Granular materials only: an elastic
    /// one has no friction.
    pub fn of(material: &Material, spacing: &Vec3) -> Self {
        let (statically, limiting, viscosity) = match material.yielding {
            Yielding::Granular {
                static_friction,
                limiting_friction,
                reference_inertial_number,
                grain_diameter,
                grain_density,
            } => (
                static_friction,
                limiting_friction,
                material.shear_modulus * reference_inertial_number
                    / (grain_diameter * grain_density.sqrt()),
            ),
            Yielding::Never => (f64::MAX, f64::MAX, 0.0),
        };
        Self {
            specific_volume: (1.0 / material.bulk_density) as f32,
            bulk_modulus: material.bulk_modulus as f32,
            shear_modulus: material.shear_modulus as f32,
            static_friction: statically as f32,
            limiting_friction: limiting as f32,
            viscosity: viscosity as f32,
            bulk_viscosity: material.bulk_viscosity(spacing.min()) as f32,
            gradient: [0, 1, 2].map(|axis| (4.0 / spacing[axis]) as f32),
        }
    }

    /// Pressure at a volumetric strain φ, −K φ/(1 + φ) where grains touch (equation 3).
    #[inline(always)]
    fn pressure<S: Simd>(&self, simd: S, volumetric_strain: f32x16<S>) -> f32x16<S> {
        let compression = splat(simd, 0.0) - volumetric_strain;
        let pressure =
            splat(simd, self.bulk_modulus) * compression / (splat(simd, 1.0) + volumetric_strain);
        pressure.max(splat(simd, 0.0))
    }

    /// Pressure including the bulk viscosity (equation 3a).
    #[inline(always)]
    fn resisting<S: Simd>(&self, simd: S, pressure: f32x16<S>, gradient: &Matrix<S>) -> f32x16<S> {
        let none = splat(simd, 0.0);
        let growth = gradient[0][0] + gradient[1][1] + gradient[2][2];
        let resisting = growth.mul_add(splat(simd, -self.bulk_viscosity), pressure);
        let pressed = pressure.simd_gt(none);
        pressed.select(resisting.max(none), pressure)
    }

    /// Deviator after `dt` of the velocity gradient `gradient`, at the new volumetric strain
    /// (equations 4–6).
    #[inline(always)]
    fn deviator<S: Simd>(
        &self,
        simd: S,
        deviator: [f32x16<S>; 6],
        gradient: &Matrix<S>,
        pressure: f32x16<S>,
        dt: f32,
    ) -> [f32x16<S>; 6] {
        let trial = self.trial(simd, deviator, gradient, dt);
        let [xx, yy, zz, xy, xz, yz] = trial;
        let diagonal = xx.mul_add(xx, yy.mul_add(yy, zz * zz));
        let off_diagonal = xy.mul_add(xy, xz.mul_add(xz, yz * yz));
        let trial_shear = splat(simd, 0.5).mul_add(diagonal, off_diagonal).sqrt();
        let at_rest = splat(simd, self.static_friction) * pressure;
        let limit = splat(simd, self.limiting_friction) * pressure;
        let viscous = splat(simd, self.viscosity * dt) * pressure.sqrt();
        let b = limit + trial_shear + viscous;
        // H/B instead of H: squares of stresses may not fit into single precision.
        let per_b = splat(simd, 1.0) / b;
        let ratio = limit.mul_add(trial_shear * per_b, at_rest * (viscous * per_b));
        let discriminant = splat(simd, 1.0) - splat(simd, 4.0) * ratio * per_b;
        let root = discriminant.max(splat(simd, 0.0)).sqrt();
        let shear = splat(simd, 2.0) * ratio / (splat(simd, 1.0) + root);
        let kept = (shear / trial_shear).min(splat(simd, 1.0));
        let yields = trial_shear.simd_gt(at_rest);
        let factor = yields.select(kept, splat(simd, 1.0));
        let pressed = pressure.simd_gt(splat(simd, 0.0));
        let mut returned = trial;
        for part in &mut returned {
            *part = pressed.select(*part * factor, splat(simd, 0.0));
        }
        returned
    }

    /// s + Δt (W s − s W + 2 G D′) (equation 4).
    #[inline(always)]
    fn trial<S: Simd>(
        &self,
        simd: S,
        [xx, yy, zz, xy, xz, yz]: [f32x16<S>; 6],
        l: &Matrix<S>,
        dt: f32,
    ) -> [f32x16<S>; 6] {
        let half = f32x16::splat(simd, 0.5 * dt);
        let double = f32x16::splat(simd, 2.0);
        let a = half * (l[0][1] - l[1][0]);
        let b = half * (l[0][2] - l[2][0]);
        let c = half * (l[1][2] - l[2][1]);
        let shear = f32x16::splat(simd, self.shear_modulus * dt);
        let stretch = double * shear;
        let mean = (l[0][0] + l[1][1] + l[2][2]) * f32x16::splat(simd, 1.0 / 3.0);
        let (axy, bxz, cyz) = (a * xy, b * xz, c * yz);
        [
            stretch.mul_add(l[0][0] - mean, double.mul_add(axy + bxz, xx)),
            stretch.mul_add(l[1][1] - mean, double.mul_add(cyz - axy, yy)),
            stretch.mul_add(l[2][2] - mean, zz - double * (bxz + cyz)),
            shear.mul_add(
                l[0][1] + l[1][0],
                a.mul_add(yy - xx, b.mul_add(yz, c.mul_add(xz, xy))),
            ),
            shear.mul_add(
                l[0][2] + l[2][0],
                b.mul_add(zz - xx, a.mul_add(yz, xz - c * xy)),
            ),
            shear.mul_add(
                l[1][2] + l[2][1],
                c.mul_add(zz - yy, yz - a.mul_add(xz, b * xy)),
            ),
        ]
    }
}

#[inline(always)]
fn splat<S: Simd>(simd: S, value: f32) -> f32x16<S> {
    f32x16::splat(simd, value)
}

/// Minor of a matrix, of two rows and two columns.
#[inline(always)]
fn minor<S: Simd>(m: &Matrix<S>, [i, j]: [usize; 2], [k, l]: [usize; 2]) -> f32x16<S> {
    m[i][k] * m[j][l] - m[i][l] * m[j][k]
}

/// F̂ = 1 + E of sixteen points, with its cofactors.
pub struct Deformed<S: Simd> {
    /// Cofactor matrix of F̂; its transpose is det F̂ · F̂⁻¹.
    pub cofactor: Matrix<S>,
    /// det F̂ − 1, to all digits where F̂ is close to one.
    pub volume_change: f32x16<S>,
}

impl<S: Simd> Deformed<S> {
    /// Cofactors and volume change of E = F̂ − 1.
    #[inline(always)]
    pub fn of(simd: S, e: &Matrix<S>) -> Self {
        let one = f32x16::splat(simd, 1.0);
        // Minors of E, then the contributions of the unit matrix.
        let (xx, yy, zz) = (
            minor(e, [1, 2], [1, 2]),
            minor(e, [0, 2], [0, 2]),
            minor(e, [0, 1], [0, 1]),
        );
        let trace = e[0][0] + e[1][1] + e[2][2];
        let xy = minor(e, [1, 2], [2, 0]);
        let xz = minor(e, [1, 2], [0, 1]);
        let determinant = e[0][0].mul_add(xx, e[0][1].mul_add(xy, e[0][2] * xz));
        let volume_change = trace + ((xx + yy + zz) + determinant);
        let cofactor = [
            [one + (e[1][1] + e[2][2] + xx), xy - e[1][0], xz - e[2][0]],
            [
                minor(e, [0, 2], [2, 1]) - e[0][1],
                one + (e[0][0] + e[2][2] + yy),
                minor(e, [0, 2], [1, 0]) - e[2][1],
            ],
            [
                minor(e, [0, 1], [1, 2]) - e[0][2],
                minor(e, [0, 1], [2, 0]) - e[1][2],
                one + (e[0][0] + e[1][1] + zz),
            ],
        ];
        Self {
            cofactor,
            volume_change,
        }
    }

    /// A F̂⁻¹.
    #[inline(always)]
    pub fn undone(&self, simd: S, a: &Matrix<S>) -> Matrix<S> {
        let one = f32x16::splat(simd, 1.0);
        self.by_cofactor(a, one / (one + self.volume_change))
    }

    /// min(1, det F̂) A F̂⁻¹.
    #[inline(always)]
    pub fn undone_at_most(&self, simd: S, a: &Matrix<S>) -> Matrix<S> {
        let one = f32x16::splat(simd, 1.0);
        let growth = self.volume_change.max(f32x16::splat(simd, 0.0));
        self.by_cofactor(a, one / (one + growth))
    }

    /// A times the transposed cofactor, scaled: (F̂⁻¹)_kj = cofactor_jk / det F̂.
    #[inline(always)]
    fn by_cofactor(&self, a: &Matrix<S>, scale: f32x16<S>) -> Matrix<S> {
        let c = &self.cofactor;
        let mut undone = *a;
        for (row, of) in undone.iter_mut().zip(a) {
            for j in 0..3 {
                let sum = of[1].mul_add(c[j][1], of[0] * c[j][0]);
                row[j] = of[2].mul_add(c[j][2], sum) * scale;
            }
        }
        undone
    }
}

/// Result of a sub-step of sixteen points.
pub struct Strained<S: Simd> {
    /// F̂ after it.
    pub deformed: Deformed<S>,
    /// Volumetric strain after it.
    pub volumetric_strain: f32x16<S>,
    pressure: f32x16<S>,
    deviator: [f32x16<S>; 6],
}

/// Advances E and the deviator of a chunk by a sub-step with the velocity gradient `a` at the
/// transfer positions, A = Σ v_i ⊗ ∇w_i.
#[inline(always)]
pub fn strain<S: Simd>(
    simd: S,
    chunk: &mut Chunk,
    a: &Matrix<S>,
    law: &Law,
    dt: f32,
) -> Strained<S> {
    let mut e = displacement_gradient(simd, chunk);
    let gradient = Deformed::of(simd, &e).undone(simd, a);
    for i in 0..3 {
        for j in 0..3 {
            e[i][j] = a[i][j].mul_add(splat(simd, dt), e[i][j]);
            chunk.gradient[j][i] = e[i][j].into();
        }
    }
    let deformed = Deformed::of(simd, &e);
    let volumetric_strain = total_dilation(simd, chunk, &deformed);
    let pressure = law.pressure(simd, volumetric_strain);
    let before = loaded(simd, &chunk.deviator);
    let effective_strain_rate = effective_strain_rate(simd, &gradient, chunk);
    let mut deviator = law.deviator(simd, before, &effective_strain_rate, pressure, dt);
    let pressure = law.resisting(simd, pressure, &gradient);
    // A point turned inside out becomes NaN, which ends the run.
    let inside_out = deformed.volume_change.simd_le(splat(simd, -1.0));
    for (kept, part) in chunk.deviator.iter_mut().zip(&mut deviator) {
        *part = inside_out.select(splat(simd, f32::NAN), *part);
        *kept = (*part).into();
    }
    Strained {
        deformed,
        volumetric_strain,
        pressure,
        deviator,
    }
}

/// The velocity gradient with the effective strain rate.
#[inline(always)]
fn effective_strain_rate<S: Simd>(simd: S, gradient: &Matrix<S>, chunk: &Chunk) -> Matrix<S> {
    let [xx, yy, zz, xy, xz, yz] = loaded(simd, &chunk.shared);
    let mut effective_strain_rate = *gradient;
    for (row, shared) in
        effective_strain_rate
            .iter_mut()
            .zip([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    {
        for (part, shared) in row.iter_mut().zip(shared) {
            *part += shared;
        }
    }
    effective_strain_rate
}

/// The state of a chunk at a transfer, F̂ = 1.
#[inline(always)]
pub fn at_transfer<S: Simd>(simd: S, chunk: &Chunk, law: &Law) -> Strained<S> {
    let none = f32x16::splat(simd, 0.0);
    let volumetric_strain = f32x16::simd_from(simd, chunk.volumetric_strain);
    Strained {
        deformed: Deformed::of(simd, &[[none; 3]; 3]),
        volumetric_strain,
        pressure: law.pressure(simd, volumetric_strain),
        deviator: loaded(simd, &chunk.deviator),
    }
}

impl<S: Simd> Strained<S> {
    /// −V σ F̂⁻ᵀ times the kernel's gradient factor: the force on a node is w δ
    /// times this (equation 9), `[row][column]`.
    #[inline(always)]
    pub fn force(&self, simd: S, chunk: &Chunk, law: &Law) -> Matrix<S> {
        let one = f32x16::splat(simd, 1.0);
        let mass = f32x16::simd_from(simd, chunk.mass);
        let at_transfer = one + f32x16::simd_from(simd, chunk.volumetric_strain);
        let minus_volume = mass * at_transfer * f32x16::splat(simd, -law.specific_volume);
        let [xx, yy, zz, xy, xz, yz] = self.deviator;
        let p = self.pressure;
        let stress = [[xx - p, xy, xz], [xy, yy - p, yz], [xz, yz, zz - p]];
        let c = &self.deformed.cofactor;
        let mut force = stress;
        for j in 0..3 {
            let scale = minus_volume * splat(simd, law.gradient[j]);
            for (row, of) in force.iter_mut().zip(&stress) {
                let sum = of[1].mul_add(c[1][j], of[0] * c[0][j]);
                row[j] = of[2].mul_add(c[2][j], sum) * scale;
            }
        }
        force
    }
}

/// Numbers of sixteen points, as vectors.
#[inline(always)]
fn loaded<S: Simd, const N: usize>(simd: S, lanes: &[Lanes; N]) -> [f32x16<S>; N] {
    let mut loaded = [splat(simd, 0.0); N];
    for (vector, of) in loaded.iter_mut().zip(lanes) {
        *vector = f32x16::simd_from(simd, *of);
    }
    loaded
}

#[inline(always)]
fn displacement_gradient<S: Simd>(simd: S, chunk: &Chunk) -> Matrix<S> {
    let mut e = [[splat(simd, 0.0); 3]; 3];
    for (j, column) in chunk.gradient.iter().enumerate() {
        for (i, of) in column.iter().enumerate() {
            e[i][j] = f32x16::simd_from(simd, *of);
        }
    }
    e
}

/// φ = φ_transfer + (det F̂ − 1)(1 + φ_transfer).
#[inline(always)]
fn total_dilation<S: Simd>(simd: S, chunk: &Chunk, deformed: &Deformed<S>) -> f32x16<S> {
    let before = f32x16::simd_from(simd, chunk.volumetric_strain);
    let change = deformed.volume_change;
    change.mul_add(before, change) + before
}

#[cfg(test)]
mod tests;
