//! Rasters written and read back.

use scree_rasters::{Purpose, WriteError, read, write_ascii, write_geotiff};
use scree_solver::raster::Raster;

/// Heights of all magnitudes as 32-bit floats hold them, with a hole.
fn surface(epsg: Option<u32>) -> Raster {
    let value = |place: u32| f64::from((f64::from(place) * 0.7654321).exp2() as f32 - 400.1);
    let mut values: Vec<f64> = (0..15).map(value).collect();
    values[0] = -0.0;
    values[1] = f64::from(f32::MIN_POSITIVE / 4.0);
    values[7] = f64::NAN;
    Raster {
        columns: 5,
        rows: 3,
        cell_size: 0.1,
        west: 600_000.3,
        south: 5_200_000.7,
        epsg,
        values,
    }
}

fn bits(raster: &Raster) -> Vec<u32> {
    let singles = raster.values.iter().map(|value| *value as f32);
    singles.map(f32::to_bits).collect()
}

fn assert_same_place(read: &Raster, written: &Raster) {
    assert_eq!([read.columns, read.rows], [written.columns, written.rows]);
    assert_eq!(read.cell_size, written.cell_size);
    assert_eq!(read.west, written.west);
    // From the northern edge and back.
    assert!((read.south - written.south).abs() < 1e-8);
}

#[test]
fn a_geotiff_keeps_every_bit() {
    for epsg in [Some(32632), None] {
        let written = surface(epsg);
        let file = write_geotiff(&written).unwrap();
        let read = read(&file, Purpose::Surface).unwrap();
        assert_same_place(&read, &written);
        assert_eq!(read.epsg, epsg);
        assert_eq!(bits(&read), bits(&written));
    }
}

#[test]
fn an_ascii_grid_keeps_every_bit_of_a_32_bit_float() {
    let written = surface(None);
    let read = read(write_ascii(&written).as_bytes(), Purpose::Surface).unwrap();
    assert_same_place(&read, &written);
    assert_eq!(bits(&read), bits(&written));
}

#[test]
fn an_ascii_grid_is_written_from_the_north() {
    let raster = Raster {
        columns: 3,
        rows: 3,
        cell_size: 0.5,
        west: -1.5,
        south: 20.25,
        epsg: Some(2056),
        values: vec![1.0, 2.0, 3.5, 4.0, f64::NAN, 6.0, 7.0, 0.1, 9.0],
    };
    let header = "ncols 3\nnrows 3\nxllcorner -1.5\nyllcorner 20.25\ncellsize 0.5\n";
    let values = "NODATA_value -9999\n7 0.1 9\n4 -9999 6\n1 2 3.5\n";
    assert_eq!(write_ascii(&raster), [header, values].concat());
}

#[test]
fn an_ascii_grid_may_have_keys_in_any_case_and_a_cell_s_centre() {
    let corner = "ncols 3\nnrows 3\nxllcorner 10\nyllcorner 20\ncellsize 2\n1 2 3 4 5 6 7 8 9\n";
    let centre = "\u{feff}NROWS 3\r\nNCOLS 3\r\nXLLCENTER 11\r\nYLLCENTER 21\r\nDX 2\r\nDY 2\r\n\
                  NODATA_value -9999\r\n\r\n 1 2\r\n3 4 5 6\r\n7 8 9";
    let corner = read(corner.as_bytes(), Purpose::HeightMap).unwrap();
    assert_eq!(read(centre.as_bytes(), Purpose::HeightMap).unwrap(), corner);
}

#[test]
fn a_code_beyond_the_format_is_refused() {
    let error = write_geotiff(&surface(Some(102_100))).unwrap_err();
    assert!(matches!(error, WriteError::Epsg { epsg: 102_100 }));
}
