//! Sampling error of a region's area.

use super::SEED;
use super::grid::Kernel;
use super::scores::Scores;
use crate::random::{Purpose, Random};

/// Resamples of the members.
const RESAMPLES: u64 = 100;

/// Areas of the region of a probability in resamples of the places, drawn with replacement (Efron
/// 1979); the bandwidth and the noise ratio stay [m²].
pub(super) fn areas(
    kernel: &Kernel,
    places_m: &[[f64; 2]],
    probability: f64,
    noise: f64,
) -> Vec<f64> {
    let area = |resample: u64| {
        let weights = weights(places_m.len(), resample);
        let density = kernel.density(places_m, &weights);
        let scores = Scores::of(kernel, &density, places_m, &weights, noise);
        let level = scores.level(probability)?;
        Some(density.area_above(level))
    };
    (0..RESAMPLES).filter_map(area).collect()
}

/// How often each place is drawn in a resample.
fn weights(count: usize, resample: u64) -> Vec<f64> {
    let mut random = Random::new(Purpose::Bootstrap, SEED, [resample, 0]);
    let mut weights = vec![0.0; count];
    for _ in 0..count {
        weights[random.below(count)] += 1.0;
    }
    weights
}
