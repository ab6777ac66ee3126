//! The scenario.

use super::{AccuracyDocument, ShapeDocument};
use serde::Serialize;
use utoipa::ToSchema;

/// A scenario. Fields with a default may be left out; the service's answer has
/// all of them filled in, and null stands for "automatic".
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Scenario)]
pub struct ScenarioDocument {
    /// Free text.
    #[schema(required = false)]
    pub title: String,
    /// Incline and floor between two side walls.
    pub channel: ChannelDocument,
    /// The granular flow; null for none.
    #[schema(required = true)]
    pub flow: Option<FlowDocument>,
    /// The rigid bodies.
    pub bodies: Vec<BodyDocument>,
    /// Gravity [m/s²].
    #[schema(required = false)]
    pub gravity_m_s2: f64,
    /// Simulated time [s]; by default 3, or the expected duration of the flow.
    #[schema(required = false)]
    pub duration_s: f64,
    /// Time between samples [s]; samples lie at k · interval and at the end.
    #[schema(required = false)]
    pub sample_interval_s: f64,
    /// Number of snapshots of the flow, spread evenly over the run.
    #[schema(required = false)]
    pub flow_snapshots: u32,
    /// Numerical choices.
    #[schema(required = false)]
    pub numerics: NumericsDocument,
    /// Requested accuracy of the answer.
    #[schema(required = false)]
    pub accuracy: AccuracyDocument,
}

/// Incline and floor between two side walls. x runs downstream and is 0 at the foot of the
/// incline; y runs across and is 0 on the centre line; z runs up and is 0 on the floor.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Channel)]
pub struct ChannelDocument {
    /// Inclination of the inclined part [°].
    pub inclination_deg: f64,
    /// Horizontal length of the inclined part [m].
    pub incline_length_m: f64,
    /// Horizontal length of the floor [m].
    pub runout_length_m: f64,
    /// Distance between the side walls [m].
    #[schema(required = false)]
    pub width_m: f64,
    /// Coulomb friction between flow and incline or floor.
    #[schema(required = false)]
    pub base_friction: f64,
    /// Coulomb friction between flow and the vertical walls.
    #[schema(required = false)]
    pub side_friction: f64,
}

/// The granular flow.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Flow)]
pub struct FlowDocument {
    /// Released volume [m³].
    pub volume_m3: f64,
    /// Position and shape of the release.
    #[schema(required = false)]
    pub release: ReleaseDocument,
    /// Material.
    #[schema(required = false)]
    pub material: MaterialDocument,
}

/// The release: as wide as the channel, with vertical front and back and an upper face parallel
/// to the slope.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Release)]
pub struct ReleaseDocument {
    /// Thickness normal to the slope [m].
    #[schema(required = false)]
    pub height_m: f64,
    /// Horizontal distance of the front from the foot of the incline [m].
    #[schema(required = false)]
    pub toe_distance_m: f64,
}

/// Granular material.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Material)]
pub struct MaterialDocument {
    /// Density of the bulk at rest [kg/m³].
    #[schema(required = false)]
    pub bulk_density_kg_m3: f64,
    /// Density of a grain [kg/m³].
    #[schema(required = false)]
    pub grain_density_kg_m3: f64,
    /// Diameter of a grain [m].
    #[schema(required = false)]
    pub grain_diameter_m: f64,
    /// Friction at rest.
    #[schema(required = false)]
    pub static_friction: f64,
    /// Friction at large inertial number.
    #[schema(required = false)]
    pub limiting_friction: f64,
    /// Inertial number at which friction is half-way between the two.
    #[schema(required = false)]
    pub reference_inertial_number: f64,
    /// Poisson's ratio.
    #[schema(required = false)]
    pub poissons_ratio: f64,
    /// Young's modulus [Pa]; null: derived from the sound speed.
    pub youngs_modulus_pa: Option<f64>,
}

/// A rigid body.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Body)]
pub struct BodyDocument {
    /// Shape.
    pub shape: ShapeDocument,
    /// Sphero radius, the radius of the rounding sphere [m]; of a ball or capsule its own.
    #[schema(required = false)]
    pub sphero_radius_m: f64,
    /// Density [kg/m³].
    #[schema(required = false)]
    pub density_kg_m3: f64,
    /// Initial position of its centre.
    #[schema(required = false)]
    pub position: PositionDocument,
    /// Angle by which the body is turned about the normal of the bed [°].
    #[schema(required = false)]
    pub yaw_deg: f64,
    /// Orientation [w, x, y, z], instead of `yaw_deg`.
    pub orientation: Option<[f64; 4]>,
    /// Initial velocity [m/s].
    #[schema(required = false)]
    pub velocity_m_s: [f64; 3],
    /// Initial angular velocity, world axes [rad/s].
    #[schema(required = false)]
    pub angular_velocity_rad_s: [f64; 3],
    /// Coulomb friction with walls and other bodies.
    #[schema(required = false)]
    pub friction: f64,
    /// Restitution with walls and other bodies.
    #[schema(required = false)]
    pub restitution: f64,
    /// Rolling resistance on walls and other bodies: the couple of a contact is
    /// at most this × its equivalent radius × its normal force.
    #[schema(required = false)]
    pub rolling_friction: f64,
    /// Coulomb friction with the flow.
    #[schema(required = false)]
    pub flow_friction: f64,
    /// Restitution with the flow.
    #[schema(required = false)]
    pub flow_restitution: f64,
    /// Hertz contact modulus E* with rigid walls, of two bodies
    /// 1/E* = 1/E_A + 1/E_B [Pa]; null: automatic.
    pub contact_modulus_pa: Option<f64>,
    /// True if the body is fixed: a barrier.
    #[schema(required = false)]
    pub fixed: bool,
    /// Prescribed motion, whatever load acts on the body; null: the body is free or fixed.
    pub motion: Option<MotionDocument>,
}

/// Prescribed motion of a body, in channel axes.
#[derive(Debug, Serialize, ToSchema)]
#[serde(untagged)]
#[schema(as = Motion)]
pub enum MotionDocument {
    /// Motion by a table: velocities are linear between its times, and constant before
    /// the first and after the last one.
    Table {
        /// Times, in increasing order [s].
        times_s: Vec<f64>,
        /// Velocity of the centre at each time [m/s].
        #[schema(required = false)]
        velocity_m_s: Vec<[f64; 3]>,
        /// Angular velocity at each time [rad/s].
        #[schema(required = false)]
        angular_velocity_rad_s: Vec<[f64; 3]>,
    },
    /// Constant motion.
    Constant {
        /// Velocity of the centre [m/s].
        #[schema(required = false)]
        velocity_m_s: [f64; 3],
        /// Angular velocity [rad/s].
        #[schema(required = false)]
        angular_velocity_rad_s: [f64; 3],
    },
}

/// Centre of a body.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Position)]
pub struct PositionDocument {
    /// x [m].
    #[schema(required = false)]
    pub downstream_m: f64,
    /// y [m].
    #[schema(required = false)]
    pub lateral_m: f64,
    /// z [m]; null: resting on the floor or flat on the incline.
    pub elevation_m: Option<f64>,
}

/// Numerical choices; null: automatic.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Numerics)]
pub struct NumericsDocument {
    /// Cell size [m].
    pub cell_size_m: Option<f64>,
    /// Material points per cell.
    #[schema(required = false)]
    pub points_per_cell: u32,
    /// Sound speed in the flow, √(K/ρ) [m/s].
    pub sound_speed_m_s: Option<f64>,
    /// Courant number of the acoustic sub-step.
    pub courant: Option<f64>,
    /// Courant number of the flow, which sets the step.
    pub flow_courant: Option<f64>,
    /// Arithmetic precision of points and grid.
    #[schema(required = false)]
    pub precision: PrecisionDocument,
    /// Computation of a scene that is symmetric about the centre plane: in full or as
    /// a symmetric half.
    #[schema(required = false)]
    pub symmetry: SymmetryDocument,
    /// Computation of a flow that does not vary across the channel yet.
    #[schema(required = false)]
    pub approach: ApproachDocument,
    /// Contact formulation between points and bodies.
    #[schema(required = false)]
    pub coupling: CouplingDocument,
    /// Condition that ends the run.
    #[schema(required = false)]
    pub ending: EndingDocument,
    /// Number of solver threads; at most that of a worker.
    pub threads: Option<u32>,
}

/// Arithmetic precision of points and grid; bodies, time and audits are in 64 bits.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Precision)]
pub enum PrecisionDocument {
    /// 32 bits, the faster choice.
    Single,
    /// 64 bits, the reference.
    Double,
}

/// Computation of a scene that is symmetric about the centre plane.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Symmetry)]
pub enum SymmetryDocument {
    /// As a symmetric half where that is exact.
    Auto,
    /// In full.
    Full,
    /// As a symmetric half; a scene that is not symmetric is refused.
    Mirror,
}

/// Computation of a flow that does not vary across the channel yet.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Approach)]
pub enum ApproachDocument {
    /// As a quasi-2D slab of one cell where that is exact.
    Auto,
    /// Over the full width.
    Full,
    /// As a quasi-2D slab; a scene that varies across the channel from the start is refused.
    Slab,
}

/// Contact formulation between points and bodies.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Coupling)]
pub enum CouplingDocument {
    /// A point's centre keeps a distance of half the point spacing.
    HalfSpacing,
    /// A point is a sphere of its own volume (source paper, P3).
    SourcePaper,
}

/// Condition that ends a run.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Ending)]
pub enum EndingDocument {
    /// Early stop once nothing can move a body or the front any more; at the latest after the
    /// duration.
    Auto,
    /// At the end of the duration.
    Full,
}
