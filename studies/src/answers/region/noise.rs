//! Noise of a density over that of independent draws.

use super::grid::{DensityGrid, Kernel};
use crate::answers::halves::{self, SIGNS};

/// Factor of the measured noise. The measure scatters, by about a fifth for independent draws, and
/// is cut at 1; the factor keeps the cut one from being too small on average.
const MARGIN: f64 = 1.2;

/// Variance of the density over the variance it would have with independent draws, at most 1.
///
/// The members of a balanced design keep apart: each leaves a hole among the others, and a kernel
/// at the member just fills it. Two halves of such a design agree better than two of independent
/// draws. The measure is the square of their difference over the expectation
/// (∫ K² − ∫ f̂²)/n, integrated over the plane. The halves are designs of half the size, so a
/// quickly converging design is somewhat quieter than this says.
pub(super) fn ratio(kernel: &Kernel, density: &DensityGrid, places_m: &[[f64; 2]]) -> f64 {
    let count = places_m.len();
    let squares = SIGNS.map(|signs| {
        let weight = |place: usize| halves::sign(signs, place, count) / count as f64;
        let weights: Vec<f64> = (0..count).map(weight).collect();
        kernel.sum(places_m, &weights).square_integral()
    });
    let measured = squares.iter().sum::<f64>() / SIGNS.len() as f64;
    let expected = (kernel.square_integral() - density.square_integral()) / count as f64;
    if expected > 0.0 {
        (MARGIN * measured / expected).min(1.0)
    } else {
        1.0
    }
}
