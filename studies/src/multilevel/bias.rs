//! Bias of the finest level.

use super::levels::Levels;
use super::{MultilevelError, above};
use crate::{CONFIDENCE, normal};
use serde::{Deserialize, Serialize};

/// Weak convergence of the levels: the expectation's error falls as (cell size)^order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeakConvergence {
    /// Factor by which the error falls from a level to the next, less one: s^α − 1.
    gain: f64,
}

/// Bias of the finest level against the limit of fine levels.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = LevelBias))]
pub struct Bias {
    /// Estimate of limit minus finest level.
    pub estimate: f64,
    /// Bound of its size, the sampling error of the finest difference included.
    pub bound: f64,
}

impl WeakConvergence {
    /// Convergence with an order in the cell size, over levels whose cell size falls by a ratio.
    ///
    /// # Errors
    /// A ratio of at most 1, or an order that is not positive.
    pub fn new(refinement: f64, order: f64) -> Result<Self, MultilevelError> {
        above(1.0, "refinement", refinement, "x > 1")?;
        above(0.0, "order", order, "x > 0")?;
        Ok(Self {
            gain: libm::pow(refinement, order) - 1.0,
        })
    }
}

impl Bias {
    /// True if the bound is within the half of the mean square error that an allocation for the
    /// target leaves to the bias; otherwise it takes a finer level.
    pub fn is_within(&self, target: f64) -> bool {
        self.bound * self.bound <= 0.5 * target * target
    }
}

impl Levels {
    /// Bias of the finest level, by Richardson extrapolation: the mean difference of the finest
    /// pairs over s^α − 1 (Giles 2015, section 3.2). The order is assumed, not tested.
    pub fn bias(&self, convergence: &WeakConvergence) -> Bias {
        let mean = self.mean();
        let finest = mean.levels[mean.levels.len() - 1];
        let z = normal::quantile(0.5 * (1.0 + CONFIDENCE));
        let error = z * finest.variance_of_mean().sqrt();
        Bias {
            estimate: finest.mean / convergence.gain,
            bound: (finest.mean.abs() + error) / convergence.gain,
        }
    }
}
