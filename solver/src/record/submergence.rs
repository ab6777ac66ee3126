//! Submergence of a body in the flow.

use crate::contact::point_body::Around;
use crate::contact::screening::screens;
use crate::math::{Mat3, Vec3};
use crate::rigid::Body;
use crate::simulation::Simulation;

/// Number of sectors round a body.
const SECTORS: usize = 8;
/// Width of the ring, in point spacings: there are a few points of every layer in each sector,
/// also round a body smaller than a cell.
const RING: f64 = 3.0;
/// Gap above all other points of its sector beyond which a point is not part of the flow's
/// surface but thrown out of it, in point spacings.
const GAP: f64 = 2.0;

/// Share of the body's height below the surface of the flow round it, 0..1, both along the
/// normal of the bed under it.
///
/// In each of eight sectors the surface is half a point spacing above the highest point that a
/// sequence of others connects with the body's foot. The share is the value at the body's
/// centre of a plane through the sectors' shares: a slope of the surface does not count twice,
/// and one splash does not submerge a body. Sectors behind a side wall or another body are left
/// out, and so are points there.
pub(super) fn submerged_fraction(simulation: &Simulation, body: &Body) -> f64 {
    let view = View::of(simulation, body);
    level_at_the_centre(simulation, body, &view, 1.0)
}

/// Depth of the body's highest place below the surface of the flow round it, along the normal of
/// the bed under it [m]; 0 if it stands out. The surface is that of [`submerged_fraction`].
pub(super) fn burial_depth(simulation: &Simulation, body: &Body) -> f64 {
    let view = View {
        ceiling: f64::INFINITY,
        ..View::of(simulation, body)
    };
    let level = level_at_the_centre(simulation, body, &view, f64::INFINITY);
    (level - 1.0).max(0.0) * (view.high - view.low)
}

/// Height of the flow's surface at the body's centre over the body's foot, as a share of the
/// body's height; that of each sector counts up to `most`.
fn level_at_the_centre(simulation: &Simulation, body: &Body, view: &View, most: f64) -> f64 {
    let others = others_near(simulation.bodies(), body, view.ring);
    let hidden = |place: &Vec3| {
        let mut others = others.iter();
        others.any(|other| screens(other, place, &body.state.position))
    };
    let mut sectors: [Vec<Spot>; SECTORS] = Default::default();
    simulation.visit_points(view.around().as_ref(), |point| {
        let spot = view.spot(&point.position);
        if let Some(spot) = spot.filter(|_| !hidden(&point.position)) {
            sectors[sector(&spot)].push(spot);
        }
    });
    let within = sectors.iter_mut().enumerate();
    let has_say =
        |sector: usize| view.has_room(simulation, sector) && !hidden(&view.middle_place(sector));
    let within = within.filter(|(sector, _)| has_say(*sector));
    let shares: Vec<(Spot, f64)> = within
        .map(|(sector, spots)| view.share(sector, spots, most))
        .collect();
    at_the_centre(&shares).clamp(0.0, most)
}

/// The other bodies that reach into a ring round one.
fn others_near<'a>(bodies: &'a [Body], body: &Body, ring: f64) -> Vec<&'a Body> {
    let near = |other: &&Body| {
        let apart = (other.state.position - body.state.position).norm();
        apart > 0.0 && apart < ring + other.shape.bounding_radius()
    };
    bodies.iter().filter(near).collect()
}

/// A place relative to a body.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Spot {
    /// Coordinate downstream along the bed [m].
    along: f64,
    /// Coordinate across [m].
    across: f64,
    /// Coordinate along the bed's normal [m].
    height: f64,
}

/// A body's surroundings, in axes of the bed under it.
#[derive(Debug, Clone, Copy)]
struct View {
    centre: Vec3,
    /// Along the bed, across it, and out of it.
    downstream: Vec3,
    across: Vec3,
    normal: Vec3,
    /// Lowest and highest place of the body [m].
    low: f64,
    high: f64,
    /// Height above which points are not looked at [m].
    ceiling: f64,
    /// Bounding radius of the body, and outer radius of the ring [m].
    radius: f64,
    ring: f64,
    /// Distance of points [m].
    spacing: f64,
}

impl View {
    fn of(simulation: &Simulation, body: &Body) -> Self {
        let centre = body.state.position;
        let normal = simulation.bed().normal(centre.x, centre.y);
        let downstream = (Vec3::x() - normal * normal.x).normalize();
        let extent = |direction: Vec3| body.shape.extent_along(&body.to_body(&direction));
        let (radius, spacing) = (body.shape.bounding_radius(), simulation.point_spacing_m());
        Self {
            centre,
            downstream,
            across: normal.cross(&downstream),
            normal,
            low: -extent(-normal),
            high: extent(normal),
            ceiling: extent(normal) + GAP * spacing,
            radius,
            ring: radius + RING * spacing,
            spacing,
        }
    }

    /// A box that contains the ring up to the ceiling; none if there is no ceiling.
    fn around(&self) -> Option<Around> {
        let tallest = self.ceiling.max(GAP * self.spacing - self.low);
        let column = || Around::column(self.centre, self.ring + self.normal.xy().norm() * tallest);
        tallest.is_finite().then(column)
    }

    /// A place if it is in the ring.
    fn spot(&self, place: &Vec3) -> Option<Spot> {
        let arm = place - self.centre;
        let spot = Spot {
            along: arm.dot(&self.downstream),
            across: arm.dot(&self.across),
            height: arm.dot(&self.normal),
        };
        let near = spot.along.hypot(spot.across) <= self.ring;
        let floor = self.low - GAP * self.spacing;
        let beside = spot.height >= floor && spot.height <= self.ceiling;
        (near && beside).then_some(spot)
    }

    /// The middle of a sector, a bounding radius away.
    fn middle(&self, sector: usize) -> Spot {
        let turn = std::f64::consts::TAU * ((sector as f64 + 0.5) / SECTORS as f64 - 0.5);
        Spot {
            along: self.radius * turn.cos(),
            across: self.radius * turn.sin(),
            height: 0.0,
        }
    }

    fn middle_place(&self, sector: usize) -> Vec3 {
        let middle = self.middle(sector);
        self.centre + self.downstream * middle.along + self.across * middle.across
    }

    /// True if a sector lies between the side walls.
    fn has_room(&self, simulation: &Simulation, sector: usize) -> bool {
        let place = self.middle_place(sector);
        let sides = simulation.rigid_walls().planes.iter();
        let mut sides = sides.filter(|plane| plane.normal.y.abs() > 0.5);
        sides.all(|plane| plane.height(&place) > 0.0)
    }

    /// Position of a sector's surface, and its height over the body's foot as a share of the
    /// body's height, up to `most`.
    fn share(&self, sector: usize, spots: &mut [Spot], most: f64) -> (Spot, f64) {
        spots.sort_unstable_by(|a, b| a.height.total_cmp(&b.height));
        let mut level = self.low;
        let mut top = None;
        for spot in spots {
            if spot.height > level + GAP * self.spacing {
                break;
            }
            level = level.max(spot.height);
            top = Some(*spot);
        }
        let Some(top) = top else {
            return (self.middle(sector), 0.0);
        };
        let surface = top.height + 0.5 * self.spacing;
        let share = (surface - self.low) / (self.high - self.low);
        (top, share.clamp(0.0, most))
    }
}

fn sector(spot: &Spot) -> usize {
    let turn = spot.across.atan2(spot.along) / std::f64::consts::TAU + 0.5;
    ((turn * SECTORS as f64) as usize).min(SECTORS - 1)
}

/// Value at the body's centre of the least-squares plane through these shares; their mean where
/// they do not determine a plane.
fn at_the_centre(shares: &[(Spot, f64)]) -> f64 {
    let mut normal = Mat3::zeros();
    let mut right = Vec3::zeros();
    for (spot, share) in shares {
        let row = Vec3::new(1.0, spot.along, spot.across);
        normal += row * row.transpose();
        right += row * *share;
    }
    let count = shares.len().max(1) as f64;
    let mean = right.x / count;
    let spread = normal[(1, 1)] * normal[(2, 2)] - normal[(1, 2)].powi(2);
    let flat = spread <= 1e-6 * (normal[(1, 1)] + normal[(2, 2)]).powi(2);
    match normal.lu().solve(&right).filter(|_| !flat) {
        Some(plane) => plane.x,
        None => mean,
    }
}

#[cfg(test)]
mod tests;
