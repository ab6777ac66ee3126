"""Requests that are repeated, and for how long."""

from __future__ import annotations

import json
import time
import uuid

import httpx
import pytest
import scenes
import scripted

import scree

BUSY = scripted.problem(429, "queue-full", Retry_After="1")


def break_off(_: scripted.Request) -> None:
    """Closes the connection without an answer."""


def test_a_submission_whose_answer_was_lost_makes_one_job(
    client: scree.Client, service: scree.LocalService
) -> None:
    def forward(request: scripted.Request) -> scripted.Answer:
        names = ("Idempotency-Key", "Content-Type")
        headers = {name: request.headers[name] for name in names}
        answer = httpx.post(service.url + request.path, headers=headers, content=request.body)
        return scripted.Answer(answer.status_code, answer.content)

    def lose(request: scripted.Request) -> None:
        forward(request)

    label = f"test:{uuid.uuid4()}"
    with scripted.server(lose, forward) as (url, requests), scree.Client(url) as between:
        job = between.submit(scenes.START, label=label)
    assert len(requests) == 2
    assert [summary["id"] for summary in client.jobs(label=label)] == [job.id]


def test_a_busy_service_is_given_the_time_it_asks_for() -> None:
    with scripted.server(BUSY, scripted.answer(200, {})) as (url, requests):
        with scree.Client(url) as client:
            begin = time.monotonic()
            client.plan({})
    assert len(requests) == 2
    assert time.monotonic() - begin >= 1


def test_a_key_in_use_is_tried_again() -> None:
    in_use = scripted.problem(409, "key-in-use")
    with scripted.server(break_off, in_use, scripted.answer(202, {"id": "1"})) as (url, requests):
        with scree.Client(url) as client:
            assert client.submit({}).id == "1"
    assert len({request.headers["Idempotency-Key"] for request in requests}) == 1


def test_a_study_is_submitted_and_changed_again_after_a_broken_connection() -> None:
    steps = [
        *(break_off, scripted.answer(202, {"id": "1", "status": "running"})),
        *(break_off, scripted.answer(200, {"id": "1", "status": "running"})),
    ]
    with scripted.server(*steps) as (url, requests), scree.Client(url) as client:
        client.submit_study({}).change(questions=[])
    submissions, changes = requests[:2], requests[2:]
    assert len({request.headers["Idempotency-Key"] for request in submissions}) == 1
    assert [request.method for request in changes] == ["PATCH", "PATCH"]
    assert [json.loads(request.body) for request in changes] == [{"questions": []}] * 2


def test_patience_has_an_end() -> None:
    with scripted.server(BUSY) as (url, requests):
        with scree.Client(url, patience_s=0.5) as client, pytest.raises(scree.Busy):
            client.plan({})
    assert len(requests) == 1
    with scripted.server(*[break_off] * 9) as (url, requests):
        with scree.Client(url, patience_s=0.5) as client, pytest.raises(scree.Unreachable):
            client.plan({})
    assert len(requests) == 3


def test_other_refusals_are_not_tried_again() -> None:
    with scripted.server(scripted.problem(409, "job-ended")) as (url, requests):
        with scree.Client(url) as client, pytest.raises(scree.Conflict):
            client.plan({})
    assert len(requests) == 1


def test_a_wrong_address_shows_at_once() -> None:
    with scripted.server() as (url, _):
        pass
    begin = time.monotonic()
    with scree.Client(url) as client, pytest.raises(scree.Unreachable, match=url):
        client.plan({})
    assert time.monotonic() - begin < 5


def test_a_service_that_has_answered_is_waited_for() -> None:
    with scree.LocalService() as service, scree.Client(service.url, patience_s=0.5) as client:
        client.plan(scenes.START)
        service.stop()
        begin = time.monotonic()
        with pytest.raises(scree.Unreachable):
            client.plan(scenes.START)
        assert time.monotonic() - begin > 0.2


def test_no_proxy_comes_between_this_machine_and_itself(
    service: scree.LocalService, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HTTP_PROXY", "http://127.0.0.1:9")
    monkeypatch.setenv("ALL_PROXY", "http://127.0.0.1:9")
    with scree.Client(service.url) as client:
        client.plan(scenes.START)
