//! Bandwidth of the kernels.

use super::atoms;
use crate::moments;

/// Fewest places that a density is fitted to.
const FEWEST: usize = 10;
/// Places that the cross-validation compares with each other; of more, as many evenly chosen.
const COMPARED: usize = 1024;
/// Quartile of a standard normal distribution, by which the interquartile range is twice too wide.
const NORMAL_QUARTILE: f64 = 0.674_489_750_196_081_7;
/// Smallest bandwidth over that of the other axis, for places on a line along an axis.
const LEAST_RATIO: f64 = 1e-3;
/// Factors of the reference bandwidths that are tried, the largest and the ratio of neighbours.
const LARGEST_FACTOR: f64 = 1.25;
const FACTOR_RATIO: f64 = 0.88;
const FACTORS: usize = 15;

/// Bandwidths downstream and across [m]; none of too few places or of one place alone.
///
/// The reference is Scott's, n^(−1/6) times the spread along each axis, right for a normal
/// distribution. One factor of both is found by least-squares cross-validation (Rudemo 1982,
/// Bowman 1984), which narrows the kernels where places have several peaks.
pub(super) fn bandwidth(places_m: &[[f64; 2]]) -> Option<[f64; 2]> {
    if places_m.len() < FEWEST {
        return None;
    }
    let shrink = libm::pow(places_m.len() as f64, -1.0 / 6.0);
    let along = [0, 1].map(|axis| shrink * spread(places_m, axis));
    let least = LEAST_RATIO * along[0].max(along[1]);
    let reference = along.map(|bandwidth| bandwidth.max(least));
    let factor = factor(places_m, reference);
    (least > 0.0).then(|| reference.map(|bandwidth| factor * bandwidth))
}

/// Spread along an axis, robust against far places: the smaller one of the standard deviation and
/// that of a normal distribution with the same quartiles (Silverman 1986, equation 3.30).
fn spread(places_m: &[[f64; 2]], axis: usize) -> f64 {
    let along: Vec<f64> = places_m.iter().map(|place| place[axis]).collect();
    let sorted = moments::sorted(&along);
    let last = (sorted.len() - 1) as f64;
    let quartiles = moments::at(&sorted, 0.75 * last) - moments::at(&sorted, 0.25 * last);
    let deviation = moments::variance(&along).sqrt();
    if quartiles > 0.0 {
        deviation.min(quartiles / (2.0 * NORMAL_QUARTILE))
    } else {
        deviation.min(atoms::extent(places_m, axis))
    }
}

/// Factor of the reference bandwidths with the least estimated square error.
fn factor(places_m: &[[f64; 2]], reference: [f64; 2]) -> f64 {
    let distances = squared_distances(places_m, reference);
    let count = places_m.len().min(COMPARED) as f64;
    let mut best = (f64::INFINITY, 1.0);
    let mut factor = LARGEST_FACTOR;
    for _ in 0..FACTORS {
        let error = squared_error(&distances, count, factor);
        if error < best.0 {
            best = (error, factor);
        }
        factor *= FACTOR_RATIO;
    }
    best.1
}

/// Squared distances of all pairs of the compared places, over the reference bandwidths.
fn squared_distances(places_m: &[[f64; 2]], reference: [f64; 2]) -> Vec<f64> {
    let stride = places_m.len() as f64 / places_m.len().min(COMPARED) as f64;
    let chosen = (0..places_m.len().min(COMPARED)).map(|one| (one as f64 * stride) as usize);
    let scaled = |place: usize| [0, 1].map(|axis| places_m[place][axis] / reference[axis]);
    let chosen: Vec<[f64; 2]> = chosen.map(scaled).collect();
    let pairs = chosen.iter().enumerate().flat_map(|(place, one)| {
        let later = chosen[place + 1..].iter();
        later.map(|other| {
            let [x, y] = [one[0] - other[0], one[1] - other[1]];
            x * x + y * y
        })
    });
    pairs.collect()
}

/// Estimate of ∫ (f̂ − f)² without its constant part, times 4π h_x h_y of the reference:
/// ∫ f̂² − 2/n Σ f̂₋ᵢ(xᵢ), where f̂₋ᵢ leaves the place i out.
fn squared_error(distances: &[f64], count: f64, factor: f64) -> f64 {
    let scale = -0.25 / (factor * factor);
    let (mut wide, mut narrow) = (0.0, 0.0);
    for distance in distances {
        let kernel = libm::exp(scale * distance);
        wide += kernel;
        narrow += kernel * kernel;
    }
    let own = 1.0 / count + 2.0 * wide / (count * count);
    (own - 8.0 * narrow / (count * (count - 1.0))) / (factor * factor)
}
