//! Numbers as byte planes: first the lowest byte of every number, then the
//! next, and so on. The slowly changing high bytes are then adjacent,
//! so that a trajectory compresses well.

/// Appends a column of f64, eight planes of one byte a number.
pub(super) fn put_f64(out: &mut Vec<u8>, column: &(impl Iterator<Item = f64> + Clone)) {
    for plane in 0..8 {
        out.extend(column.clone().map(|number| number.to_le_bytes()[plane]));
    }
}

/// Appends a column of f32.
pub(super) fn put_f32(out: &mut Vec<u8>, column: &(impl Iterator<Item = f32> + Clone)) {
    for plane in 0..4 {
        out.extend(column.clone().map(|number| number.to_le_bytes()[plane]));
    }
}

/// Appends a column of u32.
pub(super) fn put_u32(out: &mut Vec<u8>, column: &(impl Iterator<Item = u32> + Clone)) {
    put_f32(out, &column.clone().map(f32::from_bits));
}

/// Reads columns from the front of a byte string.
pub(super) struct PlaneReader<'a> {
    bytes: &'a [u8],
    rows: usize,
}

impl<'a> PlaneReader<'a> {
    /// A reader of columns of `rows` numbers each.
    pub(super) fn new(bytes: &'a [u8], rows: usize) -> Self {
        Self { bytes, rows }
    }

    /// `planes` byte planes; `None` if the bytes run out.
    pub(super) fn bytes(&mut self, planes: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.bytes.split_at_checked(planes * self.rows)?;
        self.bytes = rest;
        Some(taken)
    }

    /// The next column of f64.
    pub(super) fn f64s(&mut self) -> Option<Vec<f64>> {
        let planes = self.bytes(8)?;
        let number =
            |row| f64::from_le_bytes(std::array::from_fn(|plane| planes[plane * self.rows + row]));
        Some((0..self.rows).map(number).collect())
    }

    /// The next column of f32.
    pub(super) fn f32s(&mut self) -> Option<Vec<f32>> {
        let planes = self.bytes(4)?;
        let number =
            |row| f32::from_le_bytes(std::array::from_fn(|plane| planes[plane * self.rows + row]));
        Some((0..self.rows).map(number).collect())
    }

    /// The next column of u32.
    pub(super) fn u32s(&mut self) -> Option<Vec<u32>> {
        Some(self.f32s()?.into_iter().map(f32::to_bits).collect())
    }

    /// The next `N` columns of f64, as rows.
    pub(super) fn f64_rows<const N: usize>(&mut self) -> Option<Vec<[f64; N]>> {
        let mut rows = vec![[0.0; N]; self.rows];
        for component in 0..N {
            for (row, number) in rows.iter_mut().zip(self.f64s()?) {
                row[component] = number;
            }
        }
        Some(rows)
    }

    /// True if every byte was read.
    pub(super) fn is_done(&self) -> bool {
        self.bytes.is_empty()
    }
}
