//! Cores without volume: a segment on the x axis, or the point that is left of it at length 0.
//! Swept by a sphere, they are a capsule and a ball.

use super::closest::{Closest, Feature, outside};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// A segment on the x axis, its middle at the origin; without length a point.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Segment {
    /// Half its length [m], at least 0.
    half: f64,
    /// Its ends, −x first; of a point only one.
    vertices: Vec<Vector3<f64>>,
}

impl Segment {
    /// The origin.
    pub(super) fn point() -> Self {
        Self {
            half: 0.0,
            vertices: vec![Vector3::zeros()],
        }
    }

    /// A segment of this length [m], above 0.
    pub(super) fn of_length(length: f64) -> Self {
        let half = 0.5 * length;
        Self {
            half,
            vertices: vec![-Vector3::x() * half, Vector3::x() * half],
        }
    }

    /// Its ends [m].
    pub(super) fn vertices(&self) -> &[Vector3<f64>] {
        &self.vertices
    }

    /// True if it has a length, and so an edge.
    pub(super) fn has_edge(&self) -> bool {
        self.vertices.len() == 2
    }

    /// Nearest feature. For x on the axis itself every direction across is as good: the normal is
    /// then +z, and continuous nowhere near.
    pub(super) fn closest(&self, x: &Vector3<f64>) -> Closest {
        let along = x.x.clamp(-self.half, self.half);
        let feature = if self.has_edge() && along == x.x {
            Feature::Edge(0)
        } else {
            Feature::Vertex(usize::from(self.has_edge() && x.x > 0.0))
        };
        outside(feature, Vector3::x() * along, x, &Vector3::z())
    }

    /// Volume of the segment dilated by a sphere [m³].
    pub(super) fn dilated_volume(&self, radius: f64) -> f64 {
        PI * radius.powi(2) * (2.0 * self.half + 4.0 / 3.0 * radius)
    }

    /// Surface of the segment dilated by a sphere [m²].
    pub(super) fn dilated_surface(&self, radius: f64) -> f64 {
        4.0 * PI * radius * (self.half + radius)
    }

    /// Inertia tensor of the segment dilated by a sphere for density 1 [m⁵]: of a cylinder and two
    /// half balls, whose centres of mass are 3/8 of the radius from their flats.
    pub(super) fn dilated_inertia(&self, radius: f64) -> Matrix3<f64> {
        let square = radius.powi(2);
        let cylinder = 2.0 * PI * square * self.half;
        let ball = 4.0 / 3.0 * PI * square * radius;
        let axial = cylinder * square / 2.0 + ball * (0.4 * square);
        let across = cylinder * (self.half.powi(2) / 3.0 + square / 4.0)
            + ball * (0.4 * square + self.half * (self.half + 0.75 * radius));
        Matrix3::from_diagonal(&Vector3::new(axial, across, across))
    }

    /// Largest compliance by turning alone of a place of the rounded surface. Around an end, at an
    /// angle α from the axis, it is r² sin²α/I_x + (½ l + r cos α)²/I_y in the direction across both.
    pub(super) fn turning_compliance(&self, radius: f64, inertia: &Matrix3<f64>) -> f64 {
        let (axial, across) = (inertia[(0, 0)], inertia[(1, 1)]);
        let excess = radius * (across - axial);
        let cosine = if self.half * axial < excess {
            self.half * axial / excess
        } else {
            1.0
        };
        let lever = self.half + radius * cosine;
        radius.powi(2) * (1.0 - cosine * cosine) / axial + lever.powi(2) / across
    }
}
