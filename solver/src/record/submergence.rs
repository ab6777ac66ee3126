//! How deep a body is in the flow.

use crate::contact::point_body::Around;
use crate::math::Vec3;
use crate::rigid::Body;
use crate::simulation::Simulation;

/// Sectors of the horizon looked at round a body.
const SECTORS: usize = 8;
/// Width of the ring looked at, in cells.
const RING_CELLS: f64 = 1.0;

/// Share of the body's height below the surface of the flow round it, 0..1.
///
/// In each of eight sectors the surface is the highest point within the body's
/// bounding radius and one cell; the share is the mean over the sectors, so
/// that one splash does not drown a body.
pub(super) fn submerged_fraction(simulation: &Simulation, body: &Body) -> f64 {
    let centre = body.state.position;
    let extent = |direction: Vec3| body.shape.extent_along(&body.to_body(&direction));
    let (low, high) = (centre.z - extent(-Vec3::z()), centre.z + extent(Vec3::z()));
    let ring = body.shape.bounding_radius() + RING_CELLS * simulation.cell_size_m();
    let mut surface = [f64::NEG_INFINITY; SECTORS];
    let around = Around::column(centre, ring);
    simulation.visit_points(Some(&around), |point| {
        let (x, y) = (point.position.x - centre.x, point.position.y - centre.y);
        if x * x + y * y <= ring * ring {
            let sector = &mut surface[sector(x, y)];
            *sector = sector.max(point.position.z + simulation.point_radius_m());
        }
    });
    let share = |top: &f64| ((top - low) / (high - low)).clamp(0.0, 1.0);
    surface.iter().map(share).sum::<f64>() / SECTORS as f64
}

fn sector(x: f64, y: f64) -> usize {
    let turn = y.atan2(x) / std::f64::consts::TAU + 0.5;
    ((turn * SECTORS as f64) as usize).min(SECTORS - 1)
}
