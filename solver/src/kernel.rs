//! Quadratic B-spline kernel: the 3 × 3 × 3 nodes a point touches
//! (docs/method.md, equation 7).

use crate::math::Vec3;

/// Nodes per axis a point touches.
pub const WIDTH: usize = 3;
/// Half the kernel's width [node distances].
pub const REACH: f64 = 1.5;

/// The nodes one point touches, per axis. The weight of node (a, b, c) is
/// `weight[0][a] · weight[1][b] · weight[2][c]`, and it lies at
/// `offset[axis][·]` from the point [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stencil {
    /// Lowest node index per axis.
    pub base: [i32; 3],
    /// Weight per axis and node.
    pub weight: [[f64; WIDTH]; 3],
    /// Node minus point, per axis and node [m].
    pub offset: [[f64; WIDTH]; 3],
}

/// Where the nodes lie: node (i, j, k) at origin + (i hx, j hy, k hz).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// Node (0, 0, 0) [m].
    pub origin: Vec3,
    /// Distance of neighbouring nodes per axis [m].
    pub spacing: Vec3,
}

impl Lattice {
    /// Position of a node [m].
    pub fn position(&self, node: [i32; 3]) -> Vec3 {
        self.origin
            + Vec3::new(
                f64::from(node[0]) * self.spacing.x,
                f64::from(node[1]) * self.spacing.y,
                f64::from(node[2]) * self.spacing.z,
            )
    }

    /// Volume of one cell [m³].
    pub fn cell_volume(&self) -> f64 {
        self.spacing.product()
    }

    /// Largest volume of a point [m³], that of its kernel, two cells wide along every
    /// axis: a point alone in it can't tell how much more room there is.
    pub fn largest_point_volume(&self) -> f64 {
        8.0 * self.cell_volume()
    }

    /// Smallest spacing [m].
    pub fn finest_spacing(&self) -> f64 {
        self.spacing.min()
    }

    /// Second moment of the kernel per axis, h²/4 [m²]: Σ w (x_i − x_p)².
    pub fn kernel_moment(&self) -> Vec3 {
        self.spacing.component_mul(&self.spacing) * 0.25
    }

    /// Lowest node a point at `x` touches, per axis.
    pub fn base(&self, x: &Vec3) -> [i32; 3] {
        let in_cells = (x - self.origin).component_div(&self.spacing);
        [0, 1, 2].map(|axis| floor(in_cells[axis] - 0.5))
    }

    /// The nodes a point at `x` touches, their weights and offsets.
    pub fn stencil(&self, x: &Vec3) -> Stencil {
        let mut stencil = Stencil {
            base: [0; 3],
            weight: [[0.0; WIDTH]; 3],
            offset: [[0.0; WIDTH]; 3],
        };
        for axis in 0..3 {
            let h = self.spacing[axis];
            let in_cells = (x[axis] - self.origin[axis]) / h;
            let base = floor(in_cells - 0.5);
            let f = in_cells - f64::from(base);
            stencil.base[axis] = base;
            stencil.weight[axis] = [
                0.5 * (1.5 - f) * (1.5 - f),
                0.75 - (f - 1.0) * (f - 1.0),
                0.5 * (f - 0.5) * (f - 0.5),
            ];
            stencil.offset[axis] = [-f * h, (1.0 - f) * h, (2.0 - f) * h];
        }
        stencil
    }
}

/// Largest whole number not above `x`. The library's own is a call on
/// processors that are not assumed to round in hardware.
fn floor(x: f64) -> i32 {
    let towards_zero = x as i32;
    towards_zero - i32::from(f64::from(towards_zero) > x)
}

/// Share of the kernel above a plane `height` node distances below its node.
pub fn share_above(height: f64) -> f64 {
    let beyond = (REACH - height.abs()).max(0.0);
    let below = if height.abs() < 0.5 {
        0.5 - 0.75 * height.abs() + height.abs().powi(3) / 3.0
    } else {
        beyond.powi(3) / 6.0
    };
    if height > 0.0 { 1.0 - below } else { below }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        // Moments of the quadratic B-spline: Σw = 1, Σw d = 0, Σw d² = h²/4,
        // to rounding of positions of order 10 m.
        #[test]
        fn moments_are_those_of_the_spline(x in -9.0..9.0f64, y in -1.0..1.0f64, z in 0.0..3.0f64) {
            let lattice = Lattice { origin: Vec3::new(-9.5, -1.0, 0.0), spacing: Vec3::new(0.01, 0.012, 0.01) };
            let stencil = lattice.stencil(&Vec3::new(x, y, z));
            let moment = lattice.kernel_moment();
            for axis in 0..3 {
                let w = stencil.weight[axis];
                let d = stencil.offset[axis];
                let sum = |power: i32| (0..WIDTH).map(|a| w[a] * d[a].powi(power)).sum::<f64>();
                prop_assert!((sum(0) - 1.0).abs() < 1e-12);
                prop_assert!(sum(1).abs() < 1e-14);
                prop_assert!((sum(2) - moment[axis]).abs() < 1e-15);
            }
        }
    }

    /// Quadratic B-spline at a distance from its node.
    fn kernel(x: f64) -> f64 {
        match x.abs() {
            x if x < 0.5 => 0.75 - x * x,
            x if x < 1.5 => 0.5 * (1.5 - x).powi(2),
            _ => 0.0,
        }
    }

    // The midpoint rule on 3,000 strips, good to some 1e-7.
    #[test]
    fn the_room_above_a_wall_is_the_integral_of_the_kernel() {
        for height in [-1.6, -1.2, -0.5, -0.2, 0.0, 0.3, 0.5, 1.1, 1.5, 2.0] {
            let strips = (0..3000).map(|k| -1.5 + (f64::from(k) + 0.5) * 1e-3);
            let above = strips.filter(|x| *x > -height).map(|x| kernel(x) * 1e-3);
            let sum: f64 = above.sum();
            assert!((share_above(height) - sum).abs() < 1e-6, "{height}: {sum}");
        }
    }
}
