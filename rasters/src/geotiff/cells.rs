//! Numbers of the cells.

use super::{GeoTiffError, Tiff, text};
use tiff::decoder::DecodingResult;
use tiff::tags::Tag;
use tiff::{TiffError, TiffResult, TiffUnsupportedError};

/// `PhotometricInterpretation` of numbers: the least is black.
const BLACK_IS_ZERO: u16 = 1;

/// Type of the number in a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CellType {
    Integer,
    Single,
    Double,
}

impl CellType {
    /// Type of the only band.
    pub(super) fn of(tiff: &mut Tiff<'_>) -> Result<Self, GeoTiffError> {
        let bands = tiff.find_tag_unsigned(Tag::SamplesPerPixel)?.unwrap_or(1);
        if bands != 1 {
            return Err(GeoTiffError::Bands { bands });
        }
        let code = tiff.get_tag_unsigned(Tag::PhotometricInterpretation)?;
        if code != BLACK_IS_ZERO {
            return Err(GeoTiffError::Picture { code });
        }
        let mut first = |tag| -> TiffResult<Option<u16>> {
            let numbers = tiff.find_tag_unsigned_vec(tag)?;
            Ok(numbers.and_then(|numbers: Vec<u16>| numbers.first().copied()))
        };
        let bits = first(Tag::BitsPerSample)?.unwrap_or(1);
        let format = first(Tag::SampleFormat)?.unwrap_or(1);
        match (format, bits) {
            (1 | 2, 8 | 16 | 32) => Ok(Self::Integer),
            (3, 32) => Ok(Self::Single),
            (3, 64) => Ok(Self::Double),
            _ => Err(GeoTiffError::CellType {
                bits,
                kind: kind(format),
            }),
        }
    }

    /// Number that stands for a hole, as a cell has it.
    pub(super) fn nodata(self, tiff: &mut Tiff<'_>) -> Result<Option<f64>, GeoTiffError> {
        let Some(text) = text(tiff, Tag::GdalNodata)? else {
            return Ok(None);
        };
        let Ok(number) = text.parse::<f64>() else {
            return Err(GeoTiffError::Nodata { text });
        };
        let single = f64::from(number as f32);
        let rounds = self == Self::Single && single.is_finite();
        Ok(Some(if rounds { single } else { number }))
    }
}

/// Refuses compressions that are not read, most of which lose something, and a predictor without
/// compression, which some programs undo and others ignore.
pub(super) fn require_known_compression(tiff: &mut Tiff<'_>) -> Result<(), GeoTiffError> {
    let code = tiff.find_tag_unsigned(Tag::Compression)?.unwrap_or(NONE);
    let predictor: u16 = tiff.find_tag_unsigned(Tag::Predictor)?.unwrap_or(NONE);
    match code {
        NONE if predictor != NONE => Err(GeoTiffError::Predictor { code: predictor }),
        // None, LZW, DEFLATE by its two codes, PackBits and ZSTD.
        NONE | 5 | 8 | 32946 | 32773 | 50000 => Ok(()),
        _ => Err(GeoTiffError::Compression {
            code,
            name: compression(code),
        }),
    }
}

/// Code of no compression, and of no predictor.
const NONE: u16 = 1;

/// Name of a `Compression`, with the space before it.
fn compression(code: u16) -> &'static str {
    match code {
        6 | 7 => " JPEG",
        34887 => " LERC",
        34925 => " LZMA",
        50001 => " WebP",
        50002 => " JPEG XL",
        _ => "",
    }
}

/// Name of a `SampleFormat`.
fn kind(format: u16) -> &'static str {
    match format {
        1 => "unsigned integers",
        2 => "signed integers",
        3 => "floating-point numbers",
        5 | 6 => "complex numbers",
        _ => "values of an unknown kind",
    }
}

/// Values row by row from the south.
pub(super) fn values(tiff: &mut Tiff<'_>, columns: usize) -> Result<Vec<f64>, GeoTiffError> {
    let values = match tiff.read_image()? {
        DecodingResult::U8(numbers) => from_the_south(&numbers, columns),
        DecodingResult::I8(numbers) => from_the_south(&numbers, columns),
        DecodingResult::U16(numbers) => from_the_south(&numbers, columns),
        DecodingResult::I16(numbers) => from_the_south(&numbers, columns),
        DecodingResult::U32(numbers) => from_the_south(&numbers, columns),
        DecodingResult::I32(numbers) => from_the_south(&numbers, columns),
        DecodingResult::F32(numbers) => from_the_south(&numbers, columns),
        DecodingResult::F64(numbers) => from_the_south(&numbers, columns),
        // Their types were refused.
        DecodingResult::F16(_) | DecodingResult::U64(_) | DecodingResult::I64(_) => {
            let refused = TiffUnsupportedError::UnsupportedDataType;
            return Err(TiffError::UnsupportedError(refused).into());
        }
    };
    Ok(values)
}

fn from_the_south<T: Copy + Into<f64>>(numbers: &[T], columns: usize) -> Vec<f64> {
    let rows = numbers.chunks_exact(columns).rev();
    rows.flatten().map(|number| (*number).into()).collect()
}
