//! Layout of the panels of the aerial view.

use super::instants::Instant;
use super::panel::Scene;
use crate::pictures::labels::{Extent, Point};
use std::ops::Range;

/// Width of the picture [px].
pub(super) const WIDTH: f64 = 840.0;
/// Left of the first column: axis title and numbers [px].
pub(super) const LEFT: f64 = 62.0;
/// Right of the last column [px].
pub(super) const RIGHT: f64 = 20.0;
/// Above the first row [px].
const HEADER: f64 = 70.0;
/// Line above each strip with its time [px].
pub(super) const CAPTION: f64 = 17.0;
/// Below each strip [px].
const ROW_GAP: f64 = 9.0;
/// Between columns [px].
const COLUMN_GAP: f64 = 16.0;
/// Numbers and title of the x axis below the last row [px].
pub(super) const AXIS: f64 = 40.0;
/// Most that all rows together may take [px]; the same where bodies would else be too small for
/// their numbers.
const ROWS_LIMIT: f64 = 800.0;
const TALL_ROWS_LIMIT: f64 = 1300.0;
/// Width of a body that holds its number [px].
const NUMBERED_BODY: f64 = 12.0;

/// Panels in rows and columns, all showing the same part of the channel.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Layout {
    /// Part of the channel shown, along it [m].
    pub x: Range<f64>,
    /// The same across it [m].
    pub y: Range<f64>,
    /// Scale of both axes [px/m].
    pub px_per_m: f64,
    /// Panels side by side.
    columns: usize,
    panels: usize,
}

impl Layout {
    /// The smallest number of columns for which the picture is not too tall, unless fewer are
    /// needed for legible numbers.
    pub(super) fn of(scene: &Scene<'_>, instants: &[Instant<'_>]) -> Self {
        let panels = instants.len();
        let [_, across] = scene.scenario.extents();
        let beyond = 0.02 * (across.end - across.start);
        let mut layout = Self {
            x: scene.extent(instants),
            y: across.start - beyond..across.end + beyond,
            px_per_m: 1.0,
            columns: 1,
            panels,
        };
        for columns in 1..=panels.clamp(1, 3) {
            layout.columns = columns;
            let gaps = COLUMN_GAP * (columns - 1) as f64;
            let strip = (WIDTH - LEFT - RIGHT - gaps) / columns as f64;
            layout.px_per_m = strip / length(&layout.x);
            let body_px = |px_per_m: f64| scene.narrowest_numbered_m().map(|m| m * px_per_m);
            let fits = |width_px: f64| width_px >= NUMBERED_BODY;
            let next = layout.px_per_m * columns as f64 / (columns + 1) as f64;
            let limit = match (body_px(layout.px_per_m), body_px(next)) {
                (Some(here), Some(next)) if fits(here) && !fits(next) => TALL_ROWS_LIMIT,
                _ => ROWS_LIMIT,
            };
            if layout.rows_height() <= limit {
                return layout;
            }
        }
        let rows = layout.rows() as f64;
        let tallest = ROWS_LIMIT / rows - CAPTION - ROW_GAP;
        layout.px_per_m = tallest / length(&layout.y);
        layout
    }

    /// Size of one strip [px].
    pub(super) fn strip(&self) -> (f64, f64) {
        let scale = self.px_per_m;
        (length(&self.x) * scale, length(&self.y) * scale)
    }

    /// Upper left corner of a strip [px].
    pub(super) fn corner(&self, panel: usize) -> (f64, f64) {
        let (width, height) = self.strip();
        let (row, column) = (panel / self.columns, panel % self.columns);
        let x = LEFT + (width + COLUMN_GAP) * column as f64;
        let y = HEADER + CAPTION + (CAPTION + height + ROW_GAP) * row as f64;
        (x, y)
    }

    /// Extent of a strip.
    pub(super) fn field(&self, panel: usize) -> Extent {
        let ((left, top), (width, height)) = (self.corner(panel), self.strip());
        Extent {
            left,
            top,
            right: left + width,
            bottom: top + height,
        }
    }

    /// Place on the sheet of a point (x, y) [m] of a strip.
    pub(super) fn on_sheet(&self, panel: usize, (x, y): (f64, f64)) -> Point {
        let field = self.field(panel);
        (
            field.left + (x - self.x.start) * self.px_per_m,
            field.bottom - (y - self.y.start) * self.px_per_m,
        )
    }

    /// True if the panel has the y axis' numbers on its left.
    pub(super) fn is_first_of_row(&self, panel: usize) -> bool {
        panel.is_multiple_of(self.columns)
    }

    /// True if the panel has the x axis' numbers below it, as no panel follows there.
    pub(super) fn is_last_of_column(&self, panel: usize) -> bool {
        panel + self.columns >= self.panels
    }

    /// Height of the picture [px].
    pub(super) fn height(&self) -> f64 {
        HEADER + self.rows_height() + AXIS
    }

    /// Left and right edge of all strips [px].
    pub(super) fn horizontal_extent(&self) -> (f64, f64) {
        let last = self.corner(self.columns - 1).0 + self.strip().0;
        (LEFT, last)
    }

    /// Top and bottom of all strips [px].
    pub(super) fn vertical_extent(&self) -> (f64, f64) {
        (HEADER + CAPTION, HEADER + self.rows_height() - ROW_GAP)
    }

    fn rows(&self) -> usize {
        self.panels.div_ceil(self.columns).max(1)
    }

    fn rows_height(&self) -> f64 {
        self.rows() as f64 * (CAPTION + self.strip().1 + ROW_GAP)
    }
}

fn length(range: &Range<f64>) -> f64 {
    range.end - range.start
}
