use super::*;
use crate::raster::Raster;

fn raster(columns: usize, rows: usize, cell: f64, of: impl Fn(f64, f64) -> f64) -> Raster {
    Raster::sampled([columns, rows], cell, of)
}

// Also beyond the edges, as far as the slope there goes on.
#[test]
fn a_plane_is_reproduced() {
    let plane = |x: f64, y: f64| 700.0 + 0.3 * x - 0.8 * y;
    let surface = SplineSurface::through(&raster(7, 5, 2.0, plane), 690.0);
    for (x, y) in [
        (0.3, 0.2),
        (5.0, 5.0),
        (7.1, 9.7),
        (-3.0, 4.0),
        (14.0, 12.0),
    ] {
        let facet = surface.at(x, y);
        assert!(
            (facet.elevation - plane(x, y) + 690.0).abs() < 1e-10,
            "{x} {y}"
        );
        assert!((facet.slope[0] - 0.3).abs() < 1e-11);
        assert!((facet.slope[1] + 0.8).abs() < 1e-11);
    }
    assert!(surface.bulge(6.0, 5.0) < 1e-11);
}

#[test]
fn the_values_at_the_centres_are_kept() {
    let rough = |x: f64, y: f64| 0.1 * (1.7 * x).sin() + 0.05 * (x + 2.0 * y).cos();
    let given = raster(9, 8, 1.0, rough);
    let surface = SplineSurface::through(&given, 0.0);
    for row in 0..8 {
        for column in 0..9 {
            let [x, y] = given.centre(column, row);
            let off = surface.at(x, y).elevation - given.value_at(column, row);
            assert!(off.abs() < 1e-12, "{column} {row}: {off}");
        }
    }
}

// A spline through all values would have a dam of 1.9 m above a cliff of 20 m, and a ditch below.
#[test]
fn a_cliff_leaves_the_ground_beside_it_as_it_is() {
    let slope = |x: f64| 0.3 * x;
    for along_x in [true, false] {
        let cliff = |x: f64, y: f64| {
            let u = if along_x { x } else { y };
            slope(u) + if u < 10.0 { 30.0 } else { 10.0 }
        };
        let surface = SplineSurface::through(&raster(20, 20, 1.0, cliff), 0.0);
        for n in 0..400 {
            let u = 0.05 * f64::from(n);
            let (x, y) = if along_x { (u, 7.3) } else { (7.3, u) };
            let found = surface.at(x, y).elevation;
            if (u - 10.0).abs() > 1.0 {
                assert!((found - cliff(x, y)).abs() < 1e-12, "{u}: {found}");
            } else {
                assert!(found > 10.0 + slope(9.0) && found < 30.0 + slope(10.0));
            }
        }
    }
}

// A break of the slope of 50° is none: its values are kept.
#[test]
fn a_break_of_slope_is_no_cliff() {
    let foot = |x: f64, _: f64| (10.0 - x).max(0.0) * f64::to_radians(50.0).tan();
    let given = raster(20, 6, 1.0, foot);
    let surface = SplineSurface::through(&given, 0.0);
    for column in 0..20 {
        let [x, y] = given.centre(column, 3);
        let off = surface.at(x, y).elevation - foot(x, y);
        assert!(off.abs() < 1e-10, "{column}: {off}");
    }
}

// The error of a smooth surface falls with the third power of the cell.
#[test]
fn a_smooth_surface_is_approached_with_the_third_order() {
    let bowl = |x: f64, y: f64| (0.5 * x).sin() * (0.4 * y).cos();
    let worst = |cell: f64| {
        let cells = (10.0 / cell) as usize;
        let surface = SplineSurface::through(&raster(cells, cells, cell, bowl), 0.0);
        let places = (0..50).map(|n| (3.0 + 0.081 * f64::from(n), 6.5 - 0.063 * f64::from(n)));
        let off = places.map(|(x, y)| (surface.at(x, y).elevation - bowl(x, y)).abs());
        off.fold(0.0, f64::max)
    };
    let ratio = worst(0.5) / worst(0.25);
    assert!(ratio > 6.5, "{ratio}");
}

#[test]
fn curvature_is_the_derivative_of_the_slope() {
    let hilly = |x: f64, y: f64| (1.3 * x).sin() * 2.0 + (x * y).cos();
    let surface = SplineSurface::through(&raster(12, 11, 1.0, hilly), 0.0);
    let step = 1e-6;
    for (x, y) in [(2.3, 3.1), (4.2, 5.4), (7.7, 8.1)] {
        let slope = |x: f64, y: f64| surface.at(x, y).slope;
        let along =
            [0, 1].map(|of| (slope(x + step, y)[of] - slope(x - step, y)[of]) / (2.0 * step));
        let across =
            [0, 1].map(|of| (slope(x, y + step)[of] - slope(x, y - step)[of]) / (2.0 * step));
        let [xx, xy, yy] = surface.curvature(x, y);
        for (one, other) in [
            (xx, along[0]),
            (xy, along[1]),
            (xy, across[0]),
            (yy, across[1]),
        ] {
            assert!((one - other).abs() < 1e-6, "{x} {y}: {one} {other}");
        }
    }
}

#[test]
fn slope_is_the_derivative_and_continuous() {
    let rough = |x: f64, y: f64| (3.0 * x).sin() * 2.0 + (x * y).cos();
    let surface = SplineSurface::through(&raster(9, 8, 1.0, rough), 0.0);
    let step = 1e-6;
    for (x, y) in [(2.3, 3.1), (4.0, 5.0), (0.01, 7.9), (-1.0, 3.0)] {
        let ahead = surface.at(x + step, y).elevation - surface.at(x - step, y).elevation;
        let aside = surface.at(x, y + step).elevation - surface.at(x, y - step).elevation;
        let [sx, sy] = surface.at(x, y).slope;
        assert!((ahead / (2.0 * step) - sx).abs() < 1e-5, "{x} {y}");
        assert!((aside / (2.0 * step) - sy).abs() < 1e-5, "{x} {y}");
    }
    let [before, after] = [3.0 - 1e-9, 3.0 + 1e-9].map(|x| surface.at(x, 2.2).slope[0]);
    assert!((before - after).abs() < 1e-6);
}

#[test]
fn bounds_hold_everywhere_within() {
    let rough = |x: f64, y: f64| (1.3 * x).sin() * 2.0 + (x * y).cos();
    let surface = SplineSurface::through(&raster(12, 11, 1.0, rough), 0.0);
    for low in [[1.2, 3.4], [-2.0, 8.0], [9.5, -1.0]] {
        let high = [low[0] + 2.7, low[1] + 1.9];
        let (highest, steepest) = surface.bounds(low, high);
        let lid = surface.lid(low, high);
        for n in 0..400 {
            let [u, v] = [n % 20, n / 20].map(|n| f64::from(n) / 19.0);
            let [x, y] = [low[0] + 2.7 * u, low[1] + 1.9 * v];
            let here = surface.at(x, y);
            assert!(here.elevation <= highest + 1e-12);
            assert!(here.elevation <= lid.elevation(x, y) + 1e-12);
            assert!(here.slope[0].hypot(here.slope[1]) <= steepest + 1e-12);
        }
    }
}

#[test]
fn the_lid_of_a_plane_is_the_plane() {
    let plane = |x: f64, y: f64| 3.0 + 0.4 * x - 0.3 * y;
    let surface = SplineSurface::through(&raster(12, 11, 1.0, plane), 0.0);
    let lid = surface.lid([2.3, 4.1], [6.2, 7.7]);
    for [x, y] in [[2.3, 4.1], [6.2, 4.1], [3.0, 7.7]] {
        let above = lid.elevation(x, y) - plane(x, y);
        assert!((0.0..1e-12).contains(&above.abs()), "{above}");
    }
}

// A dome z = −κ r²/2 bulges by κ in every direction; a bowl does not.
#[test]
fn a_dome_bulges_and_a_bowl_does_not() {
    let dome = SplineSurface::through(
        &raster(20, 20, 1.0, |x, y| {
            -0.05 * ((x - 10.0).powi(2) + (y - 10.0).powi(2))
        }),
        0.0,
    );
    assert!(
        (dome.bulge(10.3, 9.6) - 0.1).abs() < 1e-6,
        "{}",
        dome.bulge(10.3, 9.6)
    );
    let bowl = SplineSurface::through(&raster(20, 20, 1.0, |x, y| 0.05 * (x * x + y * y)), 0.0);
    assert_eq!(bowl.bulge(10.3, 9.6), 0.0);
}
