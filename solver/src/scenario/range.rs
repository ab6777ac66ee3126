//! Ranges of numbers, and their wording.

/// Allowed values of a number field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rule {
    /// Key of the field.
    pub(super) key: &'static str,
    /// Values allowed.
    pub(super) range: Range,
    /// Unit, if it has one.
    pub(super) unit: Option<&'static str>,
    /// Value if the field is not given; `None`: required, automatic, or
    /// depending on other fields.
    pub(super) default: Option<f64>,
}

/// An interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Range {
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) low_is_open: bool,
}

/// low <= x <= high.
pub(super) const fn closed(low: f64, high: f64) -> Range {
    Range {
        low,
        high,
        low_is_open: false,
    }
}

/// 0 < x <= high.
pub(super) const fn positive_up_to(high: f64) -> Range {
    Range {
        low: 0.0,
        high,
        low_is_open: true,
    }
}

impl Range {
    /// True if a value lies inside; NaN never does.
    pub(super) fn contains(&self, value: f64) -> bool {
        let above = if self.low_is_open {
            value > self.low
        } else {
            value >= self.low
        };
        above && value <= self.high
    }

    /// The range in words: "0 < x <= 89".
    pub(super) fn words(&self) -> String {
        let sign = if self.low_is_open { "<" } else { "<=" };
        format!("{} {sign} x <= {}", short(self.low), short(self.high))
    }
}

impl Rule {
    pub(super) const fn new(key: &'static str, range: Range) -> Self {
        Self {
            key,
            range,
            unit: None,
            default: None,
        }
    }

    pub(super) const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = Some(unit);
        self
    }

    pub(super) const fn default(mut self, default: f64) -> Self {
        self.default = Some(default);
        self
    }
}

/// A number as people write it: very large and very small ones with an exponent.
pub(super) fn short(value: f64) -> String {
    if value == 0.0 || (1e-4..1e6).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Six significant digits, rounded towards minus infinity, so that a bound in a message still
/// holds when it is typed in.
pub(super) fn rounded_down(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let digits = 5.0 - value.abs().log10().floor();
    let scale = 10_f64.powf(digits);
    (value * scale).floor() / scale
}

/// Six significant digits, rounded towards plus infinity.
pub(super) fn rounded_up(value: f64) -> f64 {
    -rounded_down(-value)
}
