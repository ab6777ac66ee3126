//! ESRI ASCII grids that are refused, each with its message.

use super::refusal;

const GRID: &str = "ncols 4\nnrows 3\nxllcorner 500\nyllcorner 900\ncellsize 2\n\
                    1 2 3 4\n5 6 7 8\n9 10 11 12\n";

/// The grid with a text in place of another, and the message with which it is refused.
const CHANGES: [(&str, &str, &str); 27] = [
    (
        "ncols 4",
        "ncols 0",
        "the raster has 0 × 3 cells; at least 3 × 3 are needed",
    ),
    (
        "nrows 3",
        "nrows 2",
        "the raster has 4 × 2 cells; at least 3 × 3 are needed",
    ),
    (
        "ncols 4",
        "ncols 4000000000",
        "the raster has 4000000000 × 3 cells; at most 100000000 in all are read here",
    ),
    (
        "ncols 4",
        "ncols 1e300",
        "the raster has 18446744073709551615 × 3 cells; at most 100000000 in all are read here",
    ),
    (
        "ncols 4",
        "ncols -4",
        "ncols is -4; it must be a whole number from 0 on",
    ),
    (
        "ncols 4",
        "ncols 4.5",
        "ncols is 4.5; it must be a whole number from 0 on",
    ),
    (
        "nrows 3",
        "nrows nan",
        "nrows is NaN; it must be a whole number from 0 on",
    ),
    (
        "ncols 4",
        "ncols",
        "line 1 has 0 numbers for the key ncols, which needs 1",
    ),
    (
        "ncols 4",
        "ncols 4 4",
        "line 1 has 2 numbers for the key ncols, which needs 1",
    ),
    (
        "nrows 3",
        "nrows three",
        "line 2 has \"three\", which is no number",
    ),
    ("nrows 3\n", "", "the ASCII grid has no nrows"),
    (
        "xllcorner 500\n",
        "",
        "the ASCII grid has no xllcorner or xllcenter",
    ),
    (
        "yllcorner 900\n",
        "",
        "the ASCII grid has no yllcorner or yllcenter",
    ),
    (
        "cellsize 2",
        "dx 2",
        "the ASCII grid has no cellsize, nor dx and dy",
    ),
    (
        "cellsize 2",
        "cellsize 2\ndy 2",
        "the ASCII grid has both cellsize and dx or dy; one of them is needed",
    ),
    (
        "xllcorner 500",
        "xllcorner 500\nXLLCENTER 501",
        "the ASCII grid has both xllcorner and xllcenter; one of them is needed",
    ),
    (
        "nrows 3",
        "nrows 3\nNCOLS 4",
        "line 3 repeats the key ncols of line 1",
    ),
    (
        "nrows 3",
        "nrows 3\nbyteorder LSBFIRST",
        "line 3 has the key \"byteorder\"; keys are ncols, nrows, xllcorner or xllcenter, \
         yllcorner or yllcenter, cellsize or dx and dy, and nodata_value",
    ),
    (
        "cellsize 2",
        "cellsize -2",
        "the cells have a side of -2 m; possible are 0.01 m to 1000 m",
    ),
    (
        "cellsize 2",
        "cellsize nan",
        "the cells have a side of NaN m; possible are 0.01 m to 1000 m",
    ),
    (
        "cellsize 2",
        "cellsize 0.000277",
        "the cells have a side of 0.000277, less than 0.01 m: that looks like degrees, which are \
         no metres; reproject the raster to a projected coordinate system in metres",
    ),
    (
        "cellsize 2",
        "dx 2\ndy 3",
        "the cells are 2 m wide and 3 m high; they must be square, so resample the raster",
    ),
    (
        "yllcorner 900",
        "yllcorner 1e12",
        "the western edge is at 500 m and the southern one at 1000000000000 m; possible are \
         -100000000 m to 100000000 m",
    ),
    (
        "7 8",
        "7,5 8",
        "line 7 has \"7,5\"; decimals stand after a point, not a comma",
    ),
    ("7 8", "seven 8", "line 7 has \"seven\", which is no number"),
    (
        "9 10",
        "9",
        "the ASCII grid has 11 values; its columns and rows need 12",
    ),
    (
        "11 12",
        "11 12 13",
        "line 8 has values beyond the 12 that columns and rows need",
    ),
];

#[test]
fn each_has_its_message() {
    for (from, to, message) in CHANGES {
        assert!(GRID.contains(from), "{from}");
        let grid = GRID.replacen(from, to, 1);
        assert_eq!(refusal(grid.as_bytes()), message, "{from} -> {to}");
    }
}

#[test]
fn other_bytes_are_neither_format() {
    assert_eq!(refusal(b""), "the file is empty");
    let message = |start: &str| {
        format!(
            "the file begins with \"{start}\", which is neither a TIFF nor an ESRI ASCII grid \
             (whose first word is a key such as ncols)"
        )
    };
    assert_eq!(
        refusal(b"\x89PNG\r\n\x1a\n...."),
        message("\\x89PNG\\r\\n\\x1a\\n")
    );
    assert_eq!(refusal(b"II\x29\0...."), message("II)\\x00...."));
    assert_eq!(refusal(b"<html>"), message("<html>"));
    let grid = [GRID.as_bytes(), b"\xff"].concat();
    let position = GRID.len();
    let expected = format!("the ASCII grid is no text from byte {position} on");
    assert_eq!(refusal(&grid), expected);
}
