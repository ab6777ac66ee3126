//! The solid of a body, built once however often it is asked for: the hull and the core of a
//! polyhedron take milliseconds.

use super::Shape;
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

impl BuiltSolid {
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
        let solid = shape.build(sphero_radius_m)?;
        self.0.get_or_init(|| {
            Arc::new(Built {
                shape: shape.clone(),
                sphero_radius_m,
                solid: solid.clone(),
            })
        });
        Ok(solid)
    }
}

impl PartialEq for BuiltSolid {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
