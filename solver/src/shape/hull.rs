//! Convex hulls of a few points.
//!
//! A face is a plane through three of the points with none in front. Every triple is tried whose
//! three lines each have all points on one side, seen along the line: that leaves few, and needs no
//! assumption on the order or position of points, where faster methods fail on rounded
//! coordinates. Two faces of a convex solid
//! share at most two vertices, so planes that share three are one face: coplanar triangles are
//! merged, and points with ambiguous coordinates can't tear the surface.

use super::check::extent;
use super::error::ShapeError;
use super::polyhedron::ConvexPolyhedron;
use super::rim::on_rim;
use nalgebra::Vector3;
use std::collections::BTreeSet;

/// Distance from a plane that still counts as in it, over the solid's size: a hundredth
/// of the allowed bend of a face, and far above rounding.
const COPLANAR: f64 = 1e-10;
/// Smallest feature kept, over the solid's size. The normal of a triangle narrower than this is
/// not accurate to [`COPLANAR`].
const SMALLEST: f64 = 1e-5;
/// Smallest features tried in turn. A feature about as large as the limit can be one point for one
/// face and two for its neighbour, whose loops then don't close; with another limit it is the same
/// for both.
const LIMITS: [f64; 3] = [SMALLEST, 2e-6, 5e-5];

/// The convex hull of some points, without points inside it, in a face or on an edge.
///
/// # Errors
/// Points that enclose no volume.
pub(super) fn hull_of(points: &[Vector3<f64>]) -> Result<ConvexPolyhedron, ShapeError> {
    let size = extent(points);
    let first = Candidates::of(points, size, SMALLEST).hull();
    LIMITS[1..].iter().fold(first, |found, &limit| {
        found.or_else(|error| {
            Candidates::of(points, size, limit)
                .hull()
                .map_err(|_| error)
        })
    })
}

/// Outward unit normals of the hull's faces. Unlike the hull itself they are always defined,
/// though faces that are nearly flat may consist of several pieces.
pub(super) fn normals(points: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let size = extent(points);
    let faces = Candidates::of(points, size, SMALLEST).faces(size);
    faces.iter().map(|face| face.normal).collect()
}

/// Distinct points from which the hull is taken.
#[derive(Debug, Clone)]
pub(super) struct Candidates {
    points: Vec<Vector3<f64>>,
    /// Smallest feature kept, over the size.
    smallest: f64,
}

impl Candidates {
    /// Points of a solid of this size [m]; those nearer to an earlier one than the smallest feature,
    /// a fraction of the size, are the same.
    pub(super) fn of(points: &[Vector3<f64>], size: f64, smallest: f64) -> Self {
        let mut different: Vec<Vector3<f64>> = Vec::new();
        for point in points {
            let near = |other: &Vector3<f64>| (other - point).norm() <= smallest * size;
            if !different.iter().any(near) {
                different.push(*point);
            }
        }
        Self {
            points: different,
            smallest,
        }
    }

    /// Their convex hull, without points inside it, in a face or on an edge.
    ///
    /// # Errors
    /// Points that enclose no volume.
    pub(super) fn hull(mut self) -> Result<ConvexPolyhedron, ShapeError> {
        loop {
            let size = extent(&self.points);
            let faces = self.faces(size);
            let loops: Vec<Vec<usize>> = faces
                .iter()
                .map(|face| face.corners(&self.points, self.smallest * size))
                .collect();
            let is_vertex = |point: &usize| {
                let of_point = || {
                    let both = faces.iter().zip(&loops);
                    both.filter(|(face, _)| face.points.contains(point))
                };
                of_point().count() > 0 && of_point().all(|(_, corners)| corners.contains(point))
            };
            let kept: Vec<usize> = (0..self.points.len()).filter(is_vertex).collect();
            if kept.len() == self.points.len() || faces.len() < 4 {
                return ConvexPolyhedron::new(self.points, loops);
            }
            self.points = kept.iter().map(|&point| self.points[point]).collect();
        }
    }

    /// The faces, each with all points that lie in it.
    fn faces(&self, size: f64) -> Vec<Flat> {
        let mut faces: Vec<Flat> = Vec::new();
        let mut split = [0, 0];
        for triple in on_rim(&self.points, size).triples() {
            let known = |face: &Flat| triple.iter().all(|p| face.points.contains(p));
            if let Some(normal) = self.outward(triple, size, &mut split)
                && !faces.iter().any(known)
            {
                faces.push(self.flat(triple[0], normal, size));
            }
        }
        self.merged(faces, self.smallest * size)
    }

    /// Merges faces that share more than an edge.
    fn merged(&self, faces: Vec<Flat>, near: f64) -> Vec<Flat> {
        let are_one = |a: &Flat, b: &Flat| {
            let shared = a.points.intersection(&b.points).map(|&p| self.points[p]);
            !in_line(&shared.collect::<Vec<_>>(), near)
        };
        let mut apart: Vec<Flat> = Vec::new();
        for mut face in faces {
            while let Some(same) = apart.iter().position(|other| are_one(&face, other)) {
                face.points.extend(apart.remove(same).points);
            }
            apart.push(face);
        }
        apart
    }

    /// Outward unit normal of the plane through three points, if all others are behind it. Two
    /// points that `split`, lying to either side, are kept for the next triple, which they often
    /// split, too.
    fn outward(
        &self,
        triple: [usize; 3],
        size: f64,
        split: &mut [usize; 2],
    ) -> Option<Vector3<f64>> {
        let [a, b, c] = triple.map(|point| self.points[point]);
        // Most triples fail: roots and quotients are computed later.
        let (to_b, to_c) = (b - a, c - a);
        let across = to_b.cross(&to_c);
        let longest = to_b.norm_squared().max(to_c.norm_squared());
        let longest = longest.max((c - b).norm_squared());
        if across.norm_squared() <= (self.smallest * size).powi(2) * longest {
            return None;
        }
        let near = COPLANAR * size * across.norm();
        let height = |point: usize| across.dot(&(self.points[point] - a));
        if height(split[0]) > near && height(split[1]) < -near {
            return None;
        }
        let (mut front, mut back) = (None, None);
        for point in 0..self.points.len() {
            let height = height(point);
            front = front.or((height > near).then_some(point));
            back = back.or((height < -near).then_some(point));
            if let (Some(front), Some(back)) = (front, back) {
                *split = [front, back];
                return None;
            }
        }
        let normal = across.normalize();
        Some(if front.is_some() { -normal } else { normal })
    }

    /// All points in the plane through one of them.
    fn flat(&self, through: usize, normal: Vector3<f64>, size: f64) -> Flat {
        let height = |point: usize| normal.dot(&(self.points[point] - self.points[through]));
        let in_it = |point: &usize| height(*point).abs() <= COPLANAR * size;
        Flat {
            normal,
            points: (0..self.points.len()).filter(in_it).collect(),
        }
    }
}

/// True if some points lie along one line, within `near` [m].
fn in_line(points: &[Vector3<f64>], near: f64) -> bool {
    let Some(first) = points.first() else {
        return true;
    };
    let arms = || points.iter().map(|point| point - first);
    let longest = arms().max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
    let along = longest.and_then(|arm| arm.try_normalize(0.0));
    along.is_none_or(|along| arms().all(|arm| arm.cross(&along).norm() <= near))
}

/// Points in one plane with all others behind it.
#[derive(Debug)]
struct Flat {
    /// Outward unit normal.
    normal: Vector3<f64>,
    points: BTreeSet<usize>,
}

impl Flat {
    /// The points on its rim that protrude by more than `least` [m], counter-clockwise seen from
    /// outside.
    fn corners(&self, points: &[Vector3<f64>], least: f64) -> Vec<usize> {
        let count = self.points.len() as f64;
        let centre = self.points.iter().map(|&p| points[p]).sum::<Vector3<f64>>() / count;
        let ahead = (self.points.iter())
            .map(|&p| points[p] - centre)
            .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))
            .unwrap_or_else(Vector3::zeros);
        let left = self.normal.cross(&ahead);
        let angle = |point: usize| {
            let arm = points[point] - centre;
            f64::atan2(arm.dot(&left), arm.dot(&ahead))
        };
        let mut rim: Vec<usize> = self.points.iter().copied().collect();
        rim.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
        // One at a time: the state of a point depends on its neighbours.
        while let Some(dull) = (0..rim.len()).find(|&k| self.is_dull(points, &rim, k, least)) {
            rim.remove(dull);
        }
        rim
    }

    /// True if a point of the rim lies inside the line between its neighbours, or is between them
    /// and protrudes by no more than `least` [m].
    fn is_dull(&self, points: &[Vector3<f64>], rim: &[usize], k: usize, least: f64) -> bool {
        let at = |k: usize| points[rim[k % rim.len()]];
        let (before, after) = (at(k + rim.len() - 1) - at(k), at(k + 1) - at(k));
        let sticks_out = after.cross(&before).dot(&self.normal);
        let least = least * (after - before).norm();
        sticks_out < -least || (sticks_out <= least && before.dot(&after) < 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::pairs::all_triples;
    use proptest::prelude::*;

    /// Clouds with many points in common planes, and in common lines, as typed ones have.
    fn cloud() -> impl Strategy<Value = Vec<Vector3<f64>>> {
        let grid = prop::array::uniform3(-3..=3_i32).prop_map(|p| p.map(|c| f64::from(c) * 0.1));
        let free = prop::array::uniform3(-0.3..0.3_f64);
        let typed = free
            .clone()
            .prop_map(|p| p.map(|c| (c * 1e5).round() / 1e5));
        let of = |place: BoxedStrategy<[f64; 3]>| {
            prop::collection::vec(place.prop_map(Vector3::from), 4..24)
        };
        prop_oneof![of(grid.boxed()), of(free.boxed()), of(typed.boxed())]
    }

    proptest! {
        // The search for faces leaves out no triple that would be one.
        #[test]
        fn three_points_of_a_face_are_on_the_rim(points in cloud()) {
            let size = extent(&points);
            let candidates = Candidates::of(&points, size, SMALLEST);
            let rim = on_rim(&candidates.points, size);
            for triple in all_triples(candidates.points.len()) {
                let is_face = candidates.outward(triple, size, &mut [0, 0]).is_some();
                prop_assert!(!is_face || rim.hold(triple), "{triple:?}");
            }
        }
    }
}
