//! Pairs of points on the rim of a cloud: those that can be in one face.

use super::pairs::Pairs;
use nalgebra::Vector3;

/// Distance from a line within which a point says nothing of what lies on either side, over the
/// size.
const ON_LINE: f64 = 1e-4;
/// Angle by which points may lie beyond a half-plane \[rad\]: that of a face's tolerance,
/// 1e-10, seen from [`ON_LINE`], and as much again many times over.
const SLACK: f64 = 1e-5;

/// Pairs on the rim: seen along the line through both, all points lie in a half-plane. Two points
/// of one face always are.
pub(super) fn on_rim(points: &[Vector3<f64>], size: f64) -> Pairs {
    // Places that refuted a pair come first: they often refute the next, too.
    let mut places = points.to_vec();
    Pairs::among(points.len(), |a, b| {
        is_on_rim(&mut places, [points[a], points[b]], size)
    })
}

fn is_on_rim(places: &mut [Vector3<f64>], [from, to]: [Vector3<f64>; 2], size: f64) -> bool {
    let Some(along) = (to - from).try_normalize(ON_LINE * size) else {
        // Points so near to each other have no line with a direction.
        return true;
    };
    let [across, up] = frame(&along);
    let near = (ON_LINE * size).powi(2);
    let mut wedge: Option<Wedge> = None;
    for k in 0..places.len() {
        let arm = places[k] - from;
        let arm = [arm.dot(&across), arm.dot(&up)];
        if dot(arm, arm) <= near {
            continue;
        }
        let fits = match &mut wedge {
            None => {
                wedge = Some(Wedge::of(arm));
                true
            }
            Some(wedge) => wedge.widen(arm),
        };
        if !fits {
            places[..=k].rotate_right(1);
            return false;
        }
    }
    true
}

/// Two directions at right angles to a unit vector, and to each other.
fn frame(along: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let least = along.iamin();
    let across = along.cross(&Vector3::ith(least, 1.0)).normalize();
    [across, along.cross(&across)]
}

/// The directions between two arms of a plane, less than a half-plane from the first to either.
struct Wedge {
    first: [f64; 2],
    right: [f64; 2],
    left: [f64; 2],
}

impl Wedge {
    fn of(arm: [f64; 2]) -> Self {
        Self {
            first: arm,
            right: arm,
            left: arm,
        }
    }

    /// Adds an arm; false if the wedge then exceeds a half-plane by more than the slack.
    fn widen(&mut self, arm: [f64; 2]) -> bool {
        let turn = cross(self.first, arm);
        if is_slight(turn, self.first, arm) && dot(self.first, arm) < 0.0 {
            // Opposite to the first, it bounds a half-plane on either side.
            return true;
        }
        let side = match turn > 0.0 {
            true => &mut self.left,
            false => &mut self.right,
        };
        if cross(*side, arm) * turn > 0.0 {
            *side = arm;
        }
        let width = cross(self.right, self.left);
        width >= 0.0 || is_slight(width, self.right, self.left)
    }
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// True if the angle between two arms, whose cross product is given, is within the slack of 0 or π.
fn is_slight(cross: f64, a: [f64; 2], b: [f64; 2]) -> bool {
    cross * cross <= SLACK * SLACK * dot(a, a) * dot(b, b)
}
