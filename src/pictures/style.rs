//! Styles of the bodies, the same in all pictures of a run.

use super::canvas::INK;
use super::palette::{COLORS, body_color, contrast};
use plotters::style::{RGBColor, WHITE};
use scree_solver::record::Sample;
use scree_solver::scenario::Scenario;

/// Largest number of bodies that all have colours: each colour with a single and with a double
/// line.
const ALL_COLORED: usize = 2 * COLORS;

/// Colour of the other bodies.
const GREY: RGBColor = RGBColor(172, 177, 184);

/// Kind of a body's curve and outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Line {
    Single,
    Double,
    Grey,
}

/// Style of one body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Style {
    pub(super) color: RGBColor,
    line: Line,
}

impl Style {
    /// True if the body has a double line.
    pub(super) fn is_double(self) -> bool {
        self.line == Line::Double
    }

    /// True if the body shares its colour with all that are grey.
    pub(super) fn is_grey(self) -> bool {
        self.line == Line::Grey
    }

    /// Ink that is legible on the colour.
    pub(super) fn ink(self) -> RGBColor {
        if contrast(self.color, WHITE) > contrast(self.color, INK) {
            WHITE
        } else {
            INK
        }
    }
}

/// Styles of all bodies of a run. Fixed ones are grey; of too many others, only those few that end
/// up farthest from where they started have colours.
#[derive(Debug)]
pub(super) struct Styles {
    of_bodies: Vec<Style>,
    are_all_movers_colored: bool,
}

impl Styles {
    pub(super) fn of(scenario: &Scenario, samples: &[Sample]) -> Self {
        let bodies = 0..scenario.bodies.len();
        let mut movers: Vec<usize> = bodies.filter(|&b| !scenario.bodies[b].fixed).collect();
        let are_all_movers_colored = movers.len() <= ALL_COLORED;
        if !are_all_movers_colored {
            let way = |body: &usize| displacement(samples, *body);
            movers.sort_by(|a, b| way(b).total_cmp(&way(a)));
            movers.truncate(COLORS);
            movers.sort_unstable();
        }
        let grey = Style {
            color: GREY,
            line: Line::Grey,
        };
        let mut of_bodies = vec![grey; scenario.bodies.len()];
        for (place, body) in movers.into_iter().enumerate() {
            of_bodies[body] = Style {
                color: body_color(place),
                line: if place < COLORS {
                    Line::Single
                } else {
                    Line::Double
                },
            };
        }
        Self {
            of_bodies,
            are_all_movers_colored,
        }
    }

    /// Style of a body.
    pub(super) fn of_body(&self, body: usize) -> Style {
        self.of_bodies[body]
    }

    /// Meaning of grey, for the legend; none if no body is grey.
    pub(super) fn meaning_of_grey(&self) -> Option<&'static str> {
        let any = self.of_bodies.iter().any(|style| style.is_grey());
        let meaning = if self.are_all_movers_colored {
            "grey: fixed"
        } else {
            "grey: fixed, or with less displacement"
        };
        any.then_some(meaning)
    }

    /// True if bodies have numbers: one alone needs none.
    pub(super) fn are_numbered(&self) -> bool {
        self.of_bodies.len() > 1
    }
}

/// Net horizontal displacement of a body [m]; 0 if it is not known.
fn displacement(samples: &[Sample], body: usize) -> f64 {
    let at = |sample: Option<&Sample>| Some(sample?.bodies.get(body)?.position_m);
    let (Some(start), Some(end)) = (at(samples.first()), at(samples.last())) else {
        return 0.0;
    };
    let way = (end[0] - start[0]).hypot(end[1] - start[1]);
    if way.is_finite() { way } else { 0.0 }
}
