//! NumPy's NPZ: a ZIP archive of arrays, one per column.

use super::{Field, Writer};
use crate::results::columns::TrajectoryColumns;
use crate::results::numpy;
use crate::results::zip::{Method, ZipWriter};

/// Writes one column per pass.
pub(super) struct NpzWriter {
    rows: usize,
    fields: Vec<Field>,
    archive: ZipWriter,
}

impl NpzWriter {
    pub(super) fn new(rows: usize, fields: Vec<Field>) -> Self {
        Self {
            rows,
            fields,
            archive: ZipWriter::default(),
        }
    }
}

impl Writer for NpzWriter {
    fn passes(&self) -> usize {
        self.fields.len()
    }

    fn begin(&mut self, pass: usize, out: &mut Vec<u8>) {
        let field = self.fields[pass];
        let name = format!("{}.npy", field.name());
        self.archive.begin(&name, Method::Stored, out);
        self.archive.data(&array_head(field, self.rows), out);
    }

    fn rows(&mut self, pass: usize, samples: &TrajectoryColumns, out: &mut Vec<u8>) {
        let mut bytes = Vec::new();
        self.fields[pass].cells(samples).put_bytes(&mut bytes);
        self.archive.data(&bytes, out);
    }

    fn end(&mut self, pass: usize, out: &mut Vec<u8>) {
        self.archive.end(out);
        if pass + 1 == self.fields.len() {
            self.archive.finish(out);
        }
    }
}

/// Header before an array's numbers.
fn array_head(field: Field, rows: usize) -> Vec<u8> {
    let shape = match field.parts().len() {
        0 => format!("({rows},)"),
        parts => format!("({rows}, {parts})"),
    };
    numpy::head(field.numpy_type(), &shape)
}

#[cfg(test)]
mod tests {
    use super::super::{Format, written};
    use super::*;
    use crate::results::columns::tests::numbered_columns;

    #[test]
    fn an_array_has_its_head_and_its_numbers() {
        let field = Field::from_name("position_m").unwrap();
        let bytes = written(Format::Npz, &[numbered_columns(2)], vec![field]);
        let name = b"position_m.npy";
        // A local header of 30 bytes and the name, then the array.
        assert_eq!(&bytes[30..30 + name.len()], name);
        let array = &bytes[30 + name.len()..];
        assert_eq!(&array[..8], b"\x93NUMPY\x01\x00");
        let text = String::from_utf8_lossy(&array[10..128]);
        assert!(text.starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }"));
        let number =
            |place: usize| f64::from_le_bytes(array[128 + 8 * place..][..8].try_into().unwrap());
        assert_eq!(
            [0, 1, 2, 3, 4, 5].map(number),
            [1.0, 1.25, -1.5, 101.0, 101.25, -101.5]
        );
    }
}
