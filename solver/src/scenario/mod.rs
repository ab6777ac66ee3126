//! The scenario: strict JSON in, validated description out.
//!
//! Every field with its meaning, unit, default and range is in
//! `docs/scenario.md`.

mod accuracy;
mod agreement;
mod area_rows;
mod body;
mod builder;
mod cells;
mod duration;
#[cfg(feature = "schema")]
mod fields;
mod fit;
mod ground;
mod maps;
mod motion;
mod node;
mod on_terrain;
mod parse;
mod placement;
mod places;
mod polygon;
mod position;
mod range;
mod reader;
mod reduction;
mod released_area;
mod releases_fit;
mod report;
mod rules;
#[cfg(feature = "schema")]
pub(crate) mod schema;
mod sections;
mod shape;
mod sharp_shape;
mod sliding_block;
mod sliding_points;
mod solid;
mod source;
mod terrain;
mod terrain_sections;
#[cfg(test)]
mod tests;

pub use crate::shape::RegularSolid;
pub use accuracy::{Accuracy, Quantity};
pub(crate) use area_rows::{MOST_POINTS, Measure, Window, squares_of};
pub use builder::{BodyBuilder, ScenarioBuilder};
pub use ground::Ground;
pub use maps::{MapUse, Maps, NamedMap};
pub use motion::Motion;
pub use node::excerpt;
pub use placement::{Pose, ReleaseBox, Support};
pub use position::{Place, Position};
pub use reduction::{Approach, Ending, Symmetry};
pub use shape::{FieldValue, REGULAR_SOLIDS, SHAPES, Shape, ShapeField, ShapeKind};
pub(crate) use sliding_block::SlidingBlock;
pub(crate) use sliding_points::SlidingPoints;
pub use solid::BuiltSolid;
pub use source::Source;
pub(crate) use terrain::ReleasedArea;
pub use terrain::{Coordinates, Terrain, TerrainRelease};

use crate::shape::{ShapeError, SpheroPolyhedron};
use serde::{Deserialize, Serialize};
use thiserror::Error;

#[cfg(feature = "schema")]
use {ground::GroundDocument, position::PositionDocument, source::SourceDocument};

/// A scenario. Fields with a default may be left out; the service's answer has all of them filled
/// in, and null stands for "automatic".
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Scenario {
    /// Free text.
    pub title: String,
    /// Ground: a channel or a terrain.
    #[serde(flatten)]
    #[cfg_attr(feature = "schema", schema(value_type = GroundDocument))]
    pub ground: Ground,
    /// The flow; `null`: no flow.
    pub flow: Option<Flow>,
    /// The bodies; `[]`: none.
    pub bodies: Vec<Body>,
    /// Gravity, along −z [m/s²].
    pub gravity_m_s2: f64,
    /// Simulated time [s]; 0 gives the start alone.
    pub duration_s: f64,
    /// Time between samples, which lie at its multiples and at the end [s]; changes no bit of the
    /// motion.
    pub sample_interval_s: f64,
    /// Number of snapshots of the flow, evenly spread, both ends included, each at the end of the
    /// step that holds its time; 1: the start.
    pub flow_snapshots: u32,
    /// Largest number of points in a snapshot of the flow, which is thinned evenly to it: the same
    /// material points in all snapshots.
    #[serde(default = "points_of_older_snapshots")]
    pub flow_snapshot_points: u32,
    /// Numerical choices.
    pub numerics: Numerics,
    /// Accuracy asked of the answer.
    pub accuracy: Accuracy,
}

/// Points in a snapshot of scenarios that were stored before they said it.
fn points_of_older_snapshots() -> u32 {
    5_000
}

/// Incline and floor between two side walls. x runs downstream and is 0 at the foot of the
/// incline; y runs across and is 0 on the centre line; z runs up and is 0 on the floor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Channel {
    /// Inclination θ of the incline [°].
    pub inclination_deg: f64,
    /// Horizontal length l0 of the incline [m].
    pub incline_length_m: f64,
    /// Horizontal length l1 of the floor [m].
    pub runout_length_m: f64,
    /// Distance between the side walls [m].
    pub width_m: f64,
    /// Coulomb friction between flow and incline or floor.
    pub base_friction: f64,
    /// Coulomb friction between flow and the vertical walls (sides and back).
    pub side_friction: f64,
}

/// The granular flow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Flow {
    /// Released material.
    #[serde(flatten)]
    #[cfg_attr(feature = "schema", schema(value_type = SourceDocument))]
    pub source: Source,
    /// Material.
    pub material: Material,
}

/// The release: as wide as the channel, with vertical front and back and an upper face parallel to
/// the slope.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Release {
    /// Thickness normal to the slope [m].
    pub height_m: f64,
    /// Horizontal distance of the front from the foot [m].
    pub toe_distance_m: f64,
}

/// Granular material.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Material {
    /// Density of the bulk at rest [kg/m³].
    pub bulk_density_kg_m3: f64,
    /// Density of a grain [kg/m³].
    pub grain_density_kg_m3: f64,
    /// Diameter d of a grain in the inertial number [m].
    pub grain_diameter_m: f64,
    /// Friction at rest μ_s.
    pub static_friction: f64,
    /// Friction at large inertial number μ_2; equal to μ_s: Drucker–Prager.
    pub limiting_friction: f64,
    /// Inertial number I0 half-way between the two frictions.
    pub reference_inertial_number: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// Young's modulus [Pa]; `null`: from the sound speed.
    pub youngs_modulus_pa: Option<f64>,
}

/// A rigid body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Body {
    /// The shape before rounding: `{"cube": {…}}`.
    pub shape: Shape,
    /// Radius of the sphere that rounds edges and vertices [m].
    pub sphero_radius_m: f64,
    /// Density [kg/m³].
    pub density_kg_m3: f64,
    /// Initial position of its centre.
    #[cfg_attr(feature = "schema", schema(value_type = PositionDocument))]
    pub position: Position,
    /// Turn about the normal of the bed under the centre, x towards y [°].
    pub yaw_deg: f64,
    /// Quaternion [w, x, y, z] from body axes to those of the ground, instead of yaw.
    pub orientation: Option<[f64; 4]>,
    /// Velocity of the centre at the start [m/s].
    pub velocity_m_s: [f64; 3],
    /// Angular velocity at the start, in the axes of the ground [rad/s].
    pub angular_velocity_rad_s: [f64; 3],
    /// Coulomb friction with walls and other bodies; of two bodies √(μ_A μ_B).
    pub friction: f64,
    /// Restitution with walls and other bodies.
    pub restitution: f64,
    /// Rolling resistance on walls and other bodies: the couple of a contact is at most this × its
    /// equivalent radius × its normal force; of two bodies the larger.
    pub rolling_friction: f64,
    /// Coulomb friction with the flow.
    pub flow_friction: f64,
    /// Restitution with the flow.
    pub flow_restitution: f64,
    /// Hertz contact modulus E* with rigid walls [Pa]; of two bodies 1/E* = 1/E_A + 1/E_B.
    pub contact_modulus_pa: Option<f64>,
    /// A fixed body is a barrier.
    pub fixed: bool,
    /// Prescribed motion of the body, whatever acts on it; `null`: it is free, or fixed.
    pub motion: Option<Motion>,
    /// The solid of these dimensions, built at its first use.
    #[serde(skip)]
    pub solid: BuiltSolid,
}

impl Body {
    /// The rounded solid of its shape.
    pub(crate) fn build(&self) -> Result<SpheroPolyhedron, ShapeError> {
        self.solid.of(&self.shape, self.sphero_radius_m)
    }
}

/// Numerical choices; null: automatic.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Numerics {
    /// Size of a grid cell [m].
    pub cell_size_m: Option<f64>,
    /// Material points per cell.
    pub points_per_cell: u32,
    /// √(K/ρ) of the bulk [m/s]; not together with `youngs_modulus_pa`.
    pub sound_speed_m_s: Option<f64>,
    /// Courant number of the acoustic sub-step.
    pub courant: Option<f64>,
    /// Courant number of the flow's own step.
    pub flow_courant: Option<f64>,
    /// Arithmetic of points and grid.
    pub precision: Precision,
    /// Use of the symmetry of a scene about the centre plane: computation by halves.
    pub symmetry: Symmetry,
    /// Computation of a flow before it varies across the channel.
    pub approach: Approach,
    /// Formulation of contacts between points and bodies.
    pub coupling: Coupling,
    /// End of the run.
    pub ending: Ending,
    /// Solver threads.
    pub threads: Option<usize>,
}

/// Contact formulation between points and bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Coupling {
    /// A point's centre keeps a distance of half the point spacing.
    #[default]
    HalfSpacing,
    /// A point is a sphere of its own volume (source paper, P3).
    SourcePaper,
}

/// Arithmetic precision of points and grid; bodies, time and audits are in 64 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Precision {
    /// 32 bits, the faster choice.
    #[default]
    Single,
    /// 64 bits, the reference.
    Double,
}

/// One violated rule of a scenario.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Violation {
    /// JSON pointer (RFC 6901) of the field, "" for the whole document.
    pub pointer: String,
    /// The value received (null if missing; long texts cut, of large objects and
    /// lists only the size).
    pub value: serde_json::Value,
    /// Allowed values, in words or as a range such as "0 < x <= 89".
    pub allowed: String,
    /// Unit of value and range, if it has one.
    pub unit: Option<String>,
    /// One sentence for people.
    pub detail: String,
}

/// Error of a text that is not a valid scenario.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ScenarioError {
    /// No JSON.
    #[error("not JSON: {message} (line {line}, column {column})")]
    Malformed {
        /// The parser's message.
        message: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
    },
    /// JSON, but not a valid scenario: all violations, in document order.
    #[error("{} violation(s) in the scenario", .0.len())]
    Invalid(Vec<Violation>),
}
