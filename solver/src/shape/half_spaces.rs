//! Convex solids as intersections of half-spaces: the largest ball inside, and the solid with
//! every plane moved in.

use super::error::ShapeError;
use super::inscribed::{Ball, Plane, largest_ball};
use super::polyhedron::ConvexPolyhedron;
use super::triangulation::{is_in_front, triangulated};
use super::{check, hull};
use nalgebra::{Matrix3, Vector3};

/// Angle below which two planes are one face \[rad\]: coordinates typed with six digits turn
/// parts of a face by less.
const ONE_FACE: f64 = 1e-5;
/// Triple product of three normals below which their planes have no well-defined point in
/// common; other planes meet there too.
const NO_CROSSING: f64 = 1e-11;
/// Distance in front of a plane that still counts as behind, over the size.
const BEHIND: f64 = 1e-9;

/// All places x with n·x ≤ offset for every plane.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct HalfSpaces {
    planes: Vec<Plane>,
    /// Upper bound of the distance of two places in it, almost sharp [m].
    size: f64,
    ball: Ball,
}

/// The point in which three planes meet.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    planes: [usize; 3],
    /// Triple product of the normals, positive.
    spanned: f64,
    place: Vector3<f64>,
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
        let planes: Vec<Plane> = faces.into_iter().map(plane).collect();
        let size = 2.0 * check::extent(points);
        Ok(Self {
            ball: largest_ball(&planes, size),
            planes,
            size,
        })
    }

    /// Radius of the largest ball inside [m].
    pub(super) fn inradius(&self) -> f64 {
        self.ball.radius
    }

    /// Least angle of two faces \[rad\].
    pub(super) fn least_angle(&self) -> f64 {
        let normals = || self.planes.iter().map(|(normal, _)| normal).enumerate();
        let angles =
            normals().flat_map(|(k, a)| normals().skip(k + 1).map(move |(_, b)| a.angle(b)));
        angles.fold(f64::INFINITY, f64::min)
    }

    /// Solid that remains when every plane moves in by `depth` [m]. Faces, edges and vertices may
    /// vanish, and vertices with more than three planes may split.
    ///
    /// # Errors
    /// No solid remains, or one too small to tell its features apart.
    pub(super) fn eroded(&self, depth: f64) -> Result<ConvexPolyhedron, ShapeError> {
        let mut crossings: Vec<Crossing> = Vec::new();
        let mut shared: Vec<Vec<usize>> = Vec::new();
        for planes in self.vertices(depth)? {
            let known = |others: &Vec<usize>| planes.iter().all(|plane| others.contains(plane));
            let crossing = match shared.iter().any(known) {
                true => None,
                false => self.crossing(planes, depth),
            };
            let Some(crossing) = crossing else {
                continue;
            };
            let through = self.planes_through(&crossing.place, depth);
            crossings.push(self.sharpest(crossing, &through, depth));
            if through.len() > 3 {
                shared.push(through);
            }
        }
        // Of several crossings at one place the sharpest is first, and is kept.
        crossings.sort_by(|a, b| {
            b.spanned
                .total_cmp(&a.spanned)
                .then(a.planes.cmp(&b.planes))
        });
        let places: Vec<_> = crossings.iter().map(|crossing| crossing.place).collect();
        hull::hull_at_least(&places, 2.0 * (self.ball.radius - depth))
    }

    /// Three planes for every vertex of the solid that remains: a triangle of the hull of the
    /// points dual to the planes about the largest ball's centre, each in the direction of its
    /// plane and at the inverse of its distance. The hull is exact, for planes that differ from
    /// these by rounding; so planes nearly parallel, or nearly through one point, give short
    /// edges, but no contradiction.
    fn vertices(&self, depth: f64) -> Result<Vec<[usize; 3]>, ShapeError> {
        let nothing = ShapeError::TooFew {
            vertices: 0,
            faces: self.planes.len(),
        };
        let distance = |(normal, offset): &Plane| offset - depth - normal.dot(&self.ball.centre);
        if self.planes.iter().any(|plane| distance(plane) <= 0.0) {
            return Err(nothing);
        }
        let dual = |plane: &Plane| plane.0 / distance(plane);
        let dual: Vec<Vector3<f64>> = self.planes.iter().map(dual).collect();
        let triangles = triangulated(&dual);
        let is_open = |corners: [usize; 3]| {
            is_in_front(&Vector3::zeros(), corners.map(|corner| &dual[corner]))
        };
        let mut vertices: Vec<[usize; 3]> = triangles.iter().map(|t| t.corners).collect();
        if vertices.is_empty() || vertices.iter().any(|&corners| is_open(corners)) {
            return Err(nothing);
        }
        for planes in &mut vertices {
            planes.sort_unstable();
        }
        Ok(vertices)
    }

    /// All planes through a place when moved in by `depth` [m].
    fn planes_through(&self, place: &Vector3<f64>, depth: f64) -> Vec<usize> {
        let near = BEHIND * self.size;
        let is_through = |&plane: &usize| {
            let (normal, offset) = &self.planes[plane];
            (normal.dot(place) - (offset - depth)).abs() <= near
        };
        (0..self.planes.len()).filter(is_through).collect()
    }

    /// The crossing of those of some planes through one point that cross most sharply.
    fn sharpest(&self, crossing: Crossing, through: &[usize], depth: f64) -> Crossing {
        if through.len() <= 3 {
            return crossing;
        }
        let normals: Vec<_> = through.iter().map(|&plane| self.planes[plane].0).collect();
        let spanned = |[a, b, c]: [usize; 3]| normals[a].dot(&normals[b].cross(&normals[c])).abs();
        let order: Vec<usize> = (0..through.len()).collect();
        let mut triples: Vec<(f64, [usize; 3])> = hull::triples(&order)
            .map(|triple| (spanned(triple), triple))
            .collect();
        triples.sort_by(|a, b| b.0.total_cmp(&a.0));
        let of_triple = |(_, triple): &(f64, [usize; 3])| {
            self.crossing(triple.map(|place| through[place]), depth)
        };
        triples.iter().find_map(of_triple).unwrap_or(crossing)
    }

    /// Intersection of three planes moved in by `depth` [m], if it is behind all others.
    fn crossing(&self, planes: [usize; 3], depth: f64) -> Option<Crossing> {
        let [a, b, c] = planes.map(|plane| self.planes[plane].0);
        let (b_by_c, c_by_a, a_by_b) = (b.cross(&c), c.cross(&a), a.cross(&b));
        let spanned = a.dot(&b_by_c);
        if spanned.abs() < NO_CROSSING {
            return None;
        }
        let offsets = Vector3::from(planes.map(|plane| self.planes[plane].1 - depth));
        let cofactors = Matrix3::from_columns(&[b_by_c, c_by_a, a_by_b]) / spanned;
        let rough = cofactors * offsets;
        // A second iteration removes the rounding error of the first.
        let reached = Vector3::new(a.dot(&rough), b.dot(&rough), c.dot(&rough));
        let place = rough + cofactors * (offsets - reached);
        let near = BEHIND * self.size;
        let behind = |(normal, offset): &Plane| normal.dot(&place) - (offset - depth) <= near;
        self.planes.iter().all(behind).then_some(Crossing {
            planes,
            spanned: spanned.abs(),
            place,
        })
    }
}
