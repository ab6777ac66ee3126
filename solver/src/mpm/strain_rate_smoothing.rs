//! Strain-rate smoothing (docs/method.md, equation 42a).
//!
//! Where points lie unevenly, the velocity gradient of each of them is off, by 3 % in steady
//! shear with eight points a cell. Shear stress follows the direction of the strain rate, so part
//! of it does not point against the flow, and friction comes out too weak. The mean strain rate
//! of the points around is off another way: so the effective strain rate of a point is a mixture
//! of its own and the mean.

use super::chunk::Chunk;
use super::lanes::{Real, Splat, load_each};
use crate::method::METHOD;
use fearless_simd::prelude::*;

/// Smoothing of strain rates in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainRateSmoothing {
    /// Share of the mean.
    pub share: f64,
    /// Speed from which on a point is smoothed fully [m/s].
    pub full_speed: f64,
}

impl StrainRateSmoothing {
    /// None at all: an elastic body keeps its own strain rates.
    pub const NONE: Self = Self {
        share: 0.0,
        full_speed: f64::MIN_POSITIVE,
    };

    /// Smoothing of a flow whose steps are governed by this speed [m/s].
    pub fn at(speed: f64) -> Self {
        Self {
            share: METHOD.smoothing.share,
            full_speed: METHOD.smoothing.slow * speed,
        }
    }
}

/// Finds the strain rates that smoothing adds to those of the points of a chunk, deviators
/// (equation 42a), from the mean ones: xx, yy, zz, xy, and xz, yz.
#[inline(always)]
pub fn smooth_strain_rates<S: Simd, R: Real>(
    simd: S,
    chunk: &mut Chunk<R>,
    [xx, yy, zz, xy]: &[R::Vector<S>; 4],
    [xz, yz, ..]: &[R::Vector<S>; 4],
    smoothing: &StrainRateSmoothing,
) {
    let number = Splat::<S, R>::new(simd);
    let full = smoothing.full_speed * smoothing.full_speed;
    let per_full = number.of(full.max(R::SMALLEST).recip());
    let own = chunk.strain_rate(simd);
    let mut lacking = [*xx, *yy, *zz, *xy, *xz, *yz];
    for (part, own) in lacking.iter_mut().zip(own) {
        *part -= own;
    }
    let third = (lacking[0] + lacking[1] + lacking[2]) * number.of(1.0 / 3.0);
    for part in &mut lacking[..3] {
        *part -= third;
    }
    let [x, y, z] = load_each::<S, R, 3>(simd, &chunk.velocity);
    let speed = x.mul_add(x, y.mul_add(y, z * z));
    let degree = (speed * per_full).min(number.of(1.0));
    let share = number.of(smoothing.share) * degree;
    for (kept, part) in chunk.smoothing.iter_mut().zip(lacking) {
        *kept = (share * part).to_array();
    }
}

#[cfg(test)]
mod tests;
