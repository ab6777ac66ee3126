"""Problem documents as exceptions."""

from __future__ import annotations

import copy
import pickle

import pytest
import scenes
import scripted

import scree
from scree import errors


def test_a_refused_scenario_names_every_field(client: scree.Client) -> None:
    scenario = copy.deepcopy(scenes.SMALL)
    scenario["channel"]["inclination_deg"] = 95
    scenario["bodies"][0]["shape"]["cube"]["side_m"] = -1
    with pytest.raises(scree.InvalidRequest) as refused:
        client.submit(scenario)
    text = str(refused.value)
    assert "/channel/inclination_deg" in text
    assert "value: 95; allowed: 0 <= x <= 89; unit: °" in text
    assert "/bodies/0/shape/cube/side_m" in text
    assert "value: -1;" in text
    assert len(refused.value.errors) == 2
    assert refused.value.status == 422


def test_a_refused_parameter_is_named(job: scree.JobHandle) -> None:
    with pytest.raises(scree.InvalidRequest, match=r"stride: .*value: \"0\"; allowed:"):
        job.trajectory(stride=0)


def test_an_identifier_is_no_path(client: scree.Client) -> None:
    with pytest.raises(scree.NotFound, match=r"no job \.\./jobs"):
        client.job("../jobs")


@pytest.mark.parametrize(
    ("status", "exception"),
    [(401, scree.NotPermitted), (403, scree.NotPermitted), (507, scree.RequestRefused)],
)
def test_a_problem_has_the_type_of_its_status(
    status: int, exception: type[scree.RequestRefused]
) -> None:
    with scripted.server(scripted.problem(status, "some-kind")) as (url, _):
        with scree.Client(url) as client, pytest.raises(exception) as refused:
            client.plan({})
    assert type(refused.value) is exception
    assert refused.value.kind == "urn:scree:problem:some-kind"


def test_a_token_is_sent() -> None:
    with scripted.server(scripted.answer(200, {})) as (url, requests):
        with scree.Client(url, token="secret") as client:
            client.plan({})
    assert requests[0].headers["Authorization"] == "Bearer secret"


def test_an_answer_of_something_else_is_shown() -> None:
    with scripted.server(scripted.answer(502, b"<p>proxy</p>")) as (url, _):
        with scree.Client(url) as client, pytest.raises(
            scree.UnexpectedAnswer, match=r"502.*proxy"
        ):
            client.plan({})


@pytest.mark.parametrize(
    "error",
    [
        errors.refusal({"type": "t", "title": "T", "status": 404, "detail": "D"}),
        scree.JobFailed("1", {"type": "t", "title": "T", "detail": "D"}),
        scree.JobDismissed("1"),
        scree.WaitTimeout("1", 2.0),
        scree.StudyFailed("1", {"type": "t", "title": "T", "detail": "D"}),
        scree.StudyDismissed("1"),
        scree.StudyWaitTimeout("1", 2.0),
    ],
)
def test_exceptions_can_be_sent_between_processes(error: scree.ScreeError) -> None:
    copied = pickle.loads(pickle.dumps(error))
    assert type(copied) is type(error)
    assert str(copied) == str(error)


def test_a_failure_has_its_numbers() -> None:
    failure = {"type": "t", "title": "Not finite", "detail": "point 3", "time_s": 0.5, "point": 3}
    error = scree.JobFailed("1", failure)  # type: ignore[arg-type] # with its own members
    assert str(error) == "job 1 failed: Not finite: point 3 (time_s = 0.5; point = 3)"
