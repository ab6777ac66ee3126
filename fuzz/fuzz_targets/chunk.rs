//! Any bytes as a stored stretch of a trajectory: as many samples as its row says, or
//! refused. The first two bytes are that number; the checksum is right, or nothing
//! behind it would be reached.

#![no_main]

use libfuzzer_sys::fuzz_target;
use scree::results::chunk::{Block, decode};

fuzz_target!(|bytes: &[u8]| {
    let Some((count, data)) = bytes.split_first_chunk::<2>() else {
        return;
    };
    let samples = usize::from(u16::from_le_bytes(*count));
    let block = Block {
        data: data.to_vec(),
        checksum: *blake3::hash(data).as_bytes(),
    };
    if let Ok(columns) = decode(&block, samples) {
        assert_eq!(columns.len(), samples);
    }
});
