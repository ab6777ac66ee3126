"""Trajectories, snapshots and pictures."""

from __future__ import annotations

import zipfile
from pathlib import Path

import httpx
import numpy as np
import pytest
import scenes

import scree
from scree.columns import COLUMNS


def test_a_trajectory_has_all_columns(job: scree.JobHandle) -> None:
    trajectory = job.trajectory()
    samples = len(trajectory["time_s"])
    assert samples > 2
    assert set(trajectory) == set(COLUMNS)
    assert trajectory["position_m"].shape == (samples, 3)
    assert trajectory["orientation"].shape == (samples, 4)
    assert trajectory["touching_points"].dtype == np.uint32
    assert trajectory["mode"][0] == "resting"
    assert "position_m" in repr(trajectory)


def test_a_part_of_a_trajectory(job: scree.JobHandle) -> None:
    part = job.trajectory(from_s=0.05, to_s=0.15, stride=2, fields=["time_s", "velocity_m_s"])
    assert list(part) == ["time_s", "velocity_m_s"]
    assert np.allclose(part["time_s"], np.arange(0.05, 0.151, 0.02))


def test_a_table_has_the_columns_of_the_services_csv(
    job: scree.JobHandle, service: scree.LocalService
) -> None:
    table = job.trajectory().to_pandas()
    csv = httpx.get(f"{service.url}/v1/jobs/{job.id}/trajectory.csv").text
    assert [table.index.name, *table.columns] == csv.splitlines()[0].split(",")
    assert table.attrs["units"]["position_m_x"] == "m"
    assert table["position_m_z"].to_list() == job.trajectory()["position_m"][:, 2].tolist()


def test_a_dataset_has_units(job: scree.JobHandle) -> None:
    trajectory = job.trajectory()
    dataset = trajectory.to_xarray()
    assert set(dataset.variables) == {*trajectory, "axis", "quaternion"}
    assert dataset["flow_force_n"].attrs == {"units": "N", "long_name": "Force of the flow"}
    assert dataset["orientation"].dims == ("time_s", "quaternion")
    downstream = dataset["position_m"].sel(axis="x", time_s=0.1, method=None)
    assert downstream == trajectory["position_m"][10, 0]
    assert dataset.attrs["job_id"] == job.id


@pytest.mark.parametrize("name", [n for n in COLUMNS if n.endswith(("_s", "_m", "_n", "_nm"))])
def test_a_unit_in_a_name_is_the_unit_of_the_column(name: str) -> None:
    named = {"_rad_s": "rad/s", "_m_s": "m/s", "_nm": "N m", "_n": "N", "_s": "s", "_m": "m"}
    unit = next(unit for ending, unit in named.items() if name.endswith(ending))
    assert COLUMNS[name].unit == unit
    assert "[" not in COLUMNS[name].description or "," in COLUMNS[name].description


def test_rotation_turns_the_body_into_the_channel(client: scree.Client) -> None:
    turned = {"shape": {"cube": {"side_m": 0.04}}, "yaw_deg": 30, "position": {"downstream_m": 0.1}}
    job = client.submit({**scenes.START, "bodies": [turned]}).wait(60)
    (rotation,) = job.trajectory().rotation()
    half = np.sqrt(3) / 2
    assert np.allclose(rotation, [[half, -0.5, 0], [0.5, half, 0], [0, 0, 1]])


def test_the_flow_at_an_instant(job: scree.JobHandle) -> None:
    start, end = job.flow(0.0), job.flow()
    assert start.time_s == 0 < end.time_s
    assert start.position_m.shape == (len(start.speed_m_s), 3)
    assert start.position_m.dtype == start.speed_m_s.dtype == np.float32
    assert start.points >= len(start.speed_m_s) > 0
    assert (start.speed_m_s == 0).all()
    assert end.speed_m_s.max() > 0


def test_snapshots_for_paraview(job: scree.JobHandle, tmp_path: Path) -> None:
    job.flow_archive(tmp_path / "flow.zip")
    with zipfile.ZipFile(tmp_path / "flow.zip") as archive:
        assert "flow.pvd" in archive.namelist()


def test_pictures_are_shown_by_notebooks(job: scree.JobHandle) -> None:
    for picture in (job.picture("motion"), job.picture("aerial")):
        assert picture.startswith("<svg")
        assert picture._repr_svg_() == picture


def test_what_is_not_there_is_not_found(client: scree.Client, job: scree.JobHandle) -> None:
    with pytest.raises(scree.NotFound, match="body"):
        job.trajectory(7)
    still = client.submit({**scenes.START, "flow_snapshots": 0}).wait(60)
    with pytest.raises(scree.NotFound):
        still.flow()
