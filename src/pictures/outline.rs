//! Outline of a body as seen from above.

use scree_solver::record::BodySample;
use scree_solver::shape::SpheroPolyhedron;
use std::f64::consts::TAU;

/// Points on a full circle of the rounding.
const CIRCLE_POINTS: u32 = 32;

/// Outline of a body seen from above [m], anticlockwise: the convex hull of its
/// core's vertices (one of a ball, two of a capsule), turned and moved as in the sample, widened by the rounding
/// radius (the Minkowski sum of hull and disc).
pub(super) fn from_above(shape: &SpheroPolyhedron, sample: &BodySample) -> Vec<[f64; 2]> {
    let radius = shape.sphero_radius();
    let mut points = Vec::new();
    for vertex in shape.core_vertices() {
        let turned = rotate(sample.orientation, (*vertex).into());
        let centre = [0, 1].map(|axis| sample.position_m[axis] + turned[axis]);
        points.extend((0..CIRCLE_POINTS).map(|step| {
            let angle = TAU * f64::from(step) / f64::from(CIRCLE_POINTS);
            [
                centre[0] + radius * angle.cos(),
                centre[1] + radius * angle.sin(),
            ]
        }));
    }
    points.retain(|p| p.iter().all(|c| c.is_finite()));
    convex_hull(points)
}

/// Turns a vector by a unit quaternion [w, x, y, z]: v + 2 u × (u × v + w v).
fn rotate([w, x, y, z]: [f64; 4], v: [f64; 3]) -> [f64; 3] {
    let axis = [x, y, z];
    let inner = cross(axis, v);
    let inner = [0, 1, 2].map(|i| inner[i] + w * v[i]);
    let outer = cross(axis, inner);
    [0, 1, 2].map(|i| v[i] + 2.0 * outer[i])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Convex hull, anticlockwise, by Andrew's monotone chain.
fn convex_hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut hull = half_hull(points.iter().copied());
    let upper = half_hull(points.iter().rev().copied());
    hull.pop();
    hull.extend(&upper[..upper.len() - 1]);
    hull
}

/// The chain that turns left all the way from the first to the last point.
fn half_hull(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut chain: Vec<[f64; 2]> = Vec::new();
    for point in points {
        while let [.., a, b] = chain[..]
            && turn(a, b, point) <= 0.0
        {
            chain.pop();
        }
        chain.push(point);
    }
    chain
}

/// Positive where a → b → c turns left.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pictures::fixtures::resting_at;
    use scree_solver::shape::{RegularSolid, SharpPolyhedron};

    fn extent(outline: &[[f64; 2]], axis: usize) -> f64 {
        let coordinates = || outline.iter().map(|p| p[axis]);
        coordinates().fold(f64::MIN, f64::max) - coordinates().fold(f64::MAX, f64::min)
    }

    /// A tetrahedron that lies on a face is a rounded triangle from above.
    #[test]
    fn outline_of_a_tetrahedron_is_a_rounded_triangle() {
        let sharp = SharpPolyhedron::regular(RegularSolid::Tetrahedron, 0.04).unwrap();
        let body = sharp.rounded(0.002).unwrap();
        let outline = from_above(&body, &resting_at([0.0; 3]));
        // The core is the same solid, scaled by 1 − radius/inradius.
        let core = 0.04 * (1.0 - 0.002 / sharp.inradius());
        assert!((extent(&outline, 1) - (core + 0.004)).abs() < 1e-9);
        let height = core * 0.75_f64.sqrt() + 0.004;
        // The circle has points on the axes, and an edge runs along y.
        assert!((extent(&outline, 0) - height).abs() < 1e-9);
        let area: f64 = (0..outline.len())
            .map(|k| (outline[k], outline[(k + 1) % outline.len()]))
            .map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0]))
            .sum();
        let triangle = core * core * 0.75_f64.sqrt() / 2.0;
        let expected = triangle + 3.0 * core * 0.002 + std::f64::consts::PI * 0.002_f64.powi(2);
        // A circle of thirty-two points has 0.6 % less area.
        assert!((area / expected - 1.0).abs() < 1e-3, "{area} {expected}");
    }

    /// From above a ball is a circle, and a capsule a stadium as long and as wide as it is.
    #[test]
    fn outlines_of_round_bodies_are_a_circle_and_a_stadium() {
        let at_origin = resting_at([0.0; 3]);
        let circle = from_above(&SpheroPolyhedron::ball(0.02).unwrap(), &at_origin);
        assert_eq!(circle.len(), CIRCLE_POINTS as usize);
        assert!(
            circle
                .iter()
                .all(|p| (p[0].hypot(p[1]) - 0.02).abs() < 1e-15)
        );
        let capsule = SpheroPolyhedron::capsule(0.01, 0.06).unwrap();
        let stadium = from_above(&capsule, &at_origin);
        assert!((extent(&stadium, 0) - 0.06).abs() < 1e-15);
        assert!((extent(&stadium, 1) - 0.02).abs() < 1e-15);
        assert_eq!(stadium.len(), CIRCLE_POINTS as usize + 2);
    }

    /// A 4 cm cube is 4 cm across its flats, rounding included; turned by 45°
    /// about z it is √2 (L − 2r) + 2r across. The circle has points on the
    /// axes, so both hold to rounding.
    #[test]
    fn outline_of_a_cube_has_its_width() {
        let cube = SpheroPolyhedron::cube(0.04, 0.002).unwrap();
        let mut sample = resting_at([0.3, -0.05, 0.02]);
        let flat = from_above(&cube, &sample);
        assert!((extent(&flat, 0) - 0.04).abs() < 1e-12);
        assert!((extent(&flat, 1) - 0.04).abs() < 1e-12);

        let half_turn = (TAU / 16.0).sin_cos();
        sample.orientation = [half_turn.1, 0.0, 0.0, half_turn.0];
        let turned = from_above(&cube, &sample);
        let expected = 2_f64.sqrt() * 0.036 + 0.004;
        assert!((extent(&turned, 0) - expected).abs() < 1e-12);
        let centre = turned.iter().map(|p| p[0]).sum::<f64>() / turned.len() as f64;
        assert!(
            (centre - 0.3).abs() < 1e-12,
            "centred on the body: {centre}"
        );
    }
}
