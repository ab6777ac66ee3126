//! The scenario: strict JSON in, validated description out.
//!
//! Every field with its meaning, unit, default and range is in
//! `docs/scenario.md`.

mod accuracy;
mod agreement;
mod body;
mod duration;
mod fit;
mod motion;
mod node;
mod parse;
mod placement;
mod range;
mod reader;
mod reduction;
mod report;
mod rules;
mod sections;
mod shape;
#[cfg(test)]
mod tests;

pub use crate::shape::RegularSolid;
pub use accuracy::{Accuracy, Quantity};
pub use motion::Motion;
pub use node::excerpt;
pub use placement::{Pose, ReleaseBox, Support};
pub use reduction::{Approach, Ending, Symmetry};
pub use shape::{FieldValue, REGULAR_SOLIDS, SHAPES, Shape, ShapeField, ShapeKind};

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A validated scenario. Serialised, it is the scenario's JSON with every
/// default filled in; `None` stands for "automatic".
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scenario {
    /// Free text.
    pub title: String,
    /// The channel.
    pub channel: Channel,
    /// The granular flow; `None`: no flow.
    pub flow: Option<Flow>,
    /// The rigid bodies.
    pub bodies: Vec<Body>,
    /// Gravity [m/s²].
    pub gravity_m_s2: f64,
    /// Simulated time [s].
    pub duration_s: f64,
    /// Time between samples [s]: samples lie at k · interval and at the end.
    pub sample_interval_s: f64,
    /// Snapshots of the flow, at equal intervals over the run, both ends included.
    pub flow_snapshots: u32,
    /// Numerical choices.
    pub numerics: Numerics,
    /// Accuracy asked for.
    pub accuracy: Accuracy,
}

/// Incline and floor between two side walls.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Channel {
    /// Inclination of the inclined part [°].
    pub inclination_deg: f64,
    /// Horizontal length l0 of the inclined part [m].
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
pub struct Flow {
    /// Released volume [m³].
    pub volume_m3: f64,
    /// Release.
    pub release: Release,
    /// Material.
    pub material: Material,
}

/// Shape of the release: the whole width, vertical front and back, upper face
/// parallel to the slope.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Release {
    /// Thickness normal to the slope [m].
    pub height_m: f64,
    /// Horizontal distance of the front from the foot of the incline [m].
    pub toe_distance_m: f64,
}

/// Granular material.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Density of the bulk at rest, ρ_c [kg/m³].
    pub bulk_density_kg_m3: f64,
    /// Density of a grain, ρ_s [kg/m³].
    pub grain_density_kg_m3: f64,
    /// Diameter of a grain, d [m].
    pub grain_diameter_m: f64,
    /// Friction at rest, μ_s.
    pub static_friction: f64,
    /// Friction at large inertial number, μ_2 (equal to μ_s: Drucker–Prager).
    pub limiting_friction: f64,
    /// Inertial number I0.
    pub reference_inertial_number: f64,
    /// Poisson's ratio ν.
    pub poissons_ratio: f64,
    /// Young's modulus E [Pa]; `None`: from the sound speed.
    pub youngs_modulus_pa: Option<f64>,
}

/// A rigid body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// Shape.
    pub shape: Shape,
    /// Radius of the rounding sphere, r [m]; of a ball or capsule its own.
    pub sphero_radius_m: f64,
    /// Density [kg/m³].
    pub density_kg_m3: f64,
    /// Position of its centre at the start.
    pub position: Position,
    /// Turn about the normal of its support [°].
    pub yaw_deg: f64,
    /// Free orientation [w, x, y, z] instead of `yaw_deg`.
    pub orientation: Option<[f64; 4]>,
    /// Initial velocity [m/s].
    pub velocity_m_s: [f64; 3],
    /// Initial angular velocity, world axes [rad/s].
    pub angular_velocity_rad_s: [f64; 3],
    /// Coulomb friction with walls and other bodies.
    pub friction: f64,
    /// Restitution with walls and other bodies.
    pub restitution: f64,
    /// Rolling resistance on walls and other bodies: the couple of a contact is
    /// at most this × its equivalent radius × its normal force.
    pub rolling_friction: f64,
    /// Coulomb friction with the flow.
    pub flow_friction: f64,
    /// Restitution with the flow.
    pub flow_restitution: f64,
    /// Hertz contact modulus E* with rigid walls [Pa], of two bodies
    /// 1/E* = 1/E_A + 1/E_B; `None`: by equation 33 of `docs/method.md`.
    pub contact_modulus_pa: Option<f64>,
    /// A fixed body is a barrier.
    pub fixed: bool,
    /// Prescribed motion, whatever acts on it; `None`: it is fixed or free.
    pub motion: Option<Motion>,
}

/// Centre of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Position {
    /// x [m].
    pub downstream_m: f64,
    /// y [m].
    pub lateral_m: f64,
    /// z [m]; `None`: resting on the floor or flat on the incline.
    pub elevation_m: Option<f64>,
}

/// Numerical choices; `None`: automatic.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Numerics {
    /// Cell size h [m].
    pub cell_size_m: Option<f64>,
    /// Material points per cell.
    pub points_per_cell: u32,
    /// √(K/ρ) [m/s].
    pub sound_speed_m_s: Option<f64>,
    /// Courant number of the acoustic sub-step.
    pub courant: Option<f64>,
    /// Courant number of the flow's step.
    pub flow_courant: Option<f64>,
    /// Arithmetic of points and grid.
    pub precision: Precision,
    /// Use of a scene's symmetry: computation by halves.
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

/// Formulation of contacts between points and bodies. As JSON `"half_spacing"` or
/// `"source_paper"`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Coupling {
    /// A point's centre stands off by half the point spacing, where the continuum's
    /// surface is; the overlap carries the largest pressure expected.
    #[default]
    HalfSpacing,
    /// A point is a sphere of its own volume, as stiff as the material (P3).
    SourcePaper,
}

/// Arithmetic of the flow, its points and its grid; bodies, time and audits are
/// in f64 either way. As JSON `"single"` or `"double"`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Precision {
    /// 32 bits, sixteen points at a time.
    #[default]
    Single,
    /// The plain reference path, in f64.
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
