"""Studies from their submission to their end."""

from __future__ import annotations

import copy
import uuid

import pytest
import scenes
import scripted

import scree
from scree import client as client_module
from scree import contract

SMALL = {**scenes.FEW, "scenario": {**scenes.SMALL, "bodies": scenes.PLACED}}
LONG = {**scenes.FEW, "scenario": {**scenes.LONG, "bodies": scenes.PLACED}}


def test_a_study_ends_with_all_its_members(study: scree.StudyHandle) -> None:
    assert study.status == "successful"
    assert study.has_ended
    assert study.document["members"] == study.document["members_ended"] == 32
    assert study.document["study"]["questions"] == scenes.STUDY["questions"]
    assert study.id in repr(study)


def test_a_key_names_one_study(client: scree.Client) -> None:
    key = str(uuid.uuid4())
    first = client.submit_study(scenes.FEW, key=key)
    assert client.submit_study(scenes.FEW, key=key).id == first.id
    with pytest.raises(scree.InvalidRequest) as refused:
        client.submit_study(scenes.STUDY, key=key)
    assert refused.value.kind == "urn:scree:problem:key-of-another-request"


def test_a_refused_study_names_every_field(client: scree.Client) -> None:
    study = copy.deepcopy(scenes.STUDY)
    study["inputs"][1]["pointer"] = "/bodies/3/yaw_deg"
    study["design"]["sobol"]["members"] = 12
    with pytest.raises(scree.InvalidRequest) as refused:
        client.submit_study(study)
    pointers = {error.get("pointer") for error in refused.value.errors}
    assert pointers == {"/inputs/1/pointer", "/design/sobol/members"}
    assert "value: 12; allowed:" in str(refused.value)


def test_a_plan_tells_the_cost_of_all_members(client: scree.Client) -> None:
    planned = client.plan_study(SMALL)
    assert planned["cost"]["members"] == 4
    assert planned["cost"]["point_steps"] > 0
    assert planned["wall_time"]["low_s"] <= planned["wall_time"]["high_s"]


def test_studies_are_listed_across_pages(
    client: scree.Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(client_module, "PAGE", 2)
    made = [client.submit_study(scenes.FEW).wait(60).id for _ in range(3)]
    listed = [summary["id"] for summary in client.studies(status="successful")]
    assert listed[:3] == made[::-1]
    assert len(set(listed)) == len(listed)
    assert not set(made) & {summary["id"] for summary in client.studies(status="failed")}


def test_progress_is_told_until_the_end(client: scree.Client) -> None:
    seen: list[contract.StudyState] = []
    client.submit_study(scenes.FEW).wait(60, seen.append)
    ended = [state["members_ended"] for state in seen]
    assert ended == sorted(ended)
    assert ended[-1] == seen[-1]["members"] == 4


def test_an_enlarged_study_goes_on_with_its_members(client: scree.Client) -> None:
    study = client.submit_study(scenes.FEW).wait(60)
    before = [member["job"] for member in study.members()]
    study.change(design={"sobol": {"members": 8, "seed": 2}})
    assert study.wait(60).document["members_ended"] == 8
    assert [member["job"] for member in study.members()][:4] == before


def test_finer_levels_correct_the_first_members(client: scree.Client) -> None:
    few = {**scenes.FEW, "design": {"sobol": {"members": 16, "seed": 2}}}
    study = client.submit_study(few).wait(60)
    coarse = study.document["study"]["scenario"]["numerics"]["cell_size_m"]
    study.change(finer_levels=[{"cell_size_m": coarse / 1.5, "members": 8}])
    assert study.wait(60).document["members_ended"] == 24
    assert [member["level"] for member in study.members(level=1)] == [1] * 8
    first = [member["values"] for member in study.members()][:8]
    assert [member["values"] for member in study.members(level=1)] == first
    assert [level["finished"] for level in study.answers()["levels"]] == [16, 8]


def test_other_questions_get_answers(client: scree.Client) -> None:
    study = client.submit_study(scenes.FEW).wait(60)
    assert study.answers()["answers"] == []
    study.change(questions=[{"buried": {"body": 0, "deeper_than_m": 0}}])
    (answer,) = study.wait(60).answers()["answers"]
    assert list(answer) == ["buried"]


def test_a_smaller_design_is_refused(study: scree.StudyHandle) -> None:
    with pytest.raises(scree.InvalidRequest, match="/design"):
        study.change(design={"sobol": {"members": 16, "seed": 1}})


def test_a_dismissed_study_is_not_waited_for(client: scree.Client) -> None:
    study = client.submit_study(LONG)
    with pytest.raises(
        scree.StudyWaitTimeout, match=f"{study.id} did not end within 0.1 s"
    ) as late:
        study.wait(0.1)
    assert isinstance(late.value, TimeoutError)
    with pytest.raises(scree.Conflict):
        study.remove()
    assert study.dismiss().status == "dismissed"
    with pytest.raises(scree.StudyDismissed, match=study.id):
        study.wait(60)
    with pytest.raises(scree.Conflict):
        study.change(questions=[])


def test_a_failed_study_tells_why() -> None:
    problem = {"type": "t", "title": "Not made", "detail": "member 3", "error_id": "e"}
    state = {"id": "1", "status": "failed", "problem": problem}
    with scripted.server(scripted.answer(200, state)) as (url, _), scree.Client(url) as client:
        study = scree.StudyHandle(client._transport, "1")
        with pytest.raises(scree.StudyFailed) as failed:
            study.wait()
    assert str(failed.value) == 'study 1 failed: Not made: member 3 (error_id = "e")'


def test_a_removed_study_is_gone(client: scree.Client) -> None:
    study = client.submit_study({**scenes.FEW, "title": "removed"}).wait(60)
    assert client.study(study.id).document == study.document
    study.remove()
    with pytest.raises(scree.NotFound):
        client.study(study.id)
