//! Meaning of a raster's values.

use std::ops::RangeInclusive;

/// Meaning of a raster's values, and so the range that they can have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Heights of the ground, −500 m to 9000 m, without holes and without steps between
    /// neighbours that no ground has.
    HeightMap,
    /// Heights of a surface surveyed before or after an event, −500 m to 9000 m; holes remain.
    Surface,
    /// Thickness of a release, 0 m to 1000 m; holes have none.
    Thickness,
    /// Coefficient of friction, 0 to 10, without holes.
    Friction,
    /// Results of a computation, any finite numbers; holes remain.
    Result,
}

/// Treatment of holes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Holes {
    /// They make the raster useless.
    Refused,
    /// They remain.
    Kept,
    /// They are the number zero.
    Zero,
}

impl Purpose {
    /// Name of a value's quantity.
    pub(crate) fn quantity(self) -> &'static str {
        match self {
            Self::HeightMap | Self::Surface => "height",
            Self::Thickness => "thickness",
            Self::Friction => "coefficient of friction",
            Self::Result => "value",
        }
    }

    /// Unit after a number, with the space before it.
    pub(crate) fn unit(self) -> &'static str {
        match self {
            Self::HeightMap | Self::Surface | Self::Thickness => " m",
            Self::Friction | Self::Result => "",
        }
    }

    /// Possible values.
    pub(crate) fn range(self) -> RangeInclusive<f64> {
        match self {
            Self::HeightMap | Self::Surface => -500.0..=9000.0,
            Self::Thickness => 0.0..=1000.0,
            Self::Friction => 0.0..=10.0,
            Self::Result => f64::MIN..=f64::MAX,
        }
    }

    /// Treatment of its holes.
    pub(crate) fn holes(self) -> Holes {
        match self {
            Self::HeightMap | Self::Friction => Holes::Refused,
            Self::Surface | Self::Result => Holes::Kept,
            Self::Thickness => Holes::Zero,
        }
    }
}
