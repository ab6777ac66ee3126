//! A range of one body's trajectory as one compressed block with a checksum.

use super::columns::TrajectoryColumns;
use super::planes::{self, PlaneReader};
use scree_solver::record::Mode;
use thiserror::Error;

/// Samples in a full chunk. Larger chunks compress no better and make short
/// reads more expensive.
pub const CHUNK_SAMPLES: usize = 512;

/// Name of the encoding, stored with each block so that a later one can differ.
pub const ENCODING: &str = "planes-zstd-1";

/// Bytes of one sample before compression: 33 f64, one u32, one byte.
const BYTES_PER_SAMPLE: usize = 33 * 8 + 4 + 1;

/// Compression level: 3 is zstd's own default.
const ZSTD_LEVEL: i32 = 3;

/// Level for saved states.
const ZSTD_QUICK_LEVEL: i32 = 1;

/// Compressed bytes and their checksum.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// Compressed bytes.
    pub data: Vec<u8>,
    /// BLAKE3 of `data`.
    pub checksum: [u8; 32],
}

/// Reason why a stored block can't be read.
#[derive(Debug, Error)]
pub enum BlockError {
    /// The bytes differ from those written.
    #[error("the checksum does not match")]
    Checksum,
    /// The block does not hold the number of rows in its table row.
    #[error("the block does not hold {rows} rows")]
    Contents {
        /// Rows it should hold.
        rows: usize,
    },
    /// The compressed stream is broken.
    #[error("decompression: {0}")]
    Compression(#[from] std::io::Error),
}

impl Block {
    /// Checksums bytes that are compressed already.
    pub(super) fn of_packed(data: Vec<u8>) -> Self {
        let checksum = *blake3::hash(&data).as_bytes();
        Self { data, checksum }
    }

    /// Compresses and checksums.
    ///
    /// # Errors
    /// Only if the compressor is out of memory.
    pub(super) fn seal(raw: &[u8]) -> Result<Self, BlockError> {
        Self::sealed_at(raw, ZSTD_LEVEL)
    }

    /// Seals data that is soon replaced: speed matters more than size.
    ///
    /// # Errors
    /// Only if the compressor is out of memory.
    pub fn seal_quickly(raw: &[u8]) -> Result<Self, BlockError> {
        Self::sealed_at(raw, ZSTD_QUICK_LEVEL)
    }

    fn sealed_at(raw: &[u8], level: i32) -> Result<Self, BlockError> {
        Ok(Self::of_packed(zstd::bulk::compress(raw, level)?))
    }

    /// True if the bytes are those that were sealed.
    pub fn is_sound(&self) -> bool {
        blake3::hash(&self.data).as_bytes() == &self.checksum
    }

    /// Checks and decompresses into at most `limit` bytes.
    ///
    /// # Errors
    /// [`BlockError`], if the bytes differ from those sealed.
    pub fn open(&self, limit: usize) -> Result<Vec<u8>, BlockError> {
        if !self.is_sound() {
            return Err(BlockError::Checksum);
        }
        Ok(zstd::bulk::decompress(&self.data, limit)?)
    }
}

/// Encodes a range of a trajectory.
///
/// # Errors
/// Only if the compressor is out of memory.
pub fn encode(columns: &TrajectoryColumns) -> Result<Block, BlockError> {
    let mut raw = Vec::with_capacity(columns.len() * BYTES_PER_SAMPLE);
    planes::put_f64(&mut raw, &columns.time_s.iter().copied());
    put_rows(&mut raw, &columns.position_m);
    put_rows(&mut raw, &columns.orientation);
    put_rows(&mut raw, &columns.velocity_m_s);
    put_rows(&mut raw, &columns.angular_velocity_rad_s);
    put_rows(&mut raw, &columns.flow_force_n);
    put_rows(&mut raw, &columns.flow_torque_nm);
    put_rows(&mut raw, &columns.wall_force_n);
    put_rows(&mut raw, &columns.wall_torque_nm);
    planes::put_f64(&mut raw, &columns.submerged_fraction.iter().copied());
    planes::put_u32(&mut raw, &columns.touching_points.iter().copied());
    raw.extend(columns.mode.iter().copied().map(mode_to_byte));
    put_rows(&mut raw, &columns.body_force_n);
    put_rows(&mut raw, &columns.body_torque_nm);
    Block::seal(&raw)
}

/// Decodes a block of `samples` samples.
///
/// # Errors
/// [`BlockError`], if the block was not made by [`encode`].
pub fn decode(block: &Block, samples: usize) -> Result<TrajectoryColumns, BlockError> {
    let raw = block.open(samples * BYTES_PER_SAMPLE)?;
    read_columns(&raw, samples).ok_or(BlockError::Contents { rows: samples })
}

fn read_columns(raw: &[u8], samples: usize) -> Option<TrajectoryColumns> {
    let mut reader = PlaneReader::new(raw, samples);
    let columns = TrajectoryColumns {
        time_s: reader.f64s()?,
        position_m: reader.f64_rows()?,
        orientation: reader.f64_rows()?,
        velocity_m_s: reader.f64_rows()?,
        angular_velocity_rad_s: reader.f64_rows()?,
        flow_force_n: reader.f64_rows()?,
        flow_torque_nm: reader.f64_rows()?,
        wall_force_n: reader.f64_rows()?,
        wall_torque_nm: reader.f64_rows()?,
        submerged_fraction: reader.f64s()?,
        touching_points: reader.u32s()?,
        mode: reader
            .bytes(1)?
            .iter()
            .map(|&byte| mode_from_byte(byte))
            .collect::<Option<_>>()?,
        body_force_n: rows_since(&mut reader, samples)?,
        body_torque_nm: rows_since(&mut reader, samples)?,
    };
    reader.is_done().then_some(columns)
}

/// A column that is missing in blocks from before contacts between bodies existed: then it
/// was zero.
fn rows_since(reader: &mut PlaneReader, samples: usize) -> Option<Vec<[f64; 3]>> {
    if reader.is_done() {
        return Some(vec![[0.0; 3]; samples]);
    }
    reader.f64_rows()
}

fn put_rows<const N: usize>(raw: &mut Vec<u8>, rows: &[[f64; N]]) {
    for component in 0..N {
        planes::put_f64(raw, &rows.iter().map(|row| row[component]));
    }
}

fn mode_to_byte(mode: Mode) -> u8 {
    match mode {
        Mode::Resting => 0,
        Mode::Sliding => 1,
        Mode::Rolling => 2,
        Mode::Saltating => 3,
        Mode::Carried => 4,
    }
}

fn mode_from_byte(byte: u8) -> Option<Mode> {
    [
        Mode::Resting,
        Mode::Sliding,
        Mode::Rolling,
        Mode::Saltating,
        Mode::Carried,
    ]
    .get(usize::from(byte))
    .copied()
}

#[cfg(test)]
mod tests {
    use super::super::columns::tests::numbered_columns;
    use super::*;

    #[test]
    fn a_chunk_comes_back_bit_for_bit() {
        for count in [0, 1, 3, 512] {
            let mut columns = numbered_columns(count);
            if let Some(first) = columns.position_m.first_mut() {
                *first = [-0.0, f64::MIN_POSITIVE / 2.0, f64::MAX];
            }
            let block = encode(&columns).unwrap();
            let back = decode(&block, count as usize).unwrap();
            assert_eq!(back, columns);
            let bits = |columns: &TrajectoryColumns| {
                columns
                    .position_m
                    .iter()
                    .flatten()
                    .map(|x| x.to_bits())
                    .collect::<Vec<_>>()
            };
            assert_eq!(bits(&back), bits(&columns));
        }
    }

    #[test]
    fn a_chunk_from_before_bodies_touched_has_no_force_of_theirs() {
        let mut columns = numbered_columns(5);
        let raw = encode(&columns)
            .unwrap()
            .open(5 * BYTES_PER_SAMPLE)
            .unwrap();
        let older = Block::seal(&raw[..5 * (BYTES_PER_SAMPLE - 6 * 8)]).unwrap();
        columns.body_force_n = vec![[0.0; 3]; 5];
        columns.body_torque_nm = vec![[0.0; 3]; 5];
        assert_eq!(decode(&older, 5).unwrap(), columns);
    }

    #[test]
    fn a_flipped_bit_is_noticed() {
        let mut block = encode(&numbered_columns(100)).unwrap();
        let middle = block.data.len() / 2;
        block.data[middle] ^= 1;
        assert!(matches!(decode(&block, 100), Err(BlockError::Checksum)));
    }

    #[test]
    fn a_wrong_number_of_samples_is_noticed() {
        let block = encode(&numbered_columns(100)).unwrap();
        assert!(decode(&block, 99).is_err());
        assert!(matches!(
            decode(&block, 101),
            Err(BlockError::Contents { rows: 101 })
        ));
    }

    #[test]
    fn a_smooth_trajectory_takes_less_than_half_its_size() {
        let block = encode(&numbered_columns(512)).unwrap();
        assert!(
            block.data.len() * 2 < 512 * BYTES_PER_SAMPLE,
            "{} bytes",
            block.data.len()
        );
    }

    proptest::proptest! {
        /// Any bytes with a correct checksum are either decoded to
        /// as many samples as they hold, or refused.
        #[test]
        fn reading_any_bytes_is_safe(
            raw in proptest::collection::vec(proptest::prelude::any::<u8>(), 0..2000),
            samples in 0..2000_usize,
        ) {
            let packed = Block::seal(&raw).unwrap();
            let fits = |bytes| raw.len() == samples * bytes;
            if let Ok(columns) = decode(&packed, samples) {
                proptest::prop_assert!(fits(BYTES_PER_SAMPLE) || fits(BYTES_PER_SAMPLE - 6 * 8));
                proptest::prop_assert_eq!(columns.len(), samples);
            }
            let checksum = *blake3::hash(&raw).as_bytes();
            let unpacked = Block { data: raw, checksum };
            // Bytes that are no compressed stream hold no samples.
            let held = decode(&unpacked, samples).map_or(0, |columns| columns.len());
            proptest::prop_assert!(held == 0 || held == samples);
        }
    }
}
