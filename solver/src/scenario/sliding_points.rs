//! Sliding points: a rough estimate of the course of a flow on a terrain, without a computation
//! (docs/method.md, equation 85).

use super::{ReleasedArea, Scenario};
use crate::bed::{Bed, HeightField};
use crate::math::Vec3;
use crate::method::METHOD;

/// Points that slide from each release along each axis.
const ACROSS: usize = 5;
/// Directions in which a release collapses.
const SIDES: [[f64; 2]; 4] = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
/// Most steps of a point.
const STEPS: usize = 20_000;
/// Collapse time of a release that does not slide, over √(h/g).
const COLLAPSES_FOR: f64 = 4.5;
/// Length of a step, over the side of the map's cells.
const STEP: f64 = 0.2;

/// Course of points that slide from the releases down the terrain against base friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SlidingPoints {
    /// Largest speed, the collapse of the release included [m/s].
    pub(crate) fastest: f64,
    /// Time at which all of them have been at rest for the rest time, or have left [s].
    pub(crate) rests_at: f64,
}

impl SlidingPoints {
    /// Points that slide from the releases of a scenario on this ground; `None` without material
    /// on a terrain.
    pub(crate) fn of(scenario: &Scenario, ground: &HeightField) -> Option<Self> {
        let thickness = scenario.release_thickness_m().filter(|of| *of > 0.0)?;
        let gravity = scenario.gravity_m_s2;
        let collapse = (gravity * thickness).sqrt();
        let mut course: Option<Self> = None;
        for (area, starts_at) in scenario.terrain_releases().zip(scenario.release_times()) {
            for place in places(&area) {
                let (fastest, takes) = slide(ground, gravity, place, Vec3::zeros());
                // Over the edge of a cliff beside it a release that would not slide collapses.
                let pushed = SIDES.map(|[x, y]| {
                    let (fastest, _) =
                        slide(ground, gravity, place, Vec3::new(x, y, 0.0) * collapse);
                    fastest
                });
                let known = course.unwrap_or(Self {
                    fastest: 0.0,
                    rests_at: 0.0,
                });
                course = Some(Self {
                    fastest: pushed
                        .into_iter()
                        .fold(known.fastest.max(fastest.hypot(collapse)), f64::max),
                    rests_at: known.rests_at.max(starts_at + takes),
                });
            }
        }
        let fall = (thickness / gravity).sqrt();
        course.map(|course| Self {
            rests_at: course.rests_at + COLLAPSES_FOR * fall + METHOD.early_stop.rest_time * fall,
            ..course
        })
    }
}

/// Places of a release from which points slide.
fn places<'a>(area: &'a ReleasedArea<'a>) -> impl Iterator<Item = [f64; 2]> + 'a {
    area.bounds().into_iter().flat_map(move |[low, high]| {
        let grid = (0..ACROSS * ACROSS).map(move |n| {
            let share = [n % ACROSS, n / ACROSS].map(|n| (n as f64 + 0.5) / ACROSS as f64);
            [0, 1].map(|axis| low[axis] + share[axis] * (high[axis] - low[axis]))
        });
        grid.filter(|[x, y]| area.thickness_at(*x, *y) > 0.0)
    })
}

/// Largest speed of a point that slides from here with this velocity [m/s], and the time until it
/// rests or leaves the map [s].
fn slide(ground: &HeightField, gravity: f64, [x, y]: [f64; 2], mut velocity: Vec3) -> (f64, f64) {
    let step = STEP * ground.surface().cell_size();
    let extent = ground.surface().extent();
    let mut place = Vec3::new(x, y, 0.0);
    let (mut time, mut fastest) = (0.0, 0.0_f64);
    for _ in 0..STEPS {
        let plane = ground.tangent(place.x, place.y);
        let into = velocity.dot(&plane.normal);
        velocity -= plane.normal * into;
        let pull = -Vec3::z() * gravity + plane.normal * (gravity * plane.normal.z);
        let held = plane.flow_friction * gravity * plane.normal.z;
        let speed = velocity.norm();
        let rests = speed < 1e-3 * (gravity * step).sqrt() && pull.norm() <= held;
        let outside = |axis: usize| place[axis] < 0.0 || place[axis] > extent[axis];
        if rests || outside(0) || outside(1) {
            break;
        }
        // As far as a step in the time that it takes from rest or at this speed.
        let dt = step / (speed + (gravity * step).sqrt());
        // Turning up presses the point to the ground, and friction takes its share of that.
        let lost = plane.flow_friction * (-into).max(0.0) + held * dt;
        velocity += pull * dt;
        let speed = velocity.norm();
        velocity *= if speed > lost {
            1.0 - lost / speed
        } else {
            0.0
        };
        place += velocity * dt;
        time += dt;
        fastest = fastest.max(velocity.norm());
    }
    (fastest, time)
}
