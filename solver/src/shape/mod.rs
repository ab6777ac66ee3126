//! Geometry of bodies: convex sphero-polyhedra.
//!
//! A sphero-polyhedron is a convex polyhedron, the **core**, swept by a sphere
//! of the **sphero radius** r (Minkowski sum): flats, edges rounded to
//! cylinders, vertices to balls. A point of space touches it where its distance
//! from the core is r. Everything here is in the body frame, whose origin is
//! the centre of mass of the rounded solid.

mod check;
mod closest;
mod cuboid;
mod error;
mod half_spaces;
mod hull;
mod moments;
mod polyhedron;
mod principal;
mod regular;
mod separation;
mod sharp;
#[cfg(test)]
mod tests;
mod walk;

pub use closest::{Closest, Feature};
pub use error::ShapeError;
pub use polyhedron::{ConvexPolyhedron, Edge, Face};
pub use principal::PrincipalInertia;
pub use regular::RegularSolid;
pub use separation::{distance_apart, separation};
pub use sharp::SharpPolyhedron;

use cuboid::Cuboid;
use moments::Moments;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;
use walk::Walk;

/// A convex polyhedron swept by a sphere.
#[derive(Debug, Clone, PartialEq)]
pub struct SpheroPolyhedron {
    core: ConvexPolyhedron,
    nearest: Nearest,
    sphero_radius: f64,
    volume: f64,
    unit_inertia: Matrix3<f64>,
    bounding_radius: f64,
    turning_compliance: f64,
}

/// Algorithm that finds the nearest feature of the core.
#[derive(Debug, Clone, PartialEq)]
enum Nearest {
    /// Closed form, for a box.
    Cuboid(Box<Cuboid>),
    /// Walk over its surface.
    Walk(Walk),
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
        Ok(Self::measured(
            core,
            Nearest::Cuboid(Box::new(cuboid)),
            sphero_radius_m,
        ))
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
        Ok(Self::measured(
            centred,
            Nearest::Walk(walk),
            sphero_radius_m,
        ))
    }

    /// Shape with its properties; `core` is centred already.
    fn measured(core: ConvexPolyhedron, nearest: Nearest, sphero_radius: f64) -> Self {
        let farthest = core
            .vertices()
            .iter()
            .map(Vector3::norm)
            .fold(0.0, f64::max);
        let volume = steiner_volume(&core, sphero_radius);
        let unit_inertia = Moments::of_dilated(&core, sphero_radius).inertia();
        Self {
            volume,
            unit_inertia,
            turning_compliance: volume * turning_compliance(&core, sphero_radius, &unit_inertia),
            bounding_radius: farthest + sphero_radius,
            core,
            nearest,
            sphero_radius,
        }
    }

    /// Vertices of the core [m].
    pub fn core_vertices(&self) -> &[Vector3<f64>] {
        self.core.vertices()
    }

    /// Edges of the core.
    pub fn edges(&self) -> &[Edge] {
        self.core.edges()
    }

    /// Faces of the core; their planes lie r inside the body's flats.
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
        steiner_surface(&self.core, self.sphero_radius + distance)
    }

    /// Reach of the rounded solid from the origin along a unit direction [m] (support
    /// function; for other lengths it scales with them).
    pub fn extent_along(&self, direction: &Vector3<f64>) -> f64 {
        let reach = self.core.vertices().iter().map(|v| v.dot(direction));
        reach.fold(f64::NEG_INFINITY, f64::max) + self.sphero_radius * direction.norm()
    }

    /// Least distance of two parallel planes with the rounded solid between them [m]: both touch it
    /// in faces, a face and a vertex, or two edges.
    pub fn least_width(&self) -> f64 {
        let edges = self.edges();
        let crosses = edges
            .iter()
            .flat_map(|a| edges.iter().map(|b| a.direction.cross(&b.direction)));
        let directions = crosses.filter_map(|cross| cross.try_normalize(separation::PARALLEL));
        self.faces()
            .iter()
            .map(|face| face.normal)
            .chain(directions)
            .map(|direction| self.extent_along(&direction) + self.extent_along(&-direction))
            .fold(f64::INFINITY, f64::min)
    }

    /// The feature of the core nearest to `x` [m]. Distance and, outside the
    /// core, point and normal are continuous in `x`.
    pub fn closest_feature(&self, x: &Vector3<f64>) -> Closest {
        match &self.nearest {
            Nearest::Cuboid(cuboid) => cuboid.closest(x),
            Nearest::Walk(walk) => walk.closest(x),
        }
    }
}

/// Largest compliance by turning alone of a place within the sphero radius of a vertex, for
/// density 1: the largest eigenvalue of −[c]× I⁻¹ [c]×.
fn turning_compliance(
    core: &ConvexPolyhedron,
    sphero_radius: f64,
    unit_inertia: &Matrix3<f64>,
) -> f64 {
    let inverse = unit_inertia.try_inverse().unwrap_or_else(Matrix3::zeros);
    let of_vertex = |vertex: &Vector3<f64>| {
        let place = vertex + vertex.normalize() * sphero_radius;
        let cross = place.cross_matrix();
        (cross * inverse * cross.transpose())
            .symmetric_eigenvalues()
            .max()
    };
    core.vertices().iter().map(of_vertex).fold(0.0, f64::max)
}

fn positive(quantity: &'static str, value: f64) -> Result<(), ShapeError> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(ShapeError::NotPositive { quantity, value })
    }
}

/// Steiner's formula for the volume of a convex core dilated by a sphere [m³].
fn steiner_volume(core: &ConvexPolyhedron, radius: f64) -> f64 {
    let faces = core.faces().iter();
    let surface: f64 = faces.clone().map(|face| face_area(core, face)).sum();
    let inside: f64 = faces
        .map(|face| face_area(core, face) * face.offset / 3.0)
        .sum();
    let bend: f64 = core
        .edges()
        .iter()
        .map(|edge| edge.length * (PI - edge.interior_dihedral))
        .sum();
    inside + surface * radius + bend * radius.powi(2) / 2.0 + 4.0 / 3.0 * PI * radius.powi(3)
}

/// Steiner's formula for its surface [m²], the volume's derivative by the radius.
fn steiner_surface(core: &ConvexPolyhedron, radius: f64) -> f64 {
    let flats: f64 = core.faces().iter().map(|face| face_area(core, face)).sum();
    let bend = |edge: &Edge| edge.length * (PI - edge.interior_dihedral);
    let bent: f64 = core.edges().iter().map(bend).sum();
    flats + bent * radius + 4.0 * PI * radius.powi(2)
}

/// Area of a face [m²].
fn face_area(core: &ConvexPolyhedron, face: &Face) -> f64 {
    let corner = |v: usize| core.vertices()[v];
    let fan: Vector3<f64> = polyhedron::sides(&face.vertices)
        .map(|(a, b)| corner(a).cross(&corner(b)))
        .sum();
    fan.dot(&face.normal) / 2.0
}
