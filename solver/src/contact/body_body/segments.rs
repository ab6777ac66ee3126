//! Nearest places of two segments, and of a segment and a point.

use crate::math::Vec3;

/// Sine below which two segments have no defined crossing.
const PARALLEL: f64 = 1e-9;

/// Square of a distance over that of the reach up to which two lines are looked at: what rounding
/// may put within reach is not left out.
const ROUNDED: f64 = 1.0 + 1e-6;

/// The nearest places of the lines through two segments, if both lie inside the
/// segments; none for parallel ones, and none for lines farther apart than `reach`.
pub(super) fn crossing(a: &[Vec3; 2], b: &[Vec3; 2], reach: f64) -> Option<(Vec3, Vec3)> {
    let (along_a, along_b, apart) = (a[1] - a[0], b[1] - b[0], b[0] - a[0]);
    let normal = along_a.cross(&along_b);
    let squared = normal.norm_squared();
    let across = apart.dot(&normal);
    if across * across > ROUNDED * reach * reach * squared {
        return None;
    }
    let scale = along_a.norm_squared() * along_b.norm_squared();
    if squared <= PARALLEL * PARALLEL * scale {
        return None;
    }
    let inside = |place: f64| place > 0.0 && place < 1.0;
    let on_a = apart.cross(&along_b).dot(&normal) / squared;
    if !inside(on_a) {
        return None;
    }
    let on_b = apart.cross(&along_a).dot(&normal) / squared;
    inside(on_b).then(|| (a[0] + along_a * on_a, b[0] + along_b * on_b))
}

/// The place of a segment nearest to `x`.
pub(super) fn nearest_on(segment: &[Vec3; 2], x: &Vec3) -> Vec3 {
    let along = segment[1] - segment[0];
    let place = (x - segment[0]).dot(&along) / along.norm_squared();
    segment[0] + along * place.clamp(0.0, 1.0)
}

/// Distance of two segments.
pub(super) fn distance_of(a: &[Vec3; 2], b: &[Vec3; 2]) -> f64 {
    let (p, q) = nearest_places(a, b);
    (q - p).norm()
}

/// The nearest places of two cores without faces, given by their vertices: one of a point, two
/// of a segment.
pub(super) fn nearest_places(a: &[Vec3], b: &[Vec3]) -> (Vec3, Vec3) {
    let of_a = a.iter().map(|end| (*end, nearest_of(b, end)));
    let of_b = b.iter().map(|end| (nearest_of(a, end), *end));
    let crossing = match (a, b) {
        ([a0, a1], [b0, b1]) => crossing(&[*a0, *a1], &[*b0, *b1], f64::INFINITY),
        _ => None,
    };
    let apart = |(p, q): &(Vec3, Vec3)| (q - p).norm_squared();
    let pairs = of_a.chain(of_b).chain(crossing);
    let nearest = pairs.min_by(|one, other| apart(one).total_cmp(&apart(other)));
    nearest.unwrap_or_default()
}

fn nearest_of(core: &[Vec3], x: &Vec3) -> Vec3 {
    match core {
        [start, end] => nearest_on(&[*start, *end], x),
        _ => core.first().copied().unwrap_or_default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cores_without_faces_have_nearest_places() {
        let along_x = [-Vec3::x(), Vec3::x()];
        let across = [Vec3::new(0.5, -1.0, 0.2), Vec3::new(0.5, 1.0, 0.2)];
        let (p, q) = nearest_places(&along_x, &across);
        assert!((p - Vec3::new(0.5, 0.0, 0.0)).norm() < 1e-15);
        assert!((q - Vec3::new(0.5, 0.0, 0.2)).norm() < 1e-15);
        let beside = along_x.map(|end| end + Vec3::new(1.5, 0.3, 0.0));
        let (p, q) = nearest_places(&along_x, &beside);
        assert!(((q - p) - Vec3::y() * 0.3).norm() < 1e-15);
        let point = [Vec3::new(3.0, 0.0, 1.0)];
        assert_eq!(nearest_places(&point, &along_x), (point[0], Vec3::x()));
        assert_eq!(nearest_places(&along_x, &point), (Vec3::x(), point[0]));
        assert_eq!(nearest_places(&point, &point), (point[0], point[0]));
    }

    #[test]
    fn crossing_segments_are_nearest_where_they_cross() {
        let along_x = [Vec3::new(-1.0, 0.0, 0.0), Vec3::new(3.0, 0.0, 0.0)];
        let above = [Vec3::new(0.5, -1.0, 0.2), Vec3::new(0.5, 1.0, 0.2)];
        let (p, q) = crossing(&along_x, &above, 1.0).expect("they cross");
        assert!((p - Vec3::new(0.5, 0.0, 0.0)).norm() < 1e-15);
        assert!((q - Vec3::new(0.5, 0.0, 0.2)).norm() < 1e-15);
        let beside = above.map(|end| end + Vec3::new(3.0, 0.0, 0.0));
        assert_eq!(crossing(&along_x, &beside, 1.0), None);
        let parallel = along_x.map(|end| end + Vec3::z());
        assert_eq!(crossing(&along_x, &parallel, 2.0), None);
        assert_eq!(crossing(&along_x, &above, 0.19), None);
    }

    #[test]
    fn beyond_an_end_the_end_is_nearest() {
        let segment = [Vec3::zeros(), Vec3::x()];
        assert_eq!(nearest_on(&segment, &Vec3::new(2.0, 1.0, 0.0)), Vec3::x());
        assert_eq!(nearest_on(&segment, &-Vec3::x()), Vec3::zeros());
        assert_eq!(
            nearest_on(&segment, &Vec3::new(0.25, 1.0, 0.0)),
            Vec3::new(0.25, 0.0, 0.0)
        );
    }
}
