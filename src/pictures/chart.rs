//! Curves over linear or logarithmic axes, as SVG.

use super::canvas::{
    Area, FAINT_INK, HAIRLINE, INK, PictureError, bold, paint, px, text, width as stroke,
};
use super::format::{plain, round_up, title};
use super::palette::body_color;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Size of the picture [px].
const SIZE: (f64, f64) = (640.0, 398.0);
/// Edges of the field of the curves [px].
const FIELD: Field = Field {
    left: 74.0,
    right: 620.0,
    top: 96.0,
    bottom: 346.0,
};

struct Field {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

/// Curves that share two axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// Conditions of the data.
    pub subtitle: String,
    /// Axis along the lower edge.
    pub x: Axis,
    /// Axis along the left edge.
    pub y: Axis,
    /// Curves; colours distinguish at most six.
    pub curves: Vec<Curve>,
}

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Quantity and unit.
    pub title: String,
    /// Scale of its values.
    pub scale: Scale,
}

/// Scale of values on an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Linear, from zero.
    Linear,
    /// Logarithmic; values must be positive.
    Logarithmic,
}

/// Points joined by a line, each with a dot.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Name in the legend.
    pub name: String,
    /// Points (x, y), in the order in which they are joined.
    pub points: Vec<(f64, f64)>,
}

/// An axis with its ends, in the units of its scale (logarithms if logarithmic).
struct Span {
    scale: Scale,
    low: f64,
    high: f64,
}

impl Span {
    fn of(scale: Scale, values: impl Iterator<Item = f64> + Clone) -> Self {
        let fits = |v: &f64| v.is_finite() && (scale == Scale::Linear || *v > 0.0);
        let values = values.filter(fits);
        let high = values.clone().fold(f64::NEG_INFINITY, f64::max);
        let low = values.fold(f64::INFINITY, f64::min);
        match scale {
            Scale::Linear => Self {
                scale,
                low: 0.0,
                high: round_up(high),
            },
            Scale::Logarithmic if high >= low => Self {
                scale,
                low: (low.log10() - 0.08).min(high.log10() - 0.3),
                high: high.log10() + 0.08,
            },
            Scale::Logarithmic => Self {
                scale,
                low: 0.0,
                high: 1.0,
            },
        }
    }

    /// Position of a value along the axis, from 0 to 1.
    fn share(&self, value: f64) -> f64 {
        let even = match self.scale {
            Scale::Linear => value,
            Scale::Logarithmic => value.log10(),
        };
        (even - self.low) / (self.high - self.low)
    }

    /// Values that get a tick.
    fn ticks(&self) -> Vec<f64> {
        match self.scale {
            Scale::Linear => {
                let step = round_up((self.high - self.low) / 6.0);
                let count = ((self.high - self.low) / step + 1e-9).floor() as u32;
                (0..=count)
                    .map(|n| self.low + f64::from(n) * step)
                    .collect()
            }
            Scale::Logarithmic => self.logarithmic_ticks(),
        }
    }

    /// Powers of ten; with fewer than three in range also twice and five times
    /// these.
    fn logarithmic_ticks(&self) -> Vec<f64> {
        let decades = (self.low.floor() as i32)..=(self.high.ceil() as i32);
        let inside = |value: &f64| (0.0..=1.0).contains(&self.share(*value));
        let of = |steps: &[f64]| -> Vec<f64> {
            let all = decades.clone().flat_map(|decade| {
                let unit = 10f64.powi(decade);
                steps
                    .iter()
                    .map(move |step| step * unit)
                    .collect::<Vec<_>>()
            });
            all.filter(inside).collect()
        };
        let powers = of(&[1.0]);
        if powers.len() < 3 {
            of(&[1.0, 2.0, 5.0])
        } else {
            powers
        }
    }
}

impl Chart {
    /// Draws the chart as an SVG document.
    ///
    /// # Errors
    /// The drawing library fails.
    pub fn draw(&self) -> Result<String, PictureError> {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let x = Span::of(self.x.scale, points().map(|point| point.0));
        let y = Span::of(self.y.scale, points().map(|point| point.1));
        paint(SIZE, |sheet| {
            let headline = title(&self.title, "Untitled");
            sheet.draw_text(&headline, &bold(15.0, &INK), (px(16.0), px(12.0)))?;
            let subtitle = title(&self.subtitle, " ");
            sheet.draw_text(&subtitle, &text(12.0, &FAINT_INK), (px(16.0), px(33.0)))?;
            self.draw_x_axis(sheet, &x)?;
            self.draw_y_axis(sheet, &y)?;
            for (place, curve) in self.curves.iter().enumerate() {
                draw_curve(sheet, curve, body_color(place), (&x, &y))?;
            }
            self.draw_legend(sheet)
        })
    }

    fn draw_x_axis(&self, sheet: &Area<'_>, span: &Span) -> Result<(), PictureError> {
        let below = Pos::new(HPos::Center, VPos::Top);
        for tick in span.ticks() {
            let at = across(span.share(tick));
            line(sheet, (at, FIELD.top), (at, FIELD.bottom), &HAIRLINE)?;
            let style = text(11.0, &INK).pos(below);
            sheet.draw_text(&number(tick), &style, (px(at), px(FIELD.bottom + 6.0)))?;
        }
        let (left, right) = ((FIELD.left, FIELD.bottom), (FIELD.right, FIELD.bottom));
        line(sheet, left, right, &INK)?;
        let middle = 0.5 * (FIELD.left + FIELD.right);
        let style = text(12.0, &INK).pos(below);
        sheet.draw_text(&self.x.title, &style, (px(middle), px(FIELD.bottom + 26.0)))?;
        Ok(())
    }

    fn draw_y_axis(&self, sheet: &Area<'_>, span: &Span) -> Result<(), PictureError> {
        for tick in span.ticks() {
            let at = up(span.share(tick));
            line(sheet, (FIELD.left, at), (FIELD.right, at), &HAIRLINE)?;
            let style = text(11.0, &INK).pos(Pos::new(HPos::Right, VPos::Center));
            sheet.draw_text(&number(tick), &style, (px(FIELD.left - 6.0), px(at)))?;
        }
        let (low, high) = ((FIELD.left, FIELD.bottom), (FIELD.left, FIELD.top));
        line(sheet, low, high, &INK)?;
        let style = text(12.0, &INK).pos(Pos::new(HPos::Left, VPos::Bottom));
        sheet.draw_text(&self.y.title, &style, (px(16.0), px(FIELD.top - 8.0)))?;
        Ok(())
    }

    fn draw_legend(&self, sheet: &Area<'_>) -> Result<(), PictureError> {
        let mut at = FIELD.right;
        for (place, curve) in self.curves.iter().enumerate().rev() {
            // Estimated width of the text: a letter is about half as wide as its size.
            at -= 6.2 * curve.name.chars().count() as f64 + 22.0;
            let dot = (px(at), px(FIELD.top - 34.0));
            sheet.draw(&Circle::new(dot, stroke(4.0), body_color(place).filled()))?;
            let style = text(11.5, &INK).pos(Pos::new(HPos::Left, VPos::Center));
            sheet.draw_text(&curve.name, &style, (px(at + 8.0), px(FIELD.top - 34.0)))?;
        }
        Ok(())
    }
}

fn across(share: f64) -> f64 {
    FIELD.left + share * (FIELD.right - FIELD.left)
}

fn up(share: f64) -> f64 {
    FIELD.bottom - share * (FIELD.bottom - FIELD.top)
}

fn line(
    sheet: &Area<'_>,
    from: (f64, f64),
    to: (f64, f64),
    color: &RGBColor,
) -> Result<(), PictureError> {
    let ends = [(px(from.0), px(from.1)), (px(to.0), px(to.1))];
    sheet.draw(&PathElement::new(ends, color.stroke_width(stroke(0.9))))?;
    Ok(())
}

fn draw_curve(
    sheet: &Area<'_>,
    curve: &Curve,
    color: RGBColor,
    (x, y): (&Span, &Span),
) -> Result<(), PictureError> {
    let inside = |share: f64| (-1e-9..=1.0 + 1e-9).contains(&share);
    let places: Vec<_> = curve
        .points
        .iter()
        .map(|point| (x.share(point.0), y.share(point.1)))
        .filter(|(x, y)| inside(*x) && inside(*y))
        .map(|(x, y)| (px(across(x)), px(up(y))))
        .collect();
    let path = PathElement::new(places.clone(), color.stroke_width(stroke(1.8)));
    sheet.draw(&path)?;
    for place in places {
        sheet.draw(&Circle::new(place, stroke(3.4), color.filled()))?;
    }
    Ok(())
}

/// A number at a tick: plain if that is short.
fn number(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e4).contains(&value.abs()) {
        format!("{value:.0e}")
    } else {
        plain(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(scale: Scale, points: Vec<(f64, f64)>) -> Chart {
        let axis = |title: &str| Axis {
            title: title.to_owned(),
            scale,
        };
        Chart {
            title: "Speed & size".to_owned(),
            subtitle: "somewhere".to_owned(),
            x: axis("points"),
            y: axis("rate"),
            curves: vec![Curve {
                name: "one".to_owned(),
                points,
            }],
        }
    }

    #[test]
    fn ticks_are_round_and_inside() {
        let span = Span::of(Scale::Linear, [3.0, 23.0].into_iter());
        assert_eq!(span.ticks(), [0.0, 5.0, 10.0, 15.0, 20.0, 25.0]);
        let span = Span::of(Scale::Logarithmic, [1e4, 5e6].into_iter());
        assert_eq!(span.ticks(), [1e4, 1e5, 1e6]);
        let span = Span::of(Scale::Logarithmic, [10.0, 60.0].into_iter());
        assert_eq!(span.ticks(), [10.0, 20.0, 50.0]);
    }

    #[test]
    fn every_point_gets_a_dot_within_the_field() {
        for scale in [Scale::Linear, Scale::Logarithmic] {
            let svg = chart(scale, vec![(1.0, 2.0), (30.0, 5.0), (200.0, 7.0)]);
            let svg = svg.draw().expect("it is drawn");
            let document = roxmltree::Document::parse(&svg).expect("it is XML");
            let dots: Vec<_> = document
                .descendants()
                .filter(|node| node.has_tag_name("circle"))
                .collect();
            // Three on the curve, one in the legend.
            assert_eq!(dots.len(), 4);
            for dot in dots {
                let x: f64 = dot
                    .attribute("cx")
                    .and_then(|x| x.parse().ok())
                    .expect("a number");
                let field = 4.0 * FIELD.left..=4.0 * FIELD.right;
                assert!(field.contains(&x), "{x}");
            }
        }
    }

    #[test]
    fn nothing_to_show_is_no_error() {
        for scale in [Scale::Linear, Scale::Logarithmic] {
            assert!(chart(scale, Vec::new()).draw().is_ok());
            assert!(chart(scale, vec![(1.0, 1.0)]).draw().is_ok());
            assert!(chart(scale, vec![(0.0, f64::NAN)]).draw().is_ok());
        }
    }
}
