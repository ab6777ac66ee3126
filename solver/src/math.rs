//! Symmetric 3 × 3 tensors; all else is nalgebra's.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// Vector of three f64.
pub type Vec3 = Vector3<f64>;
/// Matrix of 3 × 3 f64.
pub type Mat3 = Matrix3<f64>;

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

    /// Tensor of the components xx yy zz xy xz yz.
    pub fn from_components([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> Self {
        Self {
            xx,
            yy,
            zz,
            xy,
            xz,
            yz,
        }
    }

    /// Components xx yy zz xy xz yz.
    pub fn components(&self) -> [f64; 6] {
        [self.xx, self.yy, self.zz, self.xy, self.xz, self.yz]
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
