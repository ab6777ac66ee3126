//! A layer of glass beads on a rough slope without end, and its exact profile.
//!
//! Velocity u(y) at height y of a steady layer of height h, inclined by θ, follows
//! from μ(I) = tan θ at every height (Bagnold):
//!
//! u = ⅔ (I/d) √(φ g cos θ) [h^1.5 − (h − y)^1.5],   I = I0 (tan θ − μ_s)/(μ_2 − tan θ).

use super::beads;
use super::blocks::Block;
use super::run::{CaseError, Run};
use super::scenes::{GRAVITY, tilted_gravity};
use scree_solver::Simulation;
use scree_solver::bed::PlanarBed;
use scree_solver::material::{Material, Yielding};
use scree_solver::math::{Sym3, Vec3};
use scree_solver::points::Point;
use scree_solver::scenario::Precision;
use scree_solver::simulation::Scene;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Height of the layer [m].
pub(super) const HEIGHT: f64 = 0.02;
/// Diameter of a grain [m].
const GRAIN_DIAMETER: f64 = 0.53e-3;
/// Sound speed over that of the surface, or over √(g h) if that is larger.
const STIFFNESS: f64 = 10.0;
/// Length of the layer [cells]; it is periodic.
const ALONG: u32 = 4;
/// Width of the random scatter of points about their lattice, over their distance: on a
/// lattice they would travel in rows, which does not happen in a flow.
const SCATTER: f64 = 0.2;
/// Friction of the floor: high enough to prevent slip.
const ROUGH: f64 = 1e6;
/// Time between two samples of a window [s].
const BETWEEN_LOOKS: f64 = 0.004;

/// Slope and resolution of a layer.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slope {
    /// Inclination [°].
    pub(super) inclination_deg: f64,
    /// Cells over the height.
    pub(super) cells: u32,
    /// Points per cell and axis.
    pub(super) per_cell: u32,
    /// Slope whose profile it starts with [°]; if it is too flat for
    /// a flow, the layer starts at rest.
    pub(super) start_deg: f64,
    /// Longest duration of the run [s].
    pub(super) duration: f64,
}

/// Means over a window of time.
#[derive(Debug, Clone)]
pub(super) struct Means {
    /// Downhill velocity of layers of equal mass, lowest first [m/s].
    speeds: Vec<f64>,
    /// Height of the mass centre [m].
    pub(super) centre: f64,
}

/// Inertial number of a steady layer; none on a slope that holds the beads at rest.
fn inertial_number(inclination_deg: f64) -> f64 {
    let tangent = inclination_deg.to_radians().tan();
    let (at_rest, limiting) = beads::FRICTION;
    let share = (tangent - at_rest) / (limiting - tangent);
    beads::REFERENCE_INERTIAL_NUMBER * share.max(0.0)
}

/// Exact velocity u(y) [m/s].
pub(super) fn exact_speed(inclination_deg: f64, y: f64) -> f64 {
    let packing = beads::BULK_DENSITY / beads::GRAIN_DENSITY;
    let cos = inclination_deg.to_radians().cos();
    let rate = inertial_number(inclination_deg) / GRAIN_DIAMETER * (packing * GRAVITY * cos).sqrt();
    2.0 / 3.0 * rate * (HEIGHT.powf(1.5) - (HEIGHT - y).max(0.0).powf(1.5))
}

/// d ln u / d ln μ: change of speed in percent for one percent of friction.
pub(super) fn leverage(inclination_deg: f64) -> f64 {
    let tangent = inclination_deg.to_radians().tan();
    let (at_rest, limiting) = beads::FRICTION;
    tangent * (1.0 / (tangent - at_rest) + 1.0 / (limiting - tangent))
}

/// Wave speed √(g h) [m/s].
pub(super) fn wave_speed() -> f64 {
    (GRAVITY * HEIGHT).sqrt()
}

impl Slope {
    fn cell(&self) -> f64 {
        HEIGHT / f64::from(self.cells)
    }

    /// Largest expected speed of the flow [m/s].
    fn fastest(&self) -> f64 {
        let steepest = self.inclination_deg.max(self.start_deg);
        exact_speed(steepest, HEIGHT).max(wave_speed())
    }

    /// Material with Poisson's ratio 0, so that G = 1.5 K: the sub-step is the same as with a
    /// softer one, that of a lone point, and the normal stresses caused by elastic shear, of order
    /// τ²/G and absent from the exact profile, stay small.
    fn material(&self) -> Material {
        let beads = beads::with_sound_speed(STIFFNESS * self.fastest());
        Material {
            shear_modulus: 1.5 * beads.bulk_modulus,
            yielding: Yielding::Granular {
                static_friction: beads::FRICTION.0,
                limiting_friction: beads::FRICTION.1,
                reference_inertial_number: beads::REFERENCE_INERTIAL_NUMBER,
                grain_diameter: GRAIN_DIAMETER,
                grain_density: beads::GRAIN_DENSITY,
            },
            ..beads
        }
    }

    /// The layer at its start.
    pub(super) fn scene(&self) -> Scene {
        let block = Block {
            cell: self.cell(),
            at: [0, 0, 0],
            cells: [ALONG, 1, self.cells],
            cells_across: 1,
            per_cell: self.per_cell,
            endless: true,
            material: self.material(),
            gravity: GRAVITY,
            expected_speed: self.fastest(),
            precision: Precision::Single,
            duration: self.duration,
        };
        let mut scene = block.scene();
        scene.given.gravity = tilted_gravity(self.inclination_deg);
        scene.given.walls.bed = Arc::new(PlanarBed::floor(ROUGH));
        let mut chance = Chance(1);
        let spacing = self.cell() / f64::from(self.per_cell);
        for point in &mut scene.points {
            // Half as wide across the channel, since the symmetry planes are near.
            let scatter = Vec3::new(chance.next(), 0.5 * chance.next(), chance.next());
            point.position += scatter * (SCATTER * spacing);
            self.set_off(point, &block.material);
        }
        scene
    }

    /// Sets a point's stress by its depth and its velocity by its height.
    fn set_off(&self, point: &mut Point, material: &Material) {
        let gravity = tilted_gravity(self.inclination_deg);
        let above = beads::BULK_DENSITY * (HEIGHT - point.position.z).max(0.0);
        let pressed = -gravity.z * above;
        point.volume = point.mass / material.density(pressed);
        point.stress = Sym3 {
            xz: gravity.x * above,
            ..Sym3::isotropic(-pressed)
        };
        point.velocity.x = exact_speed(self.start_deg, point.position.z);
    }

    /// Means from the present time of the run until `to` [s].
    pub(super) fn means(&self, run: &mut Run, to: f64) -> Result<Means, CaseError> {
        let mut sum = Means {
            speeds: vec![0.0; (self.cells * self.per_cell) as usize],
            centre: 0.0,
        };
        let (mut looks, mut last) = (0.0, run.simulation.time_s());
        run.watch(to, |simulation, report| {
            if report.step_ended && report.time_s >= last + BETWEEN_LOOKS {
                sum.add(simulation);
                looks += 1.0;
                last = report.time_s;
            }
            ControlFlow::Continue(())
        })?;
        sum.centre /= looks;
        sum.speeds.iter_mut().for_each(|speed| *speed /= looks);
        Ok(sum)
    }
}

impl Means {
    fn add(&mut self, simulation: &Simulation) {
        let mut points = Vec::with_capacity(simulation.point_count());
        simulation.visit_points(None, |p| points.push((p.position.z, p.velocity.x)));
        points.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let layer = points.len() / self.speeds.len();
        for (speed, points) in self.speeds.iter_mut().zip(points.chunks_exact(layer)) {
            *speed += points.iter().map(|point| point.1).sum::<f64>() / layer as f64;
        }
        self.centre += points.iter().map(|point| point.0).sum::<f64>() / points.len() as f64;
    }

    /// Height of a layer's middle if the layer is as dense as at rest [m].
    fn height(&self, layer: usize) -> f64 {
        HEIGHT * (layer as f64 + 0.5) / self.speeds.len() as f64
    }

    /// Speed of the topmost layer [m/s], and the exact value.
    pub(super) fn surface(&self, inclination_deg: f64) -> (f64, f64) {
        let top = self.speeds.len() - 1;
        (
            self.speeds[top],
            exact_speed(inclination_deg, self.height(top)),
        )
    }

    /// Root mean square difference from the exact profile, over that of the profile.
    pub(super) fn off(&self, inclination_deg: f64) -> f64 {
        let (mut off, mut whole) = (0.0, 0.0);
        for (layer, speed) in self.speeds.iter().enumerate() {
            let exact = exact_speed(inclination_deg, self.height(layer));
            off += (speed - exact).powi(2);
            whole += exact * exact;
        }
        (off / whole).sqrt()
    }
}

/// Speed of the fastest point [m/s].
pub(super) fn fastest(simulation: &Simulation) -> f64 {
    let mut fastest = 0.0f64;
    simulation.visit_points(None, |point| fastest = fastest.max(point.velocity.norm()));
    fastest
}

/// Reproducible random numbers, uniform from −½ to ½.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        let next = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = next.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64 - 0.5
    }
}
