//! The trajectory document: the JSON of the endpoint and of the files that the
//! command line writes. Made in pieces, so that a long trajectory is never in
//! memory as text.

use super::columns::TrajectoryColumns;
use serde::Serialize;

/// Rows of one column that make up one piece: some tens of kilobytes of text.
const ROWS_PER_PIECE: usize = 512;

/// The whole trajectory document of body number `body`. `job_id` is null for a
/// run without a service.
pub fn trajectory_json(
    job_id: Option<&str>,
    body: usize,
    columns: &TrajectoryColumns,
) -> serde_json::Result<String> {
    TrajectoryPieces::new(job_id, body, columns).collect()
}

/// Iterates over the text of a trajectory document; the pieces in a row are the
/// document.
#[derive(Debug)]
pub struct TrajectoryPieces<Columns> {
    head: Option<String>,
    columns: Columns,
    column: usize,
    row: usize,
}

const COLUMN_NAMES: [&str; 14] = [
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

impl<Columns: AsRef<TrajectoryColumns>> TrajectoryPieces<Columns> {
    /// The pieces of the document of body number `body`.
    pub fn new(job_id: Option<&str>, body: usize, columns: Columns) -> Self {
        let job_id = job_id.map_or(serde_json::Value::Null, serde_json::Value::from);
        let head = format!("{{\"job_id\":{job_id},\"body\":{body},\"columns\":{{");
        Self {
            head: Some(head),
            columns,
            column: 0,
            row: 0,
        }
    }

    /// The next rows of the column in hand, with what opens and closes it.
    fn piece(&mut self) -> serde_json::Result<String> {
        let columns = self.columns.as_ref();
        let last_row = columns.len().min(self.row + ROWS_PER_PIECE);
        let mut text = self.head.take().unwrap_or_default();
        if self.row == 0 {
            let comma = if self.column == 0 { "" } else { "," };
            text.push_str(&format!("{comma}\"{}\":[", COLUMN_NAMES[self.column]));
        } else {
            text.push(',');
        }
        text.push_str(&rows(columns, self.column, self.row..last_row)?);
        self.row = last_row;
        if last_row == columns.len() {
            text.push(']');
            self.column += 1;
            self.row = 0;
            if self.column == COLUMN_NAMES.len() {
                text.push_str("}}");
            }
        }
        Ok(text)
    }
}

impl<Columns: AsRef<TrajectoryColumns>> Iterator for TrajectoryPieces<Columns> {
    type Item = serde_json::Result<String>;

    fn next(&mut self) -> Option<Self::Item> {
        (self.column < COLUMN_NAMES.len()).then(|| self.piece())
    }
}

impl AsRef<TrajectoryColumns> for TrajectoryColumns {
    fn as_ref(&self) -> &TrajectoryColumns {
        self
    }
}

/// Rows of column number `column`, separated by commas.
fn rows(
    columns: &TrajectoryColumns,
    column: usize,
    range: std::ops::Range<usize>,
) -> serde_json::Result<String> {
    match column {
        0 => joined(&columns.time_s[range]),
        1 => joined(&columns.position_m[range]),
        2 => joined(&columns.orientation[range]),
        3 => joined(&columns.velocity_m_s[range]),
        4 => joined(&columns.angular_velocity_rad_s[range]),
        5 => joined(&columns.flow_force_n[range]),
        6 => joined(&columns.flow_torque_nm[range]),
        7 => joined(&columns.wall_force_n[range]),
        8 => joined(&columns.wall_torque_nm[range]),
        9 => joined(&columns.body_force_n[range]),
        10 => joined(&columns.body_torque_nm[range]),
        11 => joined(&columns.touching_points[range]),
        12 => joined(&columns.submerged_fraction[range]),
        _ => joined(&columns.mode[range]),
    }
}

fn joined<T: Serialize>(rows: &[T]) -> serde_json::Result<String> {
    let list = serde_json::to_string(rows)?;
    Ok(list[1..list.len() - 1].to_owned())
}

#[cfg(test)]
mod tests {
    use super::super::columns::tests::numbered_columns;
    use super::*;
    use serde_json::json;

    #[test]
    fn every_column_stands_under_its_own_name() {
        let text = trajectory_json(Some("abc"), 2, &numbered_columns(2)).unwrap();
        let document: serde_json::Value = serde_json::from_str(&text).unwrap();
        // The numbers come from `numbered`: sample index × 100 + the column's own.
        let expected = json!({"job_id": "abc", "body": 2, "columns": {
            "time_s": [0.0, 0.01],
            "position_m": [[1.0, 1.25, -1.5], [101.0, 101.25, -101.5]],
            "orientation": [[2.0, 2.25, 2.5, 2.75], [102.0, 102.25, 102.5, 102.75]],
            "velocity_m_s": [[3.0, 3.25, -3.5], [103.0, 103.25, -103.5]],
            "angular_velocity_rad_s": [[4.0, 4.25, -4.5], [104.0, 104.25, -104.5]],
            "flow_force_n": [[5.0, 5.25, -5.5], [105.0, 105.25, -105.5]],
            "flow_torque_nm": [[6.0, 6.25, -6.5], [106.0, 106.25, -106.5]],
            "wall_force_n": [[7.0, 7.25, -7.5], [107.0, 107.25, -107.5]],
            "wall_torque_nm": [[8.0, 8.25, -8.5], [108.0, 108.25, -108.5]],
            "body_force_n": [[10.0, 10.25, -10.5], [110.0, 110.25, -110.5]],
            "body_torque_nm": [[11.0, 11.25, -11.5], [111.0, 111.25, -111.5]],
            "touching_points": [9, 19],
            "submerged_fraction": [1.0, 0.5],
            "mode": ["resting", "sliding"],
        }});
        assert_eq!(document, expected);
    }

    #[test]
    fn a_document_is_whole_for_any_number_of_rows_about_a_piece() {
        for count in [0, 1, 511, 512, 513, 1024, 1100] {
            let text = trajectory_json(None, 0, &numbered_columns(count)).unwrap();
            let document: serde_json::Value = serde_json::from_str(&text).unwrap();
            assert_eq!(document["job_id"], serde_json::Value::Null);
            let columns = document["columns"].as_object().unwrap();
            assert_eq!(columns.len(), COLUMN_NAMES.len());
            for (name, column) in columns {
                assert_eq!(column.as_array().unwrap().len(), count as usize, "{name}");
            }
        }
    }
}
