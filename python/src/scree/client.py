"""Client of a service."""

from __future__ import annotations

import contextlib
import uuid
from datetime import datetime
from typing import Any, Iterable, Iterator, Mapping, Union, cast

from typing_extensions import Literal, Self

from scree import contract, local_service
from scree.errors import Conflict, WaitTimeout
from scree.events import JobEvent, follow
from scree.job import JobHandle, ProgressFunction
from scree.study import StudyHandle
from scree.transport import Transport, Value, given

#: Jobs or studies of one page of a list, the most that the service gives.
PAGE = 100

#: A scenario: typed, or any dictionary, which the service checks.
ScenarioLike = Union[contract.Scenario, Mapping[str, Any]]

#: A study: typed, or any dictionary, which the service checks.
StudyLike = Union[contract.Study, Mapping[str, Any]]


class Client:
    """Client of the service at an address.

    Requests are repeated after broken connections, and while the service is too busy
    (429, 503), at the pace it asks for. Submissions carry an idempotency key, so that a
    repetition never makes a second job or study.

    Parameters
    ----------
    url : str
        Address of the service: ``"http://127.0.0.1:8080"``.
    token : str, optional
        Access token, where the service needs one.
    patience_s : float
        Longest time for which a request is repeated [s].

    Examples
    --------
    >>> client = scree.Client("http://127.0.0.1:8080")
    >>> job = client.submit(scenario, label="study").wait()
    >>> job.trajectory()["position_m"][-1]
    """

    def __init__(self, url: str, *, token: str | None = None, patience_s: float = 60.0) -> None:
        self._transport = Transport(url, token, patience_s)

    @classmethod
    def local(cls) -> Self:
        """Client of this process's local service, which is started if need be.

        Raises
        ------
        LocalServiceError
            The binary is not found, or does not start.
        """
        return cls(local_service.shared().url)

    def close(self) -> None:
        """Closes the connections; handles of jobs and studies need them."""
        self._transport.close()

    def __enter__(self) -> Self:
        """The client itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Closes the connections."""
        self.close()

    def submit(
        self,
        scenario: ScenarioLike,
        *,
        key: str | None = None,
        label: str | Iterable[str] = (),
        reuse: Literal["finished"] | None = None,
    ) -> JobHandle:
        """Submits a scenario as a job.

        Parameters
        ----------
        scenario : Scenario or mapping
            The scenario; numbers and arrays of NumPy are welcome.
        key : str, optional
            Idempotency key: the same key with the same scenario gives the same job, also
            from another process. Without it, one is made for this call.
        label : str or iterable of str
            Labels of the job, by which jobs can be listed.
        reuse : {"finished"}, optional
            Accept a successful job with the same scenario instead of a new run.

        Raises
        ------
        InvalidRequest
            The scenario is not allowed: the text names each field.
        Busy
            The queue is full, for longer than the client's patience.
        """
        parameters = [("label", text) for text in _texts(label)]
        if reuse is not None:
            parameters.append(("reuse", reuse))
        answer = self._transport.post("/v1/jobs", scenario, parameters, key or str(uuid.uuid4()))
        document = cast(contract.Job, answer.json())
        return JobHandle(self._transport, document["id"], document)

    def batch(
        self,
        scenarios: Iterable[ScenarioLike],
        *,
        key: str | None = None,
        label: str | Iterable[str] = (),
    ) -> list[JobHandle]:
        """Submits many scenarios in one request: all are accepted, or none.

        Parameters
        ----------
        scenarios : iterable of scenarios
            The scenarios, each as for `submit`.
        key, label
            As for `submit`; every job gets the labels.

        Returns
        -------
        list of JobHandle
            The jobs, in the order of the scenarios.
        """
        jobs = [{"scenario": scenario} for scenario in scenarios]
        batch = {"jobs": jobs, "labels": _texts(label)}
        answer = self._transport.post("/v1/batches", batch, key=key or str(uuid.uuid4()))
        ids = cast(contract.BatchAnswer, answer.json())["ids"]
        return [JobHandle(self._transport, job_id) for job_id in ids]

    def plan(self, scenario: ScenarioLike) -> contract.Planned:
        """Plan of a scenario's job: what it would compute, leave out and cost."""
        return cast(contract.Planned, self._transport.post("/v1/plans", scenario).json())

    def job(self, job_id: str) -> JobHandle:
        """Job with this identifier.

        Raises
        ------
        NotFound
            There is none.
        """
        job = JobHandle(self._transport, job_id)
        job.refresh()
        return job

    def jobs(
        self,
        *,
        status: contract.JobStatus | Iterable[contract.JobStatus] = (),
        label: str | None = None,
        created_from: datetime | None = None,
        created_to: datetime | None = None,
        include: Iterable[Literal["outcome"]] = (),
    ) -> Iterator[contract.JobSummary]:
        """Jobs, newest first, read page by page.

        Parameters
        ----------
        status : str or iterable of str
            Only jobs in one of these states; without any, in all.
        label : str, optional
            Only jobs with this label.
        created_from, created_to : datetime, optional
            Only jobs accepted between these times, both included; local time unless they
            have a zone.
        include : iterable of {"outcome"}
            Parts of the jobs beside their summaries.
        """
        parameters: list[tuple[str, Value]] = [("limit", PAGE)]
        parameters += [("status", state) for state in _texts(status)]
        parameters += [("label", label)] if label is not None else []
        times = (("created_from", created_from), ("created_to", created_to))
        parameters += [(name, time.astimezone().isoformat()) for name, time in times if time]
        parameters += [("include", part) for part in include]
        return self._transport.entries("/v1/jobs", parameters, of="jobs")

    def events(self, after: int | None = None) -> Iterator[JobEvent]:
        """Changes of all jobs, without end: from the next one, or those after a number."""
        return follow(self._transport, None, after)

    def submit_study(self, study: StudyLike, *, key: str | None = None) -> StudyHandle:
        """Submits a study: a scenario with uncertain inputs, computed many times.

        Parameters
        ----------
        study : Study or mapping
            The study; numbers and arrays of NumPy are welcome.
        key : str, optional
            Idempotency key: the same key with the same study gives the same study, also from
            another process. Without it, one is made for this call.

        Raises
        ------
        InvalidRequest
            The study is not allowed: the text names each field.
        Busy
            Too many studies run, for longer than the client's patience.
        """
        answer = self._transport.post("/v1/studies", study, key=key or str(uuid.uuid4()))
        document = cast(contract.StudyState, answer.json())
        return StudyHandle(self._transport, document["id"], document)

    def plan_study(self, study: StudyLike) -> contract.PlannedStudy:
        """Plan of a study: what its members would cost, and how long they would take."""
        answer = self._transport.post("/v1/study-plans", study)
        return cast(contract.PlannedStudy, answer.json())

    def study(self, study_id: str) -> StudyHandle:
        """Study with this identifier.

        Raises
        ------
        NotFound
            There is none.
        """
        study = StudyHandle(self._transport, study_id)
        study.refresh()
        return study

    def studies(
        self, *, status: contract.StudyStatus | None = None
    ) -> Iterator[contract.StudySummary]:
        """Studies, newest first, read page by page.

        Parameters
        ----------
        status : str, optional
            Only studies in this state; without it, in all.
        """
        parameters = given(limit=PAGE, status=status)
        return self._transport.entries("/v1/studies", parameters, of="studies")


def run(
    scenario: ScenarioLike,
    *,
    url: str | None = None,
    token: str | None = None,
    timeout_s: float | None = None,
    progress: ProgressFunction | None = None,
) -> JobHandle:
    """Runs a scenario to its end.

    Parameters
    ----------
    scenario : Scenario or mapping
        The scenario.
    url, token : str, optional
        Service to run it, and access token. Without `url`, the binary ``scree``
        (``$SCREE_BINARY``, or on the path) is started as a service of this process, and
        stopped with it: results have to be read before.
    timeout_s, progress
        As for `JobHandle.wait`.

    Returns
    -------
    JobHandle
        The job, with outcome, trajectories, flow and pictures.

    Raises
    ------
    InvalidRequest
        The scenario is not allowed: the text names each field.
    JobFailed
        The run failed.
    WaitTimeout
        The time is over; the job is dismissed. So it is by Ctrl-C.
    LocalServiceError
        The binary is not found, or does not start.
    """
    client = Client.local() if url is None else Client(url, token=token)
    job = client.submit(scenario)
    try:
        return job.wait(timeout_s, progress)
    except (KeyboardInterrupt, WaitTimeout):
        with contextlib.suppress(Conflict):  # It has just ended.
            job.dismiss()
        raise


def _texts(texts: str | Iterable[str]) -> list[str]:
    return [texts] if isinstance(texts, str) else list(texts)
