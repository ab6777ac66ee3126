//! Arbitrary bytes as a stored range of a trajectory: decoded to the number of samples in its row,
//! or
//! refused. The first two bytes are that number; the checksum is correct, since otherwise no
//! code behind its check would run.

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
