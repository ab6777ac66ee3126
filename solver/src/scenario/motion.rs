//! The prescribed motion of a body: its description and its reader.

use super::node::Node;
use super::range::short;
use super::reader::{Object, Several};
use super::rules::{ANGULAR_VELOCITY, MOTION_TIME, MOTION_TIMES, VELOCITY};
use crate::motion::{PrescribedMotion, Velocities};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Prescribed motion of a body, in channel axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(untagged)]
#[non_exhaustive]
pub enum Motion {
    /// Motion by a table: velocities are linear between its times, and constant before the first
    /// and after the last one.
    Table {
        /// Times of a table, each after the one before [s]; left out: constant velocities.
        times_s: Vec<f64>,
        /// Velocity of the centre at each of the times, in channel axes [m/s]; without times a
        /// single one.
        velocity_m_s: Vec<[f64; 3]>,
        /// Angular velocity about the centre at each of the times, in channel axes [rad/s];
        /// without times a single one.
        angular_velocity_rad_s: Vec<[f64; 3]>,
    },
    /// Constant motion.
    Constant {
        /// Velocity of the centre, in channel axes [m/s].
        velocity_m_s: [f64; 3],
        /// Angular velocity about the centre, in channel axes [rad/s].
        angular_velocity_rad_s: [f64; 3],
    },
}

impl Motion {
    /// The motion in the solver's terms.
    ///
    /// # Panics
    /// If the motion did not come from the parser, which refuses invalid tables.
    pub fn prescribed(&self) -> PrescribedMotion {
        let velocities = |linear: &[f64; 3], angular: &[f64; 3]| Velocities {
            linear: Vector3::from(*linear),
            angular: Vector3::from(*angular),
        };
        match self {
            Self::Constant {
                velocity_m_s,
                angular_velocity_rad_s,
            } => PrescribedMotion::constant(velocities(velocity_m_s, angular_velocity_rad_s)),
            Self::Table {
                times_s,
                velocity_m_s,
                angular_velocity_rad_s,
            } => {
                let rows = velocity_m_s.iter().zip(angular_velocity_rad_s);
                let rows = rows.map(|(linear, angular)| velocities(linear, angular));
                PrescribedMotion::table(times_s.iter().copied().zip(rows))
            }
        }
    }
}

/// The motion of a body, if it is given; a refused one is `None`.
pub(super) fn read_motion(body: &Object<'_>) -> Option<Option<Motion>> {
    let node = match body.member("motion") {
        None | Some(Node::Null) => return Some(None),
        Some(node) => node,
    };
    let object = body.object(node, "motion")?;
    // Rows without times are a table, too: one without its times.
    let motion = if object.member(MOTION_TIME.key).is_some() || has_rows(&object) {
        read_table(&object)
    } else {
        read_constant(&object)
    };
    object.refuse_unknown();
    motion.map(Some)
}

/// True if a velocity is a list of lists.
fn has_rows(object: &Object<'_>) -> bool {
    let is_list = |node: &Node| matches!(node, Node::List(_));
    [&VELOCITY, &ANGULAR_VELOCITY].iter().any(|rule| {
        let node = object.member(rule.key);
        matches!(node, Some(Node::List(items)) if items.iter().any(is_list))
    })
}

fn read_constant(object: &Object<'_>) -> Option<Motion> {
    let velocity_m_s = object.vector(&VELOCITY);
    let angular_velocity_rad_s = object.vector(&ANGULAR_VELOCITY);
    Some(Motion::Constant {
        velocity_m_s: velocity_m_s?,
        angular_velocity_rad_s: angular_velocity_rad_s?,
    })
}

fn read_table(object: &Object<'_>) -> Option<Motion> {
    let times_s = object.numbers(&MOTION_TIME, &Several::new(MOTION_TIMES, ["time", "times"]));
    let times_s = times_s.filter(|times| times_ascend(object, times));
    // The required number of velocities is known for valid times only.
    let rows = |times: &Vec<f64>| times.len()..=times.len();
    let several = Several::new(
        times_s.as_ref().map_or(MOTION_TIMES, rows),
        ["velocity", "velocities"],
    );
    let velocities = [&VELOCITY, &ANGULAR_VELOCITY].map(|rule| {
        object.member(rule.key).map_or_else(
            || Some(vec![[0.0; 3]; times_s.as_ref().map_or(0, Vec::len)]),
            |_| object.vectors(rule, &several),
        )
    });
    let [velocity_m_s, angular_velocity_rad_s] = velocities;
    Some(Motion::Table {
        times_s: times_s?,
        velocity_m_s: velocity_m_s?,
        angular_velocity_rad_s: angular_velocity_rad_s?,
    })
}

/// True if every time is after the one before; the first that is not is refused.
fn times_ascend(object: &Object<'_>, times: &[f64]) -> bool {
    let Some(before) = times.windows(2).position(|pair| pair[0] >= pair[1]) else {
        return true;
    };
    let bound = short(times[before]);
    let pointer = format!("{}/{}", object.pointer_to(MOTION_TIME.key), before + 1);
    let why = format!(
        "is {}, not after the time before it ({bound})",
        short(times[before + 1])
    );
    let allowed = format!("x > {bound}");
    object
        .report
        .refuse(&pointer, &allowed, MOTION_TIME.unit, &why);
    false
}
