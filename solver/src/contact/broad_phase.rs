//! Broad phase: bounding balls, sorted along the axis of their largest spread (sweep and
//! prune).

use crate::math::Vec3;

/// A ball round the region that a body can reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// Centre [m].
    pub centre: Vec3,
    /// Radius [m].
    pub radius: f64,
}

/// Every pair of balls that overlap, the lower number first, in order.
pub fn overlapping_pairs(balls: &[Ball]) -> Vec<[usize; 2]> {
    let axis = widest_axis(balls);
    let start = |ball: &Ball| ball.centre[axis] - ball.radius;
    let mut order: Vec<usize> = (0..balls.len()).collect();
    order.sort_unstable_by(|&a, &b| {
        start(&balls[a])
            .total_cmp(&start(&balls[b]))
            .then(a.cmp(&b))
    });
    let mut pairs = Vec::new();
    // Balls passed so far that reach beyond the start of the current one.
    let mut open: Vec<usize> = Vec::new();
    for &next in &order {
        let ball = &balls[next];
        let begins = start(ball);
        open.retain(|&other| balls[other].centre[axis] + balls[other].radius > begins);
        for &other in &open {
            let reach = ball.radius + balls[other].radius;
            let apart = ball.centre - balls[other].centre;
            if apart.norm_squared() < reach * reach {
                pairs.push([next.min(other), next.max(other)]);
            }
        }
        open.push(next);
    }
    pairs.sort_unstable();
    pairs
}

/// The axis along which the centres vary most.
fn widest_axis(balls: &[Ball]) -> usize {
    let mut low = Vec3::repeat(f64::INFINITY);
    let mut high = -low;
    for ball in balls {
        low = low.inf(&ball.centre);
        high = high.sup(&ball.centre);
    }
    (high - low).imax()
}

#[cfg(test)]
mod tests {
    use super::*;

    // Against all pairs, for sets of several densities and shapes.
    #[test]
    fn no_pair_is_missed_and_none_made_up() {
        let mut number = 0.0f64;
        let mut next = || {
            number = (number + 0.618_033_988_749_895).fract();
            (number * 97.0).fract()
        };
        for (count, size) in [
            (0, 0.1),
            (1, 0.1),
            (2, 0.9),
            (60, 0.05),
            (60, 0.3),
            (200, 0.1),
        ] {
            let mut ball = |_| Ball {
                centre: Vec3::new(next(), 2.0 * next(), 0.5 * next()),
                radius: size * (0.2 + next()),
            };
            let balls: Vec<Ball> = (0..count).map(&mut ball).collect();
            let mut expected = Vec::new();
            for a in 0..count {
                for b in a + 1..count {
                    let reach = balls[a].radius + balls[b].radius;
                    if (balls[a].centre - balls[b].centre).norm() < reach {
                        expected.push([a, b]);
                    }
                }
            }
            assert_eq!(overlapping_pairs(&balls), expected);
        }
    }
}
