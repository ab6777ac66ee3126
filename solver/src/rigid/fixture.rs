//! Bodies for tests.

use super::{Body, BodyState, Freedom, Load};
use crate::contact::law::ContactLaw;
use crate::math::Vec3;
use crate::shape::SpheroPolyhedron;
use nalgebra::UnitQuaternion;

/// A free box of 1000 kg/m³ at rest at the origin, rounded with a tenth of its
/// shortest side; its contacts are of E* = 1 MPa, e = 0.5, μ = 0.5.
pub(crate) fn cuboid(sides_m: [f64; 3]) -> Body {
    let radius = 0.1 * sides_m.into_iter().fold(f64::INFINITY, f64::min);
    of_shape(SpheroPolyhedron::cuboid(sides_m, radius).expect("a box"))
}

/// The same of any shape.
pub(crate) fn of_shape(shape: SpheroPolyhedron) -> Body {
    let radius = shape.sphero_radius();
    let law = ContactLaw::hertz(1e6, radius, 0.5, 0.5);
    let inertia = shape.unit_inertia() * 1000.0;
    Body {
        mass: 1000.0 * shape.volume(),
        inertia,
        inverse_inertia: inertia.try_inverse().expect("a solid has inertia"),
        wall_law: law,
        flow_law: law,
        freedom: Freedom::Free,
        state: BodyState {
            position: Vec3::zeros(),
            orientation: UnitQuaternion::identity(),
            momentum: Vec3::zeros(),
            angular_momentum: Vec3::zeros(),
            springs: Vec::new(),
            wall_load: Load::default(),
            wall_energy: 0.0,
        },
        shape,
    }
}
