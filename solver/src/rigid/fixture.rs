//! Bodies for tests.

use super::{Body, BodyState, Freedom, InverseInertia, Load, TurnedCore};
use crate::bed::NearGround;
use crate::contact::law::ContactLaw;
use crate::math::Vec3;
use crate::shape::{ConvexPolyhedron, SpheroPolyhedron};
use nalgebra::UnitQuaternion;

/// A free box of 1000 kg/m³ at rest at the origin, rounded with a tenth of its
/// shortest side; its contacts are of E* = 1 MPa, e = 0.5, μ = 0.5.
pub(crate) fn cuboid(sides_m: [f64; 3]) -> Body {
    let radius = 0.1 * sides_m.into_iter().fold(f64::INFINITY, f64::min);
    of_shape(SpheroPolyhedron::cuboid(sides_m, radius).expect("a box"))
}

/// A regular tetrahedron with these properties, whose core has edges of `edge_m`, rounded with
/// a tenth of that.
pub(crate) fn tetrahedron(edge_m: f64) -> Body {
    let corner = edge_m / 8f64.sqrt();
    let vertices = [[1., 1., 1.], [1., -1., -1.], [-1., 1., -1.], [-1., -1., 1.]];
    let loops = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    let core = ConvexPolyhedron::new(
        vertices.map(|v| Vec3::from(v) * corner).to_vec(),
        loops.map(Vec::from).to_vec(),
    );
    let shape = SpheroPolyhedron::from_core(core.expect("a solid"), 0.1 * edge_m);
    of_shape(shape.expect("a positive radius"))
}

/// A body of any shape with these properties.
pub(crate) fn of_shape(shape: SpheroPolyhedron) -> Body {
    let law = ContactLaw::hertz(1e6, shape.sphero_radius(), 0.5, 0.5);
    let inertia = shape.unit_inertia() * 1000.0;
    Body {
        mass: 1000.0 * shape.volume(),
        inertia,
        inverse_inertia: InverseInertia::of(&inertia).expect("a solid has inertia"),
        wall_law: law,
        flow_law: law,
        rolling_friction: 0.0,
        freedom: Freedom::Free,
        wall_touches: Vec::new(),
        near_ground: NearGround::default(),
        turned_core: TurnedCore::default(),
        state: BodyState {
            position: Vec3::zeros(),
            orientation: UnitQuaternion::identity(),
            momentum: Vec3::zeros(),
            angular_momentum: Vec3::zeros(),
            springs: Vec::new(),
            ground_nodes: Vec::new(),
            rolling: Vec::new(),
            wall_load: Load::default(),
            wall_energy: 0.0,
            wall_overlap: 0.0,
            body_load: Load::default(),
            barrier_load: Load::default(),
            touching_bodies: 0,
            still_for: 0.0,
        },
        shape,
    }
}
