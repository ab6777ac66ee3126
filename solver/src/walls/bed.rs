//! The bed in boundary columns: slope and friction averaged with the transfer's kernel
//! (docs/method.md, equation 29d).
//!
//! With the plane under a column's own node the slope would jump half-way between two columns,
//! wherever the slope break is: an error of position of the order of a cell, which depends on
//! the phase of the grid. The kernel's mean spreads the jump over the columns round the break
//! such that its first moments are those of the break itself.

use super::columns::Way;
use super::{Plane, Walls};
use crate::kernel::{Lattice, share_above};
use crate::math::Vec3;

/// Surface that stops inflow and applies Coulomb friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Surface {
    /// Unit normal into the channel.
    pub(super) normal: Vec3,
    /// Coulomb friction of the flow.
    pub(super) friction: f64,
}

impl Surface {
    /// Surface of one plane.
    pub(super) fn of_plane(plane: &Plane) -> Self {
        Self {
            normal: plane.normal,
            friction: plane.flow_friction,
        }
    }

    /// Surface with the slope dz/dx and the friction of two, weighted.
    fn between(parts: [(&Plane, f64); 2]) -> Self {
        let mut slope = 0.0;
        let mut friction = 0.0;
        for (plane, share) in parts {
            slope += share * slope_of(plane);
            friction += share * plane.flow_friction;
        }
        Self {
            normal: Vec3::new(-slope, 0.0, 1.0).normalize(),
            friction,
        }
    }
}

/// Slope dz/dx of a plane that falls along the channel.
fn slope_of(plane: &Plane) -> f64 {
    -plane.normal.x / plane.normal.z
}

impl Walls {
    /// Surface at the intersection of a column with this plane: the plane itself away from a slope
    /// break, the mean of both planes about the column within the kernel's reach of it.
    pub(super) fn surface_at(
        &self,
        plane: usize,
        way: Way,
        along: i32,
        lattice: &Lattice,
    ) -> Surface {
        let own = &self.base[plane];
        let of_way = |other: &&Plane| Way::of(other) == way && **other != *own;
        match self.base.iter().find(of_way) {
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
                Surface::between([(downstream, share), (upstream, 1.0 - share)])
            }
            _ => Surface::of_plane(own),
        }
    }
}

/// The x at which two planes that fall along the channel intersect [m].
fn break_between(one: &Plane, other: &Plane) -> f64 {
    let at_origin = |plane: &Plane| plane.offset / plane.normal.z;
    (at_origin(one) - at_origin(other)) / (slope_of(other) - slope_of(one))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::walls::tests::{H, channel, plane};

    /// A floor and an incline of 40° that meet this far along the lattice [node
    /// distances]; base friction 0.2 and 0.6.
    fn sloped(foot: f64) -> Walls {
        let normal = Vec3::new(40f64.to_radians().sin(), 0.0, 40f64.to_radians().cos());
        let mut walls = channel(8, 0.2, 0.0);
        let offset = normal.x * foot * H;
        walls.base.push(plane("incline", normal, offset, 0.6));
        walls
    }

    fn surfaces(foot: f64) -> Vec<Surface> {
        let lattice = Lattice {
            origin: Vec3::zeros(),
            spacing: Vec3::repeat(H),
        };
        let walls = sloped(foot);
        let of_column = |along: i32| {
            let plane = usize::from(f64::from(along) < foot);
            walls.surface_at(plane, Way::Vertical, along, &lattice)
        };
        (0..=20).map(of_column).collect()
    }

    // The fall of the columns' slopes, each over one node distance, is that of the incline, and
    // about the same place: moments 0 and 1 of the break, for any phase.
    #[test]
    fn the_break_lies_where_it_is() {
        let slope = -40f64.to_radians().tan();
        for foot in [10.0, 10.1, 10.25, 10.5, 10.8] {
            let slopes = surfaces(foot).into_iter().map(|surface| {
                assert!((surface.normal.norm() - 1.0).abs() < 1e-15);
                -surface.normal.x / surface.normal.z
            });
            let (mut fall, mut moment) = (0.0, 0.0);
            for (along, slope) in slopes.enumerate() {
                fall += slope;
                moment += slope * along as f64;
            }
            // From half a node distance before the first column to the foot.
            let length = foot + 0.5;
            assert!((fall - slope * length).abs() < 1e-12, "{foot}: {fall}");
            // The spread's variance is that of the kernel, 1/4, and of a column's width,
            // 1/12: it adds half of itself to the moment of the incline.
            let expected = slope * (0.5 * (foot * foot - 0.25) + 0.5 * (0.25 + 1.0 / 12.0));
            assert!((moment - expected).abs() < 1e-12, "{foot}: {moment}");
        }
    }

    #[test]
    fn away_from_the_break_the_bed_is_the_plane() {
        let surfaces = surfaces(10.3);
        let walls = sloped(10.3);
        for (along, plane) in [(0, 1), (8, 1), (12, 0), (20, 0)] {
            let expected = Surface::of_plane(&walls.base[plane]);
            assert!((surfaces[along].normal - expected.normal).norm() < 1e-14);
            assert!((surfaces[along].friction - expected.friction).abs() < 1e-14);
        }
        // Between them friction and slope lie between those of both.
        let middle = surfaces[10];
        assert!(middle.friction > 0.2 && middle.friction < 0.6);
        assert!(middle.normal.x > 0.0 && middle.normal.x < walls.base[1].normal.x);
    }
}
