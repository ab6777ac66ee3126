//! Transfers between points and grid (docs/method.md, equations 8–13).
//!
//! ∇w_i stands for w_i M⁻¹ (x_i − x_p) with the kernel's second moment M, the gradient of
//! moving least squares (equation 7).
//!
//! Within one step the weights stay those of the transfer; the displaced nodes carry the
//! deformation F̂ of every point (transfer sub-cycling).

use crate::grid::{Grid, Node, PointBlock, TILE, Tile, in_tile};
use crate::kernel::{Stencil, WIDTH};
use crate::material::Material;
use crate::math::{Mat3, Sym3, Vec3};
use crate::points::{Deformation, Point};
use crate::redistribution::{
    PointState, RedistributionRates, Shifting, clamp_normal_velocity, excess_volume_fraction,
    limit_shift_at_bed,
};
use crate::strain_rate_smoothing::StrainRateSmoothing;
use crate::walls::Plane;
use rayon::prelude::*;

/// Rows of nodes along z in a stencil, by their place in the tile.
const ROWS: [usize; WIDTH * WIDTH] = {
    let mut rows = [0; WIDTH * WIDTH];
    let mut row = 0;
    while row < rows.len() {
        rows[row] = in_tile(row / WIDTH, row % WIDTH, 0);
        row += 1;
    }
    rows
};

/// Scatters node mass and velocity from the points (equation 8): m_i = Σ w m, m_i v_i = Σ w m
/// (v + C (x_i − x_p)).
pub fn scatter_momentum(points: &[Point], grid: &mut Grid) {
    let lattice = *grid.lattice();
    grid.scatter(
        |block, tile| {
            for point in &points[block.points.clone()] {
                let stencil = lattice.stencil(&point.position);
                let motion = (&point.velocity, &point.affine);
                let mass = Carried::with_motion(point.mass, point.mass, motion);
                scatter_affine(block, &stencil, &mass, tile);
            }
        },
        |node, [mass, px, py, pz]| {
            *node = Node {
                mass,
                velocity: if mass > 0.0 {
                    Vec3::new(px, py, pz) / mass
                } else {
                    Vec3::zeros()
                },
                ..Node::EMPTY
            };
        },
    );
}

/// Scatters the residual of the first scatter, and the compressive strain: the difference
/// between the points' own motion and that of the nodes at the points goes to the nodes as well
/// (equations 8a and 39).
pub fn residual_transfer(points: &[Point], bulk_density: f64, grid: &mut Grid) {
    let lattice = *grid.lattice();
    let inverse_moment = Mat3::from_diagonal(&lattice.kernel_moment().map(f64::recip));
    let room = lattice.spacing.product() * bulk_density;
    let mut missing = vec![(Vec3::zeros(), Mat3::zeros()); points.len()];
    for_each_block(grid, &mut missing, |block, missing| {
        let velocities = grid.tile_of(block, velocity_of);
        for (point, missing) in points[block.points.clone()].iter().zip(missing) {
            let stencil = lattice.stencil(&point.position);
            let shown = gather_moments(block, &stencil, &velocities);
            *missing = (
                point.velocity - shown.zeroth,
                point.affine - shown.first * inverse_moment,
            );
        }
    });
    grid.scatter(
        |block, tile| {
            for place in block.points.clone() {
                let point = &points[place];
                let (velocity, affine) = &missing[place];
                let stencil = lattice.stencil(&point.position);
                let compressive = (point.volume * bulk_density / point.mass - 1.0).min(0.0);
                let rest =
                    Carried::with_motion(point.mass * compressive, point.mass, (velocity, affine));
                scatter_affine(block, &stencil, &rest, tile);
            }
        },
        |node, [compressive, px, py, pz]| {
            if node.mass > 0.0 {
                node.velocity += Vec3::new(px, py, pz) / node.mass;
                node.compressive_strain = compressive / node.mass;
            }
            node.volume_fraction = (node.mass + compressive) / room;
        },
    );
}

/// Mean strain rate of the points of every node, Σ w m D / m_i (equation 42a).
pub fn scatter_strain_rates(points: &[Point], grid: &mut Grid) {
    scatter_means(
        points,
        grid,
        |d| [d.xx, d.yy, d.zz, d.xy],
        |d, [xx, yy, zz, xy]| {
            *d = Sym3 {
                xx,
                yy,
                zz,
                xy,
                ..Sym3::default()
            };
        },
    );
    scatter_means(
        points,
        grid,
        |d| [d.xz, d.yz, 0.0, 0.0],
        |d, [xz, yz, ..]| (d.xz, d.yz) = (xz, yz),
    );
}

fn scatter_means(
    points: &[Point],
    grid: &mut Grid,
    give: impl Fn(&Sym3) -> [f64; 4] + Sync,
    take: impl Fn(&mut Sym3, [f64; 4]) + Sync,
) {
    let lattice = *grid.lattice();
    grid.scatter(
        |block, tile| {
            for point in &points[block.points.clone()] {
                let stencil = lattice.stencil(&point.position);
                let given = Carried {
                    constant: give(&Sym3::of(&point.affine)).map(|part| point.mass * part),
                    slope: [[0.0; 4]; 3],
                };
                scatter_affine(block, &stencil, &given, tile);
            }
        },
        |node, sum| {
            if node.mass > 0.0 {
                take(&mut node.strain_rate, sum.map(|part| part / node.mass));
            }
        },
    );
}

/// Computes the smoothed part of every point's effective strain rate (equation 42a).
pub fn smooth_strain_rates(
    grid: &Grid,
    points: &[Point],
    strain_rate_smoothing: &StrainRateSmoothing,
    deformations: &mut [Deformation],
) {
    let lattice = *grid.lattice();
    for_each_block(grid, deformations, |block, deformations| {
        let first = grid.tile_of(block, |node| {
            let d = &node.strain_rate;
            [d.xx, d.yy, d.zz, d.xy]
        });
        let second = grid.tile_of(block, |node| {
            [node.strain_rate.xz, node.strain_rate.yz, 0.0, 0.0]
        });
        for (point, deformation) in points[block.points.clone()].iter().zip(deformations) {
            let stencil = lattice.stencil(&point.position);
            let upper = gather_moments(block, &stencil, &first);
            let lower = gather_moments(block, &stencil, &second);
            let mean = Sym3 {
                xx: upper.zeroth.x,
                yy: upper.zeroth.y,
                zz: upper.zeroth.z,
                xy: upper.last,
                xz: lower.zeroth.x,
                yz: lower.zeroth.y,
            };
            let own = Sym3::of(&point.affine);
            deformation.shared = strain_rate_smoothing.of(&own, &mean, point.velocity.norm());
        }
    });
}

/// Node forces of stress and contact (equation 9):
/// f_i = Σ (−V σ F̂⁻ᵀ ∇w_i + w_i f_p).
pub fn scatter_forces(
    points: &[Point],
    deformations: &[Deformation],
    contact_forces: &[Vec3],
    grid: &mut Grid,
) {
    let lattice = *grid.lattice();
    let inverse_moment = Mat3::from_diagonal(&lattice.kernel_moment().map(f64::recip));
    grid.scatter(
        |block, tile| {
            for place in block.points.clone() {
                let (point, contact) = (&points[place], &contact_forces[place]);
                let stencil = lattice.stencil(&point.position);
                let stress = point.stress.matrix() * deformations[place].inverse.transpose();
                let force = Carried {
                    constant: [0.0, contact.x, contact.y, contact.z],
                    slope: slopes(&(stress * inverse_moment * -point.volume)),
                };
                scatter_affine(block, &stencil, &force, tile);
            }
        },
        |node, [_, fx, fy, fz]| node.force = Vec3::new(fx, fy, fz),
    );
}

/// Velocity gradient at every point, L = (Σ v_i ⊗ ∇w_i) F̂⁻¹, and the
/// deformation after the sub-step, F̂ + Δt Σ v_i ⊗ ∇w_i (equation 11).
pub fn gather_gradient(grid: &Grid, points: &[Point], dt: f64, deformations: &mut [Deformation]) {
    let lattice = *grid.lattice();
    let inverse_moment = Mat3::from_diagonal(&lattice.kernel_moment().map(f64::recip));
    for_each_block(grid, deformations, |block, deformations| {
        let velocities = grid.tile_of(block, velocity_of);
        for (point, deformation) in points[block.points.clone()].iter().zip(deformations) {
            let stencil = lattice.stencil(&point.position);
            let moments = gather_moments(block, &stencil, &velocities);
            let at_transfer = moments.first * inverse_moment;
            deformation.advance(&at_transfer, dt);
        }
    });
}

/// Ends a step: velocity, affine velocity and position of every point from the displaced nodes
/// (equations 12 and 13), and particle redistribution (equations 39–42). Returns the changes of
/// their sums.
///
/// The affine velocity is the gradient on the displaced nodes, C F̂⁻¹, but no steeper for a
/// point having been compressed, with its skew part set so that points and displaced nodes have
/// the same angular momentum.
pub fn gather_motion(
    grid: &Grid,
    deformations: &[Deformation],
    material: &Material,
    redistribution: &RedistributionRates,
    base: &[Plane],
    points: &mut [Point],
) -> Shifting {
    let lattice = *grid.lattice();
    let moment = lattice.kernel_moment();
    let inverse_moment = Mat3::from_diagonal(&moment.map(f64::recip));
    let spread = for_each_block(grid, points, |block, points| {
        let mut spread = Shifting::default();
        let velocities = grid.tile_of(block, |node| {
            let v = &node.velocity;
            [v.x, v.y, v.z, excess_volume_fraction(node.volume_fraction)]
        });
        let displacements = grid.tile_of(block, |node| {
            [
                node.displacement.x,
                node.displacement.y,
                node.displacement.z,
                node.compressive_strain,
            ]
        });
        let deformations = &deformations[block.points.clone()];
        for (point, deformation) in points.iter_mut().zip(deformations) {
            let stencil = lattice.stencil(&point.position);
            let velocity = gather_moments(block, &stencil, &velocities);
            let moved = gather_moments(block, &stencil, &displacements);
            let displacement = moved.zeroth;
            let outer = gather_outer(block, &stencil, &velocities, &displacements);
            // Σ w v_i (x_i' − x_p')ᵀ on the displaced nodes.
            let on_displaced = velocity.first + outer - velocity.zeroth * displacement.transpose();
            let gradient = velocity.first * inverse_moment * deformation.inverse_at_most();
            point.velocity = velocity.zeroth;
            point.affine = with_angular_momentum(&gradient, &on_displaced, &moment);
            let volumetric_strain = |volume: f64| volume * material.bulk_density / point.mass - 1.0;
            let seen = PointState {
                volumetric_strain: volumetric_strain(point.volume),
                compression_at_transfer: volumetric_strain(deformation.transfer_volume).min(0.0),
                mean_compression: moved.last,
                excess_volume_fraction: velocity.last,
                slope: inverse_moment * velocity.last_first,
            };
            let travel = displacement.component_div(&lattice.spacing).norm();
            let redistributed = redistribution.of(&seen, travel, &lattice.spacing);
            point.position += displacement;
            let shift = limit_shift_at_bed(
                &redistributed.shift,
                &displacement,
                &point.position,
                base,
                &lattice.spacing,
            );
            let stop =
                clamp_normal_velocity(&point.velocity, &point.position, base, &lattice.spacing);
            point.velocity += stop;
            spread.stopped.add_at(&point.position, &(stop * point.mass));
            point.position += shift;
            spread.add(point.mass, &shift, &point.velocity);
            point.volume += point.mass / material.bulk_density
                * (redistributed.volumetric_strain - seen.volumetric_strain);
            point.volume = point.volume.min(lattice.largest_point_volume());
            point.stress =
                material.pressed_anew(&point.stress, redistributed.rise, point.density());
        }
        spread
    });
    spread.iter().fold(Shifting::default(), Shifting::plus)
}

/// `gradient` with the skew part for which (affine · h²/4) has the skew part of `target`.
fn with_angular_momentum(gradient: &Mat3, target: &Mat3, moment: &Vec3) -> Mat3 {
    let mut affine = *gradient;
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        let symmetric = 0.5 * (gradient[(a, b)] + gradient[(b, a)]);
        let wanted = target[(a, b)] - target[(b, a)];
        let skew = (wanted - symmetric * (moment[b] - moment[a])) / (moment[a] + moment[b]);
        affine[(a, b)] = symmetric + skew;
        affine[(b, a)] = symmetric - skew;
    }
    affine
}

fn velocity_of(node: &Node) -> [f64; 4] {
    [node.velocity.x, node.velocity.y, node.velocity.z, 0.0]
}

/// A quantity that varies linearly about the point: constant + slope · d.
struct Carried {
    constant: [f64; 4],
    slope: [[f64; 4]; 3],
}

impl Carried {
    /// A number, and the momentum of a mass [kg] with this velocity and affine
    /// velocity.
    fn with_motion(first: f64, mass: f64, (velocity, affine): (&Vec3, &Mat3)) -> Self {
        Self {
            constant: [
                first,
                mass * velocity.x,
                mass * velocity.y,
                mass * velocity.z,
            ],
            slope: slopes(&(affine * mass)),
        }
    }
}

/// Columns of a matrix as slopes of components 1..4.
fn slopes(matrix: &Mat3) -> [[f64; 4]; 3] {
    [0, 1, 2].map(|axis| {
        let column = matrix.column(axis);
        [0.0, column[0], column[1], column[2]]
    })
}

fn scatter_affine(block: &PointBlock, stencil: &Stencil, carried: &Carried, tile: &mut Tile) {
    let base = block.tile_base(stencil.base);
    let [wx, wy, wz] = &stencil.weight;
    let [dx, dy, dz] = &stencil.offset;
    let [slope_x, slope_y, slope_z] = &carried.slope;
    for (n, row) in ROWS.iter().enumerate() {
        let (a, b) = (n / WIDTH, n % WIDTH);
        let weight = wx[a] * wy[b];
        let start: [f64; 4] = std::array::from_fn(|k| {
            weight * (carried.constant[k] + slope_x[k] * dx[a] + slope_y[k] * dy[b])
        });
        let nodes = &mut tile[base + row..][..WIDTH];
        for c in 0..WIDTH {
            let along = weight * dz[c];
            for k in 0..4 {
                nodes[c][k] += wz[c] * (start[k] + slope_z[k] * along);
            }
        }
    }
}

/// Σ w q and Σ w q dᵀ of a nodal vector q.
struct Moments {
    zeroth: Vec3,
    first: Mat3,
    /// The moment of the scalar beside it.
    last: f64,
    last_first: Vec3,
}

fn gather_moments(block: &PointBlock, stencil: &Stencil, tile: &Tile) -> Moments {
    let base = block.tile_base(stencil.base);
    let [wx, wy, wz] = &stencil.weight;
    let [dx, dy, dz] = &stencil.offset;
    let wdz = [wz[0] * dz[0], wz[1] * dz[1], wz[2] * dz[2]];
    let mut sums = [[0.0; 4]; 4];
    for (n, row) in ROWS.iter().enumerate() {
        let (a, b) = (n / WIDTH, n % WIDTH);
        let weight = wx[a] * wy[b];
        let nodes = &tile[base + row..][..WIDTH];
        for k in 0..4 {
            let plain = wz[0] * nodes[0][k] + wz[1] * nodes[1][k] + wz[2] * nodes[2][k];
            let along = wdz[0] * nodes[0][k] + wdz[1] * nodes[1][k] + wdz[2] * nodes[2][k];
            sums[0][k] += weight * plain;
            sums[1][k] += weight * dx[a] * plain;
            sums[2][k] += weight * dy[b] * plain;
            sums[3][k] += weight * along;
        }
    }
    let column = |sum: [f64; 4]| Vec3::new(sum[0], sum[1], sum[2]);
    Moments {
        zeroth: column(sums[0]),
        first: Mat3::from_columns(&[column(sums[1]), column(sums[2]), column(sums[3])]),
        last: sums[0][3],
        last_first: Vec3::new(sums[1][3], sums[2][3], sums[3][3]),
    }
}

/// Σ w q rᵀ of two nodal vectors.
fn gather_outer(block: &PointBlock, stencil: &Stencil, q: &Tile, r: &Tile) -> Mat3 {
    let base = block.tile_base(stencil.base);
    let mut outer = Mat3::zeros();
    for a in 0..WIDTH {
        for b in 0..WIDTH {
            for c in 0..WIDTH {
                let weight = stencil.weight[0][a] * stencil.weight[1][b] * stencil.weight[2][c];
                let place = base + (a * TILE + b) * TILE + c;
                let (q, r) = (&q[place], &r[place]);
                outer +=
                    Vec3::new(q[0], q[1], q[2]) * weight * Vec3::new(r[0], r[1], r[2]).transpose();
            }
        }
    }
    outer
}

/// Runs over the blocks of points in parallel, each with its own part of a list with one entry
/// per point; the results are in the order of the blocks.
fn for_each_block<T: Send, R: Send>(
    grid: &Grid,
    list: &mut [T],
    visit: impl Fn(&PointBlock, &mut [T]) -> R + Sync,
) -> Vec<R> {
    let mut rest = list;
    let mut shares = Vec::with_capacity(grid.point_blocks().len());
    for block in grid.point_blocks() {
        let (share, tail) = rest.split_at_mut(block.points.len());
        rest = tail;
        shares.push((block, share));
    }
    shares
        .into_par_iter()
        .map(|(block, share)| visit(block, share))
        .collect()
}

#[cfg(test)]
mod tests;
