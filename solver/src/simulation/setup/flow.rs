//! Flow of a run: its material, the bounds of its steps and its contacts with bodies.

use super::resolution::Expected;
use crate::contact::law::ContactLaw;
use crate::contact::point_body::PointSphere;
use crate::kernel::Lattice;
use crate::material::{Material, Yielding};
use crate::method::METHOD;
use crate::rigid::Body;
use crate::scenario::{self, Coupling, Numerics};
use crate::stability::Limits;

/// Flow of a run.
#[derive(Debug, Clone)]
pub struct GivenFlow {
    /// Material.
    pub material: Material,
    /// Bounds of its steps.
    pub limits: Limits,
    /// Spheres that represent points in contact with bodies.
    pub sphere: PointSphere,
    /// Pressure over relative overlap δ/l at the reference overlap [Pa].
    contact_modulus: f64,
    /// Expected speeds and pressures for which its material and contacts are chosen.
    expected: Expected,
}

impl GivenFlow {
    /// A scenario's flow, of points of this volume [m³] on a lattice.
    pub(super) fn of(
        given: &scenario::Material,
        numerics: &Numerics,
        lattice: &Lattice,
        point_volume: f64,
        expected: Expected,
    ) -> Self {
        let material = material(given, numerics.sound_speed_m_s, &expected);
        let mut flow = Self::new(material, lattice, point_volume, expected);
        flow.couple(numerics.coupling, point_volume);
        let limits = &mut flow.limits;
        limits.courant = numerics.courant.unwrap_or(limits.courant);
        limits.flow_courant = numerics.flow_courant.unwrap_or(limits.flow_courant);
        flow
    }

    /// A flow of points of this volume [m³] on a lattice, for these expected speeds and pressures,
    /// at the default Courant numbers.
    pub fn new(
        material: Material,
        lattice: &Lattice,
        point_volume: f64,
        expected: Expected,
    ) -> Self {
        let spacing = point_volume.cbrt();
        let modulus = expected.contact_pressure / METHOD.stiffness.reference_overlap;
        let modulus = modulus.min(material.p_wave_modulus() / 1.5);
        // Hertz: (δ/δ_ref)^1.5 is the pressure over that at the reference overlap.
        let share = expected.static_pressure / (modulus * METHOD.stiffness.reference_overlap);
        let at_rest = if share > 0.0 && share.is_finite() {
            METHOD.stiffness.reference_overlap * share.powf(2.0 / 3.0)
        } else {
            0.0
        };
        Self {
            limits: Limits {
                p_wave_speed: material.p_wave_speed(),
                sound_speed: (material.bulk_modulus / material.bulk_density).sqrt(),
                cell_size: lattice.finest_spacing(),
                courant: METHOD.time_step.courant,
                flow_courant: METHOD.time_step.flow_courant,
                body_contact_share: METHOD.time_step.body_contact_share,
                slow: METHOD.time_step.slow * expected.speed,
            },
            sphere: PointSphere {
                radius: (0.5 + at_rest) * spacing,
                spacing,
            },
            contact_modulus: modulus,
            expected,
            material,
        }
    }

    /// Selects the formulation of contacts between points and bodies.
    fn couple(&mut self, coupling: Coupling, point_volume: f64) {
        match coupling {
            Coupling::HalfSpacing => {}
            Coupling::SourcePaper => {
                self.sphere.radius = (3.0 * point_volume / (4.0 * std::f64::consts::PI)).cbrt();
                self.contact_modulus = self.material.p_wave_modulus() / 1.5;
            }
        }
    }

    /// Relative change of density under the largest pressure expected: the dynamic one,
    /// or that of a body's impact on a bed at rest, ρ c v.
    pub fn density_change(&self) -> f64 {
        let dynamic = (self.expected.pressing_speed / self.limits.sound_speed).powi(2);
        dynamic.max(self.expected.impact_speed / self.limits.sound_speed)
    }

    /// Law of a body's contacts with points: at the reference overlap a point carries
    /// the largest pressure expected on its cross-section l² (equation 22).
    pub fn contact_law(&self, damping: f64, friction: f64) -> ContactLaw {
        let spacing = self.sphere.spacing;
        let overlap = METHOD.stiffness.reference_overlap * spacing;
        ContactLaw {
            stiffness: self.contact_modulus * spacing / overlap.sqrt(),
            ..ContactLaw::damped(0.0, 1.0, damping, friction)
        }
    }

    /// Longest stable sub-step for a free body covered with points, which rings against them [s]
    /// (docs/method.md, equation 26).
    pub fn contact_substep(&self, bodies: &[Body]) -> f64 {
        let overlap = METHOD.stiffness.reference_overlap * self.sphere.spacing;
        let of_body = |body: &Body| {
            let points = self.sphere.most_touching(body);
            let stiffness = body.flow_law.tangent_stiffness(overlap) * points;
            self.limits.body_contact_share * (body.mass / stiffness).sqrt()
        };
        bodies
            .iter()
            .filter(|body| body.is_free())
            .map(of_body)
            .fold(f64::INFINITY, f64::min)
    }
}

/// Granular material with the stiffness asked for, or a sound speed of
/// `METHOD.stiffness.sound_over_flow` times the speed of the largest dynamic pressure expected.
fn material(given: &scenario::Material, sound_speed: Option<f64>, expected: &Expected) -> Material {
    let nu = given.poissons_ratio;
    let density = given.bulk_density_kg_m3;
    let bulk_modulus = match (given.youngs_modulus_pa, sound_speed) {
        (Some(youngs_modulus), _) => youngs_modulus / (3.0 * (1.0 - 2.0 * nu)),
        (None, Some(sound_speed)) => density * sound_speed.powi(2),
        (None, None) => {
            density * (METHOD.stiffness.sound_over_flow * expected.pressing_speed).powi(2)
        }
    };
    Material {
        bulk_density: density,
        bulk_modulus,
        shear_modulus: bulk_modulus * 1.5 * (1.0 - 2.0 * nu) / (1.0 + nu),
        yielding: Yielding::Granular {
            static_friction: given.static_friction,
            limiting_friction: given.limiting_friction,
            reference_inertial_number: given.reference_inertial_number,
            grain_diameter: given.grain_diameter_m,
            grain_density: given.grain_density_kg_m3,
        },
    }
}
