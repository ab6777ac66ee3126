//! Particle redistribution (docs/method.md, equations 39–42b).
//!
//! A point's volume follows the velocity gradient along its path, which does not depend on the
//! distribution of the points. In long shear points cluster, the volumes scatter, and the flow
//! settles into less space than the sum of its volumes. Once per step the compressive strains
//! are therefore smoothed over the grid, points are shifted out of clusters, and the pressure
//! of those in a cluster is raised, so that it drives them apart.

use crate::grid::{BLOCK, BlockKey, block_of};
use crate::kernel::{Lattice, REACH, share_above};
use crate::math::Vec3;
use crate::rigid::Body;
use crate::walls::{Boundary, Impulse, NodeAccess, Plane, filled, in_plane};
use std::ops::Range;

/// Shift of points over −h² ∇excess volume fraction per cell of travel.
const SHIFT: f64 = 1.0;
/// Largest shift in a step [cells].
pub const LARGEST_SHIFT: f64 = 0.1;
/// Share of its own compressive strain min(φ, 0) that a point exchanges for the mean per cell
/// of travel.
const VOLUMETRIC_SMOOTHING: f64 = 2.0;
/// Relative rise of pressure per excess volume fraction and cell of travel.
const PRESSURE_CORRECTION: f64 = 5.0;
/// Largest relative rise of pressure in a step.
pub const LARGEST_RISE: f64 = 0.5;
/// Share of the largest possible travel below which a point is redistributed less, by the
/// square: particle noise alone has no effect.
const SLOW: f64 = 0.2;

/// Height above a plane of the bed below which no point is shifted towards it [cells].
pub const NO_SHIFT_HEIGHT: f64 = 0.5;
/// Depth behind a plane of the bed beyond which no point penetrates further [cells].
pub const DEEPEST_PENETRATION: f64 = 0.25;

/// Rates of a step, by its length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RedistributionRates {
    /// Shift over −h² ∇excess volume fraction.
    pub shift: f64,
    /// Share of its own compressive strain that a point exchanges for the mean.
    pub volumetric_smoothing: f64,
    /// Relative rise of pressure per excess volume fraction.
    pub pressure_correction: f64,
    /// Travel above which a point is fully redistributed [cells].
    pub full_travel: f64,
}

impl RedistributionRates {
    /// No redistribution: an elastic body keeps its points.
    pub const NONE: Self = Self {
        shift: 0.0,
        volumetric_smoothing: 0.0,
        pressure_correction: 0.0,
        full_travel: 0.0,
    };

    /// Rates after a step in which the fastest point could travel so many cells.
    pub fn after(travel: f64) -> Self {
        Self {
            shift: SHIFT * travel,
            volumetric_smoothing: (VOLUMETRIC_SMOOTHING * travel).min(1.0),
            pressure_correction: PRESSURE_CORRECTION * travel,
            full_travel: SLOW * travel,
        }
    }

    /// Change of a point that travelled `travel` cells, with this state.
    pub fn of(&self, seen: &PointState, travel: f64, spacing: &Vec3) -> RedistributedPoint {
        let degree = if travel < self.full_travel {
            (travel / self.full_travel).powi(2)
        } else {
            1.0
        };
        let in_cells = seen.slope.component_mul(spacing) * (-self.shift * degree);
        let length = in_cells.norm();
        let shorter = if length > LARGEST_SHIFT {
            LARGEST_SHIFT / length
        } else {
            1.0
        };
        let rise =
            degree * (self.pressure_correction * seen.excess_volume_fraction).min(LARGEST_RISE);
        let exchanged =
            self.volumetric_smoothing * (seen.mean_compression - seen.compression_at_transfer);
        let averaged = seen.volumetric_strain + degree * exchanged;
        RedistributedPoint {
            shift: (in_cells * shorter).component_mul(spacing),
            volumetric_strain: averaged - rise * (-averaged).max(0.0),
            rise,
        }
    }
}

/// State of a point, and of the nodes at the point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointState {
    /// V ρ_c/m − 1 now.
    pub volumetric_strain: f64,
    /// Its compressive part, min(φ, 0), at the transfer.
    pub compression_at_transfer: f64,
    /// Its mean over the nodes.
    pub mean_compression: f64,
    /// Excess volume fraction of the nodes round the point.
    pub excess_volume_fraction: f64,
    /// Its gradient [1/m].
    pub slope: Vec3,
}

/// Change of a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RedistributedPoint {
    /// Shift from its position [m].
    pub shift: Vec3,
    /// Its volumetric strain.
    pub volumetric_strain: f64,
    /// Relative rise of its stress.
    pub rise: f64,
}

/// A shift [m] of a point that was `moved` to a position, without its component into a plane of
/// the bed that the point is near to or behind: the volume fraction of nodes behind a wall is
/// not defined. For a point deep behind, the component of `moved` into the wall is removed,
/// too: where the flow spreads over the bed, nodes behind move inwards (equation 29), and
/// points follow them the faster the deeper they are (equation 42b).
pub fn limit_shift_at_bed(
    shift: &Vec3,
    moved: &Vec3,
    position: &Vec3,
    base: &[Plane],
    spacing: &Vec3,
) -> Vec3 {
    let mut shift = *shift;
    for plane in base {
        let width = plane.normal.component_mul(spacing).norm();
        let height = plane.height(position);
        let into = |way: &Vec3| (-plane.normal.dot(way)).max(0.0);
        if height < NO_SHIFT_HEIGHT * width {
            shift += plane.normal * into(&shift);
        }
        if height < -DEEPEST_PENETRATION * width {
            shift += plane.normal * into(moved);
        }
    }
    shift
}

/// Change of a velocity [m/s] by which a point deep behind a plane of the bed does not
/// penetrate further (equation 42c).
pub fn clamp_normal_velocity(
    velocity: &Vec3,
    position: &Vec3,
    base: &[Plane],
    spacing: &Vec3,
) -> Vec3 {
    let mut change = Vec3::zeros();
    for plane in base {
        let width = plane.normal.component_mul(spacing).norm();
        if plane.height(position) < -DEEPEST_PENETRATION * width {
            let into = (-plane.normal.dot(&(velocity + change))).max(0.0);
            change += plane.normal * into;
        }
    }
    change
}

/// Changes of the points' sums by redistribution. A shift does not change the velocity.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shifting {
    /// Σ m δx [kg m].
    pub first_moment: Vec3,
    /// Σ m δx × v [N m s].
    pub angular: Vec3,
    /// Impulse of walls on points deep behind them.
    pub stopped: Impulse,
}

impl Shifting {
    /// The sum of both.
    pub fn plus(self, other: &Self) -> Self {
        Self {
            first_moment: self.first_moment + other.first_moment,
            angular: self.angular + other.angular,
            stopped: self.stopped.plus(&other.stopped),
        }
    }

    /// Sums over so many images, which lie symmetrically about the plane y = 0. One image leaves
    /// them unchanged.
    pub fn of_images(&self, count: f64) -> Self {
        if count == 1.0 {
            return *self;
        }
        Self {
            first_moment: in_plane(&self.first_moment) * count,
            angular: Vec3::new(0.0, self.angular.y * count, 0.0),
            stopped: self.stopped.of_images(count),
        }
    }

    /// Adds a point of this mass [kg] and velocity [m/s].
    pub fn add(&mut self, mass: f64, shift: &Vec3, velocity: &Vec3) {
        self.first_moment += shift * mass;
        self.angular += shift.cross(velocity) * mass;
    }
}

/// Excess volume fraction of a node with this volume fraction.
pub fn excess_volume_fraction(volume_fraction: f64) -> f64 {
    (volume_fraction - 1.0).clamp(0.0, 1.0)
}

/// Kernel weight of a node at its own position.
const PEAK: f64 = 0.75 * 0.75 * 0.75;

/// Reduces the available nodal volume near walls and bodies.
pub fn exclude_volume(boundary: &Boundary, bodies: &[Body], nodes: &mut impl NodeAccess) {
    boundary.exclude_volume(nodes);
    for body in bodies {
        exclude_body(body, nodes);
    }
    // A body in the channel excludes volume of a node's images as well.
    boundary.fill_ghost_nodes(nodes);
}

fn exclude_body(body: &Body, nodes: &mut impl NodeAccess) {
    let lattice = *nodes.lattice();
    let (low, high) = box_of(body, &lattice);
    // However small its share, a small body does not fill a kernel.
    let least = 1.0 - PEAK * body.shape.volume() / lattice.spacing.product();
    let width = lattice.spacing.max();
    let (first, last) = (block_of(low), block_of(high));
    for place in blocks_along(nodes.blocks(), first[0], last[0]) {
        let block = nodes.blocks()[place];
        if !(1..3).all(|axis| (first[axis]..=last[axis]).contains(&block[axis])) {
            continue;
        }
        let within = |axis: usize| {
            let first = block[axis] * BLOCK as i32;
            first.max(low[axis])..=(first + BLOCK as i32 - 1).min(high[axis])
        };
        for i in within(0) {
            for j in within(1) {
                for k in within(2) {
                    let Some(place) = nodes.place_of([i, j, k]) else {
                        continue;
                    };
                    let height = body.distance_to(&lattice.position([i, j, k]));
                    let room = share_above(height / width).max(least);
                    nodes.set_volume_fraction(place, filled(nodes.volume_fraction(place), room));
                }
            }
        }
    }
}

/// Range of the blocks, which are sorted, between two coordinates along x: a large body
/// contains millions of cells, most of them without a point near.
fn blocks_along(blocks: &[BlockKey], first: i32, last: i32) -> Range<usize> {
    let start = blocks.partition_point(|block| block[0] < first);
    let end = blocks.partition_point(|block| block[0] <= last);
    start..end
}

/// Lowest and highest node whose kernel may overlap a body.
fn box_of(body: &Body, lattice: &Lattice) -> ([i32; 3], [i32; 3]) {
    let reach = body.shape.bounding_radius() + REACH * lattice.spacing.max();
    let at = |sign: f64| {
        let corner = body.state.position + Vec3::repeat(sign * reach) - lattice.origin;
        let in_cells = corner.component_div(&lattice.spacing);
        [0, 1, 2].map(|axis| in_cells[axis].clamp(-1e9, 1e9) as i32)
    };
    (at(-1.0), at(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CROWDED: PointState = PointState {
        volumetric_strain: -0.01,
        compression_at_transfer: -0.01,
        mean_compression: -0.02,
        excess_volume_fraction: 0.1,
        slope: Vec3::new(20.0, 0.0, 0.0),
    };
    const SPACING: Vec3 = Vec3::new(0.01, 0.01, 0.01);

    // By hand, with T = 0.2: shift −0.2 h² · 20/m = −0.4 mm; volumetric strain −0.01
    // + 0.4 (−0.02 + 0.01) = −0.014, and more by 0.2 · 5 · 0.1 = a tenth.
    #[test]
    fn a_point_moves_out_of_a_crowd_and_is_pressed() {
        let redistributed = RedistributionRates::after(0.2).of(&CROWDED, 0.2, &SPACING);
        assert!((redistributed.shift - Vec3::new(-4e-4, 0.0, 0.0)).norm() < 1e-12);
        assert!(
            (redistributed.volumetric_strain + 0.0154).abs() < 1e-12,
            "{}",
            redistributed.volumetric_strain
        );
    }

    #[test]
    fn a_point_at_rest_is_left_alone() {
        for redistribution in [RedistributionRates::after(0.2), RedistributionRates::NONE] {
            let redistributed = redistribution.of(&CROWDED, 0.0, &SPACING);
            assert_eq!(redistributed.shift, Vec3::zeros());
            assert_eq!(redistributed.volumetric_strain, CROWDED.volumetric_strain);
            assert_eq!(redistributed.rise, 0.0);
        }
    }

    #[test]
    fn no_point_near_a_wall_is_moved_towards_it() {
        let floor = [Plane {
            name: "floor",
            normal: Vec3::z(),
            offset: 0.0,
            flow_friction: 0.4,
        }];
        let still = Vec3::zeros();
        let kept = |z, shift| {
            limit_shift_at_bed(&shift, &still, &Vec3::new(0.0, 0.0, z), &floor, &SPACING)
        };
        let (down, up) = (Vec3::new(1e-4, 0.0, -1e-4), Vec3::new(0.0, 0.0, 1e-4));
        assert_eq!(kept(0.004, down), Vec3::new(1e-4, 0.0, 0.0));
        assert_eq!(kept(-0.004, down), Vec3::new(1e-4, 0.0, 0.0));
        assert_eq!(kept(0.006, down), down);
        assert_eq!(kept(0.004, up), up);
    }

    #[test]
    fn a_point_deep_behind_two_walls_is_stopped_by_both() {
        let steep = Vec3::new(0.6, 0.0, 0.8);
        let base = [Vec3::z(), steep].map(|normal| Plane {
            name: "a plane",
            normal,
            offset: 0.0,
            flow_friction: 0.4,
        });
        let stopped = |position: Vec3, velocity| {
            velocity + clamp_normal_velocity(&velocity, &position, &base, &SPACING)
        };
        let (down, up) = (Vec3::new(0.1, 0.2, -1.0), Vec3::new(0.1, 0.2, 1.0));
        let behind_floor = Vec3::new(0.1, 0.0, -0.0026);
        assert_eq!(stopped(behind_floor, down), Vec3::new(0.1, 0.2, 0.0));
        assert_eq!(stopped(behind_floor, up), up);
        assert_eq!(stopped(behind_floor * 0.9, down), down);
        let behind_both = stopped(Vec3::new(0.0, 0.0, -0.01), Vec3::new(-1.0, 0.2, -1.0));
        assert!(behind_both.z >= 0.0 && behind_both.dot(&steep).abs() < 1e-15);
        assert_eq!(behind_both.y, 0.2);
    }

    // A quarter of a cell is 2.5 mm.
    #[test]
    fn no_point_deep_behind_a_wall_goes_deeper() {
        let floor = [Plane {
            name: "floor",
            normal: Vec3::z(),
            offset: 0.0,
            flow_friction: 0.4,
        }];
        let none = Vec3::zeros();
        let kept =
            |z, moved| limit_shift_at_bed(&none, &moved, &Vec3::new(0.0, 0.0, z), &floor, &SPACING);
        let (down, up) = (Vec3::new(1e-4, 0.0, -1e-4), Vec3::new(0.0, 0.0, 1e-4));
        assert_eq!(kept(-0.0026, down), Vec3::new(0.0, 0.0, 1e-4));
        assert_eq!(kept(-0.0026, up), none);
        assert_eq!(kept(-0.0024, down), none);
    }
}
