//! Cells of the maps: where they are, and tiles of them where the flow is.

use crate::raster::Raster;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::Range;

/// Cells along the side of a tile.
const SIDE: usize = 16;
/// Cells of a tile.
pub(super) const CELLS: usize = SIDE * SIDE;

/// Grid of the maps' cells, in the height map's coordinates. It covers the whole height map.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Frame {
    /// Side of a cell [m].
    pub cell_size: f64,
    /// Numbers of cells to the east and to the north.
    pub count: [usize; 2],
    /// Easting and northing of the south-western corner [m].
    corner: [f64; 2],
    epsg: Option<u32>,
}

/// Place of a tile, in tiles.
pub(super) type TileIndex = [u32; 2];

impl Frame {
    /// Cells of a height map, or as many of them together as the computation's [m] have room for.
    pub(super) fn of(height: &Raster, cell_size: f64) -> Self {
        let together = height.cells_within(cell_size);
        Self {
            cell_size: height.cell_size * together as f64,
            count: [height.columns, height.rows].map(|cells| cells.div_ceil(together)),
            corner: [height.west, height.south],
            epsg: height.epsg,
        }
    }

    /// A raster of a value for each cell of these tiles; NaN where there is none.
    pub(super) fn raster<T>(&self, tiles: &Tiles<T>, value: impl Fn(&T) -> Option<f64>) -> Raster {
        let [columns, rows] = self.count;
        let mut raster = Raster {
            columns,
            rows,
            cell_size: self.cell_size,
            west: self.corner[0],
            south: self.corner[1],
            epsg: self.epsg,
            values: vec![f64::NAN; columns * rows],
        };
        for (tile, cells) in tiles.all() {
            for (place, cell) in cells.iter().enumerate() {
                let [column, row] = cell_of(tile, place);
                if column < columns
                    && row < rows
                    && let Some(value) = value(cell)
                {
                    let place = raster.index(column, row);
                    raster.values[place] = value;
                }
            }
        }
        raster
    }
}

/// Values of the cells of some tiles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Tiles<T>(BTreeMap<TileIndex, Vec<T>>);

impl<T> Default for Tiles<T> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

impl<T: Clone + Default> Tiles<T> {
    /// The cells of a tile, which is made if it isn't there.
    pub(super) fn at(&mut self, tile: TileIndex) -> &mut [T] {
        let made = || vec![T::default(); CELLS];
        self.0.entry(tile).or_insert_with(made)
    }
}

impl<T> Tiles<T> {
    /// These tiles, each with the values of its cells.
    pub(super) fn of(tiles: impl Iterator<Item = (TileIndex, Vec<T>)>) -> Self {
        Self(tiles.collect())
    }

    /// All tiles in order.
    pub(super) fn all(&self) -> impl Iterator<Item = (TileIndex, &[T])> {
        self.0.iter().map(|(tile, cells)| (*tile, cells.as_slice()))
    }

    /// Tiles with other values, by tile, place in it and value.
    pub(super) fn with<U>(&self, value: impl Fn(TileIndex, usize, &T) -> U) -> Tiles<U> {
        let of = |(tile, cells): (&TileIndex, &Vec<T>)| {
            let cells = cells.iter().enumerate();
            let values = cells.map(|(place, cell)| value(*tile, place, cell));
            (*tile, values.collect())
        };
        Tiles(self.0.iter().map(of).collect())
    }

    /// Value of a cell, if its tile is there.
    pub(super) fn get(&self, tile: TileIndex, place: usize) -> Option<&T> {
        self.0.get(&tile)?.get(place)
    }
}

/// Tile of a cell, and the places in it of the cell and those east of it.
pub(super) fn row_of(cell: [usize; 2]) -> (TileIndex, Range<usize>) {
    let tile = cell.map(|along| (along / SIDE) as u32);
    let row = cell[1] % SIDE * SIDE;
    (tile, row + cell[0] % SIDE..row + SIDE)
}

fn cell_of(tile: TileIndex, place: usize) -> [usize; 2] {
    let [column, row] = tile.map(|along| along as usize * SIDE);
    [column + place % SIDE, row + place / SIDE]
}
