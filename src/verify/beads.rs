//! Glass beads, the material of the cases with experimental answers. Fixed
//! beforehand: friction and I0 as in Jop, Forterre & Pouliquen 2006; diameter of
//! those in Lajeunesse, Monnerie & Homsy 2005; packed to 0.6.

use scree_solver::material::{Material, Yielding};

/// Density of a bead [kg/m³].
pub(super) const GRAIN_DENSITY: f64 = 2500.0;
/// Density of the bulk [kg/m³].
pub(super) const BULK_DENSITY: f64 = 1500.0;
/// Diameter of a bead [m].
pub(super) const GRAIN_DIAMETER: f64 = 1.15e-3;
/// Static and limiting friction.
pub(super) const FRICTION: (f64, f64) = (0.382, 0.644);
pub(super) const REFERENCE_INERTIAL_NUMBER: f64 = 0.279;
/// Poisson's ratio of the bulk, the solver's default.
pub(super) const POISSONS_RATIO: f64 = 0.3;

/// Beads with this sound speed [m/s].
pub(super) fn with_sound_speed(sound_speed: f64) -> Material {
    let bulk_modulus = BULK_DENSITY * sound_speed * sound_speed;
    let shear_modulus = bulk_modulus * 1.5 * (1.0 - 2.0 * POISSONS_RATIO) / (1.0 + POISSONS_RATIO);
    Material {
        bulk_density: BULK_DENSITY,
        bulk_modulus,
        shear_modulus,
        yielding: Yielding::Granular {
            static_friction: FRICTION.0,
            limiting_friction: FRICTION.1,
            reference_inertial_number: REFERENCE_INERTIAL_NUMBER,
            grain_diameter: GRAIN_DIAMETER,
            grain_density: GRAIN_DENSITY,
        },
    }
}
