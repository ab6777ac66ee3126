//! Separation of two bodies along the face normals of their cores; where neither has faces,
//! along the line of their nearest places.

use super::contact_points::Contacts;
use super::near_features::NearFeatures;
use super::segments::nearest_places;
use crate::math::Vec3;
use crate::rigid::Body;
use crate::shape::distance_apart;
use nalgebra::{Isometry3, Translation3};

/// Core vertices of two bodies in world axes, from the first's centre [m].
pub(super) type Corners = [Vec<Vec3>; 2];

/// The gap of two bodies along a direction: a lower bound of their distance if positive.
pub(super) struct Gap {
    pub(super) width: f64,
    /// Unit vector from the first body to the second.
    pub(super) direction: Vec3,
    /// Positions along it where the first core ends and the second begins.
    pub(super) first_to: f64,
    pub(super) second_from: f64,
}

/// Bound of the gap between two bodies, from the last evaluation, and the features that may touch. It
/// saves work and changes no contact: what is skipped does not touch.
#[derive(Debug, Default)]
pub struct Separation {
    /// Face with the widest gap, counted over the first's faces, then the second's.
    face: Option<usize>,
    /// A lower bound of the distance of the rounded bodies [m]; of no use below 0.
    pub(super) gap: f64,
    /// True if they touched.
    pub(super) touched: bool,
    /// Features that may touch.
    pub(super) near: NearFeatures,
    /// Core vertices, as last put.
    pub(super) corners: Corners,
}

impl Separation {
    /// True if they are still apart after coming nearer by at most `by` [m].
    pub fn outlasts(&mut self, by: f64) -> bool {
        self.gap -= by;
        self.near.approach(by);
        self.gap > 0.0
    }

    /// Lower bound of their distance [m]; 0 if none is known.
    pub fn at_least(&self) -> f64 {
        self.gap.max(0.0)
    }

    /// Lower bound of the distance of their features that do not touch [m], if some of them do;
    /// `found` are the contacts found last.
    pub fn clearance(&self, found: &Contacts) -> f64 {
        found.clearance.min(self.near.margin())
    }

    /// A separating gap: that of the face found before, or else the widest.
    pub(super) fn look(&mut self, bodies: [&Body; 2], apart: &Vec3) -> Gap {
        let gap = if let Some(face) = self.face {
            gap_at(bodies, apart, &self.corners, face)
        } else {
            let (face, gap) = widest_gap(bodies, apart, &self.corners);
            self.face = face;
            gap
        };
        let reach = bodies.map(|body| body.shape.sphero_radius());
        self.gap = gap.width - (reach[0] + reach[1]);
        gap
    }
}

/// Puts the core vertices of two bodies into `corners`; `apart` is the vector from the first's
/// centre to the second's.
pub(super) fn put_corners([first, second]: [&Body; 2], apart: &Vec3, corners: &mut Corners) {
    let [of_first, of_second] = corners;
    first.put_corners(&Vec3::zeros(), of_first);
    second.put_corners(apart, of_second);
}

/// The gap along the normal of a face, counted over the first's faces, then the second's.
fn gap_at([first, second]: [&Body; 2], apart: &Vec3, corners: &Corners, number: usize) -> Gap {
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
fn gap_of_nearest(corners: &Corners) -> Gap {
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
fn widest_gap(bodies: [&Body; 2], apart: &Vec3, corners: &Corners) -> (Option<usize>, Gap) {
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
    let mut corners = Corners::default();
    put_corners([first, second], &apart, &mut corners);
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
