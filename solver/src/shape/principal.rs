//! Principal moments and axes of an inertia tensor.

use nalgebra::{Matrix3, Vector3};

/// Moments that differ by less than this share of the largest are equal.
const EQUAL: f64 = 1e-9;

/// An inertia tensor by its principal moments and axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalInertia {
    /// Principal moments, the smallest first, in the tensor's unit.
    pub moments: [f64; 3],
    /// Unit axes of the moments, right-handed, in the tensor's frame. For equal moments, where the
    /// axes are not unique, those nearest to the frame's own.
    pub axes: [Vector3<f64>; 3],
}

impl PrincipalInertia {
    /// Moments and axes of a symmetric tensor: its eigenvalues and eigenvectors.
    pub fn of(tensor: &Matrix3<f64>) -> Self {
        let eigen = tensor.symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
        let moments = order.map(|place| eigen.eigenvalues[place]);
        let found = order.map(|place| eigen.eigenvectors.column(place).into_owned());
        let equal = |a: usize, b: usize| moments[b] - moments[a] < EQUAL * moments[2];
        let axes = match (equal(0, 1), equal(1, 2)) {
            (true, true) => [Vector3::x(), Vector3::y(), Vector3::z()],
            (true, false) => {
                let last = positive(&found[2]);
                let first = across(&last);
                [first, last.cross(&first), last]
            }
            (false, true) => {
                let first = positive(&found[0]);
                let second = across(&first);
                [first, second, first.cross(&second)]
            }
            (false, false) => {
                let [first, second] = [positive(&found[0]), positive(&found[1])];
                [first, second, first.cross(&second)]
            }
        };
        Self { moments, axes }
    }
}

/// The sense of ±axis whose largest component is positive.
fn positive(axis: &Vector3<f64>) -> Vector3<f64> {
    axis * axis[axis.iamax()].signum()
}

/// The direction across an axis nearest to one of the frame's axes.
fn across(axis: &Vector3<f64>) -> Vector3<f64> {
    let mut nearest = Vector3::zeros();
    nearest[axis.iamin()] = 1.0;
    (nearest - axis * axis.dot(&nearest)).normalize()
}
