//! Errors of a description that is not a sphero-polyhedron.

use thiserror::Error;

/// A shape that can't be built.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A length is not positive and finite.
    #[error("{quantity} is {value} m, not a positive finite length")]
    NotPositive {
        /// Name of the length.
        quantity: &'static str,
        /// Value received [m].
        value: f64,
    },
    /// The rounding sphere does not fit into the shape.
    #[error("the sphero radius {radius_m} m is not below the inradius {inradius_m} m")]
    RadiusNotBelowInradius {
        /// Radius of the rounding sphere [m].
        radius_m: f64,
        /// Radius of the largest sphere inside the shape [m].
        inradius_m: f64,
    },
    /// The core that remains after rounding is so thin that rounding errors blur its faces.
    #[error(
        "the sphero radius {radius_m} m leaves a core {thickness_m} m thick, too thin to tell its faces apart in a solid of {size_m} m; up to {allowed_m} m can be used"
    )]
    NoCore {
        /// Radius of the rounding sphere [m].
        radius_m: f64,
        /// Thickness of the core [m].
        thickness_m: f64,
        /// Diameter of the solid [m].
        size_m: f64,
        /// Largest radius that surely leaves a core [m].
        allowed_m: f64,
    },
    /// Faces nearly in one plane contradict each other after rounding.
    #[error(
        "with the sphero radius {radius_m} m faces can't be told apart that are nearly in one plane, the closest {least_angle_rad} rad from each other; faces within 1e-5 rad are one, those more than 1e-3 rad apart are told apart"
    )]
    BlurredFaces {
        /// Radius of the rounding sphere [m].
        radius_m: f64,
        /// Least angle of two faces \[rad\].
        least_angle_rad: f64,
    },
    /// A vertex has a non-finite coordinate.
    #[error("vertex {vertex} is not finite")]
    NotFinite {
        /// Index of the vertex.
        vertex: usize,
    },
    /// Fewer vertices or faces than those of a tetrahedron.
    #[error("{vertices} vertices and {faces} faces enclose nothing")]
    TooFew {
        /// Number of vertices.
        vertices: usize,
        /// Number of faces.
        faces: usize,
    },
    /// A face's loop is too short, repeats a vertex, or has an index that does not exist.
    #[error("face {face} is no loop of three or more different vertices")]
    BadLoop {
        /// Index of the face.
        face: usize,
    },
    /// An edge lacks its second face, or has a third: the surface is not closed,
    /// or the loops do not all run the same way round.
    #[error("the edge from vertex {from} to vertex {to} is not shared by exactly two faces")]
    EdgeNotShared {
        /// First vertex, in the loop's sense.
        from: usize,
        /// Second vertex.
        to: usize,
    },
    /// Closed, but not topologically a sphere (a vertex outside every face, a hole).
    #[error("{vertices} vertices - {edges} edges + {faces} faces is not 2 (Euler)")]
    NotABall {
        /// Number of vertices.
        vertices: usize,
        /// Number of edges.
        edges: usize,
        /// Number of faces.
        faces: usize,
    },
    /// A face has no area, a bent surface, or a corner that is not convex.
    #[error("face {face} is not a flat, strictly convex polygon")]
    BadFace {
        /// Index of the face.
        face: usize,
    },
    /// A vertex lies in front of a face, or in its plane without belonging to it.
    #[error(
        "vertex {vertex} is not behind face {face}: the solid is not strictly convex, or the loops do not run counter-clockwise seen from outside"
    )]
    NotConvex {
        /// Index of the face.
        face: usize,
        /// Index of the vertex.
        vertex: usize,
    },
}
