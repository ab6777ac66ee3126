//! A bed of planes that fall along the channel: floor and incline.
//!
//! In boundary columns slope and friction are averaged with the transfer's kernel (docs/method.md,
//! equation 29d). With the plane under a column's own node the slope would jump half-way between
//! two columns, wherever the slope break is: an error of position of the order of a cell, which
//! depends on the phase of the grid. The kernel's mean spreads the jump over the columns round the
//! break such that its first moments are those of the break itself.

use super::{Bed, Intersection, MOST_SURFACES, Plane, Surface, Way, rounding};
use crate::kernel::{Lattice, share_above, share_above_both};
use crate::math::Vec3;
use nalgebra::UnitQuaternion;

/// Upper envelope of planes that fall along x, at most two of them.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanarBed {
    planes: Vec<Plane>,
    /// Inclination of each plane [rad].
    inclinations: Vec<f64>,
}

impl PlanarBed {
    /// A horizontal floor at z = 0.
    pub fn floor(friction: f64) -> Self {
        Self::none().with("floor", 0.0, 0.0, friction)
    }

    /// A single incline \[rad\] with this normal · x of its places [m].
    pub fn incline(inclination: f64, offset: f64, friction: f64) -> Self {
        Self::none().with("incline", inclination, offset, friction)
    }

    /// A floor at z = 0, and an incline \[rad\] that rises from it upstream of x = 0.
    pub fn channel(inclination: f64, friction: f64) -> Self {
        let floor = Self::floor(friction);
        if inclination > 0.0 {
            floor.with_incline(inclination, 0.0, friction)
        } else {
            floor
        }
    }

    /// The bed with an incline more.
    #[must_use]
    pub fn with_incline(self, inclination: f64, offset: f64, friction: f64) -> Self {
        self.with("incline", inclination, offset, friction)
    }

    fn none() -> Self {
        Self {
            planes: Vec::new(),
            inclinations: Vec::new(),
        }
    }

    fn with(mut self, name: &'static str, inclination: f64, offset: f64, friction: f64) -> Self {
        let (sin, cos) = inclination.sin_cos();
        self.inclinations.push(inclination);
        self.planes.push(Plane {
            name,
            normal: Vec3::new(sin, 0.0, cos),
            offset,
            flow_friction: friction,
        });
        self
    }

    /// Elevation of a plane at x [m].
    fn elevation_of(&self, which: usize, x: f64) -> f64 {
        let plane = &self.planes[which];
        plane.offset / plane.normal.z - x * self.inclinations[which].tan()
    }

    /// The plane that is the bed at x.
    fn highest_at(&self, x: f64) -> usize {
        let mut highest = 0;
        for which in 1..self.planes.len() {
            if self.elevation_of(which, x) > self.elevation_of(highest, x) {
                highest = which;
            }
        }
        highest
    }

    /// The plane at which a column of nodes leaves the bed, and the place along it [node distances].
    fn crossed(&self, way: Way, across: [i32; 2], lattice: &Lattice) -> Option<(usize, f64)> {
        let axis = way.axis();
        let index = match way {
            Way::Horizontal => [0, across[0], across[1]],
            Way::Vertical => [across[0], across[1], 0],
        };
        let start = lattice.position(index);
        let of_way = self.planes.iter().enumerate();
        let (plane, along) = of_way
            .filter(|(_, plane)| Way::through(&plane.normal) == way)
            .map(|(which, plane)| (which, -plane.height(&start) / plane.normal[axis]))
            .max_by(|one, other| one.1.total_cmp(&other.1))?;
        Some((plane, along / lattice.spacing[axis]))
    }

    /// Surface at the intersection of a column with this plane: the plane itself away from a slope
    /// break, the mean of both planes about the column within the kernel's reach of it.
    fn surface_at(&self, plane: usize, way: Way, along: i32, lattice: &Lattice) -> Surface {
        let own = &self.planes[plane];
        let of_way = |other: &&Plane| Way::through(&other.normal) == way && **other != *own;
        match self.planes.iter().find(of_way) {
            Some(other) if way == Way::Vertical => {
                let x = lattice.position([along, 0, 0]).x;
                let beyond = (x - break_between(own, other)) / lattice.spacing.x;
                // The bed is the higher of both: downstream of the break the plane that rises
                // faster.
                let (downstream, upstream) = if slope_of(own) > slope_of(other) {
                    (own, other)
                } else {
                    (other, own)
                };
                let share = share_above(beyond);
                mean_surface([(downstream, share), (upstream, 1.0 - share)])
            }
            _ => Surface {
                normal: own.normal,
                friction: own.flow_friction,
            },
        }
    }
}

impl Bed for PlanarBed {
    fn elevation(&self, x: f64, _: f64) -> f64 {
        let each = 0..self.planes.len();
        each.map(|which| self.elevation_of(which, x))
            .fold(f64::NEG_INFINITY, f64::max)
    }

    fn tangent(&self, x: f64, _: f64) -> Plane {
        self.planes[self.highest_at(x)]
    }

    fn tilt(&self, x: f64, _: f64) -> UnitQuaternion<f64> {
        let inclination = self.inclinations[self.highest_at(x)];
        UnitQuaternion::from_axis_angle(&Vec3::y_axis(), inclination)
    }

    fn planes(&self) -> &[Plane] {
        &self.planes
    }

    fn share_above(&self, index: [i32; 3], lattice: &Lattice) -> f64 {
        let x = lattice.position(index);
        let height = |plane: &Plane| {
            // The kernel is as wide along a slant as along its axes.
            let width = plane.normal.component_mul(&lattice.spacing).norm();
            plane.height(&x) / width
        };
        match self.planes.as_slice() {
            [] => 1.0,
            [plane] => share_above(height(plane)),
            [one, other, ..] => {
                share_above_both([height(one), height(other)], one.normal.dot(&other.normal))
            }
        }
    }

    fn intersection(&self, way: Way, across: [i32; 2], lattice: &Lattice) -> Option<Intersection> {
        let (_, cells) = self.crossed(way, across, lattice)?;
        Some(Intersection::at(cells))
    }

    fn surface_in(&self, way: Way, across: [i32; 2], lattice: &Lattice) -> Option<Surface> {
        let (plane, _) = self.crossed(way, across, lattice)?;
        Some(self.surface_at(plane, way, across[0], lattice))
    }

    fn surfaces_over(
        &self,
        index: [i32; 3],
        lattice: &Lattice,
    ) -> [Option<Surface>; MOST_SURFACES] {
        let x = lattice.position(index);
        let rounding = rounding(&x);
        let on_or_below = |way: Way, plane: &Plane| {
            Way::through(&plane.normal) == way && plane.height(&x) <= rounding
        };
        // The floor acts before a steep incline, as it comes first.
        let [floor, incline] = [Way::Vertical, Way::Horizontal].map(|way| {
            let of_way = self.planes.iter().enumerate();
            let (plane, _) = of_way
                .filter(|(_, plane)| on_or_below(way, plane))
                .max_by(|one, other| other.1.height(&x).total_cmp(&one.1.height(&x)))?;
            Some(self.surface_at(plane, way, index[0], lattice))
        });
        [floor, incline, None]
    }

    fn covers(&self, index: [i32; 3], lattice: &Lattice) -> bool {
        let x = lattice.position(index);
        let rounding = rounding(&x);
        self.planes.iter().any(|plane| plane.height(&x) <= rounding)
    }
}

/// Surface with the slope dz/dx and the friction of two planes, weighted.
fn mean_surface(parts: [(&Plane, f64); 2]) -> Surface {
    let mut slope = 0.0;
    let mut friction = 0.0;
    for (plane, share) in parts {
        slope += share * slope_of(plane);
        friction += share * plane.flow_friction;
    }
    Surface {
        normal: Vec3::new(-slope, 0.0, 1.0).normalize(),
        friction,
    }
}

/// Slope dz/dx of a plane that falls along the channel.
fn slope_of(plane: &Plane) -> f64 {
    -plane.normal.x / plane.normal.z
}

/// The x at which two planes that fall along the channel intersect [m].
fn break_between(one: &Plane, other: &Plane) -> f64 {
    let at_origin = |plane: &Plane| plane.offset / plane.normal.z;
    (at_origin(one) - at_origin(other)) / (slope_of(other) - slope_of(one))
}

#[cfg(test)]
mod tests;
