//! Files made by GDAL, with `files/make.py`.

use super::file;
use scree_rasters::{Purpose, hash, read};
use scree_solver::raster::Raster;

/// 100 + column + 3 row as the file counts, which is from the north.
fn expected(columns: usize, rows: usize) -> Vec<f64> {
    let from_the_south = (0..rows).rev();
    let row = |row| (0..columns).map(move |column| (100 + column + 3 * row) as f64);
    from_the_south.flat_map(row).collect()
}

fn plain(columns: usize, rows: usize) -> Raster {
    Raster {
        columns,
        rows,
        cell_size: 5.0,
        west: 600_000.0,
        south: 5_200_060.0 - 5.0 * rows as f64,
        epsg: Some(32632),
        values: expected(columns, rows),
    }
}

#[test]
fn types_of_cells_and_compressions_are_read() {
    for name in [
        "lzw-predictor-int16.tif",
        "deflate-predictor-float32.tif",
        "deflate-predictor-float64.tif",
        "zstd-predictor-int32.tif",
        "packbits-uint8.tif",
        "uint32-strips.tif",
        "tiled-lzw-float32.tif",
        "tiled-zstd-uint16.tif",
        "bigtiff.tif",
        "big-endian.tif",
        "big-endian-float64.tif",
        "pixel-is-point.tif",
        "scaled-int16.tif",
    ] {
        let raster = read(&file(name), Purpose::HeightMap);
        let raster = raster.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(raster, plain(20, 12), "{name}");
    }
}

#[test]
fn overviews_of_a_cloud_optimised_file_are_ignored() {
    let raster = read(&file("cloud-optimised.tif"), Purpose::HeightMap).unwrap();
    assert_eq!(raster, plain(150, 140));
}

#[test]
fn signed_bytes_are_read() {
    let raster = read(&file("int8.tif"), Purpose::HeightMap).unwrap();
    let lowered: Vec<f64> = expected(20, 12).iter().map(|value| value - 100.0).collect();
    assert_eq!(raster.values, lowered);
}

#[test]
fn holes_of_a_surface_stay_holes() {
    for (name, holes) in [("uint16-nodata.tif", 2), ("float32-lowest-nodata.tif", 1)] {
        let raster = read(&file(name), Purpose::Surface).unwrap();
        assert!(raster.value_at(5, 9).is_nan(), "{name}");
        let found = raster.values.iter().filter(|value| value.is_nan()).count();
        assert_eq!(found, holes, "{name}");
    }
}

#[test]
fn holes_of_a_thickness_have_none() {
    let raster = read(&file("uint16-nodata.tif"), Purpose::Thickness).unwrap();
    assert_eq!(raster.value_at(5, 9), 0.0);
    assert_eq!(raster.value_at(6, 9), 112.0);
}

#[test]
fn sample_terrains_are_height_maps() {
    let sample = |name: &str| {
        let bytes = file(&format!("../../../configs/terrains/{name}.tif"));
        read(&bytes, Purpose::HeightMap).unwrap()
    };
    let mountain = sample("jacksboro");
    assert_eq!((mountain.cell_size, mountain.epsg), (25.0, Some(32616)));
    let channel = sample("channel");
    let fall = channel.value_at(0, 0) - channel.value_at(100, 0);
    assert!((fall - 40_f64.to_radians().tan()).abs() < 1e-6);
    // The foot of the incline is at x = 0.
    let [x, _] = channel.centre(114, 0);
    assert!((x + 0.005).abs() < 1e-9);
    assert!(channel.value_at(114, 0) > 0.0 && channel.value_at(115, 0) == 0.0);
    let bowl = sample("bowl");
    let [x, y] = bowl.centre(70, 20);
    assert!((bowl.value_at(70, 20) - (x * x + y * y)).abs() < 1e-6);
}

#[test]
fn content_has_the_name_of_its_digest() {
    // The example of FIPS 180-2.
    let digest = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
    assert_eq!(hash(b"abc"), digest);
}
