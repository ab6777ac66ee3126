//! Convex solids as intersections of half-spaces: the largest ball inside, and the solid with
//! every plane moved in.

use super::error::ShapeError;
use super::pairs::Pairs;
use super::polyhedron::ConvexPolyhedron;
use super::{check, hull};
use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

/// Angle below which two planes are one face \[rad\]: coordinates typed with six digits turn
/// parts of a face by less.
const ONE_FACE: f64 = 1e-5;
/// Triple product of three normals below which their planes have no well-defined point in
/// common; other planes meet there too.
const NO_CROSSING: f64 = 1e-7;
/// Distance in front of a plane that still counts as behind, over the size.
const BEHIND: f64 = 1e-9;
/// Sine of the angle of two planes below which their line is not sought: it would be anywhere.
const NO_LINE: f64 = 1e-3;
/// Tolerance of a line's place, over the size, and of its slope against a plane: well above the
/// rounding of the line and [`BEHIND`].
const NEAR_LINE: f64 = 1e-7;
/// Rounding of lengths, over the size.
const ROUNDING: f64 = 1e-12;
/// More exchanges than any set of planes needs; a limit for cycles caused by rounding.
const MOST_EXCHANGES: usize = 10_000;

/// All places x with n·x ≤ offset for every plane.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct HalfSpaces {
    /// Outward unit normal n and offset [m].
    planes: Vec<(Vector3<f64>, f64)>,
    /// Upper bound of the distance of two places in it, almost sharp [m].
    size: f64,
}

impl HalfSpaces {
    /// Region behind all planes round some points [m]. Planes that differ in direction by less than
    /// [`ONE_FACE`] are one.
    ///
    /// # Errors
    /// Points that enclose no volume.
    pub(super) fn round(points: &[Vector3<f64>]) -> Result<Self, ShapeError> {
        let mut faces: Vec<Vector3<f64>> = Vec::new();
        for normal in hull::normals(points) {
            let same = |other: &&mut Vector3<f64>| (other.normalize() - normal).norm() < ONE_FACE;
            match faces.iter_mut().find(same) {
                Some(face) => *face += normal,
                None => faces.push(normal),
            }
        }
        if faces.len() < 4 {
            return Err(ShapeError::TooFew {
                vertices: points.len(),
                faces: faces.len(),
            });
        }
        let plane = |face: Vector3<f64>| {
            let normal = face.normalize();
            let reach = points.iter().map(|point| normal.dot(point));
            (normal, reach.fold(f64::NEG_INFINITY, f64::max))
        };
        Ok(Self {
            planes: faces.into_iter().map(plane).collect(),
            size: 2.0 * check::extent(points),
        })
    }

    /// Radius ρ of the largest ball inside [m], by linear programming: with centre c it is the
    /// largest ρ with n·c + ρ ≤ offset for all planes. The dual is solved (Chvátal 1983, Linear
    /// Programming, chapter 7): weights λ ≥ 0 on the planes with Σ λ n = 0, Σ λ = 1 and least Σ λ
    /// offset, at most four of them positive. It terminates by Bland's rule.
    pub(super) fn inradius(&self) -> f64 {
        // A column per plane, after four that only serve to start: their cost exceeds any
        // coordinate of the ball, so that none is in the solution.
        let dear = 10.0 * self.size;
        let column = |place: usize| match place.checked_sub(4) {
            None => (Vector4::ith(place, 1.0), dear),
            Some(plane) => {
                let (normal, offset) = self.planes[plane];
                (normal.push(1.0), offset)
            }
        };
        let mut basis = [0, 1, 2, 3];
        let mut radius = f64::INFINITY;
        for _ in 0..MOST_EXCHANGES {
            let columns = basis.map(|place| column(place).0);
            let prices = Vector4::from(basis.map(|place| column(place).1));
            let Some(inverse) = Matrix4::from_columns(&columns).try_inverse() else {
                break;
            };
            let weights = inverse.column(3).into_owned();
            radius = weights.dot(&prices);
            let ball = inverse.transpose() * prices;
            let cut = |place: &usize| {
                let (plane, offset) = column(*place);
                !basis.contains(place) && offset - ball.dot(&plane) < -ROUNDING * self.size
            };
            let Some(entering) = (4..4 + self.planes.len()).find(cut) else {
                break;
            };
            let rates = inverse * column(entering).0;
            let leaving = (0..4)
                .filter(|&k| rates[k] > ROUNDING)
                .map(|k| (weights[k].max(0.0) / rates[k], basis[k], k))
                .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let Some((_, _, leaving)) = leaving else {
                break;
            };
            basis[leaving] = entering;
        }
        radius
    }

    /// Solid that remains when every plane moves in by `depth` [m]. Faces, edges and vertices may
    /// vanish, and vertices with more than three planes may split.
    ///
    /// # Errors
    /// No solid remains, or one too small to tell its features apart.
    pub(super) fn eroded(&self, depth: f64) -> Result<ConvexPolyhedron, ShapeError> {
        let edges = self.edges(depth);
        let crossings = edges.triples();
        let crossings = crossings.filter_map(|triple| self.crossing(triple, depth));
        let mut crossings: Vec<_> = crossings.collect();
        // Of several crossings at one place the sharpest is first, and is kept.
        crossings.sort_by(|a, b| b.0.total_cmp(&a.0));
        let places: Vec<_> = crossings.into_iter().map(|(_, place)| place).collect();
        hull::hull_of(&places)
    }

    /// Planes that may have an edge in common when all are moved in by `depth` [m].
    fn edges(&self, depth: f64) -> Pairs {
        Pairs::among(self.planes.len(), |a, b| {
            self.may_share_an_edge(a, b, depth)
        })
    }

    /// True unless the planes' line is nowhere behind all others.
    fn may_share_an_edge(&self, a: usize, b: usize, depth: f64) -> bool {
        let [(a, of_a), (b, of_b)] = [a, b].map(|plane| self.planes[plane]);
        let Some(along) = a.cross(&b).try_normalize(NO_LINE) else {
            return true;
        };
        let (of_a, of_b, cosine) = (of_a - depth, of_b - depth, a.dot(&b));
        let of_line = a * (of_a - of_b * cosine) + b * (of_b - of_a * cosine);
        let near = of_line / (1.0 - cosine * cosine);
        let (mut start, mut end) = (f64::NEG_INFINITY, f64::INFINITY);
        for (normal, offset) in &self.planes {
            let room = offset - depth - normal.dot(&near) + NEAR_LINE * self.size;
            let slope = normal.dot(&along);
            if slope > NEAR_LINE {
                end = end.min(room / slope);
            } else if slope < -NEAR_LINE {
                start = start.max(room / slope);
            } else if room < -NEAR_LINE * self.size {
                return false;
            }
            if start > end {
                return false;
            }
        }
        true
    }

    /// Intersection of three planes moved in by `depth` [m], and its triple product, if it is
    /// behind all others.
    fn crossing(&self, triple: [usize; 3], depth: f64) -> Option<(f64, Vector3<f64>)> {
        let [a, b, c] = triple.map(|plane| self.planes[plane].0);
        let (b_by_c, c_by_a, a_by_b) = (b.cross(&c), c.cross(&a), a.cross(&b));
        let spanned = a.dot(&b_by_c);
        if spanned.abs() < NO_CROSSING {
            return None;
        }
        let offsets = Vector3::from(triple.map(|plane| self.planes[plane].1 - depth));
        let cofactors = Matrix3::from_columns(&[b_by_c, c_by_a, a_by_b]) / spanned;
        let rough = cofactors * offsets;
        // A second iteration removes the rounding error of the first.
        let reached = Vector3::new(a.dot(&rough), b.dot(&rough), c.dot(&rough));
        let place = rough + cofactors * (offsets - reached);
        let near = BEHIND * self.size;
        let behind =
            |(normal, offset): &(Vector3<f64>, f64)| normal.dot(&place) - (offset - depth) <= near;
        let meet = self.planes.iter().all(behind);
        meet.then_some((spanned.abs(), place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::pairs::all_triples;
    use proptest::prelude::*;

    fn place() -> impl Strategy<Value = Vector3<f64>> {
        prop::array::uniform3(-1.0..1.0_f64).prop_map(|place| {
            // Half of the places on a coarse grid, for planes that meet in more than three.
            let place = if place[0] > 0.0 {
                place.map(|c| (c * 4.0).round() / 4.0)
            } else {
                place
            };
            Vector3::from(place)
        })
    }

    proptest! {
        // The search for vertices leaves out no three planes that have one.
        #[test]
        fn planes_of_a_vertex_share_edges(
            points in prop::collection::vec(place(), 8..20),
            share in 0.02..0.95_f64,
        ) {
            let Ok(within) = HalfSpaces::round(&points) else { return Ok(()) };
            let depth = share * within.inradius();
            let edges = within.edges(depth);
            for triple in all_triples(within.planes.len()) {
                let is_vertex = within.crossing(triple, depth).is_some();
                prop_assert!(!is_vertex || edges.hold(triple), "{triple:?}");
            }
        }
    }
}
