"""Jobs from their submission to their end."""

from __future__ import annotations

import uuid
from datetime import datetime

import numpy as np
import pytest
import scenes

import scree
from scree import client as client_module
from scree import contract


def label() -> str:
    return f"test:{uuid.uuid4()}"


def test_a_job_ends_with_an_outcome(job: scree.JobHandle) -> None:
    assert job.status == "successful"
    assert job.has_ended
    assert len(job.outcome["bodies"]) == 1
    assert job.outcome["bodies"][0]["displacement_m"] >= 0
    assert job.document["scenario"]["title"] == "small"
    assert job.id in repr(job)


def test_a_typed_scenario_with_numbers_of_numpy_is_accepted(client: scree.Client) -> None:
    scenario: contract.Scenario = {
        "channel": {"inclination_deg": 30, "incline_length_m": 0.4, "runout_length_m": 0.4},
        "flow": None,
        "bodies": [{"shape": {"ball": {"radius_m": 0.02}}}],
        "duration_s": 0,
    }
    bodies = [{**scenario["bodies"][0], "velocity_m_s": np.array([0.5, 0, 0], dtype=np.float32)}]
    job = client.submit({**scenario, "bodies": bodies, "flow_snapshots": np.int64(2)})
    assert job.document["scenario"]["bodies"][0].get("velocity_m_s") == [0.5, 0, 0]


def test_what_is_no_number_is_refused_before_it_is_sent(client: scree.Client) -> None:
    with pytest.raises(ValueError, match="JSON"):
        client.submit({**scenes.SMALL, "duration_s": float("nan")})
    with pytest.raises(TypeError, match="no place in a JSON document"):
        client.submit({**scenes.SMALL, "duration_s": 1j})


def test_a_key_names_one_job(client: scree.Client) -> None:
    key = label()
    first = client.submit(scenes.START, key=key)
    assert client.submit(scenes.START, key=key).id == first.id
    with pytest.raises(scree.InvalidRequest) as refused:
        client.submit(scenes.SMALL, key=key)
    assert refused.value.kind == "urn:scree:problem:key-of-another-request"


def test_calls_without_a_key_make_a_job_each(client: scree.Client) -> None:
    assert client.submit(scenes.START).id != client.submit(scenes.START).id


def test_a_finished_job_is_as_good_as_a_new_one(client: scree.Client) -> None:
    scenario = {**scenes.START, "title": label()}
    job = client.submit(scenario).wait(60)
    assert client.submit(scenario, reuse="finished").id == job.id


def test_a_batch_is_listed_by_its_label_across_pages(
    client: scree.Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(client_module, "PAGE", 2)
    batch = label()
    jobs = client.batch([scenes.START] * 5, label=[batch, "other"])
    listed = [summary["id"] for summary in client.jobs(label=batch)]
    assert sorted(listed) == sorted(job.id for job in jobs)
    for job in jobs:
        job.wait(60)
    assert len(list(client.jobs(label=batch, status="successful"))) == 5
    assert not list(client.jobs(label=batch, status=["failed", "dismissed"]))


def test_jobs_are_listed_by_time_with_their_outcomes(client: scree.Client) -> None:
    begin = datetime.now()
    job = client.submit(scenes.START).wait(60)
    (listed,) = client.jobs(created_from=begin, include=["outcome"])
    assert listed["id"] == job.id
    assert listed.get("outcome") == job.outcome
    assert job.id not in [other["id"] for other in client.jobs(created_to=begin)]


def test_a_plan_tells_the_cost(client: scree.Client) -> None:
    planned = client.plan(scenes.SMALL)
    assert planned["plan"]["cost"]["points"] > 0


def test_progress_is_told_until_the_end(client: scree.Client) -> None:
    seen: list[contract.Progress] = []
    client.submit(scenes.SMALL).wait(60, seen.append)
    fractions = [progress["fraction"] for progress in seen]
    assert fractions
    assert fractions == sorted(fractions)
    assert 0 <= fractions[0] <= fractions[-1] <= 1


def test_a_dismissed_job_has_no_outcome(client: scree.Client) -> None:
    job = client.submit(scenes.LONG)
    with pytest.raises(scree.WaitTimeout, match=f"{job.id} did not end within 0.1 s") as late:
        job.wait(0.1)
    assert isinstance(late.value, TimeoutError)
    with pytest.raises(scree.JobNotEnded, match="wait"):
        _ = job.outcome
    with pytest.raises(scree.Conflict):
        job.remove()
    assert job.dismiss().status == "dismissed"
    with pytest.raises(scree.JobDismissed, match=job.id):
        job.wait(60)


def test_a_failed_job_tells_why(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SCREE_LIMITS__JOB_WALL_TIME_S", "0.3")
    with scree.LocalService() as service, scree.Client(service.url) as client:
        job = client.submit(scenes.LONG)
        with pytest.raises(scree.JobFailed) as failed:
            job.wait(60)
    assert failed.value.problem["type"] == "urn:scree:failure:wall-time"
    assert failed.value.problem["detail"] in str(failed.value)
    assert job.id in str(failed.value)


def test_a_removed_job_is_gone(client: scree.Client) -> None:
    job = client.submit(scenes.START).wait(60)
    assert client.job(job.id).document == job.document
    job.remove()
    with pytest.raises(scree.NotFound):
        client.job(job.id)


def test_run_dismisses_what_takes_too_long(service: scree.LocalService) -> None:
    with pytest.raises(scree.WaitTimeout) as late:
        scree.run(scenes.LONG, url=service.url, timeout_s=0.1)
    with scree.Client(service.url) as client:
        assert client.job(late.value.job_id).status == "dismissed"


def test_run_dismisses_what_is_interrupted(
    service: scree.LocalService, monkeypatch: pytest.MonkeyPatch
) -> None:
    jobs: list[scree.JobHandle] = []

    def interrupt(job: scree.JobHandle, *_: object) -> None:
        jobs.append(job)
        raise KeyboardInterrupt

    monkeypatch.setattr(scree.JobHandle, "wait", interrupt)
    with pytest.raises(KeyboardInterrupt):
        scree.run(scenes.LONG, url=service.url)
    assert jobs[0].refresh()["status"] == "dismissed"


def test_run_starts_a_service_of_its_own() -> None:
    job = scree.run(scenes.START)
    assert job.trajectory()["time_s"].tolist() == [0]
