//! Track of one body in the motion picture.

use crate::pictures::format::significant;
use crate::pictures::style::{Style, Styles};
use scree_solver::record::{BodyOutcome, BodySample, Outcome, Sample};
use scree_solver::scenario::Scenario;

/// Largest number of points of a curve: more than two per pixel are not visible.
const CURVE_POINTS: usize = 2_000;

/// Quantity that a panel shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    /// Net horizontal displacement [m].
    Displacement,
    /// Speed of the centre [m/s].
    Speed,
    /// Share of the height below the surface of the flow.
    Submergence,
}

impl Quantity {
    /// Quantities of a scene that can be shown, from top to bottom.
    pub(super) fn of(scenario: &Scenario) -> Vec<Self> {
        let mut shown = vec![Self::Displacement, Self::Speed];
        if scenario.flow.is_some() {
            shown.push(Self::Submergence);
        }
        shown
    }

    /// Title of its axis, with the unit.
    pub(super) fn axis_title(self) -> &'static str {
        match self {
            Self::Displacement => "displacement [m]",
            Self::Speed => "speed [m/s]",
            Self::Submergence => "submerged share [–]",
        }
    }
}

/// A marked point of a curve.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Note {
    /// Time [s] and value.
    pub at: (f64, f64),
    /// Text of the mark.
    pub text: String,
}

/// One body's curves.
#[derive(Debug)]
pub(super) struct Track<'a> {
    pub body: usize,
    pub outcome: Option<&'a BodyOutcome>,
    displacement: Vec<(f64, f64)>,
    speed: Vec<(f64, f64)>,
    submergence: Vec<(f64, f64)>,
    pub style: Style,
}

/// The track of every body that is free to move.
pub(super) fn of_free_bodies<'a>(
    scenario: &Scenario,
    samples: &[Sample],
    outcome: &'a Outcome,
    styles: &Styles,
) -> Vec<Track<'a>> {
    let free = |&body: &usize| !scenario.bodies[body].fixed;
    (0..scenario.bodies.len())
        .filter(free)
        .map(|body| {
            let outcome = outcome.bodies.get(body);
            Track::new(body, samples, outcome, styles.of_body(body))
        })
        .collect()
}

impl<'a> Track<'a> {
    fn new(
        body: usize,
        samples: &[Sample],
        outcome: Option<&'a BodyOutcome>,
        style: Style,
    ) -> Self {
        let states = || {
            samples
                .iter()
                .filter_map(|s| Some((s.time_s, s.bodies.get(body)?)))
        };
        let start = states()
            .next()
            .map_or([0.0; 3], |(_, state)| state.position_m);
        let displacement = states().map(|(t, s)| (t, horizontal_distance(start, s)));
        Self {
            body,
            outcome,
            displacement: thinned(displacement.collect()),
            speed: thinned(states().map(|(t, s)| (t, speed(s))).collect()),
            submergence: thinned(states().map(|(t, s)| (t, s.submerged_fraction)).collect()),
            style,
        }
    }

    pub(super) fn curve(&self, quantity: Quantity) -> &[(f64, f64)] {
        match quantity {
            Quantity::Displacement => &self.displacement,
            Quantity::Speed => &self.speed,
            Quantity::Submergence => &self.submergence,
        }
    }

    /// Largest value of the curve and its marks.
    pub(super) fn largest(&self, quantity: Quantity) -> f64 {
        let marks = self.notes(quantity).into_iter().map(|note| note.at.1);
        let curve = self.curve(quantity).iter().map(|point| point.1);
        curve.chain(marks).fold(0.0, f64::max)
    }

    /// The marks of one panel.
    pub(super) fn notes(&self, quantity: Quantity) -> Vec<Note> {
        let Some(outcome) = self.outcome else {
            return Vec::new();
        };
        match quantity {
            Quantity::Displacement => self.displacement_notes(outcome),
            Quantity::Speed => self.speed_notes(outcome),
            Quantity::Submergence => Vec::new(),
        }
    }

    fn displacement_notes(&self, outcome: &BodyOutcome) -> Vec<Note> {
        let onset = outcome.onset_time_s.map(|time| Note {
            at: (time, interpolate(&self.displacement, time)),
            text: format!("onset {} s", significant(time, 3)),
        });
        let end = self.displacement.last().filter(|_| onset.is_some());
        let end = end.map(|&(time, value)| Note {
            at: (time, value),
            text: format!(
                "{} m from where it started",
                significant(outcome.displacement_m, 3)
            ),
        });
        onset.into_iter().chain(end).collect()
    }

    fn speed_notes(&self, outcome: &BodyOutcome) -> Vec<Note> {
        let peak = outcome.peak_speed_time_s.map(|time| Note {
            at: (time, outcome.peak_speed_m_s),
            text: format!(
                "peak {} m/s at {} s",
                significant(outcome.peak_speed_m_s, 3),
                significant(time, 3)
            ),
        });
        let rest = outcome.stop_time_s.map(|time| Note {
            at: (time, interpolate(&self.speed, time)),
            text: format!("at rest from {} s", significant(time, 3)),
        });
        peak.into_iter().chain(rest).collect()
    }
}

fn horizontal_distance(start: [f64; 3], state: &BodySample) -> f64 {
    (state.position_m[0] - start[0]).hypot(state.position_m[1] - start[1])
}

fn speed(state: &BodySample) -> f64 {
    let [x, y, z] = state.velocity_m_s;
    x.hypot(y).hypot(z)
}

/// Every n-th point and the last, without values that are not numbers.
fn thinned(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.retain(|(time, value)| time.is_finite() && value.is_finite());
    let stride = points.len().div_ceil(CURVE_POINTS).max(1);
    let last = points.len().saturating_sub(1);
    let keep = |(index, point)| (index % stride == 0 || index == last).then_some(point);
    points.into_iter().enumerate().filter_map(keep).collect()
}

/// Value of a curve at a time, linear between its points.
fn interpolate(curve: &[(f64, f64)], time: f64) -> f64 {
    let after = curve.partition_point(|point| point.0 < time);
    match (after.checked_sub(1).map(|i| curve[i]), curve.get(after)) {
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (time - a.0) / (b.0 - a.0),
        (Some(a), None) => a.1,
        (None, Some(b)) => b.1,
        (None, None) => 0.0,
    }
}
