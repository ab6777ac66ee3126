//! Table of the values of several bodies, above the panels.

use super::track::Track;
use crate::pictures::canvas::{Area, FAINT_INK, INK, PictureError, px, text};
use crate::pictures::format::significant;
use crate::pictures::labels::Badge;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use scree_solver::record::BodyOutcome;

/// Height of a line [px].
const LINE: f64 = 19.0;

/// Above the table [px].
const GAP: f64 = 8.0;

/// Titles of the columns, and their right edges [px].
const COLUMNS: [(&str, f64); 6] = [
    ("body", 62.0),
    ("onset [s]", 150.0),
    ("peak speed [m/s]", 290.0),
    ("at [s]", 370.0),
    ("at rest from [s]", 500.0),
    ("displacement [m]", 650.0),
];

/// Lines of the table: one per body with a colour of its own, and one for all others.
pub(super) struct Table<'a> {
    tracks: Vec<&'a Track<'a>>,
    grey: usize,
}

impl<'a> Table<'a> {
    /// The table; without lines if there is only one body, whose values are written at its
    /// curves.
    pub(super) fn of(tracks: &'a [Track<'a>]) -> Self {
        let several = tracks.len() > 1;
        let (grey, own): (Vec<_>, Vec<_>) = tracks
            .iter()
            .filter(|_| several)
            .partition(|track| track.style.is_grey());
        Self {
            tracks: own,
            grey: grey.len(),
        }
    }

    /// Height [px].
    pub(super) fn height(&self) -> f64 {
        if self.tracks.is_empty() {
            return 0.0;
        }
        let lines = 1 + self.tracks.len() + usize::from(self.grey > 0);
        GAP + LINE * lines as f64
    }

    /// Draws the table below this height [px].
    pub(super) fn draw(&self, sheet: &Area<'_>, top: f64) -> Result<(), PictureError> {
        if self.tracks.is_empty() {
            return Ok(());
        }
        let middle_of = |line: usize| top + GAP + LINE * (line as f64 + 0.5);
        let right = |size, ink| text(size, ink).pos(Pos::new(HPos::Right, VPos::Center));
        for (title, edge) in COLUMNS {
            let at = (px(edge), px(middle_of(0)));
            sheet.draw_text(title, &right(11.0, &FAINT_INK), at)?;
        }
        for (index, track) in self.tracks.iter().enumerate() {
            let middle = middle_of(index + 1);
            let centre = (COLUMNS[0].1 - 14.0, middle);
            let (body, style) = (track.body, track.style);
            Badge {
                body,
                style,
                centre,
            }
            .draw(sheet)?;
            let values = values(track.outcome);
            for (value, (_, edge)) in values.iter().zip(&COLUMNS[1..]) {
                sheet.draw_text(value, &right(11.5, &INK), (px(*edge), px(middle)))?;
            }
        }
        if self.grey > 0 {
            let line = format!("grey: {} bodies with less displacement", self.grey);
            let style = text(11.5, &FAINT_INK).pos(Pos::new(HPos::Left, VPos::Center));
            let at = (
                px(COLUMNS[0].1 - 22.0),
                px(middle_of(self.tracks.len() + 1)),
            );
            sheet.draw_text(&line, &style, at)?;
        }
        Ok(())
    }
}

/// Onset, peak, its time, rest and displacement.
fn values(outcome: Option<&BodyOutcome>) -> [String; 5] {
    let number = |value: f64| significant(value, 3);
    let or_dash = |value: Option<f64>| value.map_or("–".to_owned(), number);
    let Some(outcome) = outcome else {
        return [const { None }; 5].map(or_dash);
    };
    let moved = outcome.onset_time_s.is_some();
    let rest = match outcome.stop_time_s {
        Some(time_s) => number(time_s),
        None if moved => "still moving".to_owned(),
        None => "–".to_owned(),
    };
    [
        outcome
            .onset_time_s
            .map_or("did not move".to_owned(), number),
        or_dash(moved.then_some(outcome.peak_speed_m_s)),
        or_dash(outcome.peak_speed_time_s.filter(|_| moved)),
        rest,
        or_dash(moved.then_some(outcome.displacement_m)),
    ]
}
