//! Colours: one per body, and the scale of the flow's speed.

use super::format::round_up;
use plotters::prelude::*;
use scree_solver::record::FlowSnapshot;

/// Number of colours.
pub(super) const COLORS: usize = 6;

/// Colours of the bodies, apart from each other to all eyes, colour-blind ones too, and from the
/// speed scale's greens and yellow; visible on white, and each legible below a number in white or
/// ink.
const BODY_COLORS: [RGBColor; COLORS] = [
    RGBColor(200, 16, 16),
    RGBColor(0, 106, 140),
    RGBColor(188, 138, 0),
    RGBColor(156, 20, 195),
    RGBColor(62, 50, 75),
    RGBColor(66, 147, 255),
];

/// Share of the values that the scale must cover: a few fast points must not darken all others.
const COVERED_SHARE: f64 = 0.995;

/// Colour of the body or curve at this place; those after the last begin again.
pub(super) fn body_color(place: usize) -> RGBColor {
    BODY_COLORS[place % COLORS]
}

/// Contrast of two colours, from 1 to 21, as WCAG 2 defines it.
pub(super) fn contrast(a: RGBColor, b: RGBColor) -> f64 {
    let luminance = |color| {
        let [r, g, b] = linear(color);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

/// Linear red, green and blue of an sRGB colour.
fn linear(color: RGBColor) -> [f64; 3] {
    [color.0, color.1, color.2].map(|channel| {
        let channel = f64::from(channel) / 255.0;
        if channel <= 0.040_45 {
            channel / 12.92
        } else {
            ((channel + 0.055) / 1.055).powf(2.4)
        }
    })
}

/// Quantity of the flow as a colour: viridis, which grows evenly in lightness and
/// survives grey print and colour blindness, from 0 to a round number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ColorScale {
    /// Upper end.
    pub top: f64,
    /// True if some values are larger than that and share its colour.
    pub exceeded: bool,
}

impl ColorScale {
    /// The scale for all these snapshots together: speeds [m/s].
    pub(super) fn covering(snapshots: &[&FlowSnapshot]) -> Self {
        let speeds = snapshots.iter().flat_map(|s| &s.speed_m_s);
        let speeds: Vec<f64> = speeds.map(|speed| f64::from(*speed)).collect();
        Self::of(&speeds)
    }

    /// The scale for these values.
    pub(super) fn of(values: &[f64]) -> Self {
        let finite = values.iter().copied().filter(|value| value.is_finite());
        let mut values: Vec<f64> = finite.collect();
        values.sort_by(f64::total_cmp);
        let covered = ((values.len() as f64) * COVERED_SHARE) as usize;
        let covered = values.get(covered).or(values.last()).copied();
        let top = round_up(covered.unwrap_or(0.0));
        let largest = values.last().copied().unwrap_or(0.0);
        Self {
            top,
            exceeded: largest > top,
        }
    }

    /// Colour of this value.
    pub(super) fn color(&self, value: f64) -> RGBColor {
        ViridisRGB::get_color((value / self.top).clamp(0.0, 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pictures::canvas::INK;

    type Matrix = [[f64; 3]; 3];

    /// Normal sight, and the lack of one kind of cone (Machado, Oliveira and Fernandes 2009), on
    /// linear colours.
    const EYES: [(&str, Matrix); 4] = [
        (
            "all cones",
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        ),
        (
            "no long ones",
            [
                [0.152_286, 1.052_583, -0.204_868],
                [0.114_503, 0.786_281, 0.099_216],
                [-0.003_882, -0.048_116, 1.051_998],
            ],
        ),
        (
            "no middle ones",
            [
                [0.367_322, 0.860_646, -0.227_968],
                [0.280_085, 0.672_501, 0.047_413],
                [-0.011_820, 0.042_940, 0.968_881],
            ],
        ),
        (
            "no short ones",
            [
                [1.255_528, -0.076_749, -0.178_779],
                [-0.078_411, 0.930_809, 0.147_602],
                [0.004_733, 0.691_367, 0.303_900],
            ],
        ),
    ];

    fn times(matrix: Matrix, v: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    /// Coordinates in which distances are differences to the eye (Oklab, Ottosson 2020).
    fn perceived(linear: [f64; 3]) -> [f64; 3] {
        let cones = [
            [0.412_221_47, 0.536_332_54, 0.051_445_99],
            [0.211_903_50, 0.680_699_55, 0.107_396_96],
            [0.088_302_46, 0.281_718_84, 0.629_978_70],
        ];
        let axes = [
            [0.210_454_26, 0.793_617_79, -0.004_072_05],
            [1.977_998_50, -2.428_592_21, 0.450_593_71],
            [0.025_904_04, 0.782_771_77, -0.808_675_77],
        ];
        times(axes, times(cones, linear).map(f64::cbrt))
    }

    #[test]
    fn colors_differ_to_all_eyes() {
        for (eyes, matrix) in EYES {
            let seen = BODY_COLORS.map(|color| {
                perceived(times(matrix, linear(color)).map(|channel| channel.clamp(0.0, 1.0)))
            });
            for (index, a) in seen.iter().enumerate() {
                for b in &seen[index + 1..] {
                    let [x, y, z] = [0, 1, 2].map(|axis| a[axis] - b[axis]);
                    let difference = x.hypot(y).hypot(z);
                    assert!(difference > 0.085, "{eyes}, {index}: {difference}");
                }
            }
        }
    }

    /// The limits of WCAG 2.2 for graphics and for text.
    #[test]
    fn colors_are_visible_and_numbers_on_them_legible() {
        for color in BODY_COLORS {
            let on_white = contrast(color, WHITE);
            assert!(on_white >= 3.0, "{color:?}: {on_white}");
            let number = on_white.max(contrast(color, INK));
            assert!(number >= 4.5, "{color:?}: {number}");
        }
    }
}
