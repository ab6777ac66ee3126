"""Maps of resting places, read by other programs."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
import pytest
import rasterio  # type: ignore[import-untyped]
import scenes
from rasterio.features import geometry_mask  # type: ignore[import-untyped]

import scree
from scree import contract


@pytest.fixture(scope="module")
def rest(study: scree.StudyHandle) -> contract.RestDistribution:
    return cast(contract.StudyAnswer1, study.answers()["answers"][0])["rest"]


def region(study: scree.StudyHandle, probability: float) -> dict[str, Any]:
    features = study.rest_geojson()["features"]
    regions = [one for one in features if one["properties"]["kind"] == "region"]
    return next(one for one in regions if one["properties"]["probability"] == probability)


def test_the_geotiff_is_read_by_gdal(
    study: scree.StudyHandle, rest: contract.RestDistribution
) -> None:
    density = rest["density"]
    assert density is not None
    columns, rows = density["nodes"]
    with rasterio.MemoryFile(study.rest_geotiff()) as file, file.open() as image:
        band, spacing, corner = image.read(1), image.res, image.xy(rows - 1, 0)
    assert spacing == pytest.approx(density["spacing_m"])
    # The centre of the first pixel in the last row, which is the nearest to the origin.
    assert corner == pytest.approx(density["origin_m"])
    assert band.sum(dtype=float) * np.prod(spacing) == pytest.approx(1, abs=0.01)
    assert np.allclose(band, np.reshape(density["density_per_m2"], (rows, columns))[::-1])


def test_the_largest_density_is_in_the_region(study: scree.StudyHandle) -> None:
    half, most = region(study, 0.5), region(study, 0.8)
    assert 0 < half["properties"]["area_m2"] < most["properties"]["area_m2"]
    with rasterio.MemoryFile(study.rest_geotiff()) as file, file.open() as image:
        band, transform = image.read(1), image.transform
    within = geometry_mask([half["geometry"]], band.shape, transform, invert=True)
    assert within.flat[band.argmax()]


def test_too_few_members_have_no_density(client: scree.Client) -> None:
    few = client.submit_study({**scenes.FEW, "questions": scenes.STUDY["questions"]}).wait(60)
    assert few.rest_geojson()["features"] == []
    with pytest.raises(scree.NotFound, match="too few members"):
        few.rest_geotiff()
