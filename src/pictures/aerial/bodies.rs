//! Bodies as seen from above.

use super::stroke;
use crate::pictures::canvas::{Area, INK, PictureError, px};
use crate::pictures::labels::Point;
use crate::pictures::outline;
use crate::pictures::style::{Style, Styles};
use plotters::prelude::*;
use scree_solver::record::BodySample;
use scree_solver::shape::SpheroPolyhedron;

/// A body at one instant, on the sheet.
#[derive(Debug)]
pub(in crate::pictures) struct SeenBody {
    pub index: usize,
    pub style: Style,
    pub outline: Vec<Point>,
}

/// The bodies, the lowest first: those above hide it.
pub(in crate::pictures) fn from_above(
    shapes: &[SpheroPolyhedron],
    states: &[BodySample],
    styles: &Styles,
    on_sheet: impl Fn(f64, f64) -> Point,
) -> Vec<SeenBody> {
    let mut order: Vec<usize> = (0..shapes.len().min(states.len())).collect();
    let elevation = |body: &usize| states[*body].position_m[2];
    order.sort_by(|a, b| elevation(a).total_cmp(&elevation(b)));
    let seen = |index: usize| SeenBody {
        index,
        style: styles.of_body(index),
        outline: outline::from_above(&shapes[index], &states[index])
            .into_iter()
            .map(|[x, y]| on_sheet(x, y))
            .collect(),
    };
    order.into_iter().map(seen).collect()
}

impl SeenBody {
    pub(in crate::pictures) fn draw(&self, sheet: &Area<'_>) -> Result<(), PictureError> {
        let mut path: Vec<_> = self.outline.iter().map(|(x, y)| (px(*x), px(*y))).collect();
        sheet.draw(&Polygon::new(path.clone(), self.style.color.filled()))?;
        path.extend(path.first().copied());
        if self.style.is_double() {
            let edge = WHITE.stroke_width(stroke(2.6));
            sheet.draw(&PathElement::new(path.clone(), edge))?;
        }
        sheet.draw(&PathElement::new(path, INK.stroke_width(stroke(0.8))))?;
        Ok(())
    }
}

/// Draws the path of a body's centre, with a white edge to be visible on any colour.
pub(in crate::pictures) fn draw_trail(
    sheet: &Area<'_>,
    trail: &[Point],
    style: Style,
) -> Result<(), PictureError> {
    if trail.len() < 2 {
        return Ok(());
    }
    let path: Vec<_> = trail.iter().map(|(x, y)| (px(*x), px(*y))).collect();
    for (width, color) in [(3.0, WHITE), (1.5, style.color)] {
        let line = color.stroke_width(stroke(width));
        sheet.draw(&PathElement::new(path.clone(), line))?;
    }
    Ok(())
}
