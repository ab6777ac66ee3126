//! NumPy's NPY format, version 1.0.

/// Head of an array with elements of a type in NumPy's words, and of a shape as Python writes it.
pub(super) fn head(descr: &str, shape: &str) -> Vec<u8> {
    let mut text = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}");
    // Magic, version and length take ten bytes; the numbers begin at a multiple
    // of 64, after a line feed.
    while !(10 + text.len() + 1).is_multiple_of(64) {
        text.push(' ');
    }
    text.push('\n');
    let mut head = b"\x93NUMPY\x01\x00".to_vec();
    head.extend((text.len() as u16).to_le_bytes());
    head.extend(text.bytes());
    head
}

/// A one-dimensional array of 64-bit floats.
pub fn array(values: &[f64]) -> Vec<u8> {
    let mut array = head("<f8", &format!("({},)", values.len()));
    array.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    array
}
