//! Frames: compressed blocks with checksums, one after another in a file. Length of the raw bytes
//! and of the block (u64, little-endian each), checksum, block.

use scree::results::chunk::{Block, BlockError};

/// Seals bytes as a frame.
///
/// # Errors
/// Only if the compressor is out of memory.
pub(super) fn sealed(raw: &[u8]) -> Result<Vec<u8>, BlockError> {
    let block = Block::seal_quickly(raw)?;
    let mut frame = Vec::with_capacity(48 + block.data.len());
    frame.extend((raw.len() as u64).to_le_bytes());
    frame.extend((block.data.len() as u64).to_le_bytes());
    frame.extend(block.checksum);
    frame.extend(block.data);
    Ok(frame)
}

/// The raw bytes of the first frame, and the bytes after it; none if there is no sound frame.
pub(super) fn opened(bytes: &[u8]) -> Option<(Vec<u8>, &[u8])> {
    let (raw_length, rest) = bytes.split_first_chunk::<8>()?;
    let (length, rest) = rest.split_first_chunk::<8>()?;
    let (checksum, rest) = rest.split_first_chunk::<32>()?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
    let (data, rest) = rest.split_at_checked(length)?;
    let block = Block {
        data: data.to_vec(),
        checksum: *checksum,
    };
    let limit = usize::try_from(u64::from_le_bytes(*raw_length)).ok()?;
    Some((block.open(limit).ok()?, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_come_back_in_order_and_damaged_ones_not_at_all() {
        let mut bytes = sealed(b"first").unwrap();
        let first = bytes.len();
        bytes.extend(sealed(b"").unwrap());
        let (raw, rest) = opened(&bytes).unwrap();
        assert_eq!(raw, b"first");
        assert_eq!(opened(rest), Some((Vec::new(), &[][..])));
        for length in 0..first {
            assert!(opened(&bytes[..length]).is_none(), "{length}");
        }
        // Past the raw length, which is only an upper limit.
        for place in 8..first {
            let mut damaged = bytes.clone();
            damaged[place] ^= 1;
            assert!(opened(&damaged).is_none(), "{place}");
        }
    }
}
