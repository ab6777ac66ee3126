//! Core vertices of a body in world axes.

use super::Body;
use crate::math::Vec3;
use crate::shape::SpheroPolyhedron;
use nalgebra::UnitQuaternion;

/// Core vertices turned into world axes, from the body's centre [m]; kept since all contacts of
/// a body in a sub-step need them.
#[derive(Debug, Clone, Default)]
pub struct TurnedCore {
    /// Orientation that they belong to, if they are known.
    orientation: Option<UnitQuaternion<f64>>,
    vertices: Vec<Vec3>,
}

impl Body {
    /// Turns its core vertices into world axes, unless they are known for its orientation.
    pub fn turn_core(&mut self) {
        if !self.core_is_turned() {
            self.turn_core_anew();
        }
    }

    /// Turns its core vertices into world axes.
    pub fn turn_core_anew(&mut self) {
        let orientation = self.state.orientation;
        let known = &mut self.turned_core;
        known.orientation = Some(orientation);
        known.vertices.clear();
        known.vertices.extend(turned(&self.shape, &orientation));
    }

    /// Its core vertices in world axes as last turned, from its centre [m].
    pub fn turned_core(&self) -> &[Vec3] {
        &self.turned_core.vertices
    }

    /// Replaces `corners` by its core vertices in world axes, its centre being at `centre`.
    pub fn put_corners(&self, centre: &Vec3, corners: &mut Vec<Vec3>) {
        corners.clear();
        if self.core_is_turned() {
            let vertices = self.turned_core.vertices.iter();
            corners.extend(vertices.map(|vertex| centre + vertex));
        } else {
            let vertices = turned(&self.shape, &self.state.orientation);
            corners.extend(vertices.map(|vertex| centre + vertex));
        }
    }

    fn core_is_turned(&self) -> bool {
        self.turned_core.orientation.as_ref() == Some(&self.state.orientation)
    }
}

/// Core vertices of a shape in this orientation.
fn turned<'a>(
    shape: &'a SpheroPolyhedron,
    orientation: &UnitQuaternion<f64>,
) -> impl Iterator<Item = Vec3> + 'a {
    let turn = orientation.to_rotation_matrix();
    let vertices = shape.core_vertices().iter();
    vertices.map(move |vertex| turn * vertex)
}
