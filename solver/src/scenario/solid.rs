//! The solid of a body, built once however often it is asked for: the hull and the core of a
//! polyhedron take milliseconds.

use super::Shape;
use super::sharp_shape::SharpShape;
use crate::shape::{ShapeError, SpheroPolyhedron};
use std::sync::{Arc, OnceLock};

/// A body's solid, kept from its first use on with the dimensions it was built from. Two bodies
/// are equal whether theirs have been built or not.
#[derive(Debug, Clone, Default)]
pub struct BuiltSolid(OnceLock<Arc<Built>>);

#[derive(Debug)]
struct Built {
    shape: Shape,
    sphero_radius_m: f64,
    solid: SpheroPolyhedron,
}

impl Built {
    fn new(sharp: &SharpShape, sphero_radius_m: f64) -> Result<Self, ShapeError> {
        Ok(Self {
            shape: sharp.shape().clone(),
            sphero_radius_m,
            solid: sharp.rounded(sphero_radius_m)?,
        })
    }
}

impl BuiltSolid {
    /// The solid of a shape, rounded with a radius [m], built now.
    pub(super) fn new(sharp: &SharpShape, sphero_radius_m: f64) -> Result<Self, ShapeError> {
        let built = Built::new(sharp, sphero_radius_m)?;
        Ok(Self(OnceLock::from(Arc::new(built))))
    }

    /// The solid of a shape, built anew if the one kept has other dimensions.
    pub(super) fn of(
        &self,
        shape: &Shape,
        sphero_radius_m: f64,
    ) -> Result<SpheroPolyhedron, ShapeError> {
        let of_these =
            |built: &&Arc<Built>| built.shape == *shape && built.sphero_radius_m == sphero_radius_m;
        if let Some(built) = self.0.get().filter(of_these) {
            return Ok(built.solid.clone());
        }
        let built = Built::new(&SharpShape::of(shape.clone())?, sphero_radius_m)?;
        let solid = built.solid.clone();
        self.0.get_or_init(|| Arc::new(built));
        Ok(solid)
    }
}

impl PartialEq for BuiltSolid {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
