//! Quadratic B-spline kernel: the stencil of 3 × 3 × 3 nodes of a point (docs/method.md,
//! equation 7).

use crate::math::Vec3;

/// Nodes of a stencil per axis.
pub const WIDTH: usize = 3;
/// Nodes with which a point exchanges momentum: place and weight of each.
pub type PointStencil = [(u32, f64); WIDTH * WIDTH * WIDTH];
/// Half the kernel's width [node distances].
pub const REACH: f64 = 1.5;

/// The stencil of a point, per axis. The weight of node (a, b, c) is `weight[0][a] ·
/// weight[1][b] · weight[2][c]`, and it lies at `offset[axis][·]` from the point [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stencil {
    /// Lowest node index per axis.
    pub base: [i32; 3],
    /// Weight per axis and node.
    pub weight: [[f64; WIDTH]; 3],
    /// Node minus point, per axis and node [m].
    pub offset: [[f64; WIDTH]; 3],
}

/// Lattice of the nodes: node (i, j, k) at origin + (i hx, j hy, k hz).
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

    /// Largest volume of a point [m³], that of its kernel, two cells wide along every axis: a point
    /// alone in it can't detect more available volume.
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

    /// Lowest node of the stencil of a point at `x`, per axis.
    pub fn base(&self, x: &Vec3) -> [i32; 3] {
        let in_cells = (x - self.origin).component_div(&self.spacing);
        [0, 1, 2].map(|axis| floor(in_cells[axis] - 0.5))
    }

    /// The stencil of a point at `x`, with weights and offsets.
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

/// Largest whole number not above `x`. The library's version is a call on processors that are
/// not assumed to round in hardware.
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

/// Share of the kernel above two planes, each so many node distances below its node;
/// `cosine` is that of the angle between their normals.
pub fn share_above_both(heights: [f64; 2], cosine: f64) -> f64 {
    /// Strips across the first plane's normal: accurate to some 1e-3.
    const STRIPS: u32 = 32;
    let [first, second] = heights;
    if first.min(second) <= -REACH {
        return 0.0;
    }
    if first.max(second) >= REACH {
        return share_above(first.min(second));
    }
    // Planes that nearly coincide still have a side each.
    let sine = (1.0 - cosine * cosine).max(1e-12).sqrt();
    let width = (first + REACH) / f64::from(STRIPS);
    let of_strip = |strip| {
        let along = (f64::from(strip) + 0.5) * width - first;
        weight(along) * share_above((second + along * cosine) / sine) * width
    };
    (0..STRIPS).map(of_strip).sum()
}

/// The quadratic B-spline, so many node distances from its node.
fn weight(distance: f64) -> f64 {
    let distance = distance.abs();
    if distance < 0.5 {
        0.75 - distance * distance
    } else {
        0.5 * (REACH - distance).max(0.0).powi(2)
    }
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

    // The midpoint rule on 3,000 strips, accurate to some 1e-7.
    #[test]
    fn the_room_above_a_wall_is_the_integral_of_the_kernel() {
        for height in [-1.6, -1.2, -0.5, -0.2, 0.0, 0.3, 0.5, 1.1, 1.5, 2.0] {
            let strips = (0..3000).map(|k| -1.5 + (f64::from(k) + 0.5) * 1e-3);
            let above = strips.filter(|x| *x > -height).map(|x| weight(x) * 1e-3);
            let sum: f64 = above.sum();
            assert!((share_above(height) - sum).abs() < 1e-6, "{height}: {sum}");
        }
    }
    // Two coincident planes; a right angle, where shares multiply; and one at 150°, by squares of
    // a hundredth of a node distance.
    #[test]
    fn the_room_above_two_walls_is_the_integral_of_the_kernel() {
        for height in [-0.7, 0.0, 0.4] {
            let both = share_above_both([height, height], 1.0);
            assert!(
                (both - share_above(height)).abs() < 1e-3,
                "{height}: {both}"
            );
            let both = share_above_both([height, 0.3], 0.0);
            let product = share_above(height) * share_above(0.3);
            assert!((both - product).abs() < 1e-3, "{height}: {both}");
        }
        let (sine, cosine) = 30f64.to_radians().sin_cos();
        for heights in [[0.0, 0.0], [0.3, -0.4], [-0.6, 0.9], [-1.2, -1.0]] {
            let places = |k| (f64::from(k) + 0.5) * 0.01 - 1.5;
            let mut sum = 0.0;
            for (u, t) in (0..300).flat_map(|i| (0..300).map(move |k| (places(i), places(k)))) {
                if u > -heights[0] && cosine * u + sine * t > -heights[1] {
                    sum += weight(u) * weight(t) * 1e-4;
                }
            }
            let both = share_above_both(heights, cosine);
            assert!((both - sum).abs() < 2e-3, "{heights:?}: {both}, {sum}");
        }
    }
}
