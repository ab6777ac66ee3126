//! Numbers and texts for people.

/// Longest title shown; a longer one is cut with an ellipsis.
const TITLE_CHARS: usize = 90;

/// A number with `digits` significant digits and without an exponent.
pub(super) fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor() as i32;
    let decimals = (digits as i32 - 1 - magnitude).clamp(0, 9) as usize;
    format!("{value:.decimals$}")
}

/// A number with three significant digits at most and no trailing zeros.
pub(super) fn plain(value: f64) -> String {
    let text = significant(value, 3);
    if !text.contains('.') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A number at a tick of an axis of this length, free of rounding errors: 0, not −1e-17.
pub(super) fn tick(value: f64, length: f64) -> String {
    let finest = length * 1e-6;
    // No minus sign before a zero.
    plain((value / finest).round() * finest + 0.0).replace('-', "−")
}

/// A title that is valid in XML: control characters, which XML 1.0 can't
/// represent, become spaces; blank titles become `fallback`.
pub(super) fn title(text: &str, fallback: &str) -> String {
    let legal = |c: char| if is_xml_char(c) { c } else { ' ' };
    let clean: String = text.chars().map(legal).collect();
    let clean = clean.split_whitespace().collect::<Vec<_>>().join(" ");
    if clean.is_empty() {
        return fallback.to_owned();
    }
    if clean.chars().count() <= TITLE_CHARS {
        return clean;
    }
    let head: String = clean.chars().take(TITLE_CHARS - 1).collect();
    format!("{}…", head.trim_end())
}

fn is_xml_char(c: char) -> bool {
    !c.is_control() && c != '\u{fffe}' && c != '\u{ffff}'
}

/// The smallest round number (1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten) that is not below
/// `value`; 1 if `value` is not a positive number.
pub(super) fn round_up(value: f64) -> f64 {
    if !value.is_finite() || value <= 0.0 {
        return 1.0;
    }
    let decade = 10_f64.powf(value.log10().floor());
    // Tolerance for rounding: 0.3 / 0.1 must not count as more than 3.
    let fits = |step: &f64| step * decade >= value * (1.0 - 1e-12);
    let steps = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];
    steps.into_iter().find(fits).unwrap_or(10.0) * decade
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(significant(0.17046, 3), "0.170");
        assert_eq!(significant(1.0796, 3), "1.08");
        assert_eq!(significant(1234.5, 3), "1234");
        assert_eq!(significant(f64::NAN, 3), "0");
        assert_eq!(plain(2.50), "2.5");
        assert_eq!(plain(100.0), "100");
        assert_eq!(plain(0.0), "0");
    }

    #[test]
    fn ticks_are_free_of_rounding_errors() {
        assert_eq!(tick(-2.7e-17, 0.2), "0");
        assert_eq!(tick(0.1 * 3.0, 0.5), "0.3");
        assert_eq!(tick(-0.05, 0.2), "−0.05");
    }

    /// Three times 0.1 is slightly more than 0.3, and must not become 0.4.
    #[test]
    fn axis_ends_are_the_next_round_number() {
        let cases = [
            (0.1 * 3.0, 0.3),
            (1.08, 1.5),
            (1.0, 1.0),
            (8.1, 10.0),
            (0.0234, 0.025),
        ];
        for (value, end) in cases {
            let got = round_up(value);
            assert!((got / end - 1.0).abs() < 1e-9, "{value}: {got}, not {end}");
        }
        assert_eq!(round_up(0.0), 1.0);
        assert_eq!(round_up(f64::NAN), 1.0);
    }

    #[test]
    fn titles_are_cleaned_and_cut() {
        assert_eq!(title(" a\u{0}b \n c\u{ffff}", "none"), "a b c");
        assert_eq!(title(" \t", "none"), "none");
        let cut = title(&"ä".repeat(500), "none");
        assert_eq!(cut.chars().count(), TITLE_CHARS);
        assert!(cut.ends_with('…'));
    }
}
