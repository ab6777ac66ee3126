//! Solids before they are rounded.

use super::error::ShapeError;
use super::half_spaces::HalfSpaces;
use super::regular::RegularSolid;
use super::{SpheroPolyhedron, positive};
use nalgebra::Vector3;

/// Thickness over the diameter from which on rounding errors do not matter to a core.
pub(super) const THINNEST: f64 = 1e-6;

/// A convex polyhedron with sharp edges, to be rounded: the core is the region at least the
/// sphero radius behind every face, so the rounded solid's flats are where the faces were.
#[derive(Debug, Clone, PartialEq)]
pub struct SharpPolyhedron {
    within: HalfSpaces,
    inradius: f64,
    diameter: f64,
}

impl SharpPolyhedron {
    /// A regular solid with edges of `edge_m`, lying on a face: its lowest face is normal to z,
    /// with an edge along y.
    ///
    /// # Errors
    /// A length that is not positive.
    pub fn regular(solid: RegularSolid, edge_m: f64) -> Result<Self, ShapeError> {
        positive("edge", edge_m)?;
        Self::hull_of(&solid.lying(edge_m)?)
    }

    /// The convex hull of some points [m]. Points inside it, in a face or on an edge don't matter,
    /// coplanar faces are merged, and features smaller than 1e-5 of the solid are left out.
    ///
    /// # Errors
    /// A non-finite coordinate, or points that enclose no volume.
    pub fn hull_of(points: &[Vector3<f64>]) -> Result<Self, ShapeError> {
        let finite = |point: &Vector3<f64>| point.iter().all(|c| c.is_finite());
        if let Some(vertex) = points.iter().position(|point| !finite(point)) {
            return Err(ShapeError::NotFinite { vertex });
        }
        // From one of them: far from the origin offsets would lose digits.
        let first = points.first().copied().unwrap_or_default();
        let near: Vec<_> = points.iter().map(|point| point - first).collect();
        let within = HalfSpaces::round(&near)?;
        let lengths = near
            .iter()
            .flat_map(|a| near.iter().map(move |b| (a - b).norm()));
        Ok(Self {
            inradius: within.inradius(),
            diameter: lengths.fold(0.0, f64::max),
            within,
        })
    }

    /// Radius of the largest ball inside [m].
    pub fn inradius(&self) -> f64 {
        self.inradius
    }

    /// Largest distance of two of its places [m].
    pub fn diameter(&self) -> f64 {
        self.diameter
    }

    /// The solid rounded by a sphere; the centre of mass of the rounded solid is the origin.
    ///
    /// # Errors
    /// A radius that is not positive, or leaves no core.
    pub fn rounded(&self, sphero_radius_m: f64) -> Result<SpheroPolyhedron, ShapeError> {
        positive("sphero radius", sphero_radius_m)?;
        if sphero_radius_m >= self.inradius {
            return Err(ShapeError::RadiusNotBelowInradius {
                radius_m: sphero_radius_m,
                inradius_m: self.inradius,
            });
        }
        let core = self.within.eroded(sphero_radius_m);
        let core = core.map_err(|_| self.without_core(sphero_radius_m))?;
        SpheroPolyhedron::from_core(core, sphero_radius_m)
    }

    /// Why no core is left: it is too thin, or else faces contradict each other.
    fn without_core(&self, radius_m: f64) -> ShapeError {
        let thickness_m = 2.0 * (self.inradius - radius_m);
        if thickness_m < THINNEST * self.diameter {
            return ShapeError::NoCore {
                radius_m,
                thickness_m,
                size_m: self.diameter,
                allowed_m: self.inradius - THINNEST / 2.0 * self.diameter,
            };
        }
        ShapeError::BlurredFaces {
            radius_m,
            least_angle_rad: self.within.least_angle(),
        }
    }
}
