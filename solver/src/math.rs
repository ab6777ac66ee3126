//! Symmetric 3 × 3 tensors; all else is nalgebra's.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// Vector of three f64.
pub type Vec3 = Vector3<f64>;
/// Matrix of 3 × 3 f64.
pub type Mat3 = Matrix3<f64>;

/// Determinant and inverse of a matrix; the inverse of a singular one is not
/// finite.
pub fn inverted(m: &Mat3) -> (f64, Mat3) {
    let (a, b, c) = (m.column(0), m.column(1), m.column(2));
    let (bc, ca, ab) = (b.cross(&c), c.cross(&a), a.cross(&b));
    let determinant = a.dot(&bc);
    let rows = Mat3::from_columns(&[bc, ca, ab]).transpose();
    (determinant, rows * (1.0 / determinant))
}

/// A symmetric tensor by its six components.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Sym3 {
    /// Component xx.
    pub xx: f64,
    /// Component yy.
    pub yy: f64,
    /// Component zz.
    pub zz: f64,
    /// Component xy.
    pub xy: f64,
    /// Component xz.
    pub xz: f64,
    /// Component yz.
    pub yz: f64,
}

impl Sym3 {
    /// `value` times the unit tensor.
    pub fn isotropic(value: f64) -> Self {
        Self {
            xx: value,
            yy: value,
            zz: value,
            ..Self::default()
        }
    }

    /// Symmetric part of a matrix.
    pub fn of(m: &Mat3) -> Self {
        Self {
            xx: m.m11,
            yy: m.m22,
            zz: m.m33,
            xy: 0.5 * (m.m12 + m.m21),
            xz: 0.5 * (m.m13 + m.m31),
            yz: 0.5 * (m.m23 + m.m32),
        }
    }

    /// Sum of the diagonal.
    pub fn trace(&self) -> f64 {
        self.xx + self.yy + self.zz
    }

    /// The tensor less a third of its trace.
    pub fn deviator(&self) -> Self {
        self.plus(&Self::isotropic(-self.trace() / 3.0))
    }

    /// √(½ s:s).
    pub fn equivalent_shear(&self) -> f64 {
        let diagonal = self.xx * self.xx + self.yy * self.yy + self.zz * self.zz;
        let off_diagonal = self.xy * self.xy + self.xz * self.xz + self.yz * self.yz;
        (0.5 * diagonal + off_diagonal).sqrt()
    }

    /// Sum of two tensors.
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            xx: self.xx + other.xx,
            yy: self.yy + other.yy,
            zz: self.zz + other.zz,
            xy: self.xy + other.xy,
            xz: self.xz + other.xz,
            yz: self.yz + other.yz,
        }
    }

    /// Every component times `factor`.
    pub fn times(&self, factor: f64) -> Self {
        Self {
            xx: self.xx * factor,
            yy: self.yy * factor,
            zz: self.zz * factor,
            xy: self.xy * factor,
            xz: self.xz * factor,
            yz: self.yz * factor,
        }
    }

    /// W s − s W, the spin term of the Jaumann rate; W is the skew part of the
    /// velocity gradient.
    pub fn jaumann_spin(&self, gradient: &Mat3) -> Self {
        let a = 0.5 * (gradient.m12 - gradient.m21);
        let b = 0.5 * (gradient.m13 - gradient.m31);
        let c = 0.5 * (gradient.m23 - gradient.m32);
        Self {
            xx: 2.0 * (a * self.xy + b * self.xz),
            yy: 2.0 * (c * self.yz - a * self.xy),
            zz: -2.0 * (b * self.xz + c * self.yz),
            xy: a * (self.yy - self.xx) + b * self.yz + c * self.xz,
            xz: b * (self.zz - self.xx) + a * self.yz - c * self.xy,
            yz: c * (self.zz - self.yy) - a * self.xz - b * self.xy,
        }
    }

    /// The tensor as a full matrix.
    pub fn matrix(&self) -> Mat3 {
        Mat3::new(
            self.xx, self.xy, self.xz, self.xy, self.yy, self.yz, self.xz, self.yz, self.zz,
        )
    }

    /// The tensor mirrored along x and y where the sign is −1.
    pub fn mirrored(&self, [x, y]: [f64; 2]) -> Self {
        Self {
            xy: x * y * self.xy,
            xz: x * self.xz,
            yz: y * self.yz,
            ..*self
        }
    }

    /// False if any component is NaN or infinite.
    pub fn is_finite(&self) -> bool {
        (self.xx + self.yy + self.zz + self.xy + self.xz + self.yz).is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_times_its_inverse_is_one() {
        let m = Mat3::new(1.1, 0.2, -0.3, 0.05, 0.9, 0.1, -0.2, 0.3, 1.2);
        let (determinant, inverse) = inverted(&m);
        // A few roundings of numbers of order one.
        assert!((m * inverse - Mat3::identity()).norm() < 1e-15);
        assert!((determinant - m.determinant()).abs() < 1e-15);
    }
}
