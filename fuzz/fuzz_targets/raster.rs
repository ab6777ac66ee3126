//! A raster read from any bytes: no panic; a height map is whole, and comes back from both formats.

#![no_main]

use libfuzzer_sys::fuzz_target;
use scree_rasters::{Purpose, read, write_ascii, write_geotiff};

fuzz_target!(|bytes: &[u8]| {
    let Ok(raster) = read(bytes, Purpose::HeightMap) else {
        return;
    };
    assert_eq!(raster.values.len(), raster.columns * raster.rows);
    assert!(raster.values.iter().all(|value| value.is_finite()));
    let singles = raster.values.iter().map(|value| f64::from(*value as f32));
    let singles: Vec<f64> = singles.collect();
    let again = read(write_ascii(&raster).as_bytes(), Purpose::Surface).expect("it was valid");
    assert_eq!(
        again
            .values
            .iter()
            .map(|value| f64::from(*value as f32))
            .collect::<Vec<_>>(),
        singles
    );
    let file = write_geotiff(&raster).expect("its code came from a file");
    let again = read(&file, Purpose::Surface).expect("it was valid");
    assert_eq!(again.values, singles);
});
