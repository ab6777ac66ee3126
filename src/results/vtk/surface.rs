//! Surfaces of bodies as triangles.

use nalgebra::{Unit, Vector3};
use scree_solver::shape::{Face, SpheroPolyhedron};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// Fineness of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Detail {
    /// Rounding in steps of at most this angle [rad].
    Round(f64),
    /// Polyhedra by the faces of their cores, with the vertices moved out to the rounding.
    Faceted,
}

/// A closed surface round a body, in the body's own axes.
#[derive(Debug, Default)]
pub(super) struct Surface {
    /// Corners of triangles [m]; patches have their own.
    pub(super) points: Vec<Vector3<f64>>,
    /// Triangles by their corners, counter-clockwise seen from outside.
    pub(super) triangles: Vec<[i32; 3]>,
}

/// Side of a face, as the face runs along it: from one vertex to the next.
type Side = (usize, usize);

impl Surface {
    pub(super) fn new(shape: &SpheroPolyhedron, detail: Detail) -> Self {
        let mut surface = Self::default();
        let radius = shape.sphero_radius();
        match detail {
            _ if shape.faces().is_empty() => {
                let step = match detail {
                    Detail::Round(step) => step,
                    Detail::Faceted => FRAC_PI_2,
                };
                surface.add_round(shape, step);
            }
            Detail::Round(step) => surface.add_polyhedron(shape, step),
            Detail::Faceted => {
                let outer = |vertex: &Vector3<f64>| vertex + radius * vertex.normalize();
                let corners: Vec<_> = shape.core_vertices().iter().map(outer).collect();
                for face in shape.faces() {
                    surface.add_fan(face.vertices.iter().map(|&vertex| corners[vertex]));
                }
            }
        }
        surface
    }

    /// A ball or a capsule: rings about its axis, x, the first half round its first vertex.
    fn add_round(&mut self, shape: &SpheroPolyhedron, step: f64) {
        let centres = shape.core_vertices();
        let radius = shape.sphero_radius();
        let quarter = pieces(FRAC_PI_2, step);
        let ring = |centre: Vector3<f64>, place: f64| -> Vec<_> {
            let (sin, cos) = (FRAC_PI_2 * place / quarter as f64).sin_cos();
            let around = (0..=4 * quarter).map(|turn| {
                let (z, y) = (FRAC_PI_2 * turn as f64 / quarter as f64).sin_cos();
                centre + radius * Vector3::new(sin, cos * y, cos * z)
            });
            around.collect()
        };
        let (first, last) = (centres[0], centres[centres.len() - 1]);
        let rear = (0..=quarter).map(|k| ring(first, k as f64 - quarter as f64));
        let front = (0..=quarter).map(|k| ring(last, k as f64));
        self.add_sheet(&rear.chain(front).collect::<Vec<_>>());
    }

    /// Flats, edges rounded to cylinders, and vertices to balls.
    fn add_polyhedron(&mut self, shape: &SpheroPolyhedron, step: f64) {
        let (vertices, radius) = (shape.core_vertices(), shape.sphero_radius());
        let faces = shape.faces();
        for face in faces {
            let flat = face.vertices.iter();
            self.add_fan(flat.map(|&v| vertices[v] + radius * face.normal));
        }
        let sides = sides(faces);
        for (&(from, to), face) in &sides {
            if from < to
                && let Some(beyond) = sides.get(&(to, from))
            {
                let arc = arc(&face.normal, &beyond.normal, step);
                let along = |vertex: usize| -> Vec<_> {
                    arc.iter()
                        .map(|normal| vertices[vertex] + radius * normal)
                        .collect()
                };
                self.add_sheet(&[along(from), along(to)]);
            }
        }
        for (vertex, centre) in vertices.iter().enumerate() {
            let normals = normals_round(vertex, &sides);
            self.add_cap(centre, radius, (&normals, step));
        }
    }

    /// Part of a sphere between the normals of the faces round a vertex, anticlockwise.
    fn add_cap(
        &mut self,
        centre: &Vector3<f64>,
        radius: f64,
        (normals, step): (&[Vector3<f64>], f64),
    ) {
        let next = normals.iter().cycle().skip(1);
        let mut border: Vec<Vector3<f64>> = Vec::new();
        for (one, other) in normals.iter().zip(next) {
            border.pop();
            border.extend(arc(one, other, step));
        }
        let Some(middle) = normals.iter().sum::<Vector3<f64>>().try_normalize(0.0) else {
            return;
        };
        let widest = border.iter().map(|normal| normal.angle(&middle));
        let rings = pieces(widest.fold(0.0, f64::max), step);
        let ring = |ring: usize| -> Vec<_> {
            let share = ring as f64 / rings as f64;
            let inwards = border.iter().map(|normal| normal.slerp(&middle, share));
            inwards.map(|normal| centre + radius * normal).collect()
        };
        self.add_sheet(&(0..=rings).map(ring).collect::<Vec<_>>());
    }

    /// A flat polygon.
    fn add_fan(&mut self, corners: impl Iterator<Item = Vector3<f64>>) {
        let first = self.points.len() as i32;
        self.points.extend(corners);
        for last in first + 2..self.points.len() as i32 {
            self.add_triangle([first, last - 1, last]);
        }
    }

    /// Rows of points, each joined to the next by triangles.
    fn add_sheet(&mut self, rows: &[Vec<Vector3<f64>>]) {
        let columns = rows.first().map_or(0, Vec::len) as i32;
        let first = self.points.len() as i32;
        self.points.extend(rows.iter().flatten());
        for row in 1..rows.len() as i32 {
            for column in 1..columns {
                let (left, right) = (first + column - 1, first + column);
                let [low, high] = [row - 1, row].map(|row| row * columns);
                self.add_triangle([left + low, right + low, right + high]);
                self.add_triangle([left + low, right + high, left + high]);
            }
        }
    }

    /// A triangle, unless two of its corners are one: where a row is a point, or two rows are one.
    fn add_triangle(&mut self, corners: [i32; 3]) {
        let [a, b, c] = corners.map(|corner| self.points[corner as usize]);
        let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
        let shortest = (b - a).norm().min((c - b).norm()).min((a - c).norm());
        if shortest > 1e-9 * longest {
            self.triangles.push(corners);
        }
    }
}

/// The face on the left of each side.
fn sides(faces: &[Face]) -> BTreeMap<Side, &Face> {
    let mut sides = BTreeMap::new();
    for face in faces {
        let next = face.vertices.iter().cycle().skip(1);
        for (&from, &to) in face.vertices.iter().zip(next) {
            sides.insert((from, to), face);
        }
    }
    sides
}

/// Normals of the faces round a vertex, anticlockwise seen from outside.
fn normals_round(vertex: usize, sides: &BTreeMap<Side, &Face>) -> Vec<Vector3<f64>> {
    let mut normals = Vec::new();
    let mut outwards = sides.range((vertex, 0)..(vertex + 1, 0));
    let Some((&start, _)) = outwards.next() else {
        return normals;
    };
    let mut side = start;
    while let Some(face) = sides.get(&side) {
        normals.push(face.normal);
        let place = face.vertices.iter().position(|&other| other == vertex);
        let place = place.unwrap_or(0);
        let before = (place + face.vertices.len() - 1) % face.vertices.len();
        side = (vertex, face.vertices[before]);
        if side == start {
            break;
        }
    }
    normals
}

/// Unit vectors from one to another, both included, in equal steps.
fn arc(one: &Vector3<f64>, other: &Vector3<f64>, step: f64) -> Vec<Vector3<f64>> {
    let count = pieces(one.angle(other), step);
    let [from, to] = [one, other].map(|normal| Unit::new_normalize(*normal));
    let at = |k: usize| from.slerp(&to, k as f64 / count as f64).into_inner();
    (0..=count).map(at).collect()
}

/// Number of equal steps, none larger than `step`, of an angle [rad].
fn pieces(angle: f64, step: f64) -> usize {
    ((angle / step - 1e-9).ceil() as usize).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scree_solver::shape::{RegularSolid, SharpPolyhedron};

    /// Volume inside the surface [m³], by the divergence theorem: negative or wrong if a triangle
    /// is turned or missing.
    fn volume(surface: &Surface) -> f64 {
        let of_triangle = |corners: &[i32; 3]| {
            let [a, b, c] = corners.map(|corner| surface.points[corner as usize]);
            a.dot(&b.cross(&c)) / 6.0
        };
        surface.triangles.iter().map(of_triangle).sum()
    }

    fn shapes() -> Vec<SpheroPolyhedron> {
        let rounded = |sharp: SharpPolyhedron| sharp.rounded(0.25 * sharp.inradius()).unwrap();
        let spiral = (0..32).map(|k| {
            let z = (f64::from(k) + 0.5) / 16.0 - 1.0;
            let (sin, cos) = (2.4 * f64::from(k)).sin_cos();
            Vector3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
        });
        vec![
            SpheroPolyhedron::cube(0.04, 0.002).unwrap(),
            SpheroPolyhedron::cuboid([0.1, 0.02, 0.04], 0.005).unwrap(),
            SpheroPolyhedron::ball(0.3).unwrap(),
            SpheroPolyhedron::capsule(0.1, 0.6).unwrap(),
            rounded(SharpPolyhedron::regular(RegularSolid::Tetrahedron, 0.1).unwrap()),
            rounded(SharpPolyhedron::regular(RegularSolid::Icosahedron, 0.1).unwrap()),
            rounded(SharpPolyhedron::hull_of(&spiral.collect::<Vec<_>>()).unwrap()),
        ]
    }

    #[test]
    fn a_surface_encloses_the_volume_of_the_body() {
        for (place, shape) in shapes().iter().enumerate() {
            let share = |detail| volume(&Surface::new(shape, detail)) / shape.volume();
            let fine = share(Detail::Round(0.02));
            assert!((0.999..1.0 + 1e-12).contains(&fine), "{place}: {fine}");
            let coarse = share(Detail::Round(FRAC_PI_2));
            assert!((0.3..1.0).contains(&coarse), "{place}: {coarse}");
            let faceted = share(Detail::Faceted);
            assert!((0.3..1.5).contains(&faceted), "{place}: {faceted}");
        }
    }

    /// Each side of a triangle is that of one other, in the opposite sense: no gap, no overlap.
    #[test]
    fn a_surface_is_closed() {
        for (place, shape) in shapes().iter().enumerate() {
            let surface = Surface::new(shape, Detail::Round(0.4));
            let size = shape.bounding_radius();
            let key = |corner: i32| {
                let point = surface.points[corner as usize] / size;
                // Rounded, since patches compute their common points each in its way.
                [point.x, point.y, point.z].map(|x| (x * 1e7).round() as i64)
            };
            let mut open: BTreeMap<_, i32> = BTreeMap::new();
            for [a, b, c] in surface.triangles.iter().map(|corners| corners.map(key)) {
                for (from, to) in [(a, b), (b, c), (c, a)] {
                    *open.entry((from, to)).or_default() += 1;
                    *open.entry((to, from)).or_default() -= 1;
                }
            }
            assert!(open.values().all(|&sides| sides == 0), "{place}");
        }
    }

    #[test]
    fn a_surface_is_as_large_as_the_body() {
        let cube = SpheroPolyhedron::cube(0.04, 0.002).unwrap();
        let surface = Surface::new(&cube, Detail::Round(FRAC_PI_2 / 4.0));
        for axis in 0..3 {
            let reach = surface.points.iter().map(|point| point[axis]);
            assert!((reach.fold(0.0, f64::max) - 0.02).abs() < 1e-15);
        }
    }
}
