//! Comma-separated values (RFC 4180): a heading, and one line per sample.

use super::{Field, Writer};
use crate::results::columns::TrajectoryColumns;

pub(super) struct CsvWriter {
    fields: Vec<Field>,
}

impl CsvWriter {
    pub(super) fn new(fields: Vec<Field>) -> Self {
        Self { fields }
    }
}

impl Writer for CsvWriter {
    fn passes(&self) -> usize {
        1
    }

    fn begin(&mut self, _pass: usize, out: &mut Vec<u8>) {
        let mut names = Vec::new();
        for field in &self.fields {
            match field.parts() {
                [] => names.push(field.name().to_owned()),
                parts => names.extend(parts.iter().map(|part| format!("{}_{part}", field.name()))),
            }
        }
        out.extend(names.join(",").bytes());
        out.extend(b"\r\n");
    }

    fn rows(&mut self, _pass: usize, samples: &TrajectoryColumns, out: &mut Vec<u8>) {
        let columns: Vec<_> = self
            .fields
            .iter()
            .map(|field| field.cells(samples))
            .collect();
        let mut text = String::new();
        for row in 0..samples.len() {
            for (place, cells) in columns.iter().enumerate() {
                if place > 0 {
                    text.push(',');
                }
                cells.put_csv(row, &mut text);
            }
            text.push_str("\r\n");
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

    #[test]
    fn vectors_have_a_column_a_component() {
        let names = ["time_s", "orientation", "touching_points", "mode"];
        let fields = names.map(|name| Field::from_name(name).unwrap());
        let bytes = written(Format::Csv, &[numbered_columns(2)], fields.to_vec());
        assert_eq!(
            String::from_utf8(bytes).unwrap(),
            "time_s,orientation_w,orientation_x,orientation_y,orientation_z,touching_points,mode\r\n\
             0.0,2.0,2.25,2.5,2.75,9,resting\r\n\
             0.01,102.0,102.25,102.5,102.75,19,sliding\r\n"
        );
    }

    #[test]
    fn every_line_has_as_many_cells_as_the_heading() {
        let bytes = written(Format::Csv, &[numbered_columns(3)], Field::all());
        let text = String::from_utf8(bytes).unwrap();
        let counts: Vec<usize> = text.lines().map(|line| line.split(',').count()).collect();
        assert_eq!(counts, [35; 4]);
    }
}
