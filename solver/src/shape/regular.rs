//! The five regular solids.

use super::error::ShapeError;
use super::hull::hull_of;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// A solid with equal regular faces, as JSON by its name in small letters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RegularSolid {
    /// Four triangles.
    Tetrahedron,
    /// Six squares.
    Cube,
    /// Eight triangles.
    Octahedron,
    /// Twelve pentagons.
    Dodecahedron,
    /// Twenty triangles.
    Icosahedron,
}

impl RegularSolid {
    /// All regular solids, by the number of faces.
    pub const ALL: [Self; 5] = [
        Self::Tetrahedron,
        Self::Cube,
        Self::Octahedron,
        Self::Dodecahedron,
        Self::Icosahedron,
    ];

    /// Its vertices [m] when it lies on a face: one face is lowest and normal to z, with an edge
    /// along y.
    pub(super) fn lying(self, edge_m: f64) -> Result<Vec<Vector3<f64>>, ShapeError> {
        let standing = hull_of(&self.vertices(edge_m))?;
        let lowest = &standing.faces()[0];
        let along = standing.edges()[lowest.edges[0]].direction;
        let to_lying = Matrix3::from_rows(&[
            along.cross(&-lowest.normal).transpose(),
            along.transpose(),
            -lowest.normal.transpose(),
        ]);
        Ok(standing.vertices().iter().map(|v| to_lying * v).collect())
    }

    /// Its vertices for edges of length `edge_m`, about its centre [m].
    pub(super) fn vertices(self, edge_m: f64) -> Vec<Vector3<f64>> {
        let golden = (1.0 + 5_f64.sqrt()) / 2.0;
        let (vertices, edge) = match self {
            Self::Tetrahedron => {
                let odd = |v: &Vector3<f64>| v.product() > 0.0;
                let vertices = signs([1.0; 3]).into_iter().filter(odd).collect();
                (vertices, 8_f64.sqrt())
            }
            Self::Cube => (signs([1.0; 3]), 2.0),
            Self::Octahedron => (cyclic([0.0, 0.0, 1.0]), 2_f64.sqrt()),
            Self::Dodecahedron => {
                let mut vertices = signs([1.0; 3]);
                vertices.extend(cyclic([0.0, 1.0 / golden, golden]));
                (vertices, 2.0 / golden)
            }
            Self::Icosahedron => (cyclic([0.0, 1.0, golden]), 2.0),
        };
        vertices.iter().map(|v| v * (edge_m / edge)).collect()
    }
}

/// Places with every combination of signs of these coordinates.
fn signs([x, y, z]: [f64; 3]) -> Vec<Vector3<f64>> {
    let both = |c: f64| {
        if c == 0.0 { vec![0.0] } else { vec![c, -c] }
    };
    let mut all = Vec::new();
    for x in both(x) {
        for y in both(y) {
            all.extend(both(z).into_iter().map(|z| Vector3::new(x, y, z)));
        }
    }
    all
}

/// Places with every combination of signs of the coordinates, in each cyclic order.
fn cyclic([x, y, z]: [f64; 3]) -> Vec<Vector3<f64>> {
    [[x, y, z], [y, z, x], [z, x, y]]
        .into_iter()
        .flat_map(signs)
        .collect()
}
