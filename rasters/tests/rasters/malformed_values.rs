//! Values that their purpose refuses, each with its message.

use super::{file, refusal};
use scree_rasters::{Purpose, read};

/// A grid of 3 × 3 cells of 2 m with holes of -1.
fn grid(values: &str) -> String {
    format!("ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 2\nnodata_value -1\n{values}\n")
}

fn refused(values: &str, purpose: Purpose) -> String {
    let error = read(grid(values).as_bytes(), purpose).unwrap_err();
    error.to_string()
}

#[test]
fn a_height_map_is_whole() {
    assert_eq!(
        refusal(grid("1 2 3  4 5 -1  -1 8 nan").as_bytes()),
        "the cell in row 1 and column 2, counted from 0 in the north-western corner, has no \
         height (its number is -1); 3 of 9 cells have none, and none may be without"
    );
    assert_eq!(
        refusal(&file("uint16-nodata.tif")),
        "the cell in row 2 and column 5, counted from 0 in the north-western corner, has no \
         height (its number is 65535); 2 of 240 cells have none, and none may be without"
    );
    assert_eq!(
        refused("1 2 3  nan 5 6  7 8 9", Purpose::Friction),
        "the cell in row 1 and column 0, counted from 0 in the north-western corner, has no \
         coefficient of friction (its number is NaN); 1 of 9 cells have none, and none may be \
         without"
    );
}

#[test]
fn values_are_finite_and_possible() {
    assert_eq!(
        refusal(grid("1 2 3  4 5 6  7 -inf 9").as_bytes()),
        "the height in row 2 and column 1, counted from 0 in the north-western corner, is -inf; \
         it must be finite"
    );
    assert_eq!(
        refused("1 2 3  4 1e999 6  7 8 9", Purpose::Surface),
        "the height in row 1 and column 1, counted from 0 in the north-western corner, is inf; \
         it must be finite"
    );
    assert_eq!(
        refusal(grid("1 2 3  4 -9999 6  7 8 9").as_bytes()),
        "the height in row 1 and column 1, counted from 0 in the north-western corner, is -9999 \
         m; possible are -500 m to 9000 m; is this an undeclared nodata value?"
    );
    assert_eq!(
        refused("0 2 3  4 5 6  7 8 -0.5", Purpose::Thickness),
        "the thickness in row 2 and column 2, counted from 0 in the north-western corner, is -0.5 \
         m; possible are 0 m to 1000 m; is this an undeclared nodata value?"
    );
    assert_eq!(
        refused("0 2 3  4 5 12  7 8 9", Purpose::Friction),
        "the coefficient of friction in row 1 and column 2, counted from 0 in the north-western \
         corner, is 12; possible are 0 to 10; is this an undeclared nodata value?"
    );
}

#[test]
fn a_height_map_has_no_spikes() {
    let message = |value, cell, other_value, other| {
        format!(
            "the height rises or falls from {value} m in {cell} to {other_value} m in {other}, \
             counted from 0 in the north-western corner; between cells of 2 m at most 200 m are \
             possible; is this an undeclared nodata value?"
        )
    };
    assert_eq!(
        refusal(grid("1 2 3  4 0 6  7 8 300").as_bytes()),
        message(6, "row 1 and column 2", 300, "row 2 and column 2")
    );
    assert_eq!(
        refusal(grid("1500 1400 1300  1500 1400 1300  1500 1400 0").as_bytes()),
        message(1300, "row 1 and column 2", 0, "row 2 and column 2")
    );
    assert_eq!(
        refusal(grid("0 0 201  0 0 201  0 0 201").as_bytes()),
        message(0, "row 0 and column 1", 201, "row 0 and column 2")
    );
    // A step at the limit is ground; a surface may have any.
    assert!(
        read(
            grid("0 0 200  0 0 200  0 0 200").as_bytes(),
            Purpose::HeightMap
        )
        .is_ok()
    );
    assert!(read(grid("0 0 201  0 0 0  0 0 0").as_bytes(), Purpose::Surface).is_ok());
}
