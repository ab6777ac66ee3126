//! One JSON object per sample, each on its own line.

use super::{Field, Writer};
use crate::results::columns::TrajectoryColumns;

pub(super) struct LinesWriter {
    fields: Vec<Field>,
}

impl LinesWriter {
    pub(super) fn new(fields: Vec<Field>) -> Self {
        Self { fields }
    }
}

impl Writer for LinesWriter {
    fn passes(&self) -> usize {
        1
    }

    fn begin(&mut self, _pass: usize, _out: &mut Vec<u8>) {}

    fn rows(&mut self, _pass: usize, samples: &TrajectoryColumns, out: &mut Vec<u8>) {
        let named: Vec<_> = self
            .fields
            .iter()
            .map(|field| (field.name(), field.cells(samples)))
            .collect();
        let mut text = String::new();
        for row in 0..samples.len() {
            for (place, (name, cells)) in named.iter().enumerate() {
                text.push_str(if place == 0 { "{\"" } else { ",\"" });
                text.push_str(name);
                text.push_str("\":");
                cells.put_json(row, &mut text);
            }
            text.push_str("}\n");
        }
        out.extend(text.bytes());
    }

    fn end(&mut self, _pass: usize, _out: &mut Vec<u8>) {}
}

#[cfg(test)]
mod tests {
    use super::super::{Format, written};
    use super::*;
    use crate::results::columns::tests::numbered_columns;
    use serde_json::{Value, json};

    #[test]
    fn every_line_is_a_sample() {
        let fields = ["mode", "time_s", "position_m"].map(|name| Field::from_name(name).unwrap());
        let bytes = written(Format::Ndjson, &[numbered_columns(2)], fields.to_vec());
        let text = String::from_utf8(bytes).unwrap();
        let lines: Vec<Value> = text
            .lines()
            .map(|line| serde_json::from_str(line).unwrap())
            .collect();
        assert_eq!(
            lines,
            [
                json!({"mode": "resting", "time_s": 0.0, "position_m": [1.0, 1.25, -1.5]}),
                json!({"mode": "sliding", "time_s": 0.01, "position_m": [101.0, 101.25, -101.5]}),
            ]
        );
        assert!(text.ends_with("}\n"));
    }
}
