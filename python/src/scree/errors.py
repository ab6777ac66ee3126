"""Exceptions of the package, all of them derived from `ScreeError`."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Mapping, cast

if TYPE_CHECKING:
    from scree.contract import Failure, FieldError, Problem


class ScreeError(Exception):
    """Base of all exceptions of this package."""


class LocalServiceError(ScreeError):
    """The local service can't be started: no binary, or it stopped at once."""


class Unreachable(ScreeError):
    """The service gave no answer within the client's patience."""


class UnexpectedAnswer(ScreeError):
    """An answer that is none of the service's, such as that of a proxy."""


class RequestRefused(ScreeError):
    """The service refused a request.

    The text names the kind of problem and, for each faulty field, its value, the
    values allowed, and their unit.

    Attributes
    ----------
    problem : scree.contract.Problem
        The problem document (RFC 9457) as received.
    """

    def __init__(self, problem: Problem) -> None:
        # The document is the argument, so that the exception can be pickled.
        super().__init__(problem)
        self.problem = problem

    @property
    def kind(self) -> str:
        """Kind of problem, as a stable name: ``"urn:scree:problem:invalid-scenario"``."""
        return self.problem["type"]

    @property
    def status(self) -> int:
        """HTTP status."""
        return self.problem["status"]

    @property
    def errors(self) -> list[FieldError]:
        """All faults of the request, field by field; empty if it has no faulty fields."""
        return self.problem.get("errors", [])

    def __str__(self) -> str:
        """Title and detail, or title and one line for each faulty field."""
        title = self.problem["title"]
        if not self.errors:
            return f"{title}: {self.problem['detail']}"
        return "\n".join([f"{title}:", *map(_fault, self.errors)])


class InvalidRequest(RequestRefused):
    """A scenario, batch, study, parameter or key that is not allowed (400, 422)."""


class NotPermitted(RequestRefused):
    """No good access token, or one that may not do this (401, 403)."""


class NotFound(RequestRefused):
    """No such job, body, snapshot, study, answer or picture, or not yet (404)."""


class Conflict(RequestRefused):
    """The state of the job or study does not permit this (409)."""


class Busy(RequestRefused):
    """The service was too busy for longer than the client's patience (429, 503)."""


class JobError(ScreeError):
    """A job that gives no outcome.

    Attributes
    ----------
    job_id : str
        Identifier of the job.
    """

    def __init__(self, job_id: str, *details: object) -> None:
        super().__init__(job_id, *details)
        self.job_id = job_id


class JobFailed(JobError):
    """The job failed; its records until then are kept.

    Attributes
    ----------
    problem : scree.contract.Failure
        Reason of the failure, with its numbers: ``time_s``, the offending ``point``, …
    """

    def __init__(self, job_id: str, problem: Failure) -> None:
        super().__init__(job_id, problem)
        self.problem = problem

    def __str__(self) -> str:
        """Title, detail and numbers of the failure."""
        return f"job {self.job_id} failed: {_reason(self.problem)}"


class JobDismissed(JobError):
    """The job was dismissed; its records until then are kept."""

    def __str__(self) -> str:
        """Identifier and state."""
        return f"job {self.job_id} was dismissed"


class JobNotEnded(JobError):
    """The job is not known to have ended: there is no outcome yet."""

    def __str__(self) -> str:
        """Identifier, and what to do."""
        return f"job {self.job_id} has not ended: wait() for it"


class WaitTimeout(JobError, TimeoutError):
    """The job did not end within the time given; it goes on."""

    def __init__(self, job_id: str, timeout_s: float) -> None:
        super().__init__(job_id, timeout_s)
        self.timeout_s = timeout_s

    def __str__(self) -> str:
        """Identifier and time."""
        return f"job {self.job_id} did not end within {self.timeout_s:g} s"


class StudyError(ScreeError):
    """A study that does not come to its end.

    Attributes
    ----------
    study_id : str
        Identifier of the study.
    """

    def __init__(self, study_id: str, *details: object) -> None:
        super().__init__(study_id, *details)
        self.study_id = study_id


class StudyFailed(StudyError):
    """The study failed; its members until then are kept.

    Attributes
    ----------
    problem : scree.contract.Failure
        Reason of the failure.
    """

    def __init__(self, study_id: str, problem: Failure) -> None:
        super().__init__(study_id, problem)
        self.problem = problem

    def __str__(self) -> str:
        """Title, detail and numbers of the failure."""
        return f"study {self.study_id} failed: {_reason(self.problem)}"


class StudyDismissed(StudyError):
    """The study was dismissed; its members until then are kept."""

    def __str__(self) -> str:
        """Identifier and state."""
        return f"study {self.study_id} was dismissed"


class StudyWaitTimeout(StudyError, TimeoutError):
    """The study did not end within the time given; it goes on."""

    def __init__(self, study_id: str, timeout_s: float) -> None:
        super().__init__(study_id, timeout_s)
        self.timeout_s = timeout_s

    def __str__(self) -> str:
        """Identifier and time."""
        return f"study {self.study_id} did not end within {self.timeout_s:g} s"


_BY_STATUS: dict[int, type[RequestRefused]] = {
    400: InvalidRequest,
    401: NotPermitted,
    403: NotPermitted,
    404: NotFound,
    409: Conflict,
    422: InvalidRequest,
    429: Busy,
    503: Busy,
}


def refusal(problem: Problem) -> RequestRefused:
    """Exception for a problem document."""
    return _BY_STATUS.get(problem["status"], RequestRefused)(problem)


def _fault(error: FieldError) -> str:
    place = error.get("pointer") or error.get("parameter") or "the whole document"
    unit = f"; unit: {error['unit']}" if error["unit"] else ""
    numbers = f"value: {_short(error['value'])}; allowed: {error['allowed']}{unit}"
    return f"  {place}: {error['detail']} [{numbers}]"


def _reason(problem: Failure) -> str:
    members = cast(Mapping[str, Any], problem)
    numbers = {k: v for k, v in members.items() if k not in ("type", "title", "detail")}
    listed = "; ".join(f"{name} = {_short(value)}" for name, value in numbers.items())
    text = f"{problem['title']}: {problem['detail']}"
    return f"{text} ({listed})" if listed else text


def _short(value: object) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 80 else f"{text[:79]}…"
