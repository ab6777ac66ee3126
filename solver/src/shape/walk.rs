//! The nearest feature of any convex core, fast: a walk from feature to feature, each step to a
//! neighbour that is nearer (after Lin & Canny 1991).
//!
//! It starts on the face whose plane x is farthest in front of and takes no other face that is
//! not visible from x. On such faces a place that is nearer than all its neighbours is the
//! nearest of all: at a vertex or an edge where no step to a visible face shortens the
//! distance, x lies in the feature's normal cone. Every step is taken only if the distance
//! decreases, so rounding can't cause cycles.

use super::closest::{Closest, Feature, on_face, outside};
use super::face::Face;
use super::polyhedron::{ConvexPolyhedron, Edge};
use nalgebra::Vector3;

/// A core in the layout of the walk.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Walk {
    /// Outward unit normal and offset of every face's plane.
    planes: Vec<Plane>,
    /// Index of the first rail of every face; one more for the end.
    first_rail: Vec<usize>,
    /// Sides of the faces, face by face.
    rails: Vec<Rail>,
    sides: Vec<Side>,
    vertices: Vec<Vector3<f64>>,
    /// Index of the first spoke of every vertex; one more for the end.
    first_spoke: Vec<usize>,
    /// Edges that end in a vertex, vertex by vertex.
    spokes: Vec<usize>,
}

#[derive(Debug, Clone, PartialEq)]
struct Plane {
    normal: Vector3<f64>,
    offset: f64,
}

/// A side of a face: the plane through it, normal to the face.
#[derive(Debug, Clone, PartialEq)]
struct Rail {
    /// Unit vector in the face's plane, into the face.
    inward: Vector3<f64>,
    offset: f64,
    edge: usize,
}

/// An edge, with both adjacent sides.
#[derive(Debug, Clone, PartialEq)]
struct Side {
    ends: [usize; 2],
    start: Vector3<f64>,
    direction: Vector3<f64>,
    length: f64,
    /// Its faces, and the index of their rail on it.
    faces: [usize; 2],
    rails: [usize; 2],
}

/// Current state of the walk: a feature, its place nearest to x, and the square of the distance
/// from x.
#[derive(Debug, Clone, Copy)]
struct Stand {
    feature: Feature,
    place: Vector3<f64>,
    squared: f64,
}

impl Walk {
    /// Walk layout of a core.
    pub(super) fn on(core: &ConvexPolyhedron) -> Self {
        let mut first_rail = vec![0];
        let mut rails = Vec::new();
        for face in core.faces() {
            rails.extend(face.edges.iter().map(|&edge| rail(core, face, edge)));
            first_rail.push(rails.len());
        }
        let side = |(index, edge): (usize, &Edge)| Side {
            ends: edge.vertices,
            start: core.vertices()[edge.vertices[0]],
            direction: edge.direction,
            length: edge.length,
            faces: edge.faces,
            rails: edge.faces.map(|face| {
                let own = core.faces()[face].edges.iter().position(|&e| e == index);
                first_rail[face] + own.unwrap_or(0)
            }),
        };
        let sides = core.edges().iter().enumerate().map(side).collect();
        let mut first_spoke = vec![0];
        let mut spokes = Vec::new();
        for vertex in 0..core.vertices().len() {
            let ends_here = |edge: &usize| core.edges()[*edge].vertices.contains(&vertex);
            spokes.extend((0..core.edges().len()).filter(ends_here));
            first_spoke.push(spokes.len());
        }
        Self {
            planes: (core.faces().iter())
                .map(|face| Plane {
                    normal: face.normal,
                    offset: face.offset,
                })
                .collect(),
            first_rail,
            rails,
            sides,
            vertices: core.vertices().to_vec(),
            first_spoke,
            spokes,
        }
    }

    /// Nearest feature of the core.
    pub(super) fn closest(&self, x: &Vector3<f64>) -> Closest {
        let (first, height) = self.deepest(x);
        if height <= 0.0 {
            return on_face(first, &self.planes[first].normal, x, height);
        }
        let (mut face, mut height) = (first, height);
        let mut stand = Stand {
            feature: Feature::Face(first),
            place: *x,
            squared: f64::INFINITY,
        };
        loop {
            let Some(rim) = self.on_rim(face, x) else {
                return on_face(face, &self.planes[face].normal, x, height);
            };
            if rim.squared >= stand.squared {
                break;
            }
            let onward;
            (stand, onward) = self.along_edges(rim, x);
            match onward {
                Some(next) => (face, height) = next,
                None => break,
            }
        }
        outside(stand.feature, stand.place, x, &self.planes[first].normal)
    }

    /// The face whose plane x is farthest in front of, or least behind.
    fn deepest(&self, x: &Vector3<f64>) -> (usize, f64) {
        let mut best = (0, f64::NEG_INFINITY);
        for face in 0..self.planes.len() {
            let height = self.height(face, x);
            if height > best.1 {
                best = (face, height);
            }
        }
        best
    }

    fn height(&self, face: usize, x: &Vector3<f64>) -> f64 {
        let plane = &self.planes[face];
        plane.normal.dot(x) - plane.offset
    }

    /// The place of a face's rim nearest to x; none if x is above the face.
    fn on_rim(&self, face: usize, x: &Vector3<f64>) -> Option<Stand> {
        let mut nearest: Option<Stand> = None;
        for rail in &self.rails[self.first_rail[face]..self.first_rail[face + 1]] {
            if rail.inward.dot(x) < rail.offset {
                let stand = self.on_edge(rail.edge, x);
                if nearest.is_none_or(|nearest| stand.squared < nearest.squared) {
                    nearest = Some(stand);
                }
            }
        }
        nearest
    }

    /// The place of an edge nearest to x; beyond an end, the vertex there.
    fn on_edge(&self, edge: usize, x: &Vector3<f64>) -> Stand {
        let side = &self.sides[edge];
        let along = (x - side.start).dot(&side.direction);
        let (feature, place) = if along <= 0.0 {
            (Feature::Vertex(side.ends[0]), side.start)
        } else if along >= side.length {
            (Feature::Vertex(side.ends[1]), self.vertices[side.ends[1]])
        } else {
            (Feature::Edge(edge), side.start + side.direction * along)
        };
        Stand {
            feature,
            place,
            squared: (x - place).norm_squared(),
        }
    }

    /// Continues over edges and vertices until none is nearer, or a face is: that face and the
    /// height of x over it.
    fn along_edges(&self, start: Stand, x: &Vector3<f64>) -> (Stand, Option<(usize, f64)>) {
        let mut stand = start;
        loop {
            match stand.feature {
                Feature::Vertex(vertex) => match self.nearer_spoke(vertex, stand.squared, x) {
                    Some(next) => stand = next,
                    None => return (stand, None),
                },
                Feature::Edge(edge) => return (stand, self.beside(edge, x)),
                Feature::Face(_) => return (stand, None),
            }
        }
    }

    /// The nearest place on the edges at a vertex, if it is nearer than the vertex.
    fn nearer_spoke(&self, vertex: usize, squared: f64, x: &Vector3<f64>) -> Option<Stand> {
        let spokes = &self.spokes[self.first_spoke[vertex]..self.first_spoke[vertex + 1]];
        let seen = |edge: &&usize| {
            let faces = self.sides[**edge].faces;
            faces.iter().any(|&face| self.height(face, x) > 0.0)
        };
        let on_spoke = |&edge: &usize| self.on_edge(edge, x);
        let stands = spokes.iter().filter(seen).map(on_spoke);
        let nearest = stands.min_by(|a, b| a.squared.total_cmp(&b.squared))?;
        (nearest.squared < squared).then_some(nearest)
    }

    /// The face beside an edge above which x is, seen along the face from the edge.
    fn beside(&self, edge: usize, x: &Vector3<f64>) -> Option<(usize, f64)> {
        let side = &self.sides[edge];
        for (&face, &rail) in side.faces.iter().zip(&side.rails) {
            let rail = &self.rails[rail];
            let height = self.height(face, x);
            if height > 0.0 && rail.inward.dot(x) > rail.offset {
                return Some((face, height));
            }
        }
        None
    }
}

fn rail(core: &ConvexPolyhedron, face: &Face, edge: usize) -> Rail {
    let of_edge = &core.edges()[edge];
    // The loop of an edge's first face runs along it, and has the face to its left.
    let first = std::ptr::eq(face, &core.faces()[of_edge.faces[0]]);
    let along = if first {
        of_edge.direction
    } else {
        -of_edge.direction
    };
    let inward = face.normal.cross(&along);
    Rail {
        inward,
        offset: inward.dot(&core.vertices()[of_edge.vertices[0]]),
        edge,
    }
}
