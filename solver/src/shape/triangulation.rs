//! Convex hulls as closed surfaces of triangles, exact: which side of a plane a point is on is
//! decided by the sign of a determinant that rounding can't change (Shewchuk 1997, Adaptive
//! Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates). Points nearly in one
//! plane, or exactly, give a closed convex surface like any others.

use nalgebra::Vector3;
use robust::{Coord3D, orient3d};

/// A triangle of a convex surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Triangle {
    /// Corners, counter-clockwise seen from outside.
    pub(super) corners: [usize; 3],
    /// Triangles beyond the sides; side k runs from corner k to the next.
    pub(super) neighbours: [usize; 3],
}

impl Triangle {
    fn side(&self, k: usize) -> [usize; 2] {
        [self.corners[k], self.corners[(k + 1) % 3]]
    }
}

/// Triangles of the convex hull of some points; none if all points lie in one plane. Points inside
/// it, in a triangle or on a side are no corners.
pub(super) fn triangulated(points: &[Vector3<f64>]) -> Vec<Triangle> {
    let Some(start) = tetrahedron(points) else {
        return Vec::new();
    };
    let mut surface = Surface::of(points, start);
    for point in (0..points.len()).filter(|point| !start.contains(point)) {
        surface.reach(point);
    }
    surface.compact()
}

/// True if `point` is in front of the plane through three points, the side from which these run
/// counter-clockwise.
pub(super) fn is_in_front(point: &Vector3<f64>, [a, b, c]: [&Vector3<f64>; 3]) -> bool {
    side([a, b, c, point]) < 0.0
}

/// Six times the volume of a tetrahedron with the exact sign: negative if the last corner is in
/// front of the plane through the others.
fn side(corners: [&Vector3<f64>; 4]) -> f64 {
    let [a, b, c, d] = corners.map(|corner| Coord3D {
        x: corner.x,
        y: corner.y,
        z: corner.z,
    });
    orient3d(a, b, c, d)
}

/// Four points far from each other that enclose something, the last behind the plane of the others.
fn tetrahedron(points: &[Vector3<f64>]) -> Option<[usize; 4]> {
    let farthest = |measure: &dyn Fn(&Vector3<f64>) -> f64| {
        let all = points.iter().map(measure).enumerate();
        all.max_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(point, _)| point)
    };
    let a = farthest(&|p| (p - points[0]).norm_squared())?;
    let b = farthest(&|p| (p - points[a]).norm_squared())?;
    let along = points[b] - points[a];
    let c = farthest(&|p| along.cross(&(p - points[a])).norm_squared())?;
    let [of_a, of_b, of_c] = [a, b, c].map(|k| &points[k]);
    let volume = |p: &Vector3<f64>| side([of_a, of_b, of_c, p]);
    let d = farthest(&|p| volume(p).abs())?;
    let volume = volume(&points[d]);
    if volume > 0.0 {
        Some([a, b, c, d])
    } else if volume < 0.0 {
        Some([a, c, b, d])
    } else {
        None
    }
}

/// A closed surface of triangles while it grows.
struct Surface<'a> {
    points: &'a [Vector3<f64>],
    triangles: Vec<Triangle>,
    /// True for each triangle that is seen from the point being added; it is replaced.
    seen: Vec<bool>,
    /// Places of replaced triangles.
    free: Vec<usize>,
    /// By its first corner, the new triangle on a side of the horizon.
    new: Vec<usize>,
}

impl<'a> Surface<'a> {
    fn of(points: &'a [Vector3<f64>], [a, b, c, d]: [usize; 4]) -> Self {
        let triangle = |corners, neighbours| Triangle {
            corners,
            neighbours,
        };
        Self {
            points,
            triangles: vec![
                triangle([a, b, c], [1, 2, 3]),
                triangle([b, a, d], [0, 3, 2]),
                triangle([c, b, d], [0, 1, 3]),
                triangle([a, c, d], [0, 2, 1]),
            ],
            seen: vec![false; 4],
            free: Vec::new(),
            new: vec![0; points.len()],
        }
    }

    /// Extends the surface to a point, if it is outside.
    fn reach(&mut self, point: usize) {
        let mut visible = Vec::new();
        for (place, triangle) in self.triangles.iter().enumerate() {
            let plane = triangle.corners.map(|corner| &self.points[corner]);
            if !self.seen[place] && is_in_front(&self.points[point], plane) {
                visible.push(place);
            }
        }
        for &place in &visible {
            self.seen[place] = true;
        }
        let horizon = self.horizon(&visible);
        self.free.extend(visible);
        self.join(point, &horizon);
    }

    /// Sides between what is visible and what is not, with the triangle beyond and the number of
    /// the side there.
    fn horizon(&self, visible: &[usize]) -> Vec<([usize; 2], usize, usize)> {
        let mut horizon = Vec::new();
        for &place in visible {
            let triangle = self.triangles[place];
            for (k, &beyond) in triangle.neighbours.iter().enumerate() {
                if !self.seen[beyond] {
                    let theirs = self.triangles[beyond].neighbours;
                    let theirs = theirs.iter().position(|&other| other == place);
                    horizon.push((triangle.side(k), beyond, theirs.unwrap_or(0)));
                }
            }
        }
        horizon
    }

    /// Replaces what was visible from a point by triangles from the horizon to it.
    fn join(&mut self, point: usize, horizon: &[([usize; 2], usize, usize)]) {
        for &([from, to], beyond, theirs) in horizon {
            let place = self.free.pop().unwrap_or(self.triangles.len());
            let triangle = Triangle {
                corners: [from, to, point],
                neighbours: [beyond; 3],
            };
            if place == self.triangles.len() {
                self.triangles.push(triangle);
                self.seen.push(false);
            } else {
                self.triangles[place] = triangle;
                self.seen[place] = false;
            }
            self.triangles[beyond].neighbours[theirs] = place;
            self.new[from] = place;
        }
        for &([from, to], ..) in horizon {
            let (before, after) = (self.new[from], self.new[to]);
            self.triangles[before].neighbours[1] = after;
            self.triangles[after].neighbours[2] = before;
        }
    }

    /// The triangles without the places of replaced ones.
    fn compact(self) -> Vec<Triangle> {
        let mut moved = vec![0; self.triangles.len()];
        let kept: Vec<usize> = (0..self.triangles.len())
            .filter(|&place| !self.seen[place])
            .collect();
        for (place, &former) in kept.iter().enumerate() {
            moved[former] = place;
        }
        let triangle = |&former: &usize| Triangle {
            corners: self.triangles[former].corners,
            neighbours: self.triangles[former].neighbours.map(|place| moved[place]),
        };
        kept.iter().map(triangle).collect()
    }
}
