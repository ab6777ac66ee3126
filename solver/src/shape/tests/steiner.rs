//! Volume of a rounded solid computed another way: the planes by trying every three points, each
//! face by clipping its plane with the others, and Steiner's formula. No face knows its neighbours,
//! so nothing can tear.

use crate::shape::check::extent;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Difference of two planes that are one, in direction \[rad\] and in place over the size: the
/// border between two that hardly differ would be anywhere.
const SAME: f64 = 1e-6;

type Plane = (Vector3<f64>, f64);

/// The volume of the hull of some points, rounded with a radius [m³].
pub(super) fn rounded_volume(points: &[Vector3<f64>], radius: f64) -> f64 {
    let planes: Vec<Plane> = planes(points)
        .into_iter()
        .map(|(normal, offset)| (normal, offset - radius))
        .collect();
    let mut volume = 4.0 / 3.0 * PI * radius.powi(3);
    for face in 0..planes.len() {
        let (area, sides) = clipped(face, &planes, extent(points));
        volume += area * (planes[face].1 / 3.0 + radius);
        for (other, length) in sides {
            let angle = planes[face].0.angle(&planes[other].0);
            // Half, for each of its two faces.
            volume += length * angle * radius * radius / 4.0;
        }
    }
    volume
}

/// Planes through three of the points with none in front, each once.
pub(super) fn planes(points: &[Vector3<f64>]) -> Vec<Plane> {
    let size = extent(points);
    let mut planes: Vec<Plane> = Vec::new();
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate().skip(i + 1) {
            for c in points.iter().skip(j + 1) {
                let across = (b - a).cross(&(c - a));
                if across.norm() < 1e-9 * size * (b - a).norm().max((c - a).norm()) {
                    continue;
                }
                for normal in [across.normalize(), -across.normalize()] {
                    let near = 1e-11 * size;
                    let same = |plane: &Plane| {
                        (plane.0 - normal).norm() < SAME
                            && (plane.1 - normal.dot(a)).abs() < SAME * size
                    };
                    if points.iter().all(|p| normal.dot(&(p - a)) < near)
                        && !planes.iter().any(same)
                    {
                        planes.push((normal, normal.dot(a)));
                    }
                }
            }
        }
    }
    planes
}

/// Area of a plane behind all others, and the length of its side on each of them.
fn clipped(face: usize, planes: &[Plane], size: f64) -> (f64, Vec<(usize, f64)>) {
    let (normal, offset) = planes[face];
    let across = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
    let up = normal.cross(&across);
    let corner = |x: f64, y: f64| normal * offset + (across * x + up * y) * (1e3 * size);
    // Corners, and the plane on which the side after each is.
    let mut rim: Vec<(Vector3<f64>, usize)> = [(1., 1.), (-1., 1.), (-1., -1.), (1., -1.)]
        .map(|(x, y)| (corner(x, y), usize::MAX))
        .to_vec();
    for (other, (normal, offset)) in planes.iter().enumerate().filter(|(k, _)| *k != face) {
        let height: Vec<f64> = rim.iter().map(|(p, _)| normal.dot(p) - offset).collect();
        let mut kept = Vec::new();
        for k in 0..rim.len() {
            let next = (k + 1) % rim.len();
            let (here, there) = (height[k], height[next]);
            let crossing = || rim[k].0 + (rim[next].0 - rim[k].0) * (here / (here - there));
            if here <= 0.0 {
                kept.push(rim[k]);
                if there > 0.0 {
                    kept.push((crossing(), other));
                }
            } else if there <= 0.0 {
                kept.push((crossing(), rim[k].1));
            }
        }
        rim = kept;
    }
    let ends = |k: usize| (rim[k].0, rim[(k + 1) % rim.len()].0);
    let mut area = 0.0;
    let mut sides = Vec::new();
    for k in 0..rim.len() {
        let (start, end) = ends(k);
        area += (start - rim[0].0).cross(&(end - rim[0].0)).dot(&normal) / 2.0;
        if rim[k].1 < planes.len() {
            sides.push((rim[k].1, (end - start).norm()));
        }
    }
    (area, sides)
}
