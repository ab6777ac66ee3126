//! Convex polyhedra: vertices, faces as loops, and the edges that follow.

use super::check;
use super::error::ShapeError;
use super::face::{Face, sides};
use nalgebra::Vector3;

/// An edge of a convex polyhedron.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// Its ends; the loop of `faces[0]` runs from the first to the second.
    pub vertices: [usize; 2],
    /// The two faces that share it.
    pub faces: [usize; 2],
    /// Unit vector from the first end to the second.
    pub direction: Vector3<f64>,
    /// Length [m].
    pub length: f64,
    /// Angle between the faces inside the solid, 0 < φ < π \[rad\].
    pub interior_dihedral: f64,
}

/// A closed convex polyhedron with flat, strictly convex faces.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvexPolyhedron {
    vertices: Vec<Vector3<f64>>,
    faces: Vec<Face>,
    edges: Vec<Edge>,
}

impl ConvexPolyhedron {
    /// A polyhedron from its vertices [m] and one loop of vertex indices per face,
    /// counter-clockwise seen from outside. Coplanar neighbours must be one face.
    ///
    /// # Errors
    /// Input that is not a closed, strictly convex solid; see [`ShapeError`].
    pub fn new(vertices: Vec<Vector3<f64>>, loops: Vec<Vec<usize>>) -> Result<Self, ShapeError> {
        check::loops(&vertices, &loops)?;
        let mut edges = pair_half_edges(&loops)?;
        check::euler(vertices.len(), edges.len(), loops.len())?;
        let faces: Vec<Face> = loops
            .into_iter()
            .map(|vertex_loop| face(&vertices, &edges, vertex_loop))
            .collect();
        check::convex(&vertices, &faces)?;
        for edge in &mut edges {
            measure(edge, &vertices, &faces);
        }
        Ok(Self {
            vertices,
            faces,
            edges,
        })
    }

    /// Vertices [m].
    pub fn vertices(&self) -> &[Vector3<f64>] {
        &self.vertices
    }

    /// Faces, in the order of the loops given.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// Edges, each once.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The polyhedron moved by `shift` [m].
    pub fn translated(mut self, shift: &Vector3<f64>) -> Self {
        for vertex in &mut self.vertices {
            *vertex += shift;
        }
        for face in &mut self.faces {
            face.offset += face.normal.dot(shift);
        }
        self
    }
}

/// Joins every side of a face with the opposite side of its neighbour.
fn pair_half_edges(loops: &[Vec<usize>]) -> Result<Vec<Edge>, ShapeError> {
    let half_edges: Vec<(usize, usize, usize)> = loops
        .iter()
        .enumerate()
        .flat_map(|(face, vertex_loop)| sides(vertex_loop).map(move |(a, b)| (a, b, face)))
        .collect();
    let mut edges = Vec::with_capacity(half_edges.len() / 2);
    for &(from, to, face) in &half_edges {
        let same = half_edges.iter().filter(|h| (h.0, h.1) == (from, to));
        let mut opposite = half_edges.iter().filter(|h| (h.0, h.1) == (to, from));
        let (Some(other), None, 1) = (opposite.next(), opposite.next(), same.count()) else {
            return Err(ShapeError::EdgeNotShared { from, to });
        };
        if from < to {
            edges.push(Edge {
                vertices: [from, to],
                faces: [face, other.2],
                direction: Vector3::zeros(),
                length: 0.0,
                interior_dihedral: 0.0,
            });
        }
    }
    Ok(edges)
}

/// The plane of a loop by Newell's formula, which uses all vertices equally.
fn face(vertices: &[Vector3<f64>], edges: &[Edge], vertex_loop: Vec<usize>) -> Face {
    let count = vertex_loop.len() as f64;
    let centre = vertex_loop
        .iter()
        .map(|&v| vertices[v])
        .sum::<Vector3<f64>>()
        / count;
    let area_vector: Vector3<f64> = sides(&vertex_loop)
        .map(|(a, b)| (vertices[a] - centre).cross(&(vertices[b] - centre)))
        .sum();
    let normal = area_vector
        .try_normalize(0.0)
        .unwrap_or_else(Vector3::zeros);
    let side_edges = sides(&vertex_loop)
        .filter_map(|(a, b)| {
            let ends = [a.min(b), a.max(b)];
            edges.iter().position(|edge| edge.vertices == ends)
        })
        .collect();
    Face {
        normal,
        offset: normal.dot(&centre),
        vertices: vertex_loop,
        edges: side_edges,
    }
}

/// Computes an edge's geometry after the faces have been checked.
fn measure(edge: &mut Edge, vertices: &[Vector3<f64>], faces: &[Face]) {
    let along = vertices[edge.vertices[1]] - vertices[edge.vertices[0]];
    edge.length = along.norm();
    edge.direction = along / edge.length;
    let [first, second] = edge.faces.map(|face| faces[face].normal);
    let exterior = f64::atan2(first.cross(&second).norm(), first.dot(&second));
    edge.interior_dihedral = std::f64::consts::PI - exterior;
}
