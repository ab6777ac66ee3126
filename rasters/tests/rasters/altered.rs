//! Files altered at random: read or refused, never a panic.

use super::file;
use super::image::Image;
use scree_rasters::{Purpose, read};

/// Numbers that are the same in every run (SplitMix64).
struct Draw(u64);

impl Draw {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (bits ^ (bits >> 31)) as usize % end
    }

    /// Bytes that mean much in headers, or any.
    fn byte(&mut self) -> u8 {
        let telling = [0, 1, 2, 3, 4, 127, 128, 255];
        match self.below(2) {
            0 => telling[self.below(telling.len())],
            _ => self.below(256) as u8,
        }
    }
}

#[test]
fn no_alteration_panics() {
    let grid = b"ncols 4\nnrows 3\nxllcorner 5\nyllcorner 9\ncellsize 2\nnodata_value -1\n\
                 1 2 3 4\n5 6 7 8\n9 10 11 12\n";
    let mut draw = Draw(20_261);
    let files = [
        grid.to_vec(),
        Image::plain().bytes(),
        file("lzw-predictor-int16.tif"),
        file("tiled-zstd-uint16.tif"),
        file("bigtiff.tif"),
        file("cloud-optimised.tif"),
        file("scaled-int16.tif"),
    ];
    let mut accepted = 0;
    for whole in &files {
        for _ in 0..ROUNDS {
            let mut bytes = whole.clone();
            for _ in 0..=draw.below(4) {
                let place = draw.below(bytes.len());
                bytes[place] = draw.byte();
            }
            if draw.below(4) == 0 {
                bytes.truncate(draw.below(bytes.len()));
            }
            accepted += usize::from(read(&bytes, Purpose::Surface).is_ok());
        }
    }
    // Many alterations concern a value or a text only.
    assert!(accepted > 100, "{accepted}");
}

const ROUNDS: usize = 2000;
