//! Strips and tiles, before they are decoded.

use super::{GeoTiffError, Tiff};
use tiff::decoder::ChunkType;
use tiff::tags::Tag;

/// Bytes of values that any file may have.
const ALWAYS: u64 = 64 << 20;
/// Bytes of values, 8 for each, for a byte of a larger file: somewhat more than DEFLATE makes of
/// equal cells of one byte, so that only files made to fill memory exceed it, or those with hardly
/// any content.
const PACKED: u64 = 10_000;
/// Most images in a file: overviews each halve the resolution.
const MOST_IMAGES: usize = 64;
/// Bit of `NewSubfileType`: a mask of the image.
const MASK: u32 = 4;

/// Refuses blocks that are left out, and more values than the file can honestly have.
pub(super) fn check(
    tiff: &mut Tiff<'_>,
    [columns, rows]: [usize; 2],
    bytes: usize,
) -> Result<(), GeoTiffError> {
    let (sizes, width, height) = match tiff.get_chunk_type() {
        ChunkType::Strip => {
            let rows_in_strip = tiff.find_tag_unsigned(Tag::RowsPerStrip)?;
            let height: u64 = rows_in_strip.unwrap_or(rows as u64);
            (
                Tag::StripByteCounts,
                columns as u64,
                height.min(rows as u64),
            )
        }
        ChunkType::Tile => {
            let width = tiff.get_tag_unsigned(Tag::TileWidth)?;
            let height = tiff.get_tag_unsigned(Tag::TileLength)?;
            (Tag::TileByteCounts, width, height)
        }
    };
    let sizes = tiff.get_tag_u64_vec(sizes)?;
    if let Some(block) = sizes.iter().position(|size| *size == 0) {
        return Err(GeoTiffError::Sparse { block });
    }
    let cells = width.saturating_mul(height);
    let values = cells.saturating_mul(8 * sizes.len() as u64);
    if values > ALWAYS.max(PACKED * bytes as u64) {
        return Err(GeoTiffError::Bomb { values, bytes });
    }
    Ok(())
}

/// Refuses holes that a further image marks.
pub(super) fn refuse_mask(tiff: &mut Tiff<'_>) -> Result<(), GeoTiffError> {
    for _ in 0..MOST_IMAGES {
        if !tiff.more_images() {
            return Ok(());
        }
        tiff.next_image()?;
        let kind: Option<u32> = tiff.find_tag_unsigned(Tag::NewSubfileType)?;
        if kind.is_some_and(|kind| kind & MASK != 0) {
            return Err(GeoTiffError::Mask);
        }
    }
    Err(GeoTiffError::TooManyImages { most: MOST_IMAGES })
}
