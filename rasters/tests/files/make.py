"""Makes the GeoTIFF files here with GDAL, by rasterio: python make.py

All hold the same 20 × 12 heights (or those of a larger grid where blocks need them):
100 + column + 3 row as the file counts, in cells of 5 m from (600000, 5200060) in EPSG:32632.
"""

import warnings
from pathlib import Path

import numpy as np
import rasterio
from rasterio.shutil import copy
from rasterio.transform import from_origin

HERE = Path(__file__).parent
PLAIN = {"crs": "EPSG:32632", "transform": from_origin(600000, 5200060, 5, 5)}


def heights(rows=12, columns=20):
    row, column = np.mgrid[0:rows, 0:columns]
    return 100 + column + 3 * row


def write(name, values, **options):
    """A file with one band; options as GDAL has them."""
    rows, columns = values.shape
    shape = {"height": rows, "width": columns, "count": 1, "dtype": values.dtype}
    options = {**PLAIN, **options}
    with rasterio.open(HERE / name, "w", driver="GTiff", **shape, **options) as file:
        file.write(values, 1)


def main():
    plain = heights()
    write("lzw-predictor-int16.tif", plain.astype("int16"), compress="lzw", predictor=2)
    write("deflate-predictor-float32.tif", plain.astype("float32"), compress="deflate", predictor=3)
    write("deflate-predictor-float64.tif", plain.astype("float64"), compress="deflate", predictor=3)
    write("zstd-predictor-int32.tif", plain.astype("int32"), compress="zstd", predictor=2)
    write("packbits-uint8.tif", plain.astype("uint8"), compress="packbits")
    write("int8.tif", (plain - 100).astype("int8"))
    write("uint32-strips.tif", plain.astype("uint32"), blockysize=5)
    tiles = {"tiled": True, "blockxsize": 16, "blockysize": 16}
    write("tiled-lzw-float32.tif", plain.astype("float32"), compress="lzw", predictor=3, **tiles)
    write("tiled-zstd-uint16.tif", plain.astype("uint16"), compress="zstd", predictor=2, **tiles)
    write("bigtiff.tif", plain.astype("float32"), bigtiff="yes", compress="deflate")
    write("big-endian.tif", plain.astype("int16"), endianness="big", compress="lzw", predictor=2)
    write("big-endian-float64.tif", plain.astype("float64"), endianness="big", compress="deflate")

    # The tie point is the centre of the first cell.
    with rasterio.Env(GTIFF_POINT_GEO_IGNORE=False):
        write("pixel-is-point.tif", plain.astype("int16"), compress="lzw")
        with rasterio.open(HERE / "pixel-is-point.tif", "r+") as file:
            file.update_tags(AREA_OR_POINT="Point")

    holey = plain.astype("uint16")
    holey[2, 5] = holey[3, 6] = 65535
    write("uint16-nodata.tif", holey, nodata=65535, compress="deflate")
    lowest = plain.astype("float32")
    lowest[2, 5] = np.finfo("float32").min
    write("float32-lowest-nodata.tif", lowest, nodata=float(np.finfo("float32").min), compress="zstd")

    write("scaled-int16.tif", (100 * (plain - 50)).astype("int16"), compress="deflate")
    with rasterio.open(HERE / "scaled-int16.tif", "r+") as file:
        file.scales, file.offsets = [0.01], [50.0]
        file.units = ["metre"]

    # Large enough for overviews.
    write("plain.tmp.tif", heights(140, 150).astype("int16"))
    cog = {"driver": "COG", "compress": "zstd", "predictor": "yes", "blocksize": 128}
    copy(HERE / "plain.tmp.tif", HERE / "cloud-optimised.tif", **cog)
    (HERE / "plain.tmp.tif").unlink()

    # What is refused.
    write("geographic.tif", plain.astype("int16"), crs="EPSG:4326", transform=from_origin(9, 47, 0.1, 0.1))
    write("feet.tif", plain.astype("int16"), crs="EPSG:2263")
    write("complex.tif", plain.astype("complex64"), compress="deflate")
    write("rotated.tif", plain.astype("int16"), transform=PLAIN["transform"] @ rasterio.Affine.rotation(30))
    with warnings.catch_warnings(action="ignore"):
        write("no-georeference.tif", plain.astype("int16"), crs=None, transform=None)
    points = [rasterio.control.GroundControlPoint(row, column, 5 * column, -5 * row)
              for row, column in [(0, 0), (0, 9), (9, 0)]]
    write("control-points.tif", plain.astype("int16"), transform=None, gcps=points)
    write("sparse.tif", np.zeros((32, 32), "int16"), sparse_ok=True, **tiles)
    with rasterio.open(HERE / "two-bands.tif", "w", driver="GTiff", height=12, width=20, count=2,
                       dtype="int16", compress="deflate", **PLAIN) as file:
        file.write(plain.astype("int16"), 1)
    with rasterio.open(HERE / "rgb.tif", "w", driver="GTiff", height=12, width=20, count=3,
                       dtype="uint8", photometric="rgb", compress="deflate", **PLAIN) as file:
        file.write(plain.astype("uint8"), 1)
    with rasterio.Env(GDAL_TIFF_INTERNAL_MASK=True):
        write("mask.tif", plain.astype("int16"), compress="deflate")
        with rasterio.open(HERE / "mask.tif", "r+") as file:
            file.write_mask(plain > 110)
    write("feet-heights.tif", plain.astype("int16"), compress="deflate")
    with rasterio.open(HERE / "feet-heights.tif", "r+") as file:
        file.units = ["ft"]
    write("compound-feet.tif", plain.astype("int16"), crs="EPSG:32632+6360")


if __name__ == "__main__":
    main()
