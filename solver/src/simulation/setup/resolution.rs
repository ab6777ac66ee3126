//! Automatic choices: cell size, expected speed, contact modulus
//! (docs/method.md, equations 30–33).

use crate::bed::Bed;
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::method::METHOD;
use crate::scenario::{Flow, Ground, Motion, Numerics, Scenario, SlidingPoints, Source};

/// Stiffness of a body on a rigid wall over that on an equal body: E*/2 and r/2.
const TWO_LIKE_ONE: f64 = 2.0 * std::f64::consts::SQRT_2;

/// Points across a cell, for the points that a cell has.
pub(super) fn points_across(numerics: &Numerics) -> f64 {
    f64::from(numerics.points_per_cell).cbrt().round().max(1.0)
}

/// Odd number of cells from which on an even one is as good: it differs by an eighth at most.
const MANY_CELLS: f64 = 9.0;

/// Number of cells that divide a channel of this width, in cells: the nearest whole one. With an odd
/// number of points across a cell, an odd number of them would leave a row of points in the centre
/// plane, and no half to compute (section 12); then it is the nearest even one.
fn cells_across(width: f64, points_across: f64) -> f64 {
    let nearest = width.round().max(1.0);
    let odd = |number: f64| number % 2.0 == 1.0;
    if odd(points_across) && odd(nearest) && nearest >= MANY_CELLS {
        2.0 * (0.5 * width).round()
    } else {
        nearest
    }
}

/// The lattice of a scenario: in a channel its cells divide the width evenly, so that both
/// side walls lie on nodes.
pub(super) fn lattice(scenario: &Scenario) -> Lattice {
    let cell = scenario.cell_size_m();
    let Some(channel) = scenario.channel() else {
        return Lattice {
            origin: Vec3::zeros(),
            spacing: Vec3::repeat(cell),
        };
    };
    let across = cells_across(channel.width_m / cell, points_across(&scenario.numerics));
    Lattice {
        origin: Vec3::new(-channel.incline_length_m, -0.5 * channel.width_m, 0.0),
        spacing: Vec3::new(cell, channel.width_m / across, cell),
    }
}

/// Expected speeds and pressures of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    /// Speed of the flow, or of the fastest body at the start [m/s].
    pub speed: f64,
    /// Speed whose dynamic pressure ρ_c v² is the largest pressure expected in the flow
    /// [m/s]: of the flow itself, of bodies that fall or slide into it, or of their
    /// weight, sixteen times that of a body laid on it.
    pub pressing_speed: f64,
    /// Speed with which the fastest body may meet a bed at rest [m/s].
    pub impact_speed: f64,
    /// Largest pressure expected between flow and bodies [Pa]; infinite with a prescribed motion,
    /// whose pressure is not bounded.
    pub contact_pressure: f64,
    /// Mean pressure of the flow at rest [Pa].
    pub static_pressure: f64,
}

/// Expected speeds and pressures of a scenario (equations 31 and 31a).
pub(super) fn expected(scenario: &Scenario, crowd: &Crowd) -> Expected {
    let speed = expected_speed(scenario);
    let flow = scenario.flow.as_ref();
    let density = flow.map_or(f64::INFINITY, |flow| flow.material.bulk_density_kg_m3);
    let thickness = scenario.release_thickness_m().unwrap_or_default();
    let weight = |_: &Flow| 0.5 * density * scenario.gravity_m_s2 * thickness;
    let of_body = |body: &Weighty| {
        let weight = body.mass * scenario.gravity_m_s2 / body.projected_area;
        let factor = if body.lies_on_flow {
            METHOD.stiffness.settlement
        } else {
            1.0
        };
        body.speed_squared.max(factor * weight / density)
    };
    let free = || crowd.0.iter().filter(|body| body.free);
    let pressing_squared = free().map(of_body).fold(speed * speed, f64::max);
    let impacts = free().map(|body| body.speed_squared);
    let moves = |motion: &Motion| motion.prescribed().fastest(1.0) > 0.0;
    let bodies = scenario.bodies.iter();
    let driven = bodies.filter_map(|body| body.motion.as_ref()).any(moves);
    Expected {
        speed,
        pressing_speed: pressing_squared.sqrt(),
        impact_speed: impacts.fold(0.0, f64::max).sqrt(),
        contact_pressure: if driven {
            f64::INFINITY
        } else {
            density * pressing_squared
        },
        static_pressure: flow.map_or(0.0, weight),
    }
}

/// Expected speed of the flow [m/s]: its own, or that of the fastest body.
fn expected_speed(scenario: &Scenario) -> f64 {
    let flow = scenario.flow.as_ref();
    let of_flow = flow.map_or(0.0, |flow| match (&scenario.ground, &flow.source) {
        (Ground::Channel(channel), Source::Channel { volume_m3, release }) => {
            channel.fastest_flow((*volume_m3, release), scenario.gravity_m_s2)
        }
        (Ground::Terrain(terrain), _) => {
            let ground = terrain.ground(scenario.cell_size_m());
            let course = SlidingPoints::of(scenario, &ground);
            course.map_or(0.0, |course| course.fastest)
        }
        (Ground::Channel(_), Source::Terrain { .. }) => 0.0,
    });
    let bodies = scenario.bodies.iter().enumerate();
    let thrown = bodies.map(|(place, body)| match body.motion {
        Some(_) => body.thrown_m_s(scenario.shape_of(place).bounding_radius()),
        None => Vec3::from(body.velocity_m_s).norm(),
    });
    thrown.fold(of_flow, f64::max)
}

/// Properties of a body that determine its contacts.
struct Weighty {
    mass: f64,
    sphero_radius: f64,
    restitution: f64,
    /// Position of its centre at the start [m].
    start: Vec3,
    bounding_radius: f64,
    /// Projected area [m²].
    projected_area: f64,
    /// Squared speed of its start, and of a fall to the floor [m²/s²].
    speed_squared: f64,
    /// True if it starts on or in the release, or less than its own height above.
    lies_on_flow: bool,
    free: bool,
    fixed: bool,
}

/// All bodies of a scenario, for the stiffness of their contacts.
pub(super) struct Crowd(Vec<Weighty>);

impl Crowd {
    pub(super) fn of(scenario: &Scenario) -> Self {
        let poses = scenario.initial_poses();
        let bed = scenario.bed();
        let areas: Vec<_> = scenario.terrain_releases().collect();
        let weighty = |place: usize| {
            let body = &scenario.bodies[place];
            let shape = scenario.shape_of(place);
            let start = poses[place].position;
            let lowest = shape.inscribed_radius();
            let falling = match body.motion {
                Some(_) => 0.0,
                None => 2.0 * scenario.gravity_m_s2 * fall(scenario, bed.as_ref(), &start, lowest),
            };
            let bounding_radius = shape.bounding_radius();
            let thrown = body.thrown_m_s(bounding_radius);
            Weighty {
                mass: body.density_kg_m3 * shape.volume(),
                sphero_radius: shape.sphero_radius(),
                restitution: body.restitution,
                start,
                bounding_radius,
                projected_area: shape.largest_projected_area(),
                speed_squared: falling + thrown * thrown,
                lies_on_flow: {
                    let above = start.z - 3.0 * lowest - bed.elevation(start.x, start.y);
                    let thickness = areas.iter().map(|area| area.thickness_at(start.x, start.y));
                    let in_channel = scenario.release().is_some_and(|release| {
                        let over = release.back_m <= start.x && start.x <= release.front_m;
                        over && above < release.vertical_thickness_m
                    });
                    in_channel
                        || thickness
                            .into_iter()
                            .any(|thick| thick > 0.0 && above < thick)
                },
                free: body.is_free(),
                fixed: body.fixed,
            }
        };
        Self((0..scenario.bodies.len()).map(weighty).collect())
    }

    /// Mass that may come to rest on a body, its own included if it is free [kg].
    fn carried_by(&self, place: usize) -> f64 {
        let own = &self.0[place];
        let above = self.0.iter().filter(|other| other.can_rest_on(own));
        own.moving_mass() + above.map(|other| other.mass).sum::<f64>()
    }

    /// Least sphero radius of all [m]: overlap is measured by the smaller radius of
    /// two, and the softer of two contact moduli decides.
    fn least_radius(&self) -> f64 {
        let radii = self.0.iter().map(|body| body.sphero_radius);
        radii.fold(f64::INFINITY, f64::min)
    }

    /// Energy of the hardest impact of two bodies over that of the heaviest one on a wall at the
    /// largest speed: between a rebounding and a falling body, and with a lighter body thrown up in
    /// between (equation 33).
    fn gain(&self) -> f64 {
        let free = self.0.iter().filter(|body| body.free);
        let restitution = free.map(|body| body.restitution).fold(0.0, f64::max);
        let towards = (1.0 + restitution).powi(2);
        f64::max(0.5 * towards, 4.0 / 27.0 * towards.powi(2)).max(1.0)
    }

    /// Largest mass and squared speed of the bodies that may strike this body, or that it may
    /// strike.
    fn striking(&self, place: usize) -> (f64, f64) {
        let own = &self.0[place];
        let others = self.0.iter().filter(|other| !other.fixed);
        let alone = (own.moving_mass(), own.speed_squared);
        others.fold(alone, |(mass, speed), other| {
            let speed = speed.max(other.speed_squared);
            (mass.max(other.moving_mass()), speed)
        })
    }
}

/// Height that a body may fall [m]: to the floor of a channel. On a terrain, where it may slide
/// from the highest place to the lowest without ever falling, to the ground under it.
fn fall(scenario: &Scenario, bed: &dyn Bed, start: &Vec3, lowest: f64) -> f64 {
    let floor = match scenario.ground {
        Ground::Channel(_) => 0.0,
        Ground::Terrain(_) => bed.elevation(start.x, start.y),
    };
    (start.z - lowest - floor).max(0.0)
}

impl Weighty {
    /// True if its weight can come to rest on another body: it starts higher, and its horizontal
    /// distance is at most the sum of both radii and the difference in height. Bodies that fall,
    /// roll or are stacked pass their weight down no flatter than at 45°.
    fn can_rest_on(&self, other: &Self) -> bool {
        let apart = self.start - other.start;
        let reach = self.bounding_radius + other.bounding_radius;
        self.free && apart.z > 0.0 && apart.xy().norm() < reach + apart.z
    }

    /// Mass of a free body; zero for a fixed or prescribed one, which has no weight to carry and
    /// whose mass stops no impact.
    fn moving_mass(&self) -> f64 {
        if self.free { self.mass } else { 0.0 }
    }
}

/// Contact modulus E* of a body on a rigid wall [Pa]: stiff enough that resting on one vertex
/// overlaps 1 % of the sphero radius, and an impact on one vertex at the largest speed expected
/// 20 %; among other bodies, where both yield and both are round, of the least radius, for the
/// bodies that may lie on it or strike it.
pub(super) fn contact_modulus(
    crowd: &Crowd,
    place: usize,
    expected_speed: f64,
    gravity_m_s2: f64,
) -> f64 {
    let radius = crowd.least_radius();
    let (striking, speed_squared) = crowd.striking(place);
    let speed_squared = speed_squared.max(expected_speed.powi(2));
    let pressed = crowd.carried_by(place) * gravity_m_s2;
    let (gain, softer) = match crowd.0.len() {
        1 => (1.0, 1.0),
        _ => (crowd.gain(), TWO_LIKE_ONE),
    };
    let at_rest = pressed / (METHOD.stiffness.overlap_at_rest * radius).powf(1.5);
    let at_impact = 1.25 * gain * striking * speed_squared
        / (METHOD.stiffness.overlap_at_impact * radius).powf(2.5);
    0.75 * softer * at_rest.max(at_impact) / radius.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bodies of 1 kg and 5 cm with these starts, the first one fixed or not.
    fn crowd(free: bool, starts: &[[f64; 3]]) -> Crowd {
        let weighty = |(place, start): (usize, &[f64; 3])| Weighty {
            mass: 1.0,
            sphero_radius: 0.002,
            restitution: 0.3,
            start: Vec3::from(*start),
            bounding_radius: 0.05,
            projected_area: 0.01,
            speed_squared: 0.0,
            free: free || place > 0,
            lies_on_flow: false,
            fixed: !free && place == 0,
        };
        Crowd(starts.iter().enumerate().map(weighty).collect())
    }

    #[test]
    fn cells_across_leave_no_row_of_points_in_the_centre_plane() {
        // Eight points a cell are two across: any number of cells.
        assert_eq!(cells_across(9.2, 2.0), 9.0);
        assert_eq!(cells_across(9.2, 1.0), 10.0);
        assert_eq!(cells_across(8.9, 3.0), 8.0);
        assert_eq!(cells_across(10.3, 1.0), 10.0);
        // Few cells would become too long or too short.
        assert_eq!(cells_across(5.1, 1.0), 5.0);
        assert_eq!(cells_across(0.3, 1.0), 1.0);
    }

    // 10 cm of radii plus the difference in height.
    #[test]
    fn a_body_carries_what_can_come_to_rest_on_it() {
        let beside = [0.3, 0.0, 0.1];
        let on_top = [0.0, 0.09, 0.1];
        let down_the_slope = [-0.35, 0.0, 0.3];
        let lower = [0.0, 0.0, -0.1];
        let starts = [[0.0; 3], beside, on_top, down_the_slope, lower];
        assert_eq!(crowd(true, &starts).carried_by(0), 3.0);
        assert_eq!(crowd(false, &starts).carried_by(0), 2.0);
        assert_eq!(crowd(true, &starts).carried_by(1), 1.0);
        assert_eq!(crowd(true, &starts).carried_by(4), 5.0);
    }

    #[test]
    fn a_barrier_does_not_strike_by_its_own_mass() {
        assert_eq!(crowd(false, &[[0.0; 3]]).striking(0), (0.0, 0.0));
        assert_eq!(crowd(false, &[[0.0; 3]; 2]).striking(0), (1.0, 0.0));
    }
}
