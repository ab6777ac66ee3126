//! The granular material: elastic moduli, density, friction (docs/method.md, equations 1–3a).

use crate::method::METHOD;
use serde::{Deserialize, Serialize};

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
                METHOD.stiffness.bulk_viscosity * self.bulk_density * self.p_wave_speed() * spacing
            }
            Yielding::Never => 0.0,
        }
    }

    /// Density of a bulk under this pressure [kg/m³].
    pub fn density(&self, pressure: f64) -> f64 {
        self.bulk_density * (1.0 + pressure / self.bulk_modulus)
    }
}
