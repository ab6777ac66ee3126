//! A step of the kernels, in either precision, against the reference, and its conservation.

use super::blocks::{Block, Blocks};
use super::constitutive::Law;
use super::fixture::{beads, cloud, lattice, levels};
use super::g2p::{EndTiles, Ending, gather_motion};
use super::lanes::Real;
use super::nodes::Nodes;
use super::p2g::{COMPONENTS, residual_transfer, scatter_momentum, scatter_strain_rates};
use super::packing::Packing;
use super::redistribution::{NoShiftZone, RedistributionRates, Shifting};
use super::reference::ReferenceStep;
use super::rows::Tile;
use super::strain_rate_smoothing::{StrainRateSmoothing, TransferTiles, smooth_strain_rates};
use super::stress_update::update_stress;
use crate::kernel::Lattice;
use crate::material::{Material, Yielding};
use crate::math::{Mat3, Sym3, Vec3};
use crate::points::Point;
use crate::walls::{Impulse, Plane};
use fearless_simd::{Level, dispatch};

const GRAVITY: Vec3 = Vec3::new(1.0, 0.5, -9.81);
const DT: f64 = 1e-4;

/// A slope through the cloud.
fn slope() -> [Plane; 1] {
    [Plane {
        name: "slope",
        normal: Vec3::new(0.6, 0.0, 0.8),
        offset: 0.01,
        flow_friction: 0.4,
    }]
}

/// A step of beads of which the slower ones are smoothed in part.
fn of_beads(bed: &[Plane]) -> ReferenceStep<'_> {
    ReferenceStep {
        lattice: lattice(),
        material: beads(),
        gravity: GRAVITY,
        dt: DT,
        substeps: 1,
        smoothing: StrainRateSmoothing::at(20.0),
        redistribution: RedistributionRates::after(0.2),
        bed,
    }
}

fn packing(step: &ReferenceStep) -> Packing {
    Packing {
        lattice: step.lattice,
        material: step.material,
    }
}

fn packed<R: Real>(step: &ReferenceStep, points: &[Point]) -> Blocks<R> {
    Blocks::of(points.iter().map(|point| packing(step).pack(point)))
}

fn unpacked<R: Real>(step: &ReferenceStep, blocks: &Blocks<R>) -> Vec<Point> {
    let mut points = Vec::new();
    for block in blocks.occupied() {
        let slots = 0..block.count();
        points.extend(slots.map(|slot| packing(step).unpack(&block.key, &block.get(slot))));
    }
    points.sort_unstable_by_key(|point| point.id);
    points
}

/// A cloud that drifts a third of a cell within a step.
fn drifting() -> Vec<Point> {
    let mut points = cloud(1500);
    for point in &mut points {
        point.velocity += Vec3::new(3.0, -2.0, 1.0);
    }
    points
}

/// A step of the kernels in hand.
struct KernelStep<'a, R: Real> {
    step: &'a ReferenceStep<'a>,
    blocks: Blocks<R>,
    nodes: Nodes<R>,
    law: Law<R>,
    forces: Vec<Tile<R>>,
    level: Level,
}

impl<'a, R: Real> KernelStep<'a, R> {
    fn new(step: &'a ReferenceStep<'a>, blocks: Blocks<R>, level: Level) -> Self {
        let mut nodes = Nodes::new(step.lattice);
        nodes.lay_around(blocks.occupied().iter().map(|block| block.key));
        Self {
            step,
            forces: vec![Tile::EMPTY; blocks.occupied().len()],
            blocks,
            nodes,
            law: Law::of(&step.material, &step.lattice.spacing),
            level,
        }
    }

    fn transfer(&mut self) {
        let (law, level) = (&self.law, self.level);
        let mut momentum = self.forces.clone();
        for (block, momentum) in self.blocks.occupied_mut().iter_mut().zip(&mut momentum) {
            dispatch!(level, simd => scatter_momentum(simd, block, law, momentum));
        }
        self.nodes.take_momentum(&momentum, level);
        for components in COMPONENTS {
            let blocks = self.blocks.occupied_mut().iter_mut();
            for (block, tile) in blocks.zip(&mut self.forces) {
                dispatch!(level, simd => scatter_strain_rates(simd, block, components, tile));
            }
            self.nodes
                .take_strain_rates(components, &self.forces, level);
        }
        let nodes = &self.nodes;
        let blocks = self.blocks.occupied_mut().iter_mut().zip(&mut momentum);
        for (place, ((block, residual), force)) in blocks.zip(&mut self.forces).enumerate() {
            dispatch!(level, simd => {
                let mut tiles = TransferTiles::EMPTY;
                nodes.motion_tile(simd, place, &mut tiles.motion);
                for (components, tile) in COMPONENTS.into_iter().zip(&mut tiles.strain_rate) {
                    nodes.strain_rate_tile(simd, place, components, tile);
                }
                smooth_strain_rates(simd, block, &tiles, &self.step.smoothing);
                residual_transfer(simd, block, law, &tiles.motion, residual, force);
            });
        }
        let full = self.step.material.bulk_density * self.step.lattice.cell_volume();
        self.nodes.take_residual(&momentum, R::of(full), level);
    }

    fn substeps(&mut self) {
        let (dt, law, level) = (self.step.dt, &self.law, self.level);
        for substep in 1..=self.step.substeps {
            self.nodes
                .advance(&self.forces, &self.step.gravity, dt, level);
            if substep == self.step.substeps {
                break;
            }
            let nodes = &self.nodes;
            for (place, block) in self.blocks.occupied_mut().iter_mut().enumerate() {
                let force = &mut self.forces[place];
                dispatch!(level, simd => {
                    let mut motion = Tile::EMPTY;
                    nodes.motion_tile(simd, place, &mut motion);
                    update_stress(simd, block, law, R::of(dt), &motion, force);
                });
            }
        }
    }

    fn gather(&mut self) {
        let lattice = &self.step.lattice;
        let zones = self.step.bed.iter();
        let zones: Vec<NoShiftZone<R>> =
            zones.map(|plane| NoShiftZone::of(plane, lattice)).collect();
        let largest_volume_mass = lattice.largest_point_volume() * self.step.material.bulk_density;
        let ending = Ending {
            law: &self.law,
            lattice,
            dt: R::of(self.step.dt),
            redistribution: &self.step.redistribution,
            no_shift_zones: &zones,
            largest_volume_mass: R::of(largest_volume_mass),
        };
        let nodes = &self.nodes;
        for (place, block) in self.blocks.occupied_mut().iter_mut().enumerate() {
            dispatch!(self.level, simd => {
                let mut tiles = EndTiles::EMPTY;
                nodes.motion_tile(simd, place, &mut tiles.motion);
                nodes.displacement_tile(simd, place, &mut tiles.displacement);
                nodes.volume_fraction_tile(simd, place, &mut tiles.twist);
                tiles.cross();
                gather_motion(simd, block, &ending, &tiles);
            });
        }
    }
}

/// Points after a step of the kernels, and the changes of their sums by redistribution.
fn stepped<R: Real>(
    step: &ReferenceStep,
    blocks: Blocks<R>,
    level: Level,
) -> (Blocks<R>, Shifting) {
    let mut kernels = KernelStep::new(step, blocks, level);
    kernels.transfer();
    kernels.substeps();
    kernels.gather();
    let mut blocks = kernels.blocks;
    let of_blocks = blocks.occupied().iter().map(Block::spread);
    let shifting = of_blocks.fold(Shifting::default(), |sum, of| sum.plus(&of));
    blocks.settle();
    (blocks, shifting)
}

/// Largest differences over the points, in units of the numbers that are rounded.
#[derive(Debug, Default)]
struct Worst {
    /// Position [cells].
    position: f64,
    /// Velocity, over the largest speed.
    velocity: f64,
    /// Affine velocity, over the largest speed over a quarter of a cell.
    affine: f64,
    /// Volume, relative.
    volume: f64,
    /// Stress, over the P-wave modulus.
    stress: f64,
}

fn worst(kernels: &[Point], reference: &[Point]) -> Worst {
    let speeds = reference.iter().map(|point| point.velocity.norm());
    let fastest = speeds.fold(0.0, f64::max);
    let h = lattice().spacing.min();
    let mut worst = Worst::default();
    assert_eq!(kernels.len(), reference.len());
    for (a, b) in kernels.iter().zip(reference) {
        assert_eq!((a.id, a.mass), (b.id, b.mass));
        let raise = |worst: &mut f64, off: f64| {
            assert!(off.is_finite(), "{a:?}");
            *worst = worst.max(off);
        };
        let (moved, turned) = (a.velocity - b.velocity, a.affine - b.affine);
        raise(&mut worst.position, (a.position - b.position).amax() / h);
        raise(&mut worst.velocity, moved.amax() / fastest);
        raise(&mut worst.affine, turned.amax() * h / (4.0 * fastest));
        raise(&mut worst.volume, (a.volume / b.volume - 1.0).abs());
        let stress = a.stress.matrix() - b.stress.matrix();
        raise(&mut worst.stress, stress.amax() / beads().p_wave_modulus());
    }
    worst
}

/// Compares a step of the kernels with the reference; `rounding` over that of f32.
fn compare<R: Real>(rounding: f64) {
    let bed = slope();
    let mut step = of_beads(&bed);
    let blocks = packed::<R>(&step, &drifting());
    let before = unpacked(&step, &blocks);
    for substeps in [1, 2, 8] {
        step.substeps = substeps;
        let mut reference = before.clone();
        step.advance(&mut reference);
        for level in levels() {
            let (after, _) = stepped(&step, blocks.clone(), level);
            let worst = worst(&unpacked(&step, &after), &reference);
            // Measured in single precision: 3.1e-7 (half the last place of a position, twice),
            // 2.1e-7, 8e-8, 7e-8 and 4.4e-8.
            assert!(worst.position < 1e-6 * rounding, "{worst:?}");
            assert!(worst.velocity < 8e-7 * rounding, "{worst:?}");
            assert!(worst.affine < 3e-7 * rounding, "{worst:?}");
            assert!(worst.volume < 3e-7 * rounding, "{worst:?}");
            assert!(worst.stress < 2e-7 * rounding, "{worst:?}");
        }
    }
}

#[test]
fn a_step_in_single_precision_is_that_of_the_reference() {
    compare::<f32>(1.0);
}

// f64 has 29 bits more than f32; the reference is rounded as well, and its sums over 27 nodes
// and all points of a node in another order.
#[test]
fn a_step_in_double_precision_is_that_of_the_reference() {
    compare::<f64>(2.0 * f64::EPSILON / f64::from(f32::EPSILON));
}

fn momentum(points: &[Point], lattice: &Lattice) -> (Impulse, f64, f64) {
    let moment = lattice.kernel_moment();
    let (mut sum, mut linear, mut angular) = (Impulse::default(), 0.0, 0.0);
    for point in points {
        sum.linear += point.velocity * point.mass;
        sum.angular += point.angular_momentum(&moment);
        linear += point.mass * point.velocity.norm();
        angular += point.angular_momentum(&moment).norm();
    }
    (sum, linear, angular)
}

/// Holds a step against its momentum, relative to the sum of the points' own: roundings of
/// 6e-8 that mostly cancel in single precision. Measured there: 8.5e-9 linear, 3e-9 angular;
/// without the displacement of the nodes it would be far more.
fn keeps_momentum<R: Real>(tolerance: f64) {
    let bed = slope();
    let mut step = of_beads(&bed);
    step.gravity = Vec3::zeros();
    let blocks = packed::<R>(&step, &drifting());
    let (before, linear, angular) = momentum(&unpacked(&step, &blocks), &step.lattice);
    for level in levels() {
        for substeps in [1, 2, 8] {
            step.substeps = substeps;
            let (after, shifting) = stepped(&step, blocks.clone(), level);
            let (after, ..) = momentum(&unpacked(&step, &after), &step.lattice);
            let walls = shifting.stopped;
            let lost = after.linear - walls.linear - before.linear;
            let turned = after.angular - shifting.angular - walls.angular - before.angular;
            assert!(lost.norm() / linear < tolerance, "{substeps}: {lost:?}");
            assert!(
                turned.norm() / angular < tolerance,
                "{substeps}: {turned:?}"
            );
        }
    }
}

#[test]
fn a_step_keeps_linear_and_angular_momentum() {
    keeps_momentum::<f32>(4e-8);
    // The sums here, of 1500 terms, are rounded as well. Measured: 2.1e-15.
    keeps_momentum::<f64>(2e-14);
}

/// A step without gravity, smoothing and redistribution.
fn elastic(lattice: Lattice, bulk_modulus: f64) -> ReferenceStep<'static> {
    ReferenceStep {
        lattice,
        material: Material {
            bulk_density: 1500.0,
            bulk_modulus,
            shear_modulus: 0.5 * bulk_modulus,
            yielding: Yielding::Never,
        },
        gravity: Vec3::zeros(),
        dt: DT,
        substeps: 1,
        smoothing: StrainRateSmoothing::NONE,
        redistribution: RedistributionRates::NONE,
        bed: &[],
    }
}

// A velocity field v = a + B x whose points carry C = B comes back exactly, up to rounding of
// velocities of order 3.
#[test]
fn linear_fields_come_back() {
    let step = ReferenceStep {
        dt: 0.0,
        ..elastic(lattice(), 1.0)
    };
    let a = Vec3::new(0.3, -0.7, 0.5);
    let b = Mat3::new(5.0, -20.0, 7.0, 13.0, -4.0, 9.0, -11.0, 3.0, 17.0);
    let mut points = cloud(300);
    for point in &mut points {
        (point.velocity, point.affine) = (a + b * point.position, b);
    }
    let (after, _) = stepped(&step, packed::<f64>(&step, &points), levels()[0]);
    for (point, old) in unpacked(&step, &after).iter().zip(&points) {
        assert!((point.velocity - old.velocity).norm() < 1e-13);
        assert!((point.affine - b).norm() < 1e-11);
        assert!((point.position - old.position).norm() < 1e-15);
    }
}

#[test]
fn dust_flies_straight() {
    let step = ReferenceStep {
        substeps: 4,
        ..elastic(lattice(), 0.0)
    };
    let flight = Vec3::new(1.0, -0.5, 2.0);
    let mut points = cloud(300);
    for point in &mut points {
        (point.velocity, point.affine) = (flight, Mat3::zeros());
        point.stress = Sym3::default();
    }
    let (after, _) = stepped(&step, packed::<f64>(&step, &points), levels()[0]);
    for (point, old) in unpacked(&step, &after).iter().zip(&points) {
        assert!((point.velocity - flight).norm() < 1e-14);
        assert!((point.position - old.position - flight * 4e-4).norm() < 1e-15);
        assert!((point.volume / old.volume - 1.0).abs() < 1e-14);
    }
}

/// An elastic cube of 4³ cells and 8³ points that turns about z at 10 rad/s.
fn spinning_cube(lattice: &Lattice) -> Vec<Point> {
    let spin = Mat3::new(0.0, -10.0, 0.0, 10.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let spacing = 0.5 * lattice.spacing.x;
    let place = |n: u32| (f64::from(n) - 3.5) * spacing;
    let point = |id: u32| {
        let position = Vec3::new(place(id % 8), place(id / 8 % 8), place(id / 64));
        Point {
            id,
            mass: 1500.0 * spacing.powi(3),
            volume: spacing.powi(3),
            position,
            velocity: spin * position,
            affine: spin,
            stress: Sym3::default(),
        }
    };
    (0..512).map(point).collect()
}

// Five steps of 0.2 rad, 200 sub-steps each. The cube is stretched by the centrifugal strain ρ
// (ω R)²/K = 1e-4 and its ringing (measured: 2e-5); without F̂ each step would lose 1 − 1/(1 +
// 0.2²) = 3.9 % of the volume.
#[test]
fn a_spinning_cube_keeps_its_volume() {
    let cells = Lattice {
        origin: Vec3::zeros(),
        spacing: Vec3::repeat(0.01),
    };
    let step = ReferenceStep {
        substeps: 200,
        ..elastic(cells, 6e5)
    };
    let points = spinning_cube(&cells);
    let (before, ..) = momentum(&points, &cells);
    let mut blocks = packed::<f64>(&step, &points);
    for _ in 0..5 {
        (blocks, _) = stepped(&step, blocks, levels()[1]);
    }
    let points = unpacked(&step, &blocks);
    let (after, ..) = momentum(&points, &cells);
    let lost = (after.angular - before.angular).norm() / before.angular.norm();
    assert!(lost < 1e-12, "{lost:e}");
    let tracked: f64 = points.iter().map(|point| point.volume).sum();
    let off = tracked / (512.0 * 0.005f64.powi(3)) - 1.0;
    assert!(off.abs() < 3e-4, "{off:e}");
    // The hull agrees with the tracked volume: the corners keep their distance.
    let diagonal = points[511].position - points[0].position;
    let stretched = diagonal.norm() / (0.035 * 3f64.sqrt()) - 1.0;
    let turned = diagonal.y.atan2(diagonal.x) - std::f64::consts::FRAC_PI_4;
    assert!(stretched.abs() < 1e-3, "{stretched:e}");
    assert!((turned - 1.0).abs() < 2e-3, "{turned}");
}
