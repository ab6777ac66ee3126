//! Plates with prescribed motion through a bed, and the force on them.

use super::blocks::{Block, PER_CELL, elastic};
use super::run::{CaseError, Run};
use super::scenes::{GRAVITY, body};
use scree_solver::contact::law::damping_number;
use scree_solver::material::{Material, Yielding};
use scree_solver::math::Vec3;
use scree_solver::motion::{PrescribedMotion, Velocities};
use scree_solver::rigid::{Freedom, Prescribed};
use scree_solver::scenario::Precision;
use scree_solver::simulation::Scene;
use serde_json::json;
use std::ops::ControlFlow;

/// Density of the beds [kg/m³].
pub(super) const DENSITY: f64 = 1500.0;
/// Poisson's ratio of the beds.
pub(super) const POISSONS_RATIO: f64 = 0.3;
/// Friction of the rough plates with the bed.
const FRICTION: f64 = 0.4;
/// Side of a plate that is pushed [m].
pub(super) const SIDE: f64 = 0.1;
/// Travel over which the force on it is averaged, over its side.
pub(super) const WINDOW: [f64; 2] = [0.5, 0.8];
/// Travel at full speed during the duration of its ramp, over its side.
const RAMP: f64 = 0.2;

/// A bed with this friction at any rate (Drucker–Prager) and this sound speed [m/s].
pub(super) fn bed_material(friction: f64, sound_speed: f64) -> Material {
    let bulk_modulus = DENSITY * sound_speed * sound_speed;
    let youngs_modulus = 3.0 * (1.0 - 2.0 * POISSONS_RATIO) * bulk_modulus;
    Material {
        yielding: Yielding::Granular {
            static_friction: friction,
            limiting_friction: friction,
            reference_inertial_number: 0.279,
            grain_diameter: 1e-3,
            grain_density: 2600.0,
        },
        ..elastic(DENSITY, youngs_modulus, POISSONS_RATIO)
    }
}

/// A plate among points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plate {
    /// Its lowest and highest corner, on nodes [m].
    pub(super) corners: [Vec3; 2],
    /// Friction with the bed.
    pub(super) friction: f64,
    /// Velocity after the ramp [m/s].
    pub(super) velocity: Vec3,
    /// Duration of the ramp from rest [s].
    pub(super) ramp: f64,
}

impl Plate {
    /// The bed of a block with the plate in it.
    ///
    /// # Errors
    /// The plate is invalid.
    pub(super) fn within(&self, block: &Block) -> Result<Scene, CaseError> {
        let mut scene = block.bed(POISSONS_RATIO);
        // The pressure of a driven plate has no upper bound.
        let flow = scene.given.flow.insert(block.flow(f64::INFINITY));
        let sphere = flow.sphere;
        // Points that fill their volume up to the planes of the corners then just touch the plate.
        let inset = Vec3::repeat(sphere.radius - 0.5 * sphere.spacing);
        let [low, high] = [self.corners[0] + inset, self.corners[1] - inset];
        let sides: [f64; 3] = (high - low).into();
        let mut plate = body(&json!({
            "shape": {"box": {"sides_m": sides}}, "sphero_radius_m": 0.1 * sphere.spacing,
            "position": {"downstream_m": 0.0, "elevation_m": 0.5 * sides[2]}, "fixed": true,
        }))?;
        plate.flow_law = flow.contact_law(damping_number(0.0), self.friction);
        let start = 0.5 * (low + high);
        plate.state.position = start;
        plate.freedom = Freedom::Prescribed(Prescribed {
            start,
            motion: self.motion(),
        });
        let outside = 0.5 * sphere.radius;
        scene
            .points
            .retain(|point| plate.distance_to(&point.position) > outside);
        scene.bodies.push(plate);
        Ok(scene)
    }

    fn motion(&self) -> PrescribedMotion {
        let moving = Velocities {
            linear: self.velocity,
            ..Velocities::NONE
        };
        PrescribedMotion::table([(0.0, Velocities::NONE), (self.ramp, moving)])
    }
}

/// A rough plate of side [`SIDE`] that is pushed through a periodic bed at constant speed
/// after a ramp.
#[derive(Debug, Clone, Copy)]
pub(super) struct Push {
    /// Cells over the side.
    pub(super) cells: u32,
    /// Length, width and depth of the bed, in sides.
    pub(super) bed: [u32; 3],
    /// Material of the bed.
    pub(super) material: Material,
    /// Speed after the ramp [m/s].
    pub(super) speed: f64,
    /// Unit vector along which the plate moves.
    pub(super) direction: Vec3,
}

impl Push {
    /// The bed.
    pub(super) fn block(&self) -> Block {
        Block {
            cell: SIDE / f64::from(self.cells),
            at: [0, 0, 0],
            cells: self.bed.map(|sides| sides * self.cells),
            cells_across: self.bed[1] * self.cells,
            per_cell: PER_CELL,
            endless: true,
            material: self.material,
            gravity: GRAVITY,
            expected_speed: 2.0 * self.speed,
            precision: Precision::Single,
            duration: self.time_of(WINDOW[1]),
        }
    }

    /// Height of the bed's surface [m].
    pub(super) fn surface(&self) -> f64 {
        f64::from(self.bed[2]) * SIDE
    }

    /// Mean force over the window [N] on a plate that starts between these corners, and
    /// the run in which it was measured.
    ///
    /// # Errors
    /// The plate is invalid, or the computation fails.
    pub(super) fn force(&self, corners: [Vec3; 2]) -> Result<(Run, Vec3), CaseError> {
        let plate = Plate {
            corners,
            friction: FRICTION,
            velocity: self.direction * self.speed,
            ramp: self.ramp(),
        };
        let mut run = Run::start(plate.within(&self.block())?)?;
        run.to(self.time_of(WINDOW[0]))?;
        let force = mean_force(&mut run, self.time_of(WINDOW[1]))?;
        Ok((run, force))
    }

    fn ramp(&self) -> f64 {
        RAMP * SIDE / self.speed
    }

    /// Time at which the plate has travelled this many sides [s]: half of the ramp is lost.
    fn time_of(&self, travel: f64) -> f64 {
        travel * SIDE / self.speed + 0.5 * self.ramp()
    }
}

/// Mean force of the bed on the plate from the present to a time [N].
///
/// # Errors
/// The computation fails.
pub(super) fn mean_force(run: &mut Run, to_s: f64) -> Result<Vec3, CaseError> {
    let (mut impulse, mut duration) = (Vec3::zeros(), 0.0);
    run.watch(to_s, |simulation, report| {
        impulse += simulation.flow_load(0).load.force * report.substep_s;
        duration += report.substep_s;
        ControlFlow::Continue(())
    })?;
    if duration > 0.0 {
        Ok(impulse / duration)
    } else {
        Err(CaseError::Never(
            "no time passed while the force was measured",
        ))
    }
}
