//! The granular material: stress of one point (docs/method.md, equations 1–6).

use crate::math::{Mat3, Sym3};
use serde::{Deserialize, Serialize};

/// Bulk viscosity over ρ_c c_P h, b of equation 3a.
const BULK_DAMPING: f64 = 0.2;

/// Yield condition in shear.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Yielding {
    /// Drucker–Prager at rest, μ(I) in motion.
    Granular {
        /// Friction at rest, μ_s.
        static_friction: f64,
        /// Friction at large inertial number, μ_2; μ_s gives Drucker–Prager.
        limiting_friction: f64,
        /// Inertial number I0.
        reference_inertial_number: f64,
        /// Grain diameter d [m].
        grain_diameter: f64,
        /// Grain density ρ_s [kg/m³].
        grain_density: f64,
    },
    /// No yielding, and tension is carried: the elastic test law.
    Never,
}

/// A material: elastic moduli, reference density, yielding.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Density at which grains just touch, ρ_c [kg/m³].
    pub bulk_density: f64,
    /// Bulk modulus K [Pa].
    pub bulk_modulus: f64,
    /// Shear modulus G [Pa].
    pub shear_modulus: f64,
    /// Yield condition in shear.
    pub yielding: Yielding,
}

impl Material {
    /// True if it consists of grains, which may separate.
    pub fn is_granular(&self) -> bool {
        matches!(self.yielding, Yielding::Granular { .. })
    }

    /// Largest density [kg/m³]: that of its grains, or twice the bulk at rest if that is more; no
    /// bound for a solid.
    pub fn densest(&self) -> f64 {
        match self.yielding {
            Yielding::Granular { grain_density, .. } => grain_density.max(2.0 * self.bulk_density),
            Yielding::Never => f64::INFINITY,
        }
    }

    /// P-wave modulus M = K + 4G/3 [Pa].
    pub fn p_wave_modulus(&self) -> f64 {
        self.bulk_modulus + 4.0 / 3.0 * self.shear_modulus
    }

    /// Speed of sound √(M/ρ_c) [m/s].
    pub fn p_wave_speed(&self) -> f64 {
        (self.p_wave_modulus() / self.bulk_density).sqrt()
    }

    /// Pressure of a bulk of this density [Pa] (equation 3); zero for separated grains.
    pub fn pressure(&self, density: f64) -> f64 {
        let pressure = self.bulk_modulus * (density / self.bulk_density - 1.0);
        match self.yielding {
            Yielding::Granular { .. } => pressure.max(0.0),
            Yielding::Never => pressure,
        }
    }

    /// Bulk viscosity on cells of `spacing` [m]: b ρ_c c_P h [Pa s] (equation 3a).
    /// The elastic test law has none.
    pub fn bulk_viscosity(&self, spacing: f64) -> f64 {
        match self.yielding {
            Yielding::Granular { .. } => {
                BULK_DAMPING * self.bulk_density * self.p_wave_speed() * spacing
            }
            Yielding::Never => 0.0,
        }
    }

    /// Density of a bulk under this pressure [kg/m³].
    pub fn density(&self, pressure: f64) -> f64 {
        self.bulk_density * (1.0 + pressure / self.bulk_modulus)
    }

    /// Stress [Pa] after `dt` [s] of the velocity gradient [1/s], for a point that now has the
    /// density `density` [kg/m³]. A bulk viscosity [Pa s] resists the change of volume of grains in
    /// contact, but is never tensile; it does not enter the yield condition.
    pub fn stress(
        &self,
        stress: &Sym3,
        gradient: &Mat3,
        density: f64,
        bulk_viscosity: f64,
        dt: f64,
    ) -> Sym3 {
        let pressure = self.pressure(density);
        if pressure <= 0.0 && self.is_granular() {
            return Sym3::default();
        }
        let deviator = stress.deviator();
        let strain_rate = Sym3::of(gradient).deviator();
        let rate = deviator
            .jaumann_spin(gradient)
            .plus(&strain_rate.times(2.0 * self.shear_modulus));
        let elastic = self.yielded(&deviator.plus(&rate.times(dt)), pressure, dt);
        if !self.is_granular() {
            return elastic;
        }
        let resisted = (-bulk_viscosity * gradient.trace()).max(-pressure);
        elastic.plus(&Sym3::isotropic(-resisted))
    }

    /// The stress [Pa] of a point whose density has become `density` [kg/m³] without
    /// strain, and whose deviator rises by a share of itself (equation 41a).
    pub fn pressed_anew(&self, stress: &Sym3, rise: f64, density: f64) -> Sym3 {
        let deviator = stress.deviator().times(1.0 + rise);
        deviator.plus(&Sym3::isotropic(-self.pressure(density)))
    }

    /// Stress of a trial deviator under a pressure, returned to the yield
    /// surface [Pa].
    pub fn yielded(&self, trial: &Sym3, pressure: f64, dt: f64) -> Sym3 {
        let trial_shear = trial.equivalent_shear();
        let shear = self.shear_stress(trial_shear, pressure, dt);
        let factor = if shear < trial_shear {
            shear / trial_shear
        } else {
            1.0
        };
        trial.times(factor).plus(&Sym3::isotropic(-pressure))
    }

    /// Equivalent shear stress after a step of `dt` [s] whose elastic trial is
    /// `trial` [Pa]: the closed form of Dunatunga & Kamrin (2015) for μ(I)
    /// (equation 6).
    fn shear_stress(&self, trial: f64, pressure: f64, dt: f64) -> f64 {
        let Yielding::Granular {
            static_friction,
            limiting_friction,
            reference_inertial_number,
            grain_diameter,
            grain_density,
        } = self.yielding
        else {
            return trial;
        };
        let at_rest = static_friction * pressure;
        if trial <= at_rest {
            return trial;
        }
        let limit = limiting_friction * pressure;
        let viscous =
            self.shear_modulus * reference_inertial_number * dt * (pressure / grain_density).sqrt()
                / grain_diameter;
        let b = limit + trial + viscous;
        let h = limit * trial + at_rest * viscous;
        2.0 * h / (b + (b * b - 4.0 * h).max(0.0).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glass_beads(limiting_friction: f64) -> Material {
        Material {
            bulk_density: 1500.0,
            bulk_modulus: 8.0e5,
            shear_modulus: 3.8e5,
            yielding: Yielding::Granular {
                static_friction: 0.382,
                limiting_friction,
                reference_inertial_number: 0.279,
                grain_diameter: 1e-3,
                grain_density: 2500.0,
            },
        }
    }

    // Values computed by hand from the quadratic for τ (docs/method.md, equation 6): p = 500 Pa,
    // Δt = 1e-5 s; printed to six digits, hence the tolerance.
    #[test]
    fn the_return_mapping_solves_its_quadratic() {
        let beads = glass_beads(0.644);
        for (trial, expected) in [(200.0, 192.926), (400.0, 226.147), (1000.0, 270.401)] {
            let shear = beads.shear_stress(trial, 500.0, 1e-5);
            assert!((shear - expected).abs() < 6e-4, "{trial}: {shear}");
        }
        assert_eq!(beads.shear_stress(190.0, 500.0, 1e-5), 190.0);
    }

    #[test]
    fn equal_frictions_give_drucker_prager() {
        let beads = glass_beads(0.382);
        let shear = beads.shear_stress(1000.0, 500.0, 1e-5);
        assert!((shear - 191.0).abs() < 1e-9, "{shear}");
    }

    // With τ = μ(I) p after the step, the plastic shear rate that the step
    // implies, (τ_trial − τ)/(G Δt), must give back I = γ̇ d √(ρ_s/p).
    #[test]
    fn flowing_shear_stress_is_mu_of_i() {
        let (beads, pressure, dt) = (glass_beads(0.644), 500.0, 1e-5);
        let trial = 700.0;
        let shear = beads.shear_stress(trial, pressure, dt);
        let rate = (trial - shear) / (beads.shear_modulus * dt);
        let inertial = rate * 1e-3 * (2500.0f64 / pressure).sqrt();
        let friction = 0.382 + (0.644 - 0.382) / (1.0 + 0.279 / inertial);
        assert!((shear / pressure - friction).abs() < 1e-12);
    }

    #[test]
    fn grains_apart_carry_nothing() {
        let pressed = Sym3::isotropic(-100.0);
        let stress = glass_beads(0.644).stress(&pressed, &Mat3::zeros(), 1499.9, 0.0, 1e-5);
        assert_eq!(stress, Sym3::default());
    }

    // A pure rotation turns the stress with the body: after a quarter turn in
    // small steps s_xx has become s_yy. Explicit steps grow s by (ωΔt)² each.
    #[test]
    fn stress_turns_with_the_material() {
        let elastic = Material {
            yielding: Yielding::Never,
            ..glass_beads(0.644)
        };
        let spin = Mat3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        let steps = 10_000;
        let dt = std::f64::consts::FRAC_PI_2 / f64::from(steps);
        let mut stress = Sym3 {
            xx: 1.0,
            yy: -1.0,
            ..Sym3::default()
        };
        for _ in 0..steps {
            stress = elastic.stress(&stress, &spin, 1500.0, 0.0, dt);
        }
        assert!((stress.xx + 1.0).abs() < 1e-3, "{stress:?}");
        assert!((stress.yy - 1.0).abs() < 1e-3);
        assert!(stress.xy.abs() < 1e-3);
    }
}
