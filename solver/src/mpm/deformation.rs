//! Deformation of the points of a chunk since the transfer (docs/method.md, equations 2, 9
//! and 11).

use super::chunk::Chunk;
use super::constitutive::{Deviator, Law};
use super::lanes::{Matrix, Real, Splat, load, load_each};
use fearless_simd::prelude::*;

/// Minor of a matrix, of two rows and two columns.
#[inline(always)]
fn minor<S: Simd, R: Real>(
    m: &Matrix<S, R>,
    [i, j]: [usize; 2],
    [k, l]: [usize; 2],
) -> R::Vector<S> {
    m[i][k] * m[j][l] - m[i][l] * m[j][k]
}

/// Deformation F̂ = 1 + E of the points of a chunk, by its cofactors.
pub struct Deformed<S: Simd, R: Real> {
    /// Cofactor matrix of F̂; its transpose is det F̂ · F̂⁻¹.
    cofactor: Matrix<S, R>,
    /// det F̂ − 1, to all digits where F̂ is close to one.
    volume_change: R::Vector<S>,
}

impl<S: Simd, R: Real> Deformed<S, R> {
    /// Deformation of E = F̂ − 1.
    #[inline(always)]
    pub fn of(simd: S, e: &Matrix<S, R>) -> Self {
        let one = Splat::<S, R>::new(simd).of(1.0);
        // Minors of E, then the contributions of the unit matrix.
        let (xx, yy, zz) = (
            minor::<S, R>(e, [1, 2], [1, 2]),
            minor::<S, R>(e, [0, 2], [0, 2]),
            minor::<S, R>(e, [0, 1], [0, 1]),
        );
        let trace = e[0][0] + e[1][1] + e[2][2];
        let xy = minor::<S, R>(e, [1, 2], [2, 0]);
        let xz = minor::<S, R>(e, [1, 2], [0, 1]);
        let determinant = e[0][0].mul_add(xx, e[0][1].mul_add(xy, e[0][2] * xz));
        let volume_change = trace + ((xx + yy + zz) + determinant);
        let cofactor = [
            [one + (e[1][1] + e[2][2] + xx), xy - e[1][0], xz - e[2][0]],
            [
                minor::<S, R>(e, [0, 2], [2, 1]) - e[0][1],
                one + (e[0][0] + e[2][2] + yy),
                minor::<S, R>(e, [0, 2], [1, 0]) - e[2][1],
            ],
            [
                minor::<S, R>(e, [0, 1], [1, 2]) - e[0][2],
                minor::<S, R>(e, [0, 1], [2, 0]) - e[1][2],
                one + (e[0][0] + e[1][1] + zz),
            ],
        ];
        Self {
            cofactor,
            volume_change,
        }
    }

    /// Returns A F̂⁻¹.
    #[inline(always)]
    pub fn undone(&self, simd: S, a: &Matrix<S, R>) -> Matrix<S, R> {
        let one = Splat::<S, R>::new(simd).of(1.0);
        self.by_cofactor(a, one / (one + self.volume_change))
    }

    /// Returns min(1, det F̂) A F̂⁻¹: the kernel of a compressed point keeps its size, and would
    /// carry a steeper gradient as far as before.
    #[inline(always)]
    pub fn undone_at_most(&self, simd: S, a: &Matrix<S, R>) -> Matrix<S, R> {
        let number = Splat::<S, R>::new(simd);
        let one = number.of(1.0);
        let growth = self.volume_change.max(number.of(0.0));
        self.by_cofactor(a, one / (one + growth))
    }

    /// A times the transposed cofactor, scaled: (F̂⁻¹)_kj = cofactor_jk / det F̂.
    #[inline(always)]
    fn by_cofactor(&self, a: &Matrix<S, R>, scale: R::Vector<S>) -> Matrix<S, R> {
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

/// State of the points of a chunk after a sub-step.
pub struct Strained<S: Simd, R: Real> {
    /// F̂ after it.
    pub deformed: Deformed<S, R>,
    /// Volumetric strain φ after it.
    pub volumetric_strain: R::Vector<S>,
    pressure: R::Vector<S>,
    deviator: Deviator<S, R>,
}

/// Takes E and the deviator of a chunk through a sub-step with the velocity
/// gradient `a` at the transfer positions, A = Σ v_i ⊗ ∇w_i.
#[inline(always)]
pub fn strain<S: Simd, R: Real>(
    simd: S,
    chunk: &mut Chunk<R>,
    a: &Matrix<S, R>,
    law: &Law<R>,
    dt: R,
) -> Strained<S, R> {
    let number = Splat::<S, R>::new(simd);
    let mut e = displacement_gradient(simd, chunk);
    let gradient = Deformed::<S, R>::of(simd, &e).undone(simd, a);
    for i in 0..3 {
        for j in 0..3 {
            e[i][j] = a[i][j].mul_add(number.all(dt), e[i][j]);
            chunk.gradient[j][i] = e[i][j].to_array();
        }
    }
    let deformed = Deformed::<S, R>::of(simd, &e);
    let volumetric_strain = total_volumetric_strain(simd, chunk, &deformed);
    let pressure = law.pressure(simd, volumetric_strain);
    let before = load_each::<S, R, 6>(simd, &chunk.deviator);
    let strain_rate = effective_strain_rate(simd, &gradient, chunk);
    let mut deviator = law.deviator(simd, before, &strain_rate, pressure, dt);
    let pressure = law.resisting(simd, pressure, &gradient);
    // A point turned inside out becomes not a number, which ends the run.
    let inside_out = deformed.volume_change.simd_le(number.of(-1.0));
    for (kept, part) in chunk.deviator.iter_mut().zip(&mut deviator) {
        *part = inside_out.select(number.of(f64::NAN), *part);
        *kept = (*part).to_array();
    }
    Strained {
        deformed,
        volumetric_strain,
        pressure,
        deviator,
    }
}

/// Velocity gradient with the part that strain-rate smoothing adds (equation 42a).
#[inline(always)]
fn effective_strain_rate<S: Simd, R: Real>(
    simd: S,
    gradient: &Matrix<S, R>,
    chunk: &Chunk<R>,
) -> Matrix<S, R> {
    let [xx, yy, zz, xy, xz, yz] = load_each::<S, R, 6>(simd, &chunk.smoothing);
    let added = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let mut effective = *gradient;
    for (row, added) in effective.iter_mut().zip(added) {
        for (part, added) in row.iter_mut().zip(added) {
            *part += added;
        }
    }
    effective
}

/// State of a chunk at a transfer, F̂ = 1.
#[inline(always)]
pub fn at_transfer<S: Simd, R: Real>(simd: S, chunk: &Chunk<R>, law: &Law<R>) -> Strained<S, R> {
    let none = Splat::<S, R>::new(simd).of(0.0);
    let volumetric_strain = load::<S, R>(simd, &chunk.volumetric_strain);
    Strained {
        deformed: Deformed::of(simd, &[[none; 3]; 3]),
        volumetric_strain,
        pressure: law.pressure(simd, volumetric_strain),
        deviator: load_each::<S, R, 6>(simd, &chunk.deviator),
    }
}

impl<S: Simd, R: Real> Strained<S, R> {
    /// −V σ F̂⁻ᵀ times the kernel's gradient factor: the force on a node is w δ
    /// times this (equation 9), `[row][column]`.
    #[inline(always)]
    pub fn force(&self, simd: S, chunk: &Chunk<R>, law: &Law<R>) -> Matrix<S, R> {
        let number = Splat::<S, R>::new(simd);
        let mass = load::<S, R>(simd, &chunk.mass);
        let at_transfer = number.of(1.0) + load::<S, R>(simd, &chunk.volumetric_strain);
        let minus_volume = mass * at_transfer * number.all(-law.specific_volume);
        let [xx, yy, zz, xy, xz, yz] = self.deviator;
        let p = self.pressure;
        let stress = [[xx - p, xy, xz], [xy, yy - p, yz], [xz, yz, zz - p]];
        let c = &self.deformed.cofactor;
        let mut force = stress;
        for j in 0..3 {
            let scale = minus_volume * number.all(law.gradient[j]);
            for (row, of) in force.iter_mut().zip(&stress) {
                let sum = of[1].mul_add(c[1][j], of[0] * c[0][j]);
                row[j] = of[2].mul_add(c[2][j], sum) * scale;
            }
        }
        force
    }
}

#[inline(always)]
fn displacement_gradient<S: Simd, R: Real>(simd: S, chunk: &Chunk<R>) -> Matrix<S, R> {
    let mut e = [[Splat::<S, R>::new(simd).of(0.0); 3]; 3];
    for (j, column) in chunk.gradient.iter().enumerate() {
        for (i, of) in column.iter().enumerate() {
            e[i][j] = load::<S, R>(simd, of);
        }
    }
    e
}

/// φ = φ_transfer + (det F̂ − 1)(1 + φ_transfer).
#[inline(always)]
fn total_volumetric_strain<S: Simd, R: Real>(
    simd: S,
    chunk: &Chunk<R>,
    deformed: &Deformed<S, R>,
) -> R::Vector<S> {
    let before = load::<S, R>(simd, &chunk.volumetric_strain);
    let change = deformed.volume_change;
    change.mul_add(before, change) + before
}

#[cfg(test)]
mod tests;
