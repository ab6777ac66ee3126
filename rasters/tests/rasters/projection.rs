//! Places of maps as longitude and latitude, against PROJ 9.5.1.

use scree_rasters::{Projection, ProjectionError};

/// Metres of a degree of latitude.
const DEGREE: f64 = 111_320.0;

#[test]
fn places_are_those_of_proj() {
    for (epsg, place, [longitude, latitude]) in [
        (
            32632,
            [600_000.0, 5_200_000.0],
            [10.314030877, 46.945988324],
        ),
        // Svalbard, nine degrees off the central meridian of its zone.
        (32633, [300_000.0, 8_700_000.0], [6.179465315, 78.237690642]),
        (
            32756,
            [334_000.0, 6_252_000.0],
            [151.205514687, -33.859261705],
        ),
        (25832, [550_000.0, 5_900_000.0], [9.749329183, 53.246912035]),
        (2154, [700_000.0, 6_600_000.0], [3.0, 46.5]),
        (
            3857,
            [1_000_000.0, 6_000_000.0],
            [8.983152841, 47.353704702],
        ),
        // Bern and the Lower Engadine.
        (
            2056,
            [2_600_000.0, 1_200_000.0],
            [7.438632421, 46.951082772],
        ),
        (
            2056,
            [2_780_000.0, 1_180_000.0],
            [9.794533533, 46.746868929],
        ),
    ] {
        let projection = Projection::of(epsg).unwrap();
        let [east, north] = projection.longitude_latitude(place[0], place[1]).unwrap();
        let across = (east - longitude) * latitude.to_radians().cos() * DEGREE;
        let along = (north - latitude) * DEGREE;
        assert!(
            across.hypot(along) < 1e-3,
            "EPSG:{epsg}: {east} {north}, {across} {along}"
        );
    }
}

#[test]
fn what_is_no_plane_or_not_known_is_refused() {
    assert!(matches!(
        Projection::of(4326),
        Err(ProjectionError::NoPlane { epsg: 4326 })
    ));
    assert!(matches!(
        Projection::of(2),
        Err(ProjectionError::Unknown { epsg: 2 })
    ));
    assert!(matches!(
        Projection::of(102_100),
        Err(ProjectionError::Unknown { .. })
    ));
    assert!(matches!(
        Projection::of(5513),
        Err(ProjectionError::Turned { epsg: 5513 })
    ));
    // NAD27 needs a grid.
    assert!(matches!(
        Projection::of(26710),
        Err(ProjectionError::Unsupported { epsg: 26710, .. })
    ));
    let beyond = Projection::of(2056)
        .unwrap()
        .longitude_latitude(f64::NAN, 0.0);
    assert!(matches!(
        beyond,
        Err(ProjectionError::NoPlace { epsg: 2056, .. })
    ));
}
