//! The constitutive law: stress of the points of a chunk after a strain (docs/method.md,
//! equations 3–6).

use super::lanes::{Matrix, Real, Splat};
use crate::material::{Material, Yielding};
use crate::math::{Sym3, Vec3};
use fearless_simd::{Level, dispatch, prelude::*};

/// A material in the numbers that the kernels work with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law<R> {
    /// 1/ρ_c [m³/kg].
    pub specific_volume: R,
    bulk_modulus: R,
    shear_modulus: R,
    static_friction: R,
    limiting_friction: R,
    /// G I0/(d √ρ_s) [Pa^½/s].
    viscosity: R,
    /// b ρ_c c_P h [Pa s].
    bulk_viscosity: R,
    /// False for the elastic test law, which carries tension and never yields.
    granular: bool,
    /// 4/h per axis [1/m]: ∇w is w δ times this, with δ in cells.
    pub gradient: [R; 3],
}

/// Deviator of a symmetric tensor of each point, xx yy zz xy xz yz.
pub type Deviator<S, R> = [<R as Real>::Vector<S>; 6];

impl<R: Real> Law<R> {
    /// Law of a material on a lattice with these node distances [m].
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
            Yielding::Never => (0.0, 0.0, 0.0),
        };
        Self {
            specific_volume: R::of(1.0 / material.bulk_density),
            bulk_modulus: R::of(material.bulk_modulus),
            shear_modulus: R::of(material.shear_modulus),
            static_friction: R::of(statically),
            limiting_friction: R::of(limiting),
            viscosity: R::of(viscosity),
            bulk_viscosity: R::of(material.bulk_viscosity(spacing.min())),
            granular: material.is_granular(),
            gradient: [0, 1, 2].map(|axis| R::of(4.0 / spacing[axis])),
        }
    }

    /// Pressure at a volumetric strain φ, −K φ/(1 + φ) where grains touch (equation 3).
    #[inline(always)]
    pub fn pressure<S: Simd>(&self, simd: S, volumetric_strain: R::Vector<S>) -> R::Vector<S> {
        let number = Splat::<S, R>::new(simd);
        let compression = number.of(0.0) - volumetric_strain;
        let pressure =
            number.all(self.bulk_modulus) * compression / (number.of(1.0) + volumetric_strain);
        if self.granular {
            pressure.max(number.of(0.0))
        } else {
            pressure
        }
    }

    /// Pressure with the resistance of the bulk viscosity to a change of volume; it never pulls
    /// (equation 3a).
    #[inline(always)]
    pub fn resisting<S: Simd>(
        &self,
        simd: S,
        pressure: R::Vector<S>,
        gradient: &Matrix<S, R>,
    ) -> R::Vector<S> {
        if !self.granular {
            return pressure;
        }
        let number = Splat::<S, R>::new(simd);
        let none = number.of(0.0);
        let growth = gradient[0][0] + gradient[1][1] + gradient[2][2];
        let resisting = growth.mul_add(number.all(-self.bulk_viscosity), pressure);
        let pressed = pressure.simd_gt(none);
        pressed.select(resisting.max(none), pressure)
    }

    /// Deviator after `dt` [s] of the velocity gradient [1/s], at the pressure reached
    /// (equations 4–6): an elastic trial, returned to the yield surface of μ(I).
    #[inline(always)]
    pub fn deviator<S: Simd>(
        &self,
        simd: S,
        deviator: Deviator<S, R>,
        gradient: &Matrix<S, R>,
        pressure: R::Vector<S>,
        dt: R,
    ) -> Deviator<S, R> {
        let trial = self.trial(simd, deviator, gradient, dt);
        self.yielded(simd, trial, pressure, dt)
    }

    /// Deviator after the elastic trial has yielded for `dt` [s].
    #[inline(always)]
    fn yielded<S: Simd>(
        &self,
        simd: S,
        trial: Deviator<S, R>,
        pressure: R::Vector<S>,
        dt: R,
    ) -> Deviator<S, R> {
        if self.granular {
            self.returned(simd, trial, pressure, dt)
        } else {
            trial
        }
    }

    /// Return mapping of Dunatunga & Kamrin (2015) (equation 6).
    #[inline(always)]
    fn returned<S: Simd>(
        &self,
        simd: S,
        trial: Deviator<S, R>,
        pressure: R::Vector<S>,
        dt: R,
    ) -> Deviator<S, R> {
        let number = Splat::<S, R>::new(simd);
        let [xx, yy, zz, xy, xz, yz] = trial;
        let diagonal = xx.mul_add(xx, yy.mul_add(yy, zz * zz));
        let off_diagonal = xy.mul_add(xy, xz.mul_add(xz, yz * yz));
        let trial_shear = number.of(0.5).mul_add(diagonal, off_diagonal).sqrt();
        let at_rest = number.all(self.static_friction) * pressure;
        let limit = number.all(self.limiting_friction) * pressure;
        let viscous = number.all(self.viscosity * dt) * pressure.sqrt();
        let b = limit + trial_shear + viscous;
        // H/B instead of H: squares of stresses may not fit into single precision.
        let per_b = number.of(1.0) / b;
        let ratio = limit.mul_add(trial_shear * per_b, at_rest * (viscous * per_b));
        let discriminant = number.of(1.0) - number.of(4.0) * ratio * per_b;
        let root = discriminant.max(number.of(0.0)).sqrt();
        let shear = number.of(2.0) * ratio / (number.of(1.0) + root);
        let kept = (shear / trial_shear).min(number.of(1.0));
        let yields = trial_shear.simd_gt(at_rest);
        let factor = yields.select(kept, number.of(1.0));
        let pressed = pressure.simd_gt(number.of(0.0));
        let mut returned = trial;
        for part in &mut returned {
            *part = pressed.select(*part * factor, number.of(0.0));
        }
        returned
    }

    /// Elastic trial s + Δt (W s − s W + 2 G D′) (equation 4).
    #[inline(always)]
    fn trial<S: Simd>(
        &self,
        simd: S,
        [xx, yy, zz, xy, xz, yz]: Deviator<S, R>,
        l: &Matrix<S, R>,
        dt: R,
    ) -> Deviator<S, R> {
        let number = Splat::<S, R>::new(simd);
        let half = number.all(R::of(0.5) * dt);
        let double = number.of(2.0);
        let a = half * (l[0][1] - l[1][0]);
        let b = half * (l[0][2] - l[2][0]);
        let c = half * (l[1][2] - l[2][1]);
        let shear = number.all(self.shear_modulus * dt);
        let stretch = double * shear;
        let mean = (l[0][0] + l[1][1] + l[2][2]) * number.of(1.0 / 3.0);
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

/// Stress [Pa] of a deviator [Pa] under a pressure [Pa] once it has yielded for so long that it
/// is at rest.
pub fn at_rest(material: &Material, deviator: &Sym3, pressure: f64) -> Sym3 {
    /// Long enough to leave only the shear stress that friction at rest can bear [s].
    const LONG: f64 = 1e3;
    let law = Law::<f64>::of(material, &Vec3::repeat(1.0));
    let mut yielded = deviator.components();
    dispatch!(Level::new(), simd => {
        let number = Splat::<_, f64>::new(simd);
        let mut trial = [number.of(0.0); 6];
        for (vector, part) in trial.iter_mut().zip(yielded) {
            *vector = number.of(part);
        }
        let returned = law.yielded(simd, trial, number.of(pressure), LONG);
        for (part, vector) in yielded.iter_mut().zip(returned) {
            *part = vector[0];
        }
    });
    Sym3::from_components(yielded).plus(&Sym3::isotropic(-pressure))
}
