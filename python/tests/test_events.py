"""Events of jobs."""

from __future__ import annotations

import scenes
import scripted

import scree

STREAM = {"Content-Type": "text/event-stream"}
PROGRESS = b'event: progress\ndata: {"id":"1","progress":{"fraction":0.5}}\n\n'
EVENT = b'id: %d\nevent: %s\ndata: {"id":"1"}\n\n'


def stream(*events: bytes) -> scripted.Step:
    return lambda _: scripted.Answer(200, b"".join(events), STREAM)


def test_a_job_is_followed_to_its_end(client: scree.Client) -> None:
    job = client.submit(scenes.SMALL)
    events = [event for event in job.events() if event.kind == "status"]
    assert [event.data["status"] for event in events] == ["accepted", "running", "successful"]
    assert {event.data["id"] for event in events} == {job.id}
    late = [event.data["status"] for event in job.events(events[1].number) if event in events]
    assert late == ["successful"]


def test_all_jobs_are_followed_from_a_number(client: scree.Client) -> None:
    job = client.submit(scenes.START).wait(60)
    first = next(job.events())
    assert next(client.events(first.number - 1)) == first


def test_a_broken_stream_goes_on_after_the_last_event() -> None:
    steps = [
        stream(EVENT % (4, b"status"), PROGRESS),
        scripted.problem(503, "timed-out"),
        stream(PROGRESS, EVENT % (7, b"status"), EVENT % (9, b"status")),
        scripted.answer(204),
    ]
    with scripted.server(*steps) as (url, requests), scree.Client(url) as client:
        job = scree.JobHandle(client._transport, "1")
        events = list(job.events())
    assert [event.number for event in events] == [4, 4, 4, 7, 9]
    assert [event.number for event in events if event.kind == "status"] == [4, 7, 9]
    assert [request.headers.get("Last-Event-ID") for request in requests] == [None, "4", "4", "9"]


def test_the_events_of_a_removed_job_end() -> None:
    steps = [stream(EVENT % (3, b"removed"))]
    with scripted.server(*steps) as (url, _), scree.Client(url) as client:
        (event,) = scree.JobHandle(client._transport, "1").events()
    assert (event.number, event.kind) == (3, "removed")
