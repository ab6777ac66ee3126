//! Separation of two bodies along the face normals of their cores; where neither has faces,
//! along the line of their nearest places.

use super::segments::nearest_places;
use crate::math::Vec3;
use crate::rigid::Body;
use crate::shape::distance_apart;
use nalgebra::{Isometry3, Translation3};

/// The gap of two bodies along a direction: a lower bound of their distance if positive.
pub(super) struct Gap {
    pub(super) width: f64,
    /// Unit vector from the first body to the second.
    pub(super) direction: Vec3,
    /// Positions along it where the first core ends and the second begins.
    pub(super) first_to: f64,
    pub(super) second_from: f64,
}

/// Bound of the gap of two bodies from the last evaluation. It saves work and changes no
/// contact: bodies that are skipped do not touch.
#[derive(Debug, Clone, Copy, Default)]
pub struct Separation {
    /// Face with the widest gap, counted over the first's faces, then the second's.
    face: Option<usize>,
    /// A lower bound of the distance of the rounded bodies [m]; of no use below 0.
    pub(super) gap: f64,
}

impl Separation {
    /// True if they are still apart after coming nearer by at most `by` [m].
    pub fn outlasts(&mut self, by: f64) -> bool {
        self.gap -= by;
        self.gap > 0.0
    }

    /// Lower bound of their distance [m]; 0 if none is known.
    pub fn at_least(&self) -> f64 {
        self.gap.max(0.0)
    }

    /// A separating gap: that of the face found before, or else the widest.
    pub(super) fn look(
        &mut self,
        bodies: [&Body; 2],
        apart: &Vec3,
        corners: &[Vec<Vec3>; 2],
    ) -> Gap {
        if let Some(face) = self.face {
            return gap_at(bodies, apart, corners, face);
        }
        let (face, gap) = widest_gap(bodies, apart, corners);
        self.face = face;
        gap
    }
}

/// The gap along the normal of a face, counted over the first's faces, then the second's.
fn gap_at(
    [first, second]: [&Body; 2],
    apart: &Vec3,
    corners: &[Vec<Vec3>; 2],
    number: usize,
) -> Gap {
    let faces = first.shape.faces();
    let (direction, first_to, second_from) = if let Some(face) = faces.get(number) {
        let direction = first.to_world(&face.normal);
        let heights = corners[1].iter().map(|x| direction.dot(x));
        (
            direction,
            face.offset,
            heights.fold(f64::INFINITY, f64::min),
        )
    } else {
        let face = &second.shape.faces()[number - faces.len()];
        let direction = -second.to_world(&face.normal);
        let heights = corners[0].iter().map(|x| direction.dot(x));
        let first_to = heights.fold(f64::NEG_INFINITY, f64::max);
        (direction, first_to, direction.dot(apart) - face.offset)
    };
    Gap {
        width: second_from - first_to,
        direction,
        first_to,
        second_from,
    }
}

/// The gap along the line of the nearest places of two cores without faces, which is their
/// distance; where they meet, along z.
fn gap_of_nearest(corners: &[Vec<Vec3>; 2]) -> Gap {
    let (on_first, on_second) = nearest_places(&corners[0], &corners[1]);
    let direction = (on_second - on_first).try_normalize(f64::MIN_POSITIVE);
    let direction = direction.unwrap_or_else(Vec3::z);
    let heights = |which: usize| corners[which].iter().map(|x| direction.dot(x));
    let first_to = heights(0).fold(f64::NEG_INFINITY, f64::max);
    let second_from = heights(1).fold(f64::INFINITY, f64::min);
    Gap {
        width: second_from - first_to,
        direction,
        first_to,
        second_from,
    }
}

/// The widest gap, and its face if either body has any.
fn widest_gap(bodies: [&Body; 2], apart: &Vec3, corners: &[Vec<Vec3>; 2]) -> (Option<usize>, Gap) {
    let faces: usize = bodies.iter().map(|body| body.shape.faces().len()).sum();
    if faces == 0 {
        return (None, gap_of_nearest(corners));
    }
    let mut widest = (0, gap_at(bodies, apart, corners, 0));
    for number in 1..faces {
        let gap = gap_at(bodies, apart, corners, number);
        if gap.width > widest.1.width {
            widest = (number, gap);
        }
    }
    (Some(widest.0), widest.1)
}

/// A lower bound of the distance of two rounded bodies [m], from their face
/// normals or, if they have none, exact; of no use below 0.
pub fn least_gap(first: &Body, second: &Body) -> f64 {
    let apart = second.state.position - first.state.position;
    let corners = [corners(first, &Vec3::zeros()), corners(second, &apart)];
    let reach = first.shape.sphero_radius() + second.shape.sphero_radius();
    widest_gap([first, second], &apart, &corners).1.width - reach
}

/// Distance of two rounded bodies that are apart [m].
pub fn distance(first: &Body, second: &Body) -> f64 {
    let pose = |body: &Body| Isometry3 {
        rotation: body.state.orientation,
        translation: Translation3::from(body.state.position),
    };
    let cores = distance_apart(&first.shape, &pose(first), &second.shape, &pose(second));
    cores - first.shape.sphero_radius() - second.shape.sphero_radius()
}

/// Core vertices in world axes, the body's centre being at `centre`.
pub(super) fn corners(body: &Body, centre: &Vec3) -> Vec<Vec3> {
    let turn = body.state.orientation.to_rotation_matrix();
    let vertices = body.shape.core_vertices().iter();
    vertices.map(|vertex| centre + turn * vertex).collect()
}
