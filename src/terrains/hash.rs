//! Names of terrains: the SHA-256 of their files.

use sha2::{Digest, Sha256};
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;
use thiserror::Error;

/// SHA-256 of a terrain's file, by which the terrain is named.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TerrainHash([u8; 32]);

/// Text that names no terrain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("a terrain is named by the SHA-256 of its file, 64 hexadecimal digits in lower case")]
pub struct NoTerrainHash;

impl TerrainHash {
    /// Name of the terrain with this file.
    pub fn of(file: &[u8]) -> Self {
        Self(Sha256::digest(file).into())
    }
}

/// Hash of a file that comes piece by piece.
#[derive(Debug, Clone, Default)]
pub(super) struct TerrainHasher(Sha256);

impl TerrainHasher {
    /// Takes the next piece.
    pub(super) fn update(&mut self, piece: &[u8]) {
        self.0.update(piece);
    }

    /// Name of the terrain with all pieces.
    pub(super) fn finish(self) -> TerrainHash {
        TerrainHash(self.0.finalize().into())
    }
}

impl Display for TerrainHash {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        self.0
            .iter()
            .try_for_each(|byte| write!(formatter, "{byte:02x}"))
    }
}

impl FromStr for TerrainHash {
    type Err = NoTerrainHash;

    fn from_str(text: &str) -> Result<Self, NoTerrainHash> {
        let is_legal = |byte: u8| matches!(byte, b'0'..=b'9' | b'a'..=b'f');
        if text.len() != 64 || !text.bytes().all(is_legal) {
            return Err(NoTerrainHash);
        }
        let mut hash = [0; 32];
        for (place, byte) in hash.iter_mut().enumerate() {
            let digits = &text[2 * place..2 * place + 2];
            *byte = u8::from_str_radix(digits, 16).map_err(|_| NoTerrainHash)?;
        }
        Ok(Self(hash))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_the_sha_256_in_lower_case() {
        let hash = TerrainHash::of(b"abc");
        let text = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(hash.to_string(), text);
        assert_eq!(text.parse(), Ok(hash));
        for wrong in [&text.to_uppercase(), &text[1..], &format!("{text}0"), "ä"] {
            assert_eq!(wrong.parse::<TerrainHash>(), Err(NoTerrainHash), "{wrong}");
        }
    }
}
