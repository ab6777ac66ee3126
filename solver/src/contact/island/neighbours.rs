//! Neighbour search: the pairs of bodies that may touch within a sub-step of the flow, from the
//! distance that each may travel in it (docs/method.md, "Islands").

use super::report::BodyReport;
use crate::contact::body_body::least_gap;
use crate::contact::broad_phase::{Ball, overlapping_pairs};
use crate::rigid::{Body, BodyState, Freedom};

/// Distances that the bodies may travel within a sub-step of the flow [m].
pub(super) struct Reaches(Vec<f64>);

impl Reaches {
    /// Distances under these accelerations [m/s²], impacts apart.
    pub(super) fn within(bodies: &[Body], acceleration: impl Fn(usize) -> f64, dt: f64) -> Self {
        // A body alone has no neighbour, and a steady run allocates nothing.
        if bodies.len() < 2 {
            return Self(Vec::new());
        }
        let reach = |(place, body): (usize, &Body)| {
            reach(body, speed_within(body, acceleration(place), dt), dt)
        };
        Self(bodies.iter().enumerate().map(reach).collect())
    }

    /// Pairs of bodies, one of them free, that may touch, in order.
    pub(super) fn pairs(&self, bodies: &[Body]) -> Vec<[usize; 2]> {
        let ball = |(body, reach): (&Body, &f64)| Ball {
            centre: body.state.position,
            radius: body.shape.bounding_radius() + reach,
        };
        let balls: Vec<Ball> = bodies.iter().zip(&self.0).map(ball).collect();
        let mut pairs = overlapping_pairs(&balls);
        pairs.retain(|&[first, second]| {
            let (one, other) = (&bodies[first], &bodies[second]);
            let free = one.is_free() || other.is_free();
            free && least_gap(one, other) < self.0[first] + self.0[second]
        });
        pairs
    }

    /// Extends those of bodies that may be struck to that of the striking one: bodies of the same
    /// mass exchange their speeds.
    pub(super) fn extend_to_struck(&mut self, bodies: &[Body]) {
        let unstruck = self.0.clone();
        for [one, other] in self.pairs(bodies) {
            self.0[one] = self.0[one].max(unstruck[other]);
            self.0[other] = self.0[other].max(unstruck[one]);
        }
    }

    /// Extends those that bodies exceeded, as after several impacts; true if any did.
    pub(super) fn extend_to_travelled(&mut self, reports: &[BodyReport]) -> bool {
        let mut exceeded = false;
        for (reach, report) in self.0.iter_mut().zip(reports) {
            if report.travelled > *reach {
                *reach = report.travelled;
                exceeded = true;
            }
        }
        exceeded
    }
}

/// Largest speed [m/s] of a body within `dt` under an acceleration [m/s²], impacts apart.
pub(super) fn speed_within(body: &Body, acceleration: f64, dt: f64) -> f64 {
    match body.freedom {
        Freedom::Fixed => 0.0,
        Freedom::Free | Freedom::InPlane | Freedom::Prescribed(_) => {
            body.speed_ahead() + acceleration * dt
        }
    }
}

/// Distance that a body may travel in `dt` at this speed [m/s], with an allowance for other
/// accelerations [m].
pub(super) fn reach(body: &Body, speed: f64, dt: f64) -> f64 {
    2.0 * speed * dt + 0.01 * body.shape.sphero_radius()
}

/// States of all bodies.
pub(super) fn states(bodies: &[Body]) -> Vec<BodyState> {
    bodies.iter().map(|body| body.state.clone()).collect()
}

/// Puts all bodies into these states.
pub(super) fn restore(bodies: &mut [Body], states: &[BodyState]) {
    for (body, state) in bodies.iter_mut().zip(states) {
        body.state.clone_from(state);
    }
}
