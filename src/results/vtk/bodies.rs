//! Bodies at an instant: their surfaces, with the motion of each.

use super::poly_data::{Cells, PolyData, Section};
use super::surface::{Detail, Surface};
use crate::results::interpolation::BodyState;
use nalgebra::Vector3;
use scree_solver::record::Mode;
use scree_solver::scenario::Scenario;
use scree_solver::shape::SpheroPolyhedron;
use std::f64::consts::FRAC_PI_2;

/// Most triangles of all bodies together, unless the coarsest surfaces have more.
const MOST_TRIANGLES: usize = 50_000;

/// Steps of the rounding, the finest first [rad].
const STEPS: [f64; 4] = [FRAC_PI_2 / 6.0, FRAC_PI_2 / 4.0, FRAC_PI_2 / 2.0, FRAC_PI_2];

/// Surfaces of all bodies of a scenario, each in its body's axes.
#[derive(Debug)]
pub(super) struct Surfaces(Vec<Surface>);

impl Surfaces {
    /// The finest surfaces within the number of triangles.
    pub(super) fn of(scenario: &Scenario) -> Self {
        let bodies = 0..scenario.bodies.len();
        let shapes: Vec<_> = bodies.map(|body| scenario.shape_of(body)).collect();
        let finest = STEPS.iter().find_map(|&step| within(&shapes, step));
        Self(finest.unwrap_or_else(|| {
            let faceted = |shape| Surface::new(shape, Detail::Faceted);
            shapes.iter().map(faceted).collect()
        }))
    }

    /// The bodies in these states as poly data.
    pub(super) fn at(&self, time_s: f64, states: &[BodyState]) -> Vec<u8> {
        let bodies = || self.0.iter().zip(states);
        let mut data = PolyData::at(time_s);
        let reached = bodies().flat_map(|(surface, state)| {
            let places = surface.points.iter().map(|point| state.orientation * point);
            places.map(move |place| (state, place))
        });
        let reached: Vec<_> = reached.collect();
        let speed = |(state, place): &(&BodyState, Vector3<f64>)| {
            (state.velocity + state.angular_velocity.cross(place)).norm() as f32
        };
        data.add(Section::Point, "speed_m_s", 1, reached.iter().map(speed));
        let cells = || {
            let bodies = bodies().enumerate();
            bodies.flat_map(|(body, (surface, state))| {
                surface.triangles.iter().map(move |_| (body, state))
            })
        };
        data.add(
            Section::Cell,
            "body",
            1,
            cells().map(|(body, _)| body as i32),
        );
        let mode = |(_, state): (usize, &BodyState)| mode_number(state.mode);
        data.add(Section::Cell, "mode", 1, cells().map(mode));
        let velocity = cells().flat_map(|(_, state)| single(&state.velocity));
        data.add(Section::Cell, "velocity_m_s", 3, velocity);
        let turning = cells().flat_map(|(_, state)| single(&state.angular_velocity));
        data.add(Section::Cell, "angular_velocity_rad_s", 3, turning);
        let mut first = 0;
        let triangles = bodies().flat_map(|(surface, _)| {
            let before = first;
            first += surface.points.len() as i32;
            let corners = surface.triangles.iter();
            corners.map(move |corners| corners.map(|corner| before + corner))
        });
        let triangles: Vec<_> = triangles.collect();
        let points = reached
            .iter()
            .map(|(state, place)| single(&(state.position + place)));
        data.finish(points, Cells::Polygons, &triangles)
    }
}

/// Surfaces with this step of the rounding, if they are within the number of triangles.
fn within(shapes: &[SpheroPolyhedron], step: f64) -> Option<Vec<Surface>> {
    let mut left = MOST_TRIANGLES;
    let surface = |shape| {
        let surface = Surface::new(shape, Detail::Round(step));
        left = left.checked_sub(surface.triangles.len())?;
        Some(surface)
    };
    shapes.iter().map(surface).collect()
}

fn single(vector: &Vector3<f64>) -> [f32; 3] {
    vector.map(|x| x as f32).into()
}

/// Number of a mode, in the order of the contract.
fn mode_number(mode: Mode) -> u8 {
    match mode {
        Mode::Resting => 0,
        Mode::Sliding => 1,
        Mode::Rolling => 2,
        Mode::Saltating => 3,
        Mode::Carried => 4,
    }
}
