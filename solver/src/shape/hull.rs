//! Convex hulls of a few points, without features too small to matter.
//!
//! Which triangles enclose the points is found exactly (`triangulation.rs`). Triangles in one plane
//! are one face, and points that hardly protrude from a face are left out. After each omission the
//! triangles of the rest are found anew, so that the surface is closed and convex however many
//! points are nearly in a plane, on a line or at a place.

use super::check::extent;
use super::error::ShapeError;
use super::polyhedron::ConvexPolyhedron;
use super::triangulation::{Triangle, triangulated};
use nalgebra::Vector3;
use std::collections::BTreeSet;

/// Smallest features that are told apart, over the size of the solid.
#[derive(Debug, Clone, Copy)]
struct Resolution {
    /// Smallest feature kept. The normal of a triangle narrower than this is not accurate to
    /// `flat`.
    smallest: f64,
    /// Distance from a plane that still counts as in it.
    flat: f64,
    /// Smallest feature kept where faces contradict each other.
    disputed: f64,
}

/// Resolutions tried in turn. Only the first matters but to one solid in a thousand: a face bent by
/// about as much as counts as flat may be one for one neighbour and two for the other; with another
/// resolution it is the same for both. The last leaves out what stands between.
const RESOLUTIONS: [Resolution; 5] = [
    Resolution::flat_within(1e-10),
    Resolution::flat_within(1e-11),
    Resolution::flat_within(1e-9),
    Resolution::flat_within(1e-12),
    Resolution {
        disputed: 2e-4,
        ..Resolution::flat_within(1e-10)
    },
];

impl Resolution {
    const fn flat_within(flat: f64) -> Self {
        Self {
            smallest: 1e-5,
            flat,
            disputed: 0.0,
        }
    }
}

/// Smallest feature kept, over the least thickness of a solid that is very thin.
const OF_THICKNESS: f64 = 1e-2;

/// The convex hull of some points, without points inside it, in a face or on an edge.
///
/// # Errors
/// Points that enclose no volume.
pub(super) fn hull_of(points: &[Vector3<f64>]) -> Result<ConvexPolyhedron, ShapeError> {
    hull_at_least(points, f64::INFINITY)
}

/// As [`hull_of`], of points known to enclose a solid at least so thick [m]: of a very thin one
/// smaller features are kept.
///
/// # Errors
/// Points that enclose no volume, or one whose features can't be told apart.
pub(super) fn hull_at_least(
    points: &[Vector3<f64>],
    thickness: f64,
) -> Result<ConvexPolyhedron, ShapeError> {
    let size = extent(points);
    let hull = |resolution: &Resolution| {
        let smallest = resolution.smallest.min(OF_THICKNESS * thickness / size);
        let resolution = Resolution {
            smallest,
            ..*resolution
        };
        Candidates::of(points, size, resolution).hull()
    };
    let first = hull(&RESOLUTIONS[0]);
    RESOLUTIONS[1..].iter().fold(first, |found, resolution| {
        found.or_else(|error| hull(resolution).map_err(|_| error))
    })
}

/// Outward unit normals of the hull's faces. Unlike the hull itself they are always defined,
/// though faces that are nearly flat may consist of several pieces.
pub(super) fn normals(points: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let size = extent(points);
    let faces = Candidates::of(points, size, RESOLUTIONS[0]).faces(size);
    let wide = faces.iter().filter(|face| face.is_wide);
    wide.map(|face| face.normal).collect()
}

/// Distinct points from which the hull is taken.
#[derive(Debug, Clone)]
struct Candidates {
    points: Vec<Vector3<f64>>,
    resolution: Resolution,
}

impl Candidates {
    /// Points of a solid of this size [m]; those nearer to an earlier one than the smallest feature,
    /// a fraction of the size, are the same.
    fn of(points: &[Vector3<f64>], size: f64, resolution: Resolution) -> Self {
        let mut different: Vec<Vector3<f64>> = Vec::new();
        for point in points {
            let near = |other: &Vector3<f64>| (other - point).norm() <= resolution.smallest * size;
            if !different.iter().any(near) {
                different.push(*point);
            }
        }
        Self {
            points: different,
            resolution,
        }
    }

    /// Their convex hull, without points inside it, in a face or on an edge.
    ///
    /// # Errors
    /// Points that enclose no volume.
    fn hull(mut self) -> Result<ConvexPolyhedron, ShapeError> {
        loop {
            let size = extent(&self.points);
            let faces = self.faces(size);
            let corners = |face: &Flat| face.corners(&self.points, self.resolution.smallest * size);
            let (loops, dull): (Vec<_>, Vec<_>) = faces.iter().map(corners).unzip();
            let kept = self.kept(&faces, &dull);
            if kept.len() < self.points.len() && faces.len() >= 4 {
                self.points = kept.iter().map(|&point| self.points[point]).collect();
                continue;
            }
            let solid = ConvexPolyhedron::new(self.points.clone(), loops.clone());
            match solid
                .as_ref()
                .err()
                .and_then(|error| self.disputed(&loops, error))
            {
                Some(point) => self.points.remove(point),
                None => return solid,
            };
        }
    }

    /// The point that protrudes least among those of faces that contradict each other, if by so
    /// little that it can be left out.
    fn disputed(&self, loops: &[Vec<usize>], error: &ShapeError) -> Option<usize> {
        let (face, stranger) = match *error {
            ShapeError::NotConvex { face, vertex } => (face, Some(vertex)),
            ShapeError::BadFace { face } => (face, None),
            _ => return None,
        };
        let points = loops[face].iter().copied().chain(stranger);
        let prominences = points.map(|point| (point, self.prominence(point, loops)));
        let (point, prominence) = prominences.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let disputed = self.resolution.disputed * extent(&self.points);
        (prominence <= disputed).then_some(point)
    }

    /// Bound of a point's distance from the hull of the others [m]: that from the line between its
    /// neighbours in a face.
    fn prominence(&self, point: usize, loops: &[Vec<usize>]) -> f64 {
        let in_loop = |vertex_loop: &Vec<usize>| {
            let count = vertex_loop.len();
            let place = vertex_loop.iter().position(|&other| other == point)?;
            let [before, after] = [place + count - 1, place + 1]
                .map(|k| self.points[vertex_loop[k % count]] - self.points[point]);
            let chord = after - before;
            let along = (-before.dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
            Some((before + chord * along).norm())
        };
        loops
            .iter()
            .filter_map(in_loop)
            .fold(f64::INFINITY, f64::min)
    }

    /// Points that are corners of every face they are in. Of the others only so many are left out
    /// that those between which they are dull are kept: of a short edge across a tip, each end may
    /// be dull in one face, and without either the tip would be gone.
    fn kept(&self, faces: &[Flat], dull: &[Vec<Dull>]) -> Vec<usize> {
        let mut role = vec![Role::Inside; self.points.len()];
        for &point in faces.iter().flat_map(|face| &face.points) {
            role[point] = Role::Corner;
        }
        for Dull { point, between } in dull.iter().flatten() {
            let stay = between.iter().all(|&other| role[other] != Role::Inside);
            if role[*point] == Role::Corner && stay {
                role[*point] = Role::Inside;
                between.iter().for_each(|&other| role[other] = Role::Held);
            }
        }
        let stays = |point: &usize| role[*point] != Role::Inside;
        (0..self.points.len()).filter(stays).collect()
    }

    /// The faces, each with all points that lie in it, in the order of their first three corners.
    fn faces(&self, size: f64) -> Vec<Flat> {
        let triangles = triangulated(&self.points);
        let regions = regions(&self.points, &triangles, self.resolution.flat * size);
        let mut faces: Vec<([usize; 3], Flat)> = (regions.iter())
            .map(|region| self.flat(&triangles, region, size))
            .collect();
        faces.sort_by_key(|(first, _)| *first);
        faces.into_iter().map(|(_, face)| face).collect()
    }

    /// The face of some triangles in one plane, the first of them the largest, and its first three
    /// points that span it.
    fn flat(&self, triangles: &[Triangle], region: &[usize], size: f64) -> ([usize; 3], Flat) {
        let corners = region.iter().flat_map(|&place| triangles[place].corners);
        let points: BTreeSet<usize> = corners.collect();
        let in_order: Vec<usize> = points.iter().copied().collect();
        let largest = triangles[region[0]].corners;
        let area = self.across(largest);
        let spanning = triples(&in_order).find(|triple| self.is_wide(*triple, size));
        let across = spanning.map(|triple| self.across(triple));
        let normal = across.unwrap_or(area).try_normalize(0.0);
        let normal = normal.unwrap_or_else(Vector3::zeros);
        let flat = Flat {
            normal: if normal.dot(&area) < 0.0 {
                -normal
            } else {
                normal
            },
            is_wide: spanning.is_some(),
            points,
        };
        (spanning.unwrap_or(largest), flat)
    }

    fn across(&self, triple: [usize; 3]) -> Vector3<f64> {
        let [a, b, c] = triple.map(|point| self.points[point]);
        (b - a).cross(&(c - a))
    }

    /// True if a triangle is nowhere narrower than the smallest feature.
    fn is_wide(&self, triple: [usize; 3], size: f64) -> bool {
        let [a, b, c] = triple.map(|point| self.points[point]);
        let (to_b, to_c) = (b - a, c - a);
        let longest = to_b.norm_squared().max(to_c.norm_squared());
        let longest = longest.max((c - b).norm_squared());
        to_b.cross(&to_c).norm_squared() > (self.resolution.smallest * size).powi(2) * longest
    }
}

/// Points in one plane with all others behind it.
#[derive(Debug)]
struct Flat {
    /// Outward unit normal.
    normal: Vector3<f64>,
    /// True if it is wider than the smallest feature, so that its normal is accurate.
    is_wide: bool,
    points: BTreeSet<usize>,
}

/// A point of a face that hardly protrudes between two others.
#[derive(Debug)]
struct Dull {
    point: usize,
    between: [usize; 2],
}

/// Fate of a point when dull ones are left out.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Role {
    Inside,
    Corner,
    /// A corner that must stay, since a point next to it is left out.
    Held,
}

impl Flat {
    /// The points on its rim that protrude by more than `least` [m], counter-clockwise seen from
    /// outside, and the others.
    fn corners(&self, points: &[Vector3<f64>], least: f64) -> (Vec<usize>, Vec<Dull>) {
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
        let mut dull = Vec::new();
        while let Some(k) = (0..rim.len()).find(|&k| self.is_dull(points, &rim, k, least)) {
            let between = [k + rim.len() - 1, k + 1].map(|k| rim[k % rim.len()]);
            let point = rim.remove(k);
            dull.push(Dull { point, between });
        }
        (rim, dull)
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

/// Triangles in groups, each in one plane within `near` [m]: those that border on each other, round
/// the largest of them.
fn regions(points: &[Vector3<f64>], triangles: &[Triangle], near: f64) -> Vec<Vec<usize>> {
    let across: Vec<Vector3<f64>> = (triangles.iter())
        .map(|triangle| {
            let [a, b, c] = triangle.corners.map(|corner| points[corner]);
            (b - a).cross(&(c - a))
        })
        .collect();
    let mut largest_first: Vec<usize> = (0..triangles.len()).collect();
    let area = |place: usize| across[place].norm_squared();
    largest_first.sort_by(|&a, &b| area(b).total_cmp(&area(a)));
    let mut taken = vec![false; triangles.len()];
    let mut regions = Vec::new();
    for seed in largest_first {
        if taken[seed] {
            continue;
        }
        taken[seed] = true;
        let mut region = vec![seed];
        let normal = across[seed].try_normalize(0.0);
        let normal = normal.unwrap_or_else(Vector3::zeros);
        let height = normal.dot(&points[triangles[seed].corners[0]]);
        let in_plane = |&corner: &usize| (normal.dot(&points[corner]) - height).abs() <= near;
        let mut next = 0;
        while let Some(&place) = region.get(next) {
            next += 1;
            for beyond in triangles[place].neighbours {
                if !taken[beyond] && triangles[beyond].corners.iter().all(in_plane) {
                    taken[beyond] = true;
                    region.push(beyond);
                }
            }
        }
        regions.push(region);
    }
    regions
}

/// All triples of some things, in their order.
pub(super) fn triples(things: &[usize]) -> impl Iterator<Item = [usize; 3]> + '_ {
    let from = |k: usize| things.iter().enumerate().skip(k);
    from(0).flat_map(move |(i, &a)| {
        from(i + 1).flat_map(move |(j, &b)| from(j + 1).map(move |(_, &c)| [a, b, c]))
    })
}
