//! The trajectory document: the JSON of the endpoint and of the files that the
//! command line writes.

use super::{Field, Heading, Writer};
use crate::results::columns::TrajectoryColumns;

/// The whole trajectory document of body number `body`. `job_id` is null for a
/// run without a service.
pub fn trajectory_json(job_id: Option<&str>, body: usize, columns: &TrajectoryColumns) -> String {
    let heading = Heading {
        job_id: job_id.map(str::to_owned),
        body,
        rows: columns.len(),
    };
    let mut writer = JsonWriter::new(&heading, Field::all());
    let mut out = Vec::new();
    for pass in 0..writer.passes() {
        writer.begin(pass, &mut out);
        writer.rows(pass, columns, &mut out);
        writer.end(pass, &mut out);
    }
    String::from_utf8_lossy(&out).into_owned()
}

/// Writes one column per pass.
pub(super) struct JsonWriter {
    head: String,
    fields: Vec<Field>,
    /// True if the current column has a row already.
    has_rows: bool,
}

impl JsonWriter {
    pub(super) fn new(heading: &Heading, fields: Vec<Field>) -> Self {
        let job_id = serde_json::Value::from(heading.job_id.clone());
        Self {
            head: format!(
                "{{\"job_id\":{job_id},\"body\":{},\"columns\":{{",
                heading.body
            ),
            fields,
            has_rows: false,
        }
    }
}

impl Writer for JsonWriter {
    fn passes(&self) -> usize {
        self.fields.len()
    }

    fn begin(&mut self, pass: usize, out: &mut Vec<u8>) {
        let before = if pass == 0 { self.head.as_str() } else { "," };
        out.extend(format!("{before}\"{}\":[", self.fields[pass].name()).bytes());
        self.has_rows = false;
    }

    fn rows(&mut self, pass: usize, samples: &TrajectoryColumns, out: &mut Vec<u8>) {
        let cells = self.fields[pass].cells(samples);
        let mut text = String::new();
        for row in 0..samples.len() {
            if self.has_rows {
                text.push(',');
            }
            cells.put_json(row, &mut text);
            self.has_rows = true;
        }
        out.extend(text.bytes());
    }

    fn end(&mut self, pass: usize, out: &mut Vec<u8>) {
        out.push(b']');
        if pass + 1 == self.fields.len() {
            out.extend(b"}}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Format, written};
    use super::*;
    use crate::results::columns::tests::numbered_columns;
    use serde_json::{Value, json};

    #[test]
    fn every_column_stands_under_its_own_name() {
        let text = trajectory_json(Some("abc"), 2, &numbered_columns(2));
        let document: Value = serde_json::from_str(&text).unwrap();
        // The numbers come from `numbered`: sample index × 100 + the number of the column.
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
    fn chunks_make_the_document_of_the_whole() {
        let whole = trajectory_json(Some("abc"), 2, &numbered_columns(7));
        let mut first = numbered_columns(7);
        first.truncate(3);
        let mut rest = TrajectoryColumns::default();
        for index in 3..7 {
            let (time_s, sample) = numbered_columns(7).sample(index);
            rest.push(time_s, &sample);
        }
        let chunks = [first, TrajectoryColumns::default(), rest];
        assert_eq!(
            written(Format::Json, &chunks, Field::all()),
            whole.as_bytes()
        );
        let none = written(Format::Json, &[], Field::all());
        let document: Value = serde_json::from_slice(&none).unwrap();
        assert_eq!(document["columns"]["mode"], json!([]));
    }

    #[test]
    fn numbers_read_back_with_their_bits() {
        let mut columns = numbered_columns(1);
        for number in [-0.0, 5e-324, 0.1 + 0.2, f64::MAX, 1e21, 123_456_789.0] {
            columns.submerged_fraction[0] = number;
            let text = trajectory_json(None, 0, &columns);
            let start = text.find("\"submerged_fraction\":[").unwrap() + 22;
            let end = start + text[start..].find(']').unwrap();
            let back: f64 = text[start..end].parse().unwrap();
            assert_eq!(back.to_bits(), number.to_bits());
            assert!(serde_json::from_str::<Value>(&text).is_ok(), "{text}");
        }
    }
}
