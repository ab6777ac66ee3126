//! Labels, and places for them that nothing else crosses.

mod badge;
mod extent;
mod grid;
mod leader;

pub(super) use badge::{Badge, RADIUS, draw_number};
pub(super) use extent::{Extent, Point};
pub(super) use grid::{Cell, Grid};
pub(super) use leader::Leader;

/// Width of a text [px], estimated for a wide and bold font.
pub(super) fn text_width(text: &str, size_px: f64) -> f64 {
    0.7 * size_px * text.chars().count() as f64
}
