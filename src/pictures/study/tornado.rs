//! Tornado diagram: how much of a quantity's variation each input accounts for, the largest on top.

use super::frame::{Frame, head, line};
use crate::pictures::canvas::{
    Area, FAINT_INK, INK, PictureError, paint, px, text, width as stroke,
};
use crate::pictures::palette::body_color;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use scree_studies::answers::{Estimate, Measures, Moment};

/// Width of the picture [px].
const WIDTH: f64 = 720.0;
/// Names of the inputs [px].
const LEFT: f64 = 250.0;
const RIGHT: f64 = 30.0;
/// Above and below the bars [px].
const HEADER: f64 = 78.0;
const FOOTER: f64 = 48.0;
/// Height of an input's row [px].
const ROW: f64 = 34.0;

/// A bar with its uncertainty.
#[derive(Debug, Clone, Copy)]
struct Bar {
    value: f64,
    lower: f64,
    upper: f64,
}

/// Bars of an input: one, or two that share its row.
struct Row<'a> {
    name: &'a str,
    bars: Vec<Bar>,
}

/// Names of the bars of each row, and the title of the axis.
type Legend = (&'static [&'static str], String);

/// Bars of sensitivity with their uncertainty, an input in each row.
///
/// # Errors
/// The drawing library fails.
pub fn tornado(
    (name, quantity): (&str, &str),
    inputs: &[&str],
    measures: &Measures,
) -> Result<String, PictureError> {
    let (mut rows, (names, axis)) = rows(inputs, measures, quantity);
    let size = |row: &Row| row.bars.last().map_or(0.0, |bar| bar.value);
    rows.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let ends = rows.iter().flat_map(|row| &row.bars).map(|bar| bar.upper);
    let most = ends.fold(0.0, f64::max);
    let frame = Frame {
        left: LEFT,
        top: HEADER,
        width: WIDTH - LEFT - RIGHT,
        height: ROW * rows.len() as f64,
        x: 0.0..1.05 * if most > 0.0 { most } else { 1.0 },
        y: 0.0..rows.len() as f64,
    };
    paint((WIDTH, HEADER + frame.height + FOOTER), |sheet| {
        head(sheet, name, &format!("What {quantity} depends on"))?;
        draw_legend(sheet, names)?;
        frame.draw(sheet, (6, 0))?;
        for (place, row) in rows.iter().enumerate() {
            draw_row(sheet, &frame, place, row)?;
        }
        frame.numbers_below(sheet, 6)?;
        let style = text(12.0, &INK).pos(Pos::new(HPos::Center, VPos::Bottom));
        let middle = LEFT + 0.5 * frame.width;
        let bottom = HEADER + frame.height + FOOTER - 6.0;
        sheet.draw_text(&axis, &style, (px(middle), px(bottom)))?;
        Ok(())
    })
}

fn rows<'a>(inputs: &[&'a str], measures: &Measures, quantity: &str) -> (Vec<Row<'a>>, Legend) {
    let named = |bars: Vec<Vec<Bar>>| {
        let rows = inputs.iter().zip(bars);
        rows.map(|(name, bars)| Row { name, bars }).collect()
    };
    let share = "share of the variance".to_owned();
    match measures {
        Measures::Sobol(indices) => {
            let bars = indices.inputs.iter();
            let bars = bars.map(|index| vec![of(&index.first_order), of(&index.total)]);
            let names = &["first order: alone", "total: with all interactions"];
            (named(bars.collect()), (names, share))
        }
        Measures::FirstOrder(indices) => {
            let bars = indices
                .inputs
                .iter()
                .map(|index| vec![of(&index.first_order)]);
            (named(bars.collect()), (&["first order: alone"], share))
        }
        Measures::Elementary(effects) => {
            let bars = effects.inputs.iter();
            let bars =
                bars.map(|effect| vec![within(&effect.deviation), within(&effect.mean_size)]);
            let names = &[
                "σ: interactions and curvature",
                "μ*: mean size of the effect",
            ];
            (
                named(bars.collect()),
                (names, format!("change of {quantity}")),
            )
        }
    }
}

fn of(estimate: &Estimate) -> Bar {
    Bar {
        value: estimate.value,
        lower: estimate.lower,
        upper: estimate.upper,
    }
}

fn within(moment: &Moment) -> Bar {
    Bar {
        value: moment.value,
        lower: moment.value - moment.standard_error,
        upper: moment.value + moment.standard_error,
    }
}

fn draw_row(sheet: &Area<'_>, frame: &Frame, place: usize, row: &Row) -> Result<(), PictureError> {
    let top = frame.top + ROW * place as f64;
    let thick = (ROW - 10.0) / row.bars.len() as f64;
    for (number, bar) in row.bars.iter().enumerate() {
        let top = top + 5.0 + thick * number as f64;
        let (from, _) = frame.at(0.0, 0.0);
        let (to, _) = frame.at(bar.value.max(0.0), 0.0);
        let corners = [(px(from), px(top)), (px(to), px(top + thick - 1.5))];
        sheet.draw(&Rectangle::new(
            corners,
            body_color(number + 1).mix(0.75).filled(),
        ))?;
        let middle = top + 0.5 * (thick - 1.5);
        let end = |value: f64| (frame.at(value.max(0.0), 0.0).0, middle);
        line(sheet, (end(bar.lower), end(bar.upper)), (&INK, 1.2))?;
    }
    let style = text(11.5, &INK).pos(Pos::new(HPos::Right, VPos::Center));
    let at = (px(LEFT - 8.0), px(top + 0.5 * ROW));
    sheet.draw_text(row.name, &style, at)?;
    Ok(())
}

fn draw_legend(sheet: &Area<'_>, names: &[&str]) -> Result<(), PictureError> {
    let mut left = LEFT;
    for (number, name) in names.iter().enumerate() {
        let dot = (px(left), px(62.0));
        let color = body_color(number + 1).mix(0.75);
        sheet.draw(&Circle::new(dot, stroke(4.0), color.filled()))?;
        let style = text(11.5, &FAINT_INK).pos(Pos::new(HPos::Left, VPos::Center));
        sheet.draw_text(name, &style, (px(left + 9.0), px(62.0)))?;
        left += 40.0 + 6.2 * name.chars().count() as f64;
    }
    Ok(())
}
