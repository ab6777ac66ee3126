"""Makes height maps: python make.py {jacksboro,channel,plane,bowl} [options]

Needs numpy and rasterio, and matplotlib for jacksboro. All are GeoTIFF files of 32-bit floats.

jacksboro   The steepest square near the Jacksboro fault, Tennessee: slopes above a valley, from
            data of the Shuttle Radar Topography Mission (public domain) of three arc-seconds,
            about 90 m, which matplotlib has as the sample jacksboro_fault_dem.npz
            (https://github.com/matplotlib/matplotlib/pull/3291).
channel     An incline along x, its foot at x = 0, and a floor at height 0.
plane       An inclined plane that falls in any direction, its middle at (0, 0) and 100 m high.
bowl        A paraboloid about (0, 0), 0 m high at its bottom.
"""

import argparse
from pathlib import Path

import numpy as np
import rasterio
from rasterio.transform import Affine, from_bounds, from_origin
from rasterio.warp import Resampling, calculate_default_transform, reproject

HERE = Path(__file__).parent
# The sample lies about 84.25° W, just inside zone 16.
UTM = "EPSG:32616"


def write(path, heights, west, north, cell_size, crs=None):
    rows, columns = heights.shape
    with rasterio.open(path, "w", driver="GTiff", width=columns, height=rows, count=1,
                       dtype="float32", crs=crs, compress="deflate", predictor=3,
                       transform=from_origin(west, north, cell_size, cell_size)) as file:
        file.write(heights.astype("float32"), 1)
    print(f"{path}: {columns} × {rows} cells of {cell_size} m, {heights.min():.2f} m to "
          f"{heights.max():.2f} m, {path.stat().st_size} bytes")


def mountain(cell_size):
    """The sample in UTM, NaN round it, and its affine map."""
    from matplotlib.cbook import get_sample_data

    sample = get_sample_data("jacksboro_fault_dem.npz")
    degrees = sample["elevation"].astype("float32")
    rows, columns = degrees.shape
    # The sample's ymin is its northern edge.
    south, north = sorted([float(sample["ymin"]), float(sample["ymax"])])
    bounds = float(sample["xmin"]), south, float(sample["xmax"]), north
    place = from_bounds(*bounds, columns, rows)
    transform, width, height = calculate_default_transform(
        "EPSG:4326", UTM, columns, rows, *bounds, resolution=cell_size)
    # On whole multiples of a cell.
    west, top = (round(edge / cell_size) * cell_size for edge in (transform.c, transform.f))
    transform = Affine(cell_size, 0, west, 0, -cell_size, top)
    heights = np.full((height, width), np.nan, "float32")
    reproject(degrees, heights, src_transform=place, src_crs="EPSG:4326", dst_transform=transform,
              dst_crs=UTM, dst_nodata=np.nan, resampling=Resampling.cubic)
    return heights, transform


def slopes(heights, cell_size):
    """Slope of each cell [°]."""
    south, east = np.gradient(heights, cell_size)
    return np.degrees(np.arctan(np.hypot(south, east)))


def steepest(slope, cells):
    """First row and column of the square window with the greatest mean slope, without holes."""
    sums = np.pad(np.cumsum(np.cumsum(slope.astype(float), 0), 1), ((1, 0), (1, 0)))
    totals = sums[cells:, cells:] - sums[:-cells, cells:] - sums[cells:, :-cells] + sums[:-cells, :-cells]
    return np.unravel_index(np.argmax(totals), totals.shape)


def jacksboro(options):
    heights, transform = mountain(options.cell_size)
    slope = slopes(heights, options.cell_size)
    # Cells next to the sample's edge have no slope either: they count as flat.
    slope = np.where(np.isnan(slope), -1e3, slope)
    cells = round(options.side / options.cell_size)
    row, column = steepest(slope, cells)
    window = np.s_[row:row + cells, column:column + cells]
    west, north = transform * (column, row)
    write(options.output or HERE / "jacksboro.tif", heights[window], west, north,
          options.cell_size, UTM)
    print(f"easting {west:.0f} m, northing {north:.0f} m at the north-western corner; mean slope "
          f"{slope[window].mean():.1f}°, steepest {slope[window].max():.1f}°")


def grid(west, east, width, cell_size):
    """Centres of cells: x of each column, y of each row from the north."""
    columns, rows = round((east - west) / cell_size), round(width / cell_size)
    x = west + (np.arange(columns) + 0.5) * cell_size
    y = 0.5 * rows * cell_size - (np.arange(rows) + 0.5) * cell_size
    return np.meshgrid(x, y)


def channel(options):
    west = -options.incline_length * np.cos(np.radians(options.inclination))
    cells_up = int(np.ceil(-west / options.cell_size))
    west = -cells_up * options.cell_size
    x, y = grid(west, options.runout_length, options.width, options.cell_size)
    heights = np.tan(np.radians(options.inclination)) * np.maximum(-x, 0)
    write(options.output or HERE / "channel.tif", heights, west, 0.5 * len(y) * options.cell_size,
          options.cell_size)


def plane(options):
    half = 0.5 * options.side
    x, y = grid(-half, half, options.side, options.cell_size)
    turn = np.radians(options.towards)
    heights = 100 - np.tan(np.radians(options.inclination)) * (x * np.cos(turn) + y * np.sin(turn))
    write(options.output or HERE / "plane.tif", heights, -half, half, options.cell_size)


def bowl(options):
    half = 0.5 * options.side
    x, y = grid(-half, half, options.side, options.cell_size)
    heights = options.depth * (x**2 + y**2) / half**2
    write(options.output or HERE / "bowl.tif", heights, -half, half, options.cell_size)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    kinds = parser.add_subparsers(required=True)

    def kind(function, **numbers):
        options = kinds.add_parser(function.__name__,
                                   formatter_class=argparse.ArgumentDefaultsHelpFormatter)
        for name, (default, text) in numbers.items():
            options.add_argument(f"--{name.replace('_', '-')}", type=float, default=default, help=text)
        options.add_argument("--output", type=Path, help="file")
        options.set_defaults(function=function)

    kind(jacksboro, cell_size=(25, "side of a cell [m]"), side=(2500, "side of the window [m]"))
    kind(channel, cell_size=(0.01, "side of a cell [m]"), inclination=(40, "[°]"),
         incline_length=(1.5, "along the incline [m]"), runout_length=(1, "length of the floor [m]"),
         width=(0.9, "across [m]"))
    kind(plane, cell_size=(0.05, "side of a cell [m]"), side=(4, "[m]"), inclination=(20, "[°]"),
         towards=(30, "direction in which it falls, from east towards north [°]"))
    kind(bowl, cell_size=(0.01, "side of a cell [m]"), side=(1, "[m]"),
         depth=(0.25, "height of the rim half a side from the middle [m]"))
    return parser.parse_args()


if __name__ == "__main__":
    options = arguments()
    options.function(options)
