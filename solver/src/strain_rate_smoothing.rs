//! Strain-rate smoothing (docs/method.md, equation 42a).
//!
//! Where points are unevenly distributed, the velocity gradient at each of them has an error, 3
//! % in steady shear with eight points a cell. Shear stress follows the direction of the strain
//! rate, so part of it does not oppose the flow, and friction is too low. The errors of
//! neighbours are nearly independent: the effective strain rate is therefore a mixture of a
//! point's own and their mean.

use crate::math::Sym3;

/// Share of the mean in the effective strain rate of a point.
const SHARE: f64 = 0.5;
/// Share of the fastest speed below which a point is smoothed less, by the square: particle
/// noise alone has no effect.
const SLOW: f64 = 0.2;

/// Smoothing of strain rates in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainRateSmoothing {
    /// Share of the mean.
    pub share: f64,
    /// Speed above which a point is fully smoothed [m/s].
    pub full_speed: f64,
}

impl StrainRateSmoothing {
    /// No smoothing: an elastic body keeps its own strain rates.
    pub const NONE: Self = Self {
        share: 0.0,
        full_speed: f64::MIN_POSITIVE,
    };

    /// Smoothing in a flow that governs its steps by this speed [m/s].
    pub fn at(speed: f64) -> Self {
        Self {
            share: SHARE,
            full_speed: SLOW * speed,
        }
    }

    /// Smoothed part of the effective strain rate [1/s] of a point of this speed [m/s], a deviator,
    /// for the mean of its neighbourhood `mean`.
    pub fn of(&self, own: &Sym3, mean: &Sym3, speed: f64) -> Sym3 {
        let degree = (speed / self.full_speed).min(1.0).powi(2);
        let lacking = mean.plus(&own.times(-1.0)).deviator();
        lacking.times(self.share * degree)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OWN: Sym3 = Sym3 {
        xx: 3.0,
        yy: 0.0,
        zz: 0.0,
        xy: 0.0,
        xz: 10.0,
        yz: 1.0,
    };
    const MEAN: Sym3 = Sym3 {
        xx: 0.0,
        yy: 0.0,
        zz: 0.0,
        xy: 0.0,
        xz: 9.0,
        yz: 0.0,
    };

    // By hand: of −3 in xx a third is volume and stays, so −2, +1, +1.
    #[test]
    fn a_moving_point_feels_the_mean_but_keeps_its_change_of_volume() {
        let effective_strain_rate = StrainRateSmoothing::at(1.0).of(&OWN, &MEAN, 0.3);
        let expected = [-2.0, 1.0, 1.0, 0.0, -1.0, -1.0].map(|part| SHARE * part);
        let found = [
            effective_strain_rate.xx,
            effective_strain_rate.yy,
            effective_strain_rate.zz,
            effective_strain_rate.xy,
            effective_strain_rate.xz,
            effective_strain_rate.yz,
        ];
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-15,
                "{effective_strain_rate:?}"
            );
        }
    }

    #[test]
    fn a_point_that_hardly_moves_is_left_alone() {
        let effective_strain_rate = StrainRateSmoothing::at(1.0).of(&OWN, &MEAN, 0.02);
        assert!(
            (effective_strain_rate.xz + SHARE * 0.01).abs() < 1e-15,
            "{effective_strain_rate:?}"
        );
        assert_eq!(StrainRateSmoothing::at(1.0).of(&OWN, &MEAN, 0.0).xz, 0.0);
        assert_eq!(StrainRateSmoothing::NONE.of(&OWN, &MEAN, 1.0).xz, 0.0);
    }
}
