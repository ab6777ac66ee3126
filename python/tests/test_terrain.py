"""A job on a terrain, from a height map written by GDAL to results that GDAL reads."""

from __future__ import annotations

from typing import Any

import httpx
import numpy as np
import pytest
import rasterio  # type: ignore[import-untyped]

import scree

WEST, NORTH, CELL = 600_000.0, 5_000_010.0, 1.0
#: From columns and rows to places.
PLACE = rasterio.Affine(CELL, 0, WEST, 0, -CELL, NORTH)


@pytest.fixture(scope="module")
def height_map() -> bytes:
    """A slope of 12 by 10 cells that falls by 0.4 to the east, in UTM zone 32 north."""
    heights = np.tile(700 - 0.4 * np.arange(12, dtype="float32"), (10, 1))
    with rasterio.MemoryFile() as file:
        with file.open(
            driver="GTiff",
            width=12,
            height=10,
            count=1,
            dtype="float32",
            crs="EPSG:32632",
            compress="zstd",
            transform=PLACE,
        ) as image:
            image.write(heights, 1)
        return bytes(file.read())


@pytest.fixture(scope="module")
def results(service: scree.LocalService, client: scree.Client, height_map: bytes) -> str:
    """Address of a job's results on that slope."""
    uploaded = httpx.post(
        f"{service.url}/v1/terrains", content=height_map, headers={"content-type": "image/tiff"}
    )
    assert uploaded.status_code == 201, uploaded.text
    scenario: dict[str, Any] = {
        "terrain": {"height_map": uploaded.json()["hash"]},
        "flow": {
            "releases": [
                {
                    "polygon_m": [
                        [WEST + 1.5, NORTH - 7],
                        [WEST + 4, NORTH - 7],
                        [WEST + 4, NORTH - 3],
                        [WEST + 1.5, NORTH - 3],
                    ],
                    "thickness_m": 0.6,
                }
            ]
        },
        "bodies": [
            {
                "shape": {"cube": {"side_m": 0.8}},
                "position": {"east_m": WEST + 5.5, "north_m": NORTH - 5},
            }
        ],
        "duration_s": 0.5,
        "numerics": {"cell_size_m": 0.35},
    }
    job = client.submit(scenario).wait(120)
    return f"{service.url}/v1/jobs/{job.id}"


def test_maps_are_read_by_gdal_where_the_height_map_lies(results: str) -> None:
    deposit = httpx.get(f"{results}/maps/deposit.tif").raise_for_status().content
    with rasterio.MemoryFile(deposit) as file, file.open() as image:
        assert image.crs.to_epsg() == 32632
        assert image.transform == PLACE
        band = image.read(1, masked=True)
        assert image.shape == (10, 12)
    # 2.5 m by 4 m by 0.6 m, none of which has left the map.
    assert float(band.sum()) * CELL**2 == pytest.approx(6.0, rel=1e-3)
    text = httpx.get(f"{results}/maps/deposit.asc").raise_for_status().content
    with rasterio.MemoryFile(text, ext="asc") as file, file.open() as image:
        assert np.ma.allclose(image.read(1, masked=True), band)


def test_tracks_lie_where_the_bodies_were(results: str) -> None:
    answer = httpx.get(f"{results}/tracks.geojson?coordinates=wgs84").raise_for_status()
    features = answer.json()["features"]
    points = [one["geometry"] for one in features if one["geometry"]["type"] == "Point"]
    # 600 km east and 5,000 km north in zone 32, about 9° E of which is its middle.
    longitude, latitude = points[0]["coordinates"][:2]
    assert longitude == pytest.approx(10.27, abs=0.01)
    assert latitude == pytest.approx(45.15, abs=0.01)
