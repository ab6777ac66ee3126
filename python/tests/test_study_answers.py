"""Answers, members and pictures of a study."""

from __future__ import annotations

import csv
from typing import Any, cast

import httpx
import numpy as np
import pytest

import scree
from scree import study as study_module


def test_each_question_has_an_answer(study: scree.StudyHandle) -> None:
    answers = study.answers()
    assert [list(answer) for answer in answers["answers"]] == [["rest"], ["sensitivity"]]
    assert answers["members"]["finished"] == 32


def test_members_are_listed_across_pages(
    client: scree.Client, study: scree.StudyHandle, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(study_module, "MEMBERS_PAGE", 10)
    members = list(study.members())
    assert [member["member"] for member in members] == list(range(32))
    x, y = np.array([member["values"] for member in members]).T
    assert 0.1 <= x.min() < x.max() <= 0.2
    assert -0.02 <= y.min() < y.max() <= 0.02
    job = client.job(cast(str, members[7]["job"]))
    assert job.outcome["bodies"][0]["displacement_m"] == 0


def test_the_table_has_the_members_inputs_and_quantities(study: scree.StudyHandle) -> None:
    table = study.table()
    values = np.array([member["values"] for member in study.members()])
    assert (table["bodies.0.position.downstream_m"] == values[:, 0]).all()
    assert (table["body0.rest_x_m"] == values[:, 0]).all()
    assert (table["body0.rest_y_m"] == values[:, 1]).all()
    assert "runout_m" in repr(table)


def test_a_table_of_pandas_has_the_columns_of_the_services_csv(
    study: scree.StudyHandle, service: scree.LocalService
) -> None:
    frame = study.table().to_pandas()
    text = httpx.get(f"{service.url}/v1/studies/{study.id}/members.csv").text
    heading, *rows = csv.reader(text.splitlines())
    names = [name.lstrip("/").replace("/", ".") for name in heading if name != "failure"]
    assert list(frame) == names
    assert frame["runout_m"].to_list() == [float(row[heading.index("runout_m")]) for row in rows]
    assert frame.attrs["study_id"] == study.id


@pytest.mark.parametrize("name", ["rest", "sensitivity", "scatter"])
def test_pictures_are_shown_by_notebooks(study: scree.StudyHandle, name: Any) -> None:
    picture = study.picture(name)
    assert picture.startswith("<svg")
    assert picture._repr_svg_() == picture


def test_a_question_is_named_by_its_place(study: scree.StudyHandle) -> None:
    assert study.rest_geojson(0) == study.rest_geojson()
    assert study.rest_geotiff(0) == study.rest_geotiff()
    assert study.picture("sensitivity", 1) == study.picture("sensitivity")
    with pytest.raises(scree.NotFound, match="question 1 of the study has no resting place"):
        study.rest_geojson(1)
    with pytest.raises(scree.InvalidRequest, match=r"question: .*value: "):
        study.picture("scatter", 1)
