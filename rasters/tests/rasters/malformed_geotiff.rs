//! GeoTIFF files that are refused, each with its message.

use super::image::{
    Image, KEY_DOUBLES, METADATA, NODATA, PREDICTOR, SCALE, TIE_POINT, TRANSFORMATION,
};
use super::{file, refusal};
use scree_rasters::{Purpose, read};

#[test]
fn files_of_gdal_have_their_messages() {
    let geographic = "the coordinates are geographic, and degrees are no metres; reproject the \
                      raster to a projected coordinate system in metres, such as UTM";
    for (name, message) in [
        ("geographic.tif", geographic),
        (
            "feet.tif",
            "the coordinates are in US survey feet (unit 9003); they must be in metres (9001)",
        ),
        (
            "complex.tif",
            "the cells have complex numbers of 64 bits; integers of 8, 16 and 32 bits and \
             floating-point numbers of 32 and 64 bits are read",
        ),
        (
            "two-bands.tif",
            "the TIFF has 2 bands; a raster of numbers has 1",
        ),
        ("rgb.tif", "the TIFF has 3 bands; a raster of numbers has 1"),
        (
            "mask.tif",
            "the TIFF marks holes by a mask; write them as a nodata value",
        ),
        (
            "feet-heights.tif",
            "the values are in \"ft\"; they must be in metres",
        ),
        (
            "compound-feet.tif",
            "the heights are those of EPSG:6360, in feet; they must be in metres",
        ),
        (
            "no-georeference.tif",
            "the TIFF has no georeference: neither ModelPixelScale with ModelTiepoint nor \
             ModelTransformation",
        ),
        (
            "control-points.tif",
            "the TIFF is placed by 3 control points; warp it to a regular grid",
        ),
        (
            "sparse.tif",
            "block 0 of the TIFF is left out; write the file with SPARSE_OK=FALSE",
        ),
        (
            "rotated.tif",
            "the raster is rotated, sheared or mirrored: a column leads by (4.330127018922194, \
             -2.4999999999999996) m and a row by (-2.4999999999999996, -4.330127018922194) m; a \
             column must lead due east and a row due south",
        ),
    ] {
        assert_eq!(refusal(&file(name)), message, "{name}");
    }
}

#[test]
fn the_plain_image_is_read() {
    let raster = read(&Image::plain().bytes(), Purpose::HeightMap).unwrap();
    assert_eq!(
        (raster.west, raster.south, raster.cell_size),
        (500.0, 894.0, 2.0)
    );
}

/// Changes of the georeference.
#[test]
fn placements_have_their_messages() {
    let placed = |doubles: &[(u16, &[f64])]| {
        let doubles = doubles
            .iter()
            .map(|(tag, numbers)| (*tag, numbers.to_vec()));
        refusal(&Image::with(|image| image.doubles = doubles.collect()))
    };
    let tie: (u16, &[f64]) = (TIE_POINT, &[0.0, 0.0, 0.0, 500.0, 900.0, 0.0]);
    assert_eq!(
        placed(&[(SCALE, &[2.0, 3.0, 0.0]), tie]),
        "the cells are 2 m wide and 3 m high; they must be square, so resample the raster"
    );
    assert_eq!(
        placed(&[(SCALE, &[2.0, -2.0, 0.0]), tie]),
        "the raster is rotated, sheared or mirrored: a column leads by (2, 0) m and a row by (0, \
         2) m; a column must lead due east and a row due south"
    );
    assert_eq!(
        placed(&[(SCALE, &[2.0, 2.0]), tie]),
        "the tag ModelPixelScale has 2 numbers, which is not its length"
    );
    assert_eq!(
        placed(&[(SCALE, &[2.0, 2.0, 0.0]), (TIE_POINT, &[0.0, 0.0, 0.0])]),
        "the tag ModelTiepoint has 3 numbers, which is not its length"
    );
    assert_eq!(
        placed(&[(TRANSFORMATION, &[2.0, 0.0, 0.0, 500.0])]),
        "the tag ModelTransformation has 4 numbers, which is not its length"
    );
    assert_eq!(
        placed(&[(SCALE, &[2.0, 2.0, 0.3048]), tie]),
        "the georeference scales heights by 0.3048 with offset 0; write plain metres"
    );
    assert_eq!(
        placed(&[(SCALE, &[f64::NAN, 2.0, 0.0]), tie]),
        "the cells have a side of NaN m; possible are 0.01 m to 1000 m"
    );
    assert_eq!(
        placed(&[(SCALE, &[5e3, 5e3, 0.0]), tie]),
        "the cells have a side of 5000 m; possible are 0.01 m to 1000 m"
    );
}

#[test]
fn a_transformation_without_rotation_is_read() {
    let numbers = [
        [2.0, 0.0, 0.0, 500.0],
        [0.0, -2.0, 0.0, 900.0],
        [0.0; 4],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let turned = Image::with(|image| {
        image.doubles = vec![(TRANSFORMATION, numbers.as_flattened().to_vec())];
    });
    let plain = read(&Image::plain().bytes(), Purpose::HeightMap).unwrap();
    assert_eq!(read(&turned, Purpose::HeightMap).unwrap(), plain);
}

/// Changes of what the coordinates mean.
#[test]
fn coordinates_have_their_messages() {
    let keyed = |keys: &[[u16; 4]]| refusal(&Image::with(|image| image.keys = keys.to_vec()));
    let projected = [1024, 0, 1, 1];
    assert_eq!(
        keyed(&[[1024, 0, 1, 3]]),
        "the coordinates are geocentric; reproject the raster to a projected coordinate system in \
         metres, such as UTM"
    );
    assert!(keyed(&[[2048, 0, 1, 4326]]).starts_with("the coordinates are geographic"));
    assert!(keyed(&[projected, [3072, 0, 1, 4326]]).starts_with("the coordinates are geographic"));
    assert_eq!(
        keyed(&[projected, [3076, 0, 1, 32767]]),
        "the coordinates are in another unit (unit 32767); they must be in metres (9001)"
    );
    assert_eq!(
        keyed(&[projected, [3072, 0, 1, 2263]]),
        "a unit of EPSG:2263 is 0.3048006096012192 m long; coordinates must be in metres"
    );
    assert_eq!(
        keyed(&[projected, [4099, 0, 1, 9002]]),
        "the heights are in feet (unit 9002); they must be in metres (9001)"
    );
    assert_eq!(
        keyed(&[projected, [4096, 0, 1, 6360]]),
        "the heights are those of EPSG:6360, in feet; they must be in metres"
    );
}

/// A unit of length that has a size instead of a code.
#[test]
fn sizes_of_units_have_their_messages() {
    let sized = |metres| {
        Image::with(|image| {
            image.keys.push([3077, KEY_DOUBLES, 1, 0]);
            image.doubles.push((KEY_DOUBLES, vec![metres]));
        })
    };
    assert_eq!(
        refusal(&sized(0.3048)),
        "the unit of the coordinates is 0.3048 m long; they must be in metres"
    );
    let plain = read(&Image::plain().bytes(), Purpose::HeightMap).unwrap();
    assert_eq!(read(&sized(1.0), Purpose::HeightMap).unwrap(), plain);
}

#[test]
fn a_predictor_without_compression_has_its_message() {
    let predicted = Image::with(|image| image.shorts.push((PREDICTOR, 3)));
    assert_eq!(
        refusal(&predicted),
        "the TIFF has the predictor 3 but no compression; write it with compression, or with the \
         predictor 1"
    );
}

/// Texts that GDAL adds.
#[test]
fn texts_have_their_messages() {
    let noted = |tag, text| refusal(&Image::with(|image| image.texts = vec![(tag, text)]));
    assert_eq!(
        noted(NODATA, "none"),
        "GDAL_NODATA is \"none\", which is no number"
    );
    assert_eq!(
        noted(METADATA, "<GDALMetadata>"),
        "GDAL_METADATA is no XML: the root node was opened but never closed"
    );
    assert_eq!(
        noted(METADATA, "<M><Item sample='0' role='scale'>big</Item></M>"),
        "the scale in GDAL_METADATA is \"big\"; it must be a finite number, a scale not 0"
    );
    assert_eq!(
        noted(METADATA, "<M><Item sample='0' role='scale'>0</Item></M>"),
        "the scale in GDAL_METADATA is \"0\"; it must be a finite number, a scale not 0"
    );
}

/// The file with other entries in its directory, each with its tag and type and then its value
/// before and after.
fn patched(name: &str, patches: &[(u16, [u16; 2], [u32; 2])]) -> Vec<u8> {
    let mut bytes = file(name);
    for (tag, types, values) in patches {
        let [from, to] = [0, 1].map(|side| entry(*tag, types[side], values[side]));
        let place = bytes.windows(12).position(|window| window == from);
        let place = place.expect("the entry is there");
        bytes[place..place + 12].copy_from_slice(&to);
    }
    bytes
}

/// Entry of a directory: tag, type, count of one, value.
fn entry(tag: u16, kind: u16, value: u32) -> Vec<u8> {
    let head = [tag, kind, 1, 0].map(u16::to_le_bytes);
    [head.as_flattened(), &value.to_le_bytes()].concat()
}

const SHORT: u16 = 3;
const LONG: u16 = 4;
const WIDTH: u16 = 256;
const HEIGHT: u16 = 257;
const COMPRESSION: u16 = 259;
const PHOTOMETRIC: u16 = 262;
const ROWS_PER_STRIP: u16 = 278;

#[test]
fn broken_files_have_their_messages() {
    let name = "lzw-predictor-int16.tif";
    let whole = file(name);
    for length in [6, whole.len() - 40] {
        assert_eq!(
            refusal(&whole[..length]),
            format!("the TIFF of {length} bytes ends before its raster does; was it cut off?")
        );
    }
    for (code, packed) in [(7, "7 JPEG"), (34887, "34887 LERC"), (2, "2")] {
        assert_eq!(
            refusal(&patched(name, &[(COMPRESSION, [SHORT; 2], [5, code])])),
            format!(
                "the TIFF has compression {packed}; LZW, DEFLATE, ZSTD, PackBits and none are read"
            )
        );
    }
    assert_eq!(
        refusal(&patched(name, &[(PHOTOMETRIC, [SHORT; 2], [1, 0])])),
        "the TIFF has photometric interpretation 0, that of a picture; a raster of numbers has 1"
    );
}

#[test]
fn sizes_are_refused_before_memory_is_taken() {
    let name = "lzw-predictor-int16.tif";
    assert_eq!(
        refusal(&patched(
            name,
            &[(WIDTH, [SHORT, LONG], [20, 4_000_000_000])]
        )),
        "the raster has 4000000000 × 12 cells; at most 100000000 in all are read here"
    );
    let large = [
        (WIDTH, [SHORT; 2], [20, 65_000]),
        (HEIGHT, [SHORT; 2], [12, 1500]),
        (ROWS_PER_STRIP, [SHORT; 2], [12, 1500]),
    ];
    assert_eq!(
        refusal(&patched(name, &large)),
        "the TIFF of 442 bytes unpacks to 780000000 bytes; at most 10000 for each of its bytes \
         (or 64 MiB) are read, so write the file with less compression"
    );
    let few = [(WIDTH, [SHORT; 2], [20, 2])];
    assert_eq!(
        refusal(&patched(name, &few)),
        "the raster has 2 × 12 cells; at least 3 × 3 are needed"
    );
}
