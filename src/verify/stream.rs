//! A fixed cube in a block of points: in the path of a stream, or buried in a bed.
//! The block is periodic along the channel, and smooth walls mirror it across.

use super::blocks::{Block, PER_CELL};
use super::run::{Answer, CaseError, Run};
use super::scenes::body;
use scree_solver::contact::law::damping_number;
use scree_solver::material::Material;
use scree_solver::math::Vec3;
use scree_solver::rigid::Body;
use scree_solver::scenario::Precision;
use scree_solver::simulation::Scene;
use serde_json::json;
use std::ops::ControlFlow;

/// Side of the cube [m].
pub(super) const SIDE: f64 = 0.04;
/// Radius of its edges, over the side: as small as allowed, so that areas and
/// volumes are those of a sharp cube.
const ROUNDING: f64 = 0.01;
/// Speed of the stream [m/s].
const SPEED: f64 = 1.0;
/// Distance of the stream above the cube at the start [cells].
const GAP: u32 = 1;

/// A stream falling onto the cube at constant speed, without gravity.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stream {
    /// Cells per side of the cube.
    pub(super) cells: u32,
    /// Cells of stream along and across the channel, the cube in their middle.
    pub(super) wide: u32,
    /// Material of the stream, before thinning to `share`.
    pub(super) material: Material,
    /// Density over that of the material.
    pub(super) share: f64,
    /// Radius of the points' spheres over its usual value.
    pub(super) sphere: f64,
    /// Travel after the first contact [cells].
    pub(super) travel: u32,
}

/// A fixed, frictionless cube with restitution 0.
pub(super) fn fixed_cube(centre: Vec3, scene: &Scene) -> Result<Body, CaseError> {
    let mut cube = body(&json!({
        "shape": {"cube": {"side_m": SIDE}},
        "sphero_radius_m": ROUNDING * SIDE,
        "fixed": true,
        "position": {"downstream_m": 0.0, "elevation_m": 0.5},
    }))?;
    cube.state.position = centre;
    if let Some(flow) = &scene.given.flow {
        cube.flow_law = flow.contact_law(damping_number(0.0), 0.0);
    }
    Ok(cube)
}

impl Stream {
    fn cell(&self) -> f64 {
        SIDE / f64::from(self.cells)
    }

    /// Momentum flux ρ v² A [N].
    pub(super) fn momentum_flux(&self) -> f64 {
        self.share * self.material.bulk_density * (SPEED * SIDE).powi(2)
    }

    /// Distance from the cube on each side within which the stream would have to be stopped
    /// to give this force [N] [cells].
    pub(super) fn stand_off(&self, force: f64) -> f64 {
        let wider = (force / self.momentum_flux()).max(0.0).sqrt();
        0.5 * (wider - 1.0) * f64::from(self.cells)
    }

    fn scene(&self) -> Result<Scene, CaseError> {
        let wide = self.wide;
        // Points that pass the cube do not reach the floor.
        let below = self.travel + GAP + 2;
        let block = Block {
            cell: self.cell(),
            at: [0, 0, below + self.cells + GAP],
            // The end of the stream is still above the cube.
            cells: [wide, wide, self.travel + 4],
            cells_across: wide,
            per_cell: PER_CELL,
            endless: true,
            material: self.material,
            gravity: 0.0,
            expected_speed: SPEED,
            precision: Precision::Single,
            duration: f64::from(self.travel + 2 * GAP) * self.cell() / SPEED,
        };
        let mut scene = block.scene();
        let mut centre = block.middle();
        centre.z = (f64::from(below) + 0.5 * f64::from(self.cells)) * self.cell();
        if let Some(flow) = &mut scene.given.flow {
            flow.sphere.radius *= self.sphere;
            // The solver's sub-step is that of points at full density.
            flow.limits.courant *= self.share;
        }
        for point in &mut scene.points {
            point.mass *= self.share;
            point.velocity.z = -SPEED;
        }
        let cube = fixed_cube(centre, &scene)?;
        scene.bodies.push(cube);
        Ok(scene)
    }

    /// Mean force on the cube [N] between travels after the first contact, given
    /// in cells, each window starting where the one before it ends.
    pub(super) fn forces<const N: usize>(
        &self,
        from: f64,
        windows: [f64; N],
    ) -> Result<Answer<N>, CaseError> {
        let mut run = Run::start(self.scene()?)?;
        let mut touched = None;
        let (mut impulses, mut times) = ([0.0; N], [0.0; N]);
        let cell = self.cell();
        run.watch(f64::INFINITY, |simulation, report| {
            let load = simulation.flow_load(0);
            if touched.is_none() && load.touching_points > 0 {
                touched = Some(report.time_s);
            }
            let since = touched.map_or(0.0, |start| report.time_s - start);
            let travelled = since * SPEED / cell;
            let window = windows.iter().position(|end| travelled < *end);
            if let (Some(window), true) = (window, travelled >= from) {
                impulses[window] -= load.load.force.z * report.substep_s;
                times[window] += report.substep_s;
            }
            ControlFlow::Continue(())
        })?;
        if times.contains(&0.0) {
            return Err(CaseError::Never("the stream did not come so far"));
        }
        let mut forces = impulses;
        for (force, time) in forces.iter_mut().zip(times) {
            *force /= time;
        }
        Ok(run.answer(forces))
    }
}
