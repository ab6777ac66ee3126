//! Initial equilibrium of a body at rest: it is sunk into its support until the contacts carry
//! its weight, so that it does not start with a small fall.

use crate::math::{Mat3, Vec3};
use crate::rigid::Body;
use crate::walls::Plane;
use nalgebra::{UnitQuaternion, Vector2};

/// Height of a vertex above a plane, over its sphero radius, below which it touches.
const TOUCHING: f64 = 1.0 + 1e-6;
/// Imbalance that counts as none, as a share of the weight (at the bounding
/// radius).
const BALANCED: f64 = 1e-9;
/// Largest number of rounds of Newton's method, which takes about six.
const MOST_ROUNDS: usize = 40;

/// Sinks a body that touches a plane, and turns it where its weight is not shared
/// evenly: by the contacts' overlaps, about a hundredth of the sphero radius.
pub(super) fn settle<'a>(
    body: &mut Body,
    mut planes: impl Iterator<Item = &'a Plane>,
    gravity: &Vec3,
) {
    let touches = |plane: &&Plane| !carriers(body, plane).is_empty();
    let Some(support) = planes.find(touches) else {
        return;
    };
    let pressed = (-gravity.dot(&support.normal) * body.mass).max(0.0);
    let carriers = carriers(body, support);
    let even = (pressed / carriers.len() as f64 / body.wall_law.stiffness).powf(2.0 / 3.0);
    let footing = Footing {
        carriers: &carriers,
        load: pressed / body.wall_law.stiffness,
        size: body.shape.bounding_radius(),
    };
    // A body that will tip over has no equilibrium, and is sunk evenly.
    let pose = footing.balance(even).unwrap_or(Vec3::x() * even);
    body.state.position -= support.normal * pose.x;
    if pose.yz() != Vector2::zeros() {
        body.state.orientation = Footing::turn(&pose, support) * body.state.orientation;
    }
}

/// Positions of the vertices that touch a plane, from the centre: ahead and to the left [m], in
/// the axes of [`along`].
fn carriers(body: &Body, plane: &Plane) -> Vec<[f64; 2]> {
    let reach = body.shape.sphero_radius() * TOUCHING;
    let [ahead, left] = along(plane);
    let arms = body.shape.core_vertices().iter().map(|v| body.to_world(v));
    arms.filter(|arm| plane.height(&(body.state.position + arm)) < reach)
        .map(|arm| [arm.dot(&ahead), arm.dot(&left)])
        .collect()
}

/// Two unit vectors in a plane, right-handed with its normal.
fn along(plane: &Plane) -> [Vec3; 2] {
    let least = plane.normal.iamin();
    let ahead = Vec3::ith(least, 1.0).cross(&plane.normal).normalize();
    [ahead, plane.normal.cross(&ahead)]
}

/// Contacts of equal stiffness k under a load at the middle.
struct Footing<'a> {
    carriers: &'a [[f64; 2]],
    /// Load over k [m^1.5].
    load: f64,
    /// Size of the body [m].
    size: f64,
}

impl Footing<'_> {
    /// Distance by which the body sinks [m] and angles by which it tips ahead and to the left
    /// \[rad\] until forces k δ^1.5 and their torques balance: the minimum of ⅖ Σ k δ^2.5 less the
    /// load's work, by Newton's method from an even sinking. An even one stays as it is.
    fn balance(&self, even: f64) -> Option<Vec3> {
        let mut pose = Vec3::new(even, 0.0, 0.0);
        for _ in 0..MOST_ROUNDS {
            let (pull, stiffness) = self.imbalance(&pose);
            let torque = pull.y.hypot(pull.z) / self.size;
            if pull.x.abs().max(torque) <= BALANCED * self.load {
                return Some(pose);
            }
            pose -= stiffness.try_inverse()? * pull;
        }
        None
    }

    /// Gradient and curvature of the energy over k.
    fn imbalance(&self, pose: &Vec3) -> (Vec3, Mat3) {
        let mut pull = Vec3::new(-self.load, 0.0, 0.0);
        let mut stiffness = Mat3::zeros();
        for &[ahead, left] in self.carriers {
            let lever = Vec3::new(1.0, ahead, left);
            let root = pose.dot(&lever).max(0.0).sqrt();
            pull += lever * root.powi(3);
            stiffness += lever * lever.transpose() * (1.5 * root);
        }
        (pull, stiffness)
    }

    /// The rotation of the body for these tip angles.
    fn turn(pose: &Vec3, plane: &Plane) -> UnitQuaternion<f64> {
        let [ahead, left] = along(plane);
        UnitQuaternion::from_scaled_axis(left * pose.y - ahead * pose.z)
    }
}

#[cfg(test)]
mod tests {
    use super::Footing;
    use crate::math::Vec3;
    use proptest::prelude::*;

    proptest! {
        // A tripod about the middle, one foot with as little as a fiftieth of the load.
        #[test]
        fn an_uneven_tripod_finds_its_balance(
            feet in prop::array::uniform2(prop::array::uniform2(-0.03..0.03_f64)),
            shares in prop::array::uniform3(0.02..1.0_f64),
        ) {
            let [a, b] = feet;
            prop_assume!((a[0] * b[1] - a[1] * b[0]).abs() > 1e-5);
            let third = |axis: usize| -(shares[0] * a[axis] + shares[1] * b[axis]) / shares[2];
            let carriers = [a, b, [third(0), third(1)]];
            let footing = Footing { carriers: &carriers, load: 1e-6, size: 0.05 };
            let even = (footing.load / 3.0_f64).powf(2.0 / 3.0);
            let pose = footing.balance(even).expect("it stands");
            let sum: f64 = shares.iter().sum();
            for (foot, share) in carriers.iter().zip(shares) {
                let overlap = pose.dot(&Vec3::new(1.0, foot[0], foot[1]));
                let carried = overlap.max(0.0).powf(1.5) / footing.load;
                prop_assert!((carried - share / sum).abs() < 1e-6, "{carried} {}", share / sum);
            }
        }
    }

    #[test]
    fn an_even_footing_is_left_alone_and_a_tipping_one_found() {
        let square = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
        let even = 0.25_f64.powf(2.0 / 3.0);
        let footing = |carriers| Footing {
            carriers,
            load: 1.0,
            size: 1.0,
        };
        assert_eq!(footing(&square).balance(even), Some(Vec3::x() * even));
        let aside = square.map(|[ahead, left]| [ahead + 2.0, left]);
        assert_eq!(footing(&aside).balance(even), None);
        let on_edge = [[0.0, 1.0], [0.0, -1.0]];
        let even = 0.5_f64.powf(2.0 / 3.0);
        assert_eq!(footing(&on_edge).balance(even), Some(Vec3::x() * even));
    }
}
