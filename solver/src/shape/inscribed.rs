//! The largest ball behind a number of planes, by linear programming.

use nalgebra::{Matrix4, Vector3, Vector4};

/// Outward unit normal n and offset [m] of a plane: n·x = offset.
pub(super) type Plane = (Vector3<f64>, f64);

/// Rounding of lengths, over the size.
const ROUNDING: f64 = 1e-12;
/// Rates of change of a weight, tried in turn, up to which it counts as none. Planes nearly
/// parallel have very low rates; the exchange of one for the other makes the equations singular.
const STEADY: [f64; 5] = [ROUNDING, 1e-9, 1e-6, 1e-3, 1e-1];
/// Depth by which a plane may cut the ball, over the size.
const CUT: f64 = 1e-10;
/// More exchanges than any set of planes needs; a limit for cycles caused by rounding.
const MOST_EXCHANGES: usize = 1000;

/// A ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ball {
    /// Centre [m].
    pub(super) centre: Vector3<f64>,
    /// Radius [m].
    pub(super) radius: f64,
}

impl Ball {
    /// Least distance of the centre behind a plane [m].
    fn room(&self, planes: &[Plane]) -> f64 {
        let height = |(normal, offset): &Plane| offset - normal.dot(&self.centre);
        planes.iter().map(height).fold(f64::INFINITY, f64::min)
    }
}

/// The largest ball behind all planes of a solid of this size [m].
pub(super) fn largest_ball(planes: &[Plane], size: f64) -> Ball {
    let mut widest: Option<(f64, Ball)> = None;
    for steady in STEADY {
        let ball = search(planes, size, steady);
        let room = ball.room(planes);
        if room >= ball.radius - CUT * size {
            return ball;
        }
        if widest.is_none_or(|(most, _)| room > most) {
            let radius = room;
            widest = Some((room, Ball { radius, ..ball }));
        }
    }
    widest.map_or(NO_BALL, |(_, ball)| ball)
}

const NO_BALL: Ball = Ball {
    centre: Vector3::new(0.0, 0.0, 0.0),
    radius: f64::INFINITY,
};

/// The largest ρ with n·c + ρ ≤ offset for all planes and some centre c. The dual is solved
/// (Chvátal 1983, Linear Programming, chapter 7): weights λ ≥ 0 on the planes with Σ λ n = 0,
/// Σ λ = 1 and least Σ λ offset, at most four of them positive. It terminates by Bland's rule.
fn search(planes: &[Plane], size: f64, steady: f64) -> Ball {
    // A column per plane, after four that only serve to start: their cost exceeds any
    // coordinate of the ball, so that none is in the solution.
    let dear = 10.0 * size;
    let column = |place: usize| match place.checked_sub(4) {
        None => (Vector4::ith(place, 1.0), dear),
        Some(plane) => {
            let (normal, offset) = planes[plane];
            (normal.push(1.0), offset)
        }
    };
    let mut basis = [0, 1, 2, 3];
    let mut found = NO_BALL;
    for _ in 0..MOST_EXCHANGES {
        let columns = basis.map(|place| column(place).0);
        let prices = Vector4::from(basis.map(|place| column(place).1));
        let Some(inverse) = Matrix4::from_columns(&columns).try_inverse() else {
            break;
        };
        let weights = inverse.column(3).into_owned();
        let ball = inverse.transpose() * prices;
        found = Ball {
            centre: ball.xyz(),
            radius: weights.dot(&prices),
        };
        let cut = |place: &usize| {
            let (plane, offset) = column(*place);
            !basis.contains(place) && offset - ball.dot(&plane) < -ROUNDING * size
        };
        let Some(entering) = (4..4 + planes.len()).find(cut) else {
            break;
        };
        let rates = inverse * column(entering).0;
        let leaving = (0..4)
            .filter(|&k| rates[k] > steady)
            .map(|k| (weights[k].max(0.0) / rates[k], basis[k], k))
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let Some((_, _, leaving)) = leaving else {
            break;
        };
        basis[leaving] = entering;
    }
    found
}
