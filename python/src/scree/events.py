"""Changes of jobs, as the service sends them."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Iterator

import httpx

from scree.errors import Busy, ScreeError, Unreachable
from scree.transport import NothingMore, Parameters, Transport


@dataclass(frozen=True)
class JobEvent:
    """A change of a job.

    Attributes
    ----------
    number : int
        Number of the event, or of the last before it that has one; a stream goes on after it
        with ``after=number``.
    kind : str
        ``"status"``; ``"removed"``; ``"progress"`` of a followed job, which has no number; or
        ``"reset"``: the service's database was restored, and what is known may be wrong.
    data : dict
        ``id`` of the job, with ``status`` and ``attempt``, or with ``progress``.
    """

    number: int
    kind: str
    data: dict[str, Any]


def follow(transport: Transport, job_id: str | None, after: int | None) -> Iterator[JobEvent]:
    """Events after a number, across broken connections; those of one job end with it."""
    parameters: Parameters = [] if job_id is None else [("job", job_id)]
    retries = transport.retries()
    while True:
        problem: ScreeError = Unreachable("the service ended the stream of events")
        try:
            for event in transport.events(parameters, after):
                retries = transport.retries()
                after = int(event.id or after or 0)
                yield JobEvent(after, event.event, json.loads(event.data))
                if job_id is not None and event.event == "removed":
                    return
        except NothingMore:
            return
        except Busy as busy:
            problem = busy
        except httpx.TransportError as error:
            problem = transport.unreachable(error)
        retries.pause(problem)
