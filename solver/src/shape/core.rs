//! Cores: every kind of convex set that a sphere is swept over. A further kind of core is a
//! variant here, with its geometry in a file of its own.

use super::closest::Closest;
use super::cuboid::Cuboid;
use super::face::Face;
use super::moments::Moments;
use super::polyhedron::{ConvexPolyhedron, Edge};
use super::segment::Segment;
use super::steiner;
use super::walk::Walk;
use nalgebra::{Matrix3, Vector3};

/// Sine of the angle of two edges below which they have no common normal: they are parallel,
/// and face normals separate instead.
pub(super) const PARALLEL: f64 = 1e-12;

/// Sine of the angle of an edge and a face below which they may be parallel.
const SLIGHT: f64 = 1e-9;

/// A convex set whose nearest feature can be found. Only one with a volume has faces.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Core {
    /// A segment or a point.
    Segment(Segment),
    /// A box, its nearest feature in closed form.
    Cuboid(ConvexPolyhedron, Box<Cuboid>),
    /// A polyhedron, its nearest feature by a walk over its surface.
    Polyhedron(ConvexPolyhedron, Walk),
}

/// An edge of a core.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoreEdge {
    /// Its ends, by their index into the vertices.
    pub vertices: [usize; 2],
    /// Unit vector from the first end to the second.
    pub direction: Vector3<f64>,
}

impl Core {
    /// The core as a polyhedron, if it has a volume.
    pub(super) fn solid(&self) -> Option<&ConvexPolyhedron> {
        match self {
            Self::Segment(_) => None,
            Self::Cuboid(solid, _) | Self::Polyhedron(solid, _) => Some(solid),
        }
    }

    fn segment(&self) -> Option<&Segment> {
        match self {
            Self::Segment(segment) => Some(segment),
            Self::Cuboid(..) | Self::Polyhedron(..) => None,
        }
    }

    /// Vertices [m].
    pub(super) fn vertices(&self) -> &[Vector3<f64>] {
        match self {
            Self::Segment(segment) => segment.vertices(),
            Self::Cuboid(solid, _) | Self::Polyhedron(solid, _) => solid.vertices(),
        }
    }

    /// Edges, each once.
    pub(super) fn edges(&self) -> impl Iterator<Item = CoreEdge> + Clone + '_ {
        let of_solid = self.solid().into_iter().flat_map(ConvexPolyhedron::edges);
        let of_segment = self.segment().filter(|segment| segment.has_edge());
        of_solid
            .map(|edge| CoreEdge {
                vertices: edge.vertices,
                direction: edge.direction,
            })
            .chain(of_segment.map(|_| CoreEdge {
                vertices: [0, 1],
                direction: Vector3::x(),
            }))
    }

    /// Faces; none without a volume.
    pub(super) fn faces(&self) -> &[Face] {
        self.solid().map_or(&[], ConvexPolyhedron::faces)
    }

    /// Nearest feature.
    pub(super) fn closest(&self, x: &Vector3<f64>) -> Closest {
        match self {
            Self::Segment(segment) => segment.closest(x),
            Self::Cuboid(_, cuboid) => cuboid.closest(x),
            Self::Polyhedron(_, walk) => walk.closest(x),
        }
    }

    /// Volume of the core dilated by a sphere [m³].
    pub(super) fn dilated_volume(&self, radius: f64) -> f64 {
        match self {
            Self::Segment(segment) => segment.dilated_volume(radius),
            Self::Cuboid(solid, _) | Self::Polyhedron(solid, _) => steiner::volume(solid, radius),
        }
    }

    /// Surface of the core dilated by a sphere [m²].
    pub(super) fn dilated_surface(&self, radius: f64) -> f64 {
        match self {
            Self::Segment(segment) => segment.dilated_surface(radius),
            Self::Cuboid(solid, _) | Self::Polyhedron(solid, _) => steiner::surface(solid, radius),
        }
    }

    /// Inertia tensor about the origin of the core dilated by a sphere, for density 1 [m⁵].
    pub(super) fn dilated_inertia(&self, radius: f64) -> Matrix3<f64> {
        match self {
            Self::Segment(segment) => segment.dilated_inertia(radius),
            Self::Cuboid(solid, _) | Self::Polyhedron(solid, _) => {
                Moments::of_dilated(solid, radius).inertia()
            }
        }
    }

    /// Largest compliance of a surface place by turning alone, for density 1: of a polyhedron that
    /// of the places within the radius of a vertex, the largest eigenvalue of −[c]× I⁻¹ [c]×.
    pub(super) fn turning_compliance(&self, radius: f64, unit_inertia: &Matrix3<f64>) -> f64 {
        match self {
            Self::Segment(segment) => segment.turning_compliance(radius, unit_inertia),
            Self::Cuboid(..) | Self::Polyhedron(..) => {
                of_vertices(self.vertices(), radius, unit_inertia)
            }
        }
    }

    /// Radius of the largest ball about the origin that does not leave the core [m].
    pub(super) fn inscribed_radius(&self) -> f64 {
        match self {
            Self::Segment(_) => 0.0,
            Self::Cuboid(solid, _) | Self::Polyhedron(solid, _) => {
                let offsets = solid.faces().iter().map(|face| face.offset);
                offsets.fold(f64::INFINITY, f64::min)
            }
        }
    }

    /// True if two of its vertices are further apart along a unit vector than this [m], and by more
    /// than rounding: most directions are told so by the first few.
    pub(super) fn is_wider(&self, direction: &Vector3<f64>, width: f64) -> bool {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        self.vertices().iter().any(|vertex| {
            let place = direction.dot(vertex);
            (low, high) = (low.min(place), high.max(place));
            high - low > width * (1.0 + 1e-9)
        })
    }

    /// Directions that have the one of least width among them: two parallel planes round a
    /// polyhedron touch it in faces, a face and a vertex, or two edges; round a segment, along it.
    pub(super) fn narrow_directions(&self) -> Vec<Vector3<f64>> {
        let Some(solid) = self.solid() else {
            return vec![Vector3::y()];
        };
        let edges = solid.edges();
        // Slopes of every edge against every face.
        let slope = |edge: &Edge, face: &Face| edge.direction.dot(&face.normal);
        let slopes: Vec<Vec<f64>> = (edges.iter())
            .map(|edge| solid.faces().iter().map(|face| slope(edge, face)).collect())
            .collect();
        // Normal to both edges, a plane touches the solid along one only if the faces there turn
        // to either side of the other.
        let turns = |along: usize, at: &Edge| {
            let [one, other] = at.faces.map(|face| slopes[along][face]);
            one.min(other) <= SLIGHT && one.max(other) >= -SLIGHT
        };
        let pairs = (0..edges.len()).flat_map(|a| (a + 1..edges.len()).map(move |b| (a, b)));
        let directions = pairs
            .filter(|&(a, b)| turns(a, &edges[b]) && turns(b, &edges[a]))
            .map(|(a, b)| edges[a].direction.cross(&edges[b].direction))
            .filter_map(|cross| cross.try_normalize(PARALLEL));
        let normals = solid.faces().iter().map(|face| face.normal);
        normals.chain(directions).collect()
    }
}

fn of_vertices(vertices: &[Vector3<f64>], radius: f64, unit_inertia: &Matrix3<f64>) -> f64 {
    let inverse = unit_inertia.try_inverse().unwrap_or_else(Matrix3::zeros);
    let of_vertex = |vertex: &Vector3<f64>| {
        let place = vertex + vertex.normalize() * radius;
        let cross = place.cross_matrix();
        (cross * inverse * cross.transpose())
            .symmetric_eigenvalues()
            .max()
    };
    vertices.iter().map(of_vertex).fold(0.0, f64::max)
}
