//! The columns of a trajectory by name, and their cells as text and as bytes.

use crate::results::columns::TrajectoryColumns;
use scree_solver::record::Mode;
use std::borrow::Cow;
use std::fmt::Write as _;
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{ObjectBuilder, Schema, Type};
use utoipa::{PartialSchema, ToSchema};

/// A column of a trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field(usize);

/// Names of the columns, in the document's order.
const NAMES: [&str; 14] = [
    "time_s",
    "position_m",
    "orientation",
    "velocity_m_s",
    "angular_velocity_rad_s",
    "flow_force_n",
    "flow_torque_nm",
    "wall_force_n",
    "wall_torque_nm",
    "body_force_n",
    "body_torque_nm",
    "touching_points",
    "submerged_fraction",
    "mode",
];

/// Length of the longest mode name [bytes].
const MODE_BYTES: usize = 9;

/// The cells of one column.
pub(super) enum Cells<'a> {
    Numbers(&'a [f64]),
    Threes(&'a [[f64; 3]]),
    Fours(&'a [[f64; 4]]),
    Counts(&'a [u32]),
    Modes(&'a [Mode]),
}

impl PartialSchema for Field {
    fn schema() -> RefOr<Schema> {
        ObjectBuilder::new()
            .schema_type(Type::String)
            .enum_values(Some(NAMES))
            .into()
    }
}

impl ToSchema for Field {
    fn name() -> Cow<'static, str> {
        Cow::Borrowed("TrajectoryField")
    }
}

impl Field {
    /// All columns.
    pub fn all() -> Vec<Self> {
        (0..NAMES.len()).map(Self).collect()
    }

    /// The column with this name.
    #[cfg(test)]
    pub fn from_name(name: &str) -> Option<Self> {
        NAMES.iter().position(|other| *other == name).map(Self)
    }

    /// Name of the column.
    pub fn name(self) -> &'static str {
        NAMES[self.0]
    }

    /// Number of components of a cell.
    pub fn components(self) -> usize {
        self.parts().len().max(1)
    }

    /// Names of the components of a cell: x, y, z of a vector, w, x, y, z of an
    /// orientation, none for a scalar.
    pub(super) fn parts(self) -> &'static [&'static str] {
        match self.name() {
            "time_s" | "touching_points" | "submerged_fraction" | "mode" => &[],
            "orientation" => &["w", "x", "y", "z"],
            _ => &["x", "y", "z"],
        }
    }

    /// NumPy's name of a cell's type.
    pub(super) fn numpy_type(self) -> &'static str {
        match self.name() {
            "touching_points" => "<u4",
            "mode" => "|S9",
            _ => "<f8",
        }
    }

    pub(super) fn cells(self, columns: &TrajectoryColumns) -> Cells<'_> {
        match self.0 {
            0 => Cells::Numbers(&columns.time_s),
            1 => Cells::Threes(&columns.position_m),
            2 => Cells::Fours(&columns.orientation),
            3 => Cells::Threes(&columns.velocity_m_s),
            4 => Cells::Threes(&columns.angular_velocity_rad_s),
            5 => Cells::Threes(&columns.flow_force_n),
            6 => Cells::Threes(&columns.flow_torque_nm),
            7 => Cells::Threes(&columns.wall_force_n),
            8 => Cells::Threes(&columns.wall_torque_nm),
            9 => Cells::Threes(&columns.body_force_n),
            10 => Cells::Threes(&columns.body_torque_nm),
            11 => Cells::Counts(&columns.touching_points),
            12 => Cells::Numbers(&columns.submerged_fraction),
            _ => Cells::Modes(&columns.mode),
        }
    }
}

impl Cells<'_> {
    /// Appends a cell as JSON.
    pub(super) fn put_json(&self, row: usize, text: &mut String) {
        match self {
            Self::Numbers(cells) => put_number(cells[row], text),
            Self::Threes(cells) => put_list(&cells[row], text),
            Self::Fours(cells) => put_list(&cells[row], text),
            Self::Counts(cells) => put(cells[row], text),
            Self::Modes(cells) => {
                text.push('"');
                text.push_str(word(cells[row]));
                text.push('"');
            }
        }
    }

    /// Appends a cell's parts with commas between them.
    pub(super) fn put_csv(&self, row: usize, text: &mut String) {
        match self {
            Self::Numbers(cells) => put_number(cells[row], text),
            Self::Threes(cells) => put_parts(&cells[row], text),
            Self::Fours(cells) => put_parts(&cells[row], text),
            Self::Counts(cells) => put(cells[row], text),
            Self::Modes(cells) => text.push_str(word(cells[row])),
        }
    }

    /// Appends all cells as bytes, little-endian.
    pub(super) fn put_bytes(&self, out: &mut Vec<u8>) {
        match self {
            Self::Numbers(cells) => put_f64s(cells.iter(), out),
            Self::Threes(cells) => put_f64s(cells.iter().flatten(), out),
            Self::Fours(cells) => put_f64s(cells.iter().flatten(), out),
            Self::Counts(cells) => out.extend(cells.iter().flat_map(|cell| cell.to_le_bytes())),
            Self::Modes(cells) => {
                for mode in *cells {
                    let mut bytes = [0; MODE_BYTES];
                    bytes[..word(*mode).len()].copy_from_slice(word(*mode).as_bytes());
                    out.extend(bytes);
                }
            }
        }
    }
}

fn put_f64s<'a>(numbers: impl Iterator<Item = &'a f64>, out: &mut Vec<u8>) {
    out.extend(numbers.flat_map(|number| number.to_le_bytes()));
}

fn put_list(parts: &[f64], text: &mut String) {
    text.push('[');
    put_parts(parts, text);
    text.push(']');
}

fn put_parts(parts: &[f64], text: &mut String) {
    for (place, part) in parts.iter().enumerate() {
        if place > 0 {
            text.push(',');
        }
        put_number(*part, text);
    }
}

/// The shortest text that parses to this number; a run records only
/// finite numbers.
fn put_number(number: f64, text: &mut String) {
    put(format_args!("{number:?}"), text);
}

fn put(what: impl std::fmt::Display, text: &mut String) {
    // Writing into a string can't fail.
    let _ = write!(text, "{what}");
}

fn word(mode: Mode) -> &'static str {
    match mode {
        Mode::Resting => "resting",
        Mode::Sliding => "sliding",
        Mode::Rolling => "rolling",
        Mode::Saltating => "saltating",
        Mode::Carried => "carried",
    }
}
