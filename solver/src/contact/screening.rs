//! Screening of points by bodies: a plate thinner than a point's stand-off separates the point
//! from bodies behind the plate.

use super::broad_phase::{Ball, overlapping_pairs};
use crate::math::Vec3;
use crate::rigid::Body;

/// Steps of a ray towards a surface; one that grazes a surface takes more, and passes.
const MOST_STEPS: usize = 16;
/// Distance from a surface, over the ray's length, that counts as zero.
const REACHED: f64 = 1e-3;

/// True if a body lies between two places. The ray advances by its distance from the body until
/// that vanishes, or the end comes first.
pub fn screens(body: &Body, from: &Vec3, to: &Vec3) -> bool {
    let way = to - from;
    let length = way.norm();
    if length == 0.0 || !ray_meets_ball(body, from, &(way / length), length) {
        return false;
    }
    let mut gone = 0.0;
    for _ in 0..MOST_STEPS {
        let distance = body.distance_to(&(from + way * (gone / length)));
        if distance <= REACHED * length {
            return true;
        }
        gone += distance;
        if gone >= length {
            return false;
        }
    }
    false
}

fn ray_meets_ball(body: &Body, from: &Vec3, direction: &Vec3, length: f64) -> bool {
    let arm = body.state.position - from;
    let nearest = arm.dot(direction).clamp(0.0, length);
    (arm - direction * nearest).norm() <= body.shape.bounding_radius()
}

/// Per body, the other bodies that may lie between it and a point within `reach` [m].
pub fn screening_bodies(bodies: &[Body], reach: f64, of: &mut Vec<Vec<usize>>) {
    of.resize_with(bodies.len(), Vec::new);
    of.iter_mut().for_each(Vec::clear);
    if bodies.len() < 2 {
        return;
    }
    let ball = |body: &Body| Ball {
        centre: body.state.position,
        radius: body.shape.bounding_radius() + 0.5 * reach,
    };
    let balls: Vec<Ball> = bodies.iter().map(ball).collect();
    for [one, other] in overlapping_pairs(&balls) {
        of[one].push(other);
        of[other].push(one);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigid::fixture::cuboid;

    #[test]
    fn a_plate_screens_what_is_behind_it_and_nothing_beside_it() {
        let plate = cuboid([0.002, 0.1, 0.1]);
        let before = Vec3::new(-0.01, 0.0, 0.0);
        assert!(screens(&plate, &before, &Vec3::new(0.01, 0.0, 0.0)));
        assert!(screens(&plate, &before, &Vec3::new(0.01, 0.04, -0.04)));
        assert!(!screens(&plate, &before, &Vec3::new(-0.002, 0.04, 0.0)));
        let over_the_edge = Vec3::new(-0.01, 0.0, 0.06);
        assert!(!screens(
            &plate,
            &over_the_edge,
            &Vec3::new(0.01, 0.0, 0.06)
        ));
        assert!(!screens(&plate, &before, &before));
    }

    #[test]
    fn bodies_near_each_other_may_screen_each_other() {
        let mut bodies = vec![cuboid([0.02; 3]), cuboid([0.02; 3]), cuboid([0.02; 3])];
        bodies[1].state.position = Vec3::new(0.03, 0.0, 0.0);
        bodies[2].state.position = Vec3::new(0.3, 0.0, 0.0);
        let mut of = Vec::new();
        screening_bodies(&bodies, 0.01, &mut of);
        assert_eq!(of, [vec![1], vec![0], vec![]]);
    }
}
