//! Exact volume moments of a polyhedron dilated by a sphere.
//!
//! The dilated solid consists of the core, a prism on every face, a sector of a cylinder along
//! every edge and a sector of a ball at every vertex (Steiner's decomposition). Each has closed
//! moments. For the ball sector over the spherical polygon P of a vertex's normal cone, Green's
//! theorem on the sphere for harmonics of degree 1 and 2 turns ∫ u dΩ and ∫ (u uᵀ − 1/3) dΩ
//! into sums over the arcs of P: with θ an arc's angle, m its inward pole and U = ∫ u ds over
//! it,
//!
//! ∫ u dΩ = ½ Σ θ m,  ∫ u uᵀ dΩ = Ω/3 + ⅙ Σ (U mᵀ + m Uᵀ).
//!
//! An arc of a vertex belongs to one of its edges, and its inward pole is the direction along
//! that edge into the vertex. Ω is the difference between a full turn and the angles of the
//! faces at the vertex (Gauss–Bonnet).

use super::face::Face;
use super::polyhedron::{ConvexPolyhedron, Edge};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// ∫ dV [m³], ∫ x dV [m⁴] and ∫ x xᵀ dV [m⁵] of a solid of density 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moments {
    pub(super) volume: f64,
    pub(super) first: Vector3<f64>,
    pub(super) second: Matrix3<f64>,
}

impl Moments {
    const ZERO: Self = Self {
        volume: 0.0,
        first: Vector3::new(0.0, 0.0, 0.0),
        second: Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    };

    /// Moments of `core` dilated by a sphere of `radius` [m].
    pub(super) fn of_dilated(core: &ConvexPolyhedron, radius: f64) -> Self {
        let mut sum = Self::ZERO;
        for face in core.faces() {
            sum.add_core_below(core, face);
            sum.add_prism(core, face, radius);
        }
        for edge in core.edges() {
            sum.add_edge(core, edge, radius);
        }
        for vertex in 0..core.vertices().len() {
            sum.add_corner(core, vertex, radius);
        }
        sum
    }

    /// Inertia tensor about the origin [m⁵].
    pub(super) fn inertia(&self) -> Matrix3<f64> {
        Matrix3::from_diagonal_element(self.second.trace()) - self.second
    }

    /// The cone from the origin over one face.
    fn add_core_below(&mut self, core: &ConvexPolyhedron, face: &Face) {
        let area = Area::of(core, face);
        // A cone's layers scale with the distance from its tip: ∫ s² ds, ∫ s³ ds, ∫ s⁴ ds.
        self.volume += face.offset * area.area / 3.0;
        self.first += area.first * (face.offset / 4.0);
        self.second += area.second * (face.offset / 5.0);
    }

    /// The prism of height `radius` on one face.
    fn add_prism(&mut self, core: &ConvexPolyhedron, face: &Face, radius: f64) {
        let area = Area::of(core, face);
        let normal = face.normal;
        self.volume += area.area * radius;
        self.first += area.first * radius + normal * (area.area * radius.powi(2) / 2.0);
        self.second += area.second * radius
            + symmetric(&area.first, &normal) * (radius.powi(2) / 2.0)
            + normal * normal.transpose() * (area.area * radius.powi(3) / 3.0);
    }

    /// The sector of a cylinder along one edge.
    fn add_edge(&mut self, core: &ConvexPolyhedron, edge: &Edge, radius: f64) {
        let [start, end] = edge.vertices.map(|v| core.vertices()[v]);
        let middle = (start + end) / 2.0;
        let along = edge.direction;
        let arc = Arc::of(core, edge);
        let section = arc.angle * radius.powi(2) / 2.0;
        let lever = arc.integral() * (radius.powi(3) / 3.0);
        let spread = arc.second_integral(&along) * (radius.powi(4) / 4.0);
        self.volume += section * edge.length;
        self.first += (middle * section + lever) * edge.length;
        self.second += (middle * middle.transpose() * section
            + along * along.transpose() * (section * edge.length.powi(2) / 12.0)
            + symmetric(&middle, &lever)
            + spread)
            * edge.length;
    }

    /// The sector of a ball at one vertex.
    fn add_corner(&mut self, core: &ConvexPolyhedron, vertex: usize, radius: f64) {
        let tip = core.vertices()[vertex];
        let solid_angle = solid_angle_of_normals(core, vertex);
        let mut directions = Vector3::zeros();
        let mut spread = Matrix3::from_diagonal_element(solid_angle / 3.0);
        for edge in core.edges().iter().filter(|e| e.vertices.contains(&vertex)) {
            let starts_here = edge.vertices[0] == vertex;
            let pole = if starts_here {
                -edge.direction
            } else {
                edge.direction
            };
            let arc = Arc::of(core, edge);
            directions += pole * (arc.angle / 2.0);
            spread += symmetric(&arc.integral(), &pole) / 6.0;
        }
        let volume = solid_angle * radius.powi(3) / 3.0;
        let lever = directions * (radius.powi(4) / 4.0);
        self.volume += volume;
        self.first += tip * volume + lever;
        self.second += tip * tip.transpose() * volume
            + symmetric(&tip, &lever)
            + spread * (radius.powi(5) / 5.0);
    }
}

/// a bᵀ + b aᵀ.
fn symmetric(a: &Vector3<f64>, b: &Vector3<f64>) -> Matrix3<f64> {
    a * b.transpose() + b * a.transpose()
}

/// ∫ dA, ∫ x dA and ∫ x xᵀ dA over a face.
struct Area {
    area: f64,
    first: Vector3<f64>,
    second: Matrix3<f64>,
}

impl Area {
    fn of(core: &ConvexPolyhedron, face: &Face) -> Self {
        let corner = |k: usize| core.vertices()[face.vertices[k]];
        let mut sum = Self {
            area: 0.0,
            first: Vector3::zeros(),
            second: Matrix3::zeros(),
        };
        for k in 1..face.vertices.len() - 1 {
            sum.add_triangle([corner(0), corner(k), corner(k + 1)], &face.normal);
        }
        sum
    }

    /// ∫ x xᵀ over a triangle is A/12 (Σ v vᵀ + s sᵀ) with s = Σ v.
    fn add_triangle(&mut self, corners: [Vector3<f64>; 3], normal: &Vector3<f64>) {
        let [a, b, c] = corners;
        let area = (b - a).cross(&(c - a)).dot(normal) / 2.0;
        let sum = a + b + c;
        let squares = a * a.transpose() + b * b.transpose() + c * c.transpose();
        self.area += area;
        self.first += sum * (area / 3.0);
        self.second += (squares + sum * sum.transpose()) * (area / 12.0);
    }
}

/// The unit arc from one face's normal to the other's around an edge.
struct Arc {
    angle: f64,
    bisector: Vector3<f64>,
}

impl Arc {
    fn of(core: &ConvexPolyhedron, edge: &Edge) -> Self {
        let [first, second] = edge.faces.map(|face| core.faces()[face].normal);
        Self {
            angle: PI - edge.interior_dihedral,
            bisector: (first + second).normalize(),
        }
    }

    /// ∫ u ds.
    fn integral(&self) -> Vector3<f64> {
        self.bisector * (2.0 * (self.angle / 2.0).sin())
    }

    /// ∫ u uᵀ ds, the arc's plane being normal to `along`.
    fn second_integral(&self, along: &Vector3<f64>) -> Matrix3<f64> {
        let across = along.cross(&self.bisector);
        let (half, sine) = (self.angle / 2.0, self.angle.sin() / 2.0);
        self.bisector * self.bisector.transpose() * (half + sine)
            + across * across.transpose() * (half - sine)
    }
}

/// Solid angle of the directions in which `vertex` is the farthest [sr].
fn solid_angle_of_normals(core: &ConvexPolyhedron, vertex: usize) -> f64 {
    let corner_angle = |face: &Face| {
        let count = face.vertices.len();
        let place = face.vertices.iter().position(|&v| v == vertex)?;
        let here = core.vertices()[vertex];
        let next = core.vertices()[face.vertices[(place + 1) % count]] - here;
        let previous = core.vertices()[face.vertices[(place + count - 1) % count]] - here;
        Some(f64::atan2(
            next.cross(&previous).norm(),
            next.dot(&previous),
        ))
    };
    2.0 * PI - core.faces().iter().filter_map(corner_angle).sum::<f64>()
}
