//! A step of the method as in a textbook, which the kernels are held against: scalars in double
//! precision, one point and one node at a time, every formula as it stands in docs/method.md.
//! Neither walls nor bodies, neither blocks nor tiles.

use crate::kernel::Lattice;
use crate::material::{Material, Yielding};
use crate::math::{Mat3, Sym3, Vec3};
use crate::method::METHOD;
use crate::mpm::redistribution::RedistributionRates;
use crate::mpm::strain_rate_smoothing::StrainRateSmoothing;
use crate::points::Point;
use crate::walls::Plane;
use std::collections::BTreeMap;

/// Node of the grid.
#[derive(Debug, Clone, Copy, Default)]
struct Node {
    /// Mass [kg].
    mass: f64,
    /// Velocity [m/s].
    velocity: Vec3,
    displacement: Vec3,
    strain_rate: Mat3,
    compressive: f64,
    volume_fraction: f64,
}

/// Deformation of a point since the transfer.
struct Deformation {
    gradient: Mat3,
    transfer_volume: f64,
    /// Strain rate that smoothing adds.
    smoothing: Sym3,
}

/// A step of a flow without walls and bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct ReferenceStep<'a> {
    /// Lattice of the nodes.
    pub(super) lattice: Lattice,
    /// Material of the points.
    pub(super) material: Material,
    /// Gravity [m/s²].
    pub(super) gravity: Vec3,
    /// Length of a sub-step [s].
    pub(super) dt: f64,
    /// Number of sub-steps.
    pub(super) substeps: u32,
    /// Strain-rate smoothing.
    pub(super) smoothing: StrainRateSmoothing,
    /// Rates of redistribution.
    pub(super) redistribution: RedistributionRates,
    /// Planes of the bed, for redistribution alone.
    pub(super) bed: &'a [Plane],
}

/// Index, weight and offset from the point [m] of each node of a stencil.
fn stencil(lattice: &Lattice, position: &Vec3) -> Vec<([i32; 3], f64, Vec3)> {
    let s = lattice.stencil(position);
    let nodes = (0..27).map(|n| [n / 9, n / 3 % 3, n % 3]);
    nodes
        .map(|[a, b, c]| {
            let index = [
                s.base[0] + a as i32,
                s.base[1] + b as i32,
                s.base[2] + c as i32,
            ];
            let weight = s.weight[0][a] * s.weight[1][b] * s.weight[2][c];
            let offset = Vec3::new(s.offset[0][a], s.offset[1][b], s.offset[2][c]);
            (index, weight, offset)
        })
        .collect()
}

type Nodes = BTreeMap<[i32; 3], Node>;

impl ReferenceStep<'_> {
    /// Takes the points through the step.
    pub(super) fn advance(&self, points: &mut [Point]) {
        let mut nodes = self.transfer(points);
        let mut deformations: Vec<Deformation> = points
            .iter()
            .map(|point| self.start(point, &nodes))
            .collect();
        for _ in 0..self.substeps {
            self.update_grid(points, &deformations, &mut nodes);
            for (point, deformation) in points.iter_mut().zip(&mut deformations) {
                self.update_stress(point, deformation, &nodes);
            }
        }
        for (point, deformation) in points.iter_mut().zip(&deformations) {
            self.gather(point, deformation, &nodes);
        }
    }

    /// Inverse of the kernel's second moment.
    fn inverse_moment(&self) -> Mat3 {
        Mat3::from_diagonal(&self.lattice.kernel_moment().map(f64::recip))
    }

    /// Both transfers: equations 8, 8a, 39 and 42a.
    fn transfer(&self, points: &[Point]) -> Nodes {
        let mut nodes = Nodes::new();
        for point in points {
            let rate = 0.5 * (point.affine + point.affine.transpose());
            for (index, w, offset) in stencil(&self.lattice, &point.position) {
                let node = nodes.entry(index).or_default();
                node.mass += w * point.mass;
                node.velocity += (point.velocity + point.affine * offset) * (w * point.mass);
                node.strain_rate += rate * (w * point.mass);
            }
        }
        for node in nodes.values_mut() {
            node.velocity /= node.mass;
            node.strain_rate /= node.mass;
        }
        let mut residual: BTreeMap<[i32; 3], (Vec3, f64)> = BTreeMap::new();
        for point in points {
            let here = stencil(&self.lattice, &point.position);
            let (velocity, moment) = self.moments(&here, &nodes);
            let velocity = point.velocity - velocity;
            let affine = point.affine - moment * self.inverse_moment();
            let strain = point.volume * self.material.bulk_density / point.mass - 1.0;
            for (index, w, offset) in here {
                let (momentum, compressive) = residual.entry(index).or_default();
                *momentum += (velocity + affine * offset) * (w * point.mass);
                *compressive += w * point.mass * strain.min(0.0);
            }
        }
        let full = self.material.bulk_density * self.lattice.cell_volume();
        for (index, (momentum, compressive)) in residual {
            let node = nodes.entry(index).or_default();
            node.velocity += momentum / node.mass;
            node.compressive = compressive / node.mass;
            node.volume_fraction = (node.mass + compressive) / full;
        }
        nodes
    }

    /// Σ w v_i and Σ w v_i dᵀ.
    fn moments(&self, stencil: &[([i32; 3], f64, Vec3)], nodes: &Nodes) -> (Vec3, Mat3) {
        let (mut zeroth, mut first) = (Vec3::zeros(), Mat3::zeros());
        for (index, w, offset) in stencil {
            zeroth += nodes[index].velocity * *w;
            first += nodes[index].velocity * *w * offset.transpose();
        }
        (zeroth, first)
    }

    /// State of a point at the transfer (equation 42a).
    fn start(&self, point: &Point, nodes: &Nodes) -> Deformation {
        let mut mean = Mat3::zeros();
        for (index, w, _) in stencil(&self.lattice, &point.position) {
            mean += nodes[&index].strain_rate * w;
        }
        let lacking = Sym3::of(&(mean - Sym3::of(&point.affine).matrix())).deviator();
        let degree = (point.velocity.norm() / self.smoothing.full_speed).min(1.0);
        Deformation {
            gradient: Mat3::identity(),
            transfer_volume: point.volume,
            smoothing: lacking.times(self.smoothing.share * degree.powi(2)),
        }
    }

    /// Grid update: equations 9 and 10.
    fn update_grid(&self, points: &[Point], deformations: &[Deformation], nodes: &mut Nodes) {
        let mut forces: BTreeMap<[i32; 3], Vec3> = BTreeMap::new();
        for (point, deformation) in points.iter().zip(deformations) {
            let (_, inverse) = inverted(&deformation.gradient);
            let stress = point.stress.matrix() * inverse.transpose() * self.inverse_moment();
            for (index, w, offset) in stencil(&self.lattice, &point.position) {
                *forces.entry(index).or_default() -= stress * offset * (w * point.volume);
            }
        }
        for (index, node) in nodes {
            node.velocity += (forces[index] / node.mass + self.gravity) * self.dt;
            node.displacement += node.velocity * self.dt;
        }
    }

    /// Stress update: equations 11 and 2–6.
    fn update_stress(&self, point: &mut Point, deformation: &mut Deformation, nodes: &Nodes) {
        let (_, moment) = self.moments(&stencil(&self.lattice, &point.position), nodes);
        let at_transfer = moment * self.inverse_moment();
        let (_, inverse) = inverted(&deformation.gradient);
        let velocity_gradient = at_transfer * inverse + deformation.smoothing.matrix();
        deformation.gradient += at_transfer * self.dt;
        point.volume = deformation.transfer_volume * deformation.gradient.determinant();
        point.stress = stress(
            &self.material,
            &point.stress,
            &velocity_gradient,
            point.density(),
            self.material.bulk_viscosity(self.lattice.finest_spacing()),
            self.dt,
        );
    }

    /// Transfer back and redistribution: equations 12, 13 and 39–42c.
    fn gather(&self, point: &mut Point, deformation: &Deformation, nodes: &Nodes) {
        let here = stencil(&self.lattice, &point.position);
        let (velocity, moment) = self.moments(&here, nodes);
        let (mut displacement, mut outer) = (Vec3::zeros(), Mat3::zeros());
        let (mut compressive, mut excess, mut slope) = (0.0, 0.0, Vec3::zeros());
        for (index, w, offset) in &here {
            let node = &nodes[index];
            displacement += node.displacement * *w;
            outer += node.velocity * *w * node.displacement.transpose();
            compressive += w * node.compressive;
            let crowd = (node.volume_fraction - 1.0).clamp(0.0, 1.0);
            excess += w * crowd;
            slope += offset * (w * crowd);
        }
        let (determinant, inverse) = inverted(&deformation.gradient);
        let gradient = moment * self.inverse_moment() * inverse * determinant.min(1.0);
        let on_displaced = moment + outer - velocity * displacement.transpose();
        point.affine = with_skew_part_of(&gradient, &on_displaced, &self.lattice.kernel_moment());
        point.velocity = velocity;
        point.position += displacement;
        let density = self.material.bulk_density;
        let strain = |volume: f64| volume * density / point.mass - 1.0;
        let h = self.lattice.spacing;
        let rates = &self.redistribution;
        let travel = displacement.component_div(&h).norm();
        let degree = (travel / rates.full_travel.max(f64::MIN_POSITIVE))
            .min(1.0)
            .powi(2);
        let in_cells = (self.inverse_moment() * slope).component_mul(&h) * (-rates.shift * degree);
        let shorter = (METHOD.redistribution.largest_shift / in_cells.norm()).min(1.0);
        let mut shift = (in_cells * shorter).component_mul(&h);
        let rise =
            degree * (rates.pressure_correction * excess).min(METHOD.redistribution.largest_rise);
        let before = strain(deformation.transfer_volume).min(0.0);
        let averaged =
            strain(point.volume) + degree * rates.volumetric_smoothing * (compressive - before);
        let strained = averaged - rise * (-averaged).max(0.0);
        point.volume = point.mass / density * (1.0 + strained);
        point.volume = point.volume.min(self.lattice.largest_point_volume());
        let deviator = point.stress.deviator().times(1.0 + rise);
        let pressure = self.material.pressure(point.density());
        point.stress = deviator.plus(&Sym3::isotropic(-pressure));
        for plane in self.bed {
            let width = plane.normal.component_mul(&h).norm();
            let height = plane.height(&point.position);
            let into = |way: &Vec3| (-plane.normal.dot(way)).max(0.0);
            if height < METHOD.redistribution.no_shift_height * width {
                shift += plane.normal * into(&shift);
            }
            if height < -METHOD.redistribution.deepest_penetration * width {
                shift += plane.normal * into(&displacement);
                point.velocity += plane.normal * into(&point.velocity);
            }
        }
        point.position += shift;
    }
}

/// `gradient` with the skew part that makes (affine · h²/4) have the skew part of `target`
/// (equation 13).
fn with_skew_part_of(gradient: &Mat3, target: &Mat3, moment: &Vec3) -> Mat3 {
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

/// Stress [Pa] after `dt` [s] of a velocity gradient [1/s], at the density reached [kg/m³]
/// (equations 3–6).
pub(super) fn stress(
    material: &Material,
    stress: &Sym3,
    gradient: &Mat3,
    density: f64,
    bulk_viscosity: f64,
    dt: f64,
) -> Sym3 {
    let pressure = material.pressure(density);
    if pressure <= 0.0 && material.is_granular() {
        return Sym3::default();
    }
    let deviator = stress.deviator();
    let strain_rate = Sym3::of(gradient).deviator();
    let rate =
        jaumann_spin(&deviator, gradient).plus(&strain_rate.times(2.0 * material.shear_modulus));
    let trial = deviator.plus(&rate.times(dt));
    let trial_shear = trial.equivalent_shear();
    let shear = shear_stress(material, trial_shear, pressure, dt);
    let factor = if shear < trial_shear {
        shear / trial_shear
    } else {
        1.0
    };
    let resisted = if material.is_granular() {
        (-bulk_viscosity * gradient.trace()).max(-pressure)
    } else {
        0.0
    };
    trial
        .times(factor)
        .plus(&Sym3::isotropic(-pressure - resisted))
}

/// Equivalent shear stress [Pa] after the return from an elastic trial [Pa] (equation 6).
pub(super) fn shear_stress(material: &Material, trial: f64, pressure: f64, dt: f64) -> f64 {
    let Yielding::Granular {
        static_friction,
        limiting_friction,
        reference_inertial_number,
        grain_diameter,
        grain_density,
    } = material.yielding
    else {
        return trial;
    };
    let at_rest = static_friction * pressure;
    if trial <= at_rest {
        return trial;
    }
    let limit = limiting_friction * pressure;
    let viscous =
        material.shear_modulus * reference_inertial_number * dt * (pressure / grain_density).sqrt()
            / grain_diameter;
    let b = limit + trial + viscous;
    let h = limit * trial + at_rest * viscous;
    2.0 * h / (b + (b * b - 4.0 * h).max(0.0).sqrt())
}

/// W s − s W, the spin term of the Jaumann rate; W is the skew part of the
/// velocity gradient.
fn jaumann_spin(s: &Sym3, gradient: &Mat3) -> Sym3 {
    let a = 0.5 * (gradient.m12 - gradient.m21);
    let b = 0.5 * (gradient.m13 - gradient.m31);
    let c = 0.5 * (gradient.m23 - gradient.m32);
    Sym3 {
        xx: 2.0 * (a * s.xy + b * s.xz),
        yy: 2.0 * (c * s.yz - a * s.xy),
        zz: -2.0 * (b * s.xz + c * s.yz),
        xy: a * (s.yy - s.xx) + b * s.yz + c * s.xz,
        xz: b * (s.zz - s.xx) + a * s.yz - c * s.xy,
        yz: c * (s.zz - s.yy) - a * s.xz - b * s.xy,
    }
}

/// Determinant and inverse of a matrix; the inverse of a singular one is not
/// finite.
pub(super) fn inverted(m: &Mat3) -> (f64, Mat3) {
    let (a, b, c) = (m.column(0), m.column(1), m.column(2));
    let (bc, ca, ab) = (b.cross(&c), c.cross(&a), a.cross(&b));
    let determinant = a.dot(&bc);
    let rows = Mat3::from_columns(&[bc, ca, ab]).transpose();
    (determinant, rows * (1.0 / determinant))
}

mod tests;
