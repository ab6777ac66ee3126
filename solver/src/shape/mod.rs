//! Geometry of bodies: convex sphero-polyhedra.
//!
//! A sphero-polyhedron is a convex polyhedron, the **core**, swept by a sphere
//! of the **sphero radius** r (Minkowski sum): flats, edges rounded to
//! cylinders, vertices to balls. The core may lack a volume: that of a ball is
//! a point, that of a capsule a segment. A point of space touches it where its distance
//! from the core is r. Everything here is in the body frame, whose origin is
//! the centre of mass of the rounded solid.

mod check;
mod closest;
mod core;
mod cuboid;
mod error;
mod face;
mod half_spaces;
mod hull;
mod inscribed;
mod moments;
mod polyhedron;
mod principal;
mod regular;
mod segment;
mod separation;
mod sharp;
mod steiner;
#[cfg(test)]
mod tests;
mod triangulation;
mod walk;

pub use self::core::CoreEdge;
pub use closest::{Closest, Feature};
pub use error::ShapeError;
pub use face::Face;
pub use polyhedron::{ConvexPolyhedron, Edge};
pub use principal::PrincipalInertia;
pub use regular::RegularSolid;
pub use separation::{distance_apart, separation};
pub use sharp::SharpPolyhedron;

use self::core::Core;
use cuboid::Cuboid;
use moments::Moments;
use nalgebra::{Matrix3, Vector3};
use segment::Segment;
use std::f64::consts::PI;
use walk::Walk;

/// A convex core swept by a sphere.
#[derive(Debug, Clone, PartialEq)]
pub struct SpheroPolyhedron {
    core: Core,
    sphero_radius: f64,
    volume: f64,
    unit_inertia: Matrix3<f64>,
    bounding_radius: f64,
    turning_compliance: f64,
}

impl SpheroPolyhedron {
    /// A cube whose opposite flats are `side_m` apart, rounding included.
    ///
    /// # Errors
    /// A length that is not positive, or a radius not below half the side.
    pub fn cube(side_m: f64, sphero_radius_m: f64) -> Result<Self, ShapeError> {
        Self::cuboid([side_m; 3], sphero_radius_m)
    }

    /// A box whose opposite flats are `sides_m` apart, rounding included.
    ///
    /// # Errors
    /// A length that is not positive, or a radius not below half the shortest side.
    pub fn cuboid(sides_m: [f64; 3], sphero_radius_m: f64) -> Result<Self, ShapeError> {
        for side in sides_m {
            positive("side", side)?;
        }
        positive("sphero radius", sphero_radius_m)?;
        let inradius_m = sides_m.iter().fold(f64::INFINITY, |a, &b| a.min(b)) / 2.0;
        let half = Vector3::from(sides_m) / 2.0 - Vector3::repeat(sphero_radius_m);
        if half.min() <= 0.0 {
            return Err(ShapeError::RadiusNotBelowInradius {
                radius_m: sphero_radius_m,
                inradius_m,
            });
        }
        let (core, cuboid) = Cuboid::new(half)?;
        let core = Core::Cuboid(core, Box::new(cuboid));
        Ok(Self::measured(core, sphero_radius_m))
    }

    /// A ball: a point swept by a sphere.
    ///
    /// # Errors
    /// A radius that is not positive.
    pub fn ball(radius_m: f64) -> Result<Self, ShapeError> {
        positive("radius", radius_m)?;
        Ok(Self::measured(Core::Segment(Segment::point()), radius_m))
    }

    /// A capsule along x, its length between the tips: a segment swept by a sphere.
    ///
    /// # Errors
    /// A radius that is not positive, or a length not above twice the radius.
    pub fn capsule(radius_m: f64, length_m: f64) -> Result<Self, ShapeError> {
        positive("radius", radius_m)?;
        let between_centres = length_m - 2.0 * radius_m;
        positive("length between the centres of the ends", between_centres)?;
        let core = Core::Segment(Segment::of_length(between_centres));
        Ok(Self::measured(core, radius_m))
    }

    /// Any convex core, swept by a sphere of `sphero_radius_m`. The core is
    /// moved so that the centre of mass of the rounded solid is the origin.
    ///
    /// # Errors
    /// A radius that is not positive. (The core's own conditions are checked by
    /// [`ConvexPolyhedron::new`].)
    pub fn from_core(core: ConvexPolyhedron, sphero_radius_m: f64) -> Result<Self, ShapeError> {
        positive("sphero radius", sphero_radius_m)?;
        // From any vertex first: a core far from the origin would lose its
        // small volume in large moments.
        let first_vertex = core.vertices()[0];
        let core = core.translated(&-first_vertex);
        let moments = Moments::of_dilated(&core, sphero_radius_m);
        let centred = core.translated(&-(moments.first / moments.volume));
        let walk = Walk::on(&centred);
        let core = Core::Polyhedron(centred, walk);
        Ok(Self::measured(core, sphero_radius_m))
    }

    /// Shape with its properties; `core` is centred already.
    fn measured(core: Core, sphero_radius: f64) -> Self {
        let farthest = core
            .vertices()
            .iter()
            .map(Vector3::norm)
            .fold(0.0, f64::max);
        let volume = core.dilated_volume(sphero_radius);
        let unit_inertia = core.dilated_inertia(sphero_radius);
        Self {
            volume,
            unit_inertia,
            turning_compliance: volume * core.turning_compliance(sphero_radius, &unit_inertia),
            bounding_radius: farthest + sphero_radius,
            core,
            sphero_radius,
        }
    }

    /// Vertices of the core [m].
    pub fn core_vertices(&self) -> &[Vector3<f64>] {
        self.core.vertices()
    }

    /// Edges of the core.
    pub fn edges(&self) -> impl Iterator<Item = CoreEdge> + Clone + '_ {
        self.core.edges()
    }

    /// Faces of the core, none if it has no volume; their planes lie r inside the body's flats.
    pub fn faces(&self) -> &[Face] {
        self.core.faces()
    }

    /// Radius r of the rounding sphere [m].
    pub fn sphero_radius(&self) -> f64 {
        self.sphero_radius
    }

    /// Volume of the rounded solid [m³], exact (docs/method.md, equation 14):
    /// V0 + S0 r + (r²/2) Σ L (π − φ) + 4/3 π r³.
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Inertia tensor of the rounded solid about its centre of mass for density
    /// 1 [m⁵], exact; times a density [kg/m³] it is in kg m².
    pub fn unit_inertia(&self) -> Matrix3<f64> {
        self.unit_inertia
    }

    /// Radius of the smallest ball about the centre of mass that contains the rounded solid [m].
    pub fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }

    /// Largest compliance of a surface place by turning, over that of the translation: the
    /// effective mass is everywhere at least m/(1 + this).
    pub fn turning_compliance(&self) -> f64 {
        self.turning_compliance
    }

    /// Largest speed of a place of the rounded solid that moves with `linear` at its centre and
    /// turns with `angular`, both in body axes: that of the vertices, since speed is a convex
    /// function of the place, plus the contribution of the rounding.
    pub fn fastest_place(&self, linear: &Vector3<f64>, angular: &Vector3<f64>) -> f64 {
        let vertices = self.core.vertices().iter();
        let speeds = vertices.map(|vertex| (linear + angular.cross(vertex)).norm_squared());
        speeds.fold(0.0, f64::max).sqrt() + self.sphero_radius * angular.norm()
    }

    /// Bound of its projected areas [m²]: that of the bounding ball, or half the surface, which no
    /// projected area of a convex solid exceeds.
    pub fn largest_projected_area(&self) -> f64 {
        (PI * self.bounding_radius.powi(2)).min(0.5 * self.surface_at(0.0))
    }

    /// Surface of the solid dilated by a sphere of radius `distance` [m²]: the places this far from
    /// it.
    pub fn surface_at(&self, distance: f64) -> f64 {
        self.core.dilated_surface(self.sphero_radius + distance)
    }

    /// Reach of the rounded solid from the origin along a unit direction [m] (support
    /// function; for other lengths it scales with them).
    pub fn extent_along(&self, direction: &Vector3<f64>) -> f64 {
        let reach = self.core.vertices().iter().map(|v| v.dot(direction));
        reach.fold(f64::NEG_INFINITY, f64::max) + self.sphero_radius * direction.norm()
    }

    /// Radius of the largest ball about the centre of mass inside the rounded solid [m].
    pub fn inscribed_radius(&self) -> f64 {
        self.core.inscribed_radius() + self.sphero_radius
    }

    /// Least distance of two parallel planes with the rounded solid between them [m].
    pub fn least_width(&self) -> f64 {
        let mut least = f64::INFINITY;
        for direction in self.core.narrow_directions() {
            if !self
                .core
                .is_wider(&direction, least - 2.0 * self.sphero_radius)
            {
                let width = self.extent_along(&direction) + self.extent_along(&-direction);
                least = least.min(width);
            }
        }
        least
    }

    /// The feature of the core nearest to `x` [m]. Distance and, outside the
    /// core, point and normal are continuous in `x`.
    pub fn closest_feature(&self, x: &Vector3<f64>) -> Closest {
        self.core.closest(x)
    }
}

fn positive(quantity: &'static str, value: f64) -> Result<(), ShapeError> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(ShapeError::NotPositive { quantity, value })
    }
}
