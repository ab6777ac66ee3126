"""A job of the service, from its submission to its results."""

from __future__ import annotations

import math
import os
import time
from pathlib import Path
from typing import Callable, Iterable, Iterator, cast
from urllib.parse import quote

from typing_extensions import Literal, Self

from scree import contract
from scree.errors import JobDismissed, JobFailed, JobNotEnded, WaitTimeout
from scree.events import JobEvent, follow
from scree.flow import FlowPoints
from scree.picture import Picture
from scree.trajectory import BodyTrajectory
from scree.transport import LONGEST_WAIT_S, Transport, Value, given

#: Time between two calls of a `progress` function [s].
_PROGRESS_S = 1.0

ProgressFunction = Callable[[contract.Progress], object]


class JobHandle:
    """A job by its identifier; results are read from the service when they are asked for.

    Attributes
    ----------
    id : str
        Identifier of the job.
    """

    def __init__(
        self, transport: Transport, job_id: str, document: contract.Job | None = None
    ) -> None:
        self.id = job_id
        self._transport = transport
        self._document = document

    def __repr__(self) -> str:
        """Identifier and the state last seen."""
        state = "" if self._document is None else f", {self._document['status']}"
        return f"<JobHandle {self.id}{state}>"

    @property
    def document(self) -> contract.Job:
        """The job as last received: state, scenario with defaults, plan, provenance, …."""
        return self._document or self.refresh()

    @property
    def status(self) -> contract.JobStatus:
        """State as last received; `refresh` asks the service again."""
        return self.document["status"]

    @property
    def has_ended(self) -> bool:
        """True if the state last received is final."""
        return self.status in ("successful", "failed", "dismissed")

    @property
    def outcome(self) -> contract.Outcome:
        """The answer in short: bodies, flow, conservation, cost.

        Raises
        ------
        JobFailed, JobDismissed
            There is no outcome, and never will be.
        JobNotEnded
            There is no outcome yet.
        """
        outcome = self.document["outcome"]
        if outcome is not None:
            return outcome
        problem = self.document["problem"]
        if problem is not None:
            raise JobFailed(self.id, problem)
        raise JobDismissed(self.id) if self.status == "dismissed" else JobNotEnded(self.id)

    def refresh(self) -> contract.Job:
        """The job as it is now."""
        return self._read([])

    def wait(
        self, timeout_s: float | None = None, progress: ProgressFunction | None = None
    ) -> Self:
        """Waits for the end of the job.

        Parameters
        ----------
        timeout_s : float, optional
            Longest time to wait, to a second [s]; without it there is no limit.
        progress : callable, optional
            Called about every second, and at the end, with the job's progress: ``fraction``
            (0 to 1), ``simulated_time_s``, ``eta_s``, ….

        Returns
        -------
        JobHandle
            This job, with its outcome.

        Raises
        ------
        JobFailed
            The job failed: ``problem`` says why.
        JobDismissed
            The job was dismissed.
        WaitTimeout
            The time is over. The job goes on.
        """
        end_s = float("inf") if timeout_s is None else time.monotonic() + timeout_s
        pace_s = LONGEST_WAIT_S if progress is None else _PROGRESS_S
        while True:
            left_s = end_s - time.monotonic()
            # The service knows whole seconds only.
            wait_s = math.ceil(max(0, min(pace_s, left_s)))
            document = self._read([("wait", f"{wait_s}s")])
            if progress is not None:
                progress(document["progress"])
            if self.has_ended:
                self.outcome  # noqa: B018 -- raises unless successful
                return self
            if time.monotonic() >= end_s:
                raise WaitTimeout(self.id, cast(float, timeout_s))

    def trajectory(
        self,
        body: int = 0,
        *,
        from_s: float | None = None,
        to_s: float | None = None,
        stride: int | None = None,
        fields: Iterable[str] | None = None,
    ) -> BodyTrajectory:
        """Trajectory of a body, so far or whole.

        Parameters
        ----------
        body : int
            Index of the body in the scenario.
        from_s, to_s : float, optional
            First and last simulated time, both included [s].
        stride : int, optional
            One in this many samples.
        fields : iterable of str, optional
            These columns only.

        Returns
        -------
        BodyTrajectory
            Arrays by name, each with one entry per sample.

        Raises
        ------
        NotFound
            There is no such body.
        InvalidRequest
            A parameter that is not allowed.
        """
        parameters = given(body=body, from_s=from_s, to_s=to_s, stride=stride)
        parameters += [("fields", name) for name in fields or ()]
        answer = self._transport.get(f"{self._path}/trajectory.npz", parameters)
        return BodyTrajectory.from_npz(self.id, body, answer.content)

    def flow(self, time_s: float | None = None) -> FlowPoints:
        """Snapshot of the flow nearest to a time.

        Parameters
        ----------
        time_s : float, optional
            Simulated time [s]; without it, the latest snapshot.

        Raises
        ------
        NotFound
            There is no snapshot (yet).
        """
        answer = self._transport.get(f"{self._path}/flow", given(time_s=time_s))
        return FlowPoints.from_document(answer.json())

    def flow_archive(self, file: str | os.PathLike[str]) -> None:
        """All snapshots so far for ParaView, written to a ZIP file: open its ``flow.pvd``.

        Raises
        ------
        NotFound
            There is no such job (any more).
        """
        Path(file).write_bytes(self._transport.get(f"{self._path}/flow.zip").content)

    def picture(self, name: Literal["motion", "aerial"]) -> Picture:
        """Picture of a successful job, as SVG.

        Parameters
        ----------
        name : {"motion", "aerial"}
            Displacement and speed of the bodies; or flow and bodies from above.

        Raises
        ------
        NotFound
            There is no such picture (yet).
        """
        return Picture(self._transport.get(f"{self._path}/{name}.svg").text)

    def events(self, after: int | None = None) -> Iterator[JobEvent]:
        """Changes of this job, from its first or from those after a number, until it ends."""
        return follow(self._transport, self.id, after)

    def dismiss(self) -> Self:
        """Dismisses the job: a running one stops, and its records are kept.

        Raises
        ------
        Conflict
            The job has succeeded or failed.
        """
        self._document = self._transport.delete(self._path).json()
        return self

    def remove(self) -> None:
        """Removes the job, which has ended, and its results.

        Raises
        ------
        Conflict
            The job has not ended.
        NotFound
            There is no such job (any more).
        """
        self._transport.delete(self._path, [("remove", "ended")])

    @property
    def _path(self) -> str:
        return f"/v1/jobs/{quote(self.id, safe='')}"

    def _read(self, parameters: list[tuple[str, Value]]) -> contract.Job:
        document = cast(contract.Job, self._transport.get(self._path, parameters).json())
        self._document = document
        return document
