"""Requests to the service: retries within bounds, and problem documents as exceptions."""

from __future__ import annotations

import contextlib
import json
import time
import weakref
from typing import Any, Iterator, Mapping, Sequence, Tuple, Union, cast

import httpx
from httpx_sse import ServerSentEvent, connect_sse

from scree import errors
from scree.contract import Problem

#: Longest time that a request may wait for the end of a job, a limit of the service [s].
LONGEST_WAIT_S = 60

#: Time to wait for the next piece of an answer, beyond what the service takes for it [s].
_READ_S = 60.0
#: First and longest pause before a request is repeated, where the service names none [s].
_PAUSES_S = (0.1, 2.0)
_JSON = {"Content-Type": "application/json"}
_LOOPBACK = ("127.0.0.1", "::1", "localhost")
_KEY_IN_USE = "urn:scree:problem:key-in-use"

Value = Union[str, int, float]
Parameters = Sequence[Tuple[str, Value]]


class NothingMore(Exception):
    """End of the events of one job."""


class Transport:
    """Connections to one service.

    Every request of this package can be repeated without harm: those that submit
    jobs and studies have an idempotency key, and a change that is made twice is as
    made once. So a request is repeated after a broken connection and after 429 and
    503, until `patience_s` has passed.

    Parameters
    ----------
    url : str
        Address of the service.
    token : str, optional
        Access token.
    patience_s : float
        Longest time for which a request is repeated [s].
    """

    def __init__(self, url: str, token: str | None, patience_s: float) -> None:
        self._patience_s = patience_s
        self._has_answered = False
        address = httpx.URL(url)
        self._http = httpx.Client(
            base_url=address,
            headers={"Authorization": f"Bearer {token}"} if token else {},
            timeout=httpx.Timeout(LONGEST_WAIT_S + _READ_S, connect=5.0),
            # A proxy of the environment knows nothing of this machine's loopback interface.
            trust_env=address.host not in _LOOPBACK,
        )
        # Handles of jobs and studies need the connections as long as there are any.
        self._closing = weakref.finalize(self, self._http.close)

    def close(self) -> None:
        """Closes the connections."""
        self._closing()

    def get(self, path: str, parameters: Parameters = ()) -> httpx.Response:
        """Answer to a GET request."""
        return self._request("GET", path, parameters)

    def delete(self, path: str, parameters: Parameters = ()) -> httpx.Response:
        """Answer to a DELETE request."""
        return self._request("DELETE", path, parameters)

    def post(
        self,
        path: str,
        document: Mapping[str, Any],
        parameters: Parameters = (),
        key: str | None = None,
    ) -> httpx.Response:
        """Answer to a POST request with a JSON document."""
        headers = {**_JSON, "Idempotency-Key": key} if key is not None else _JSON
        return self._request("POST", path, parameters, headers, _encoded(document))

    def patch(self, path: str, document: Mapping[str, Any]) -> httpx.Response:
        """Answer to a PATCH request with a JSON document."""
        return self._request("PATCH", path, (), _JSON, _encoded(document))

    def entries(
        self,
        path: str,
        parameters: Parameters,
        *,
        of: str,
        place: tuple[str, str] = ("cursor", "next_cursor"),
    ) -> Iterator[Any]:
        """Entries of a list, read page by page.

        Parameters
        ----------
        path, parameters
            Those of the first page.
        of : str
            Key of a page's entries.
        place : (str, str)
            Parameter of a further page, and the key of its value in the page before: null on
            the last page.
        """
        parameter, key = place
        further: Parameters = []
        while True:
            page = self.get(path, [*parameters, *further]).json()
            yield from page[of]
            if page[key] is None:
                return
            further = [(parameter, page[key])]

    def events(self, parameters: Parameters, after: int | None) -> Iterator[ServerSentEvent]:
        """Events of one connection, until it ends.

        Raises
        ------
        NothingMore
            The job has ended, and its events have been received.
        httpx.TransportError
            The connection broke.
        """
        headers = {} if after is None else {"Last-Event-ID": str(after)}
        with connect_sse(
            self._http, "GET", "/v1/events", params=list(parameters), headers=headers
        ) as source:
            response = source.response
            if response.status_code == httpx.codes.NO_CONTENT:
                raise NothingMore
            if not response.is_success:
                response.read()
                raise _exception(response)
            self._has_answered = True
            yield from source.iter_sse()

    def retries(self) -> Retries:
        """Pauses between repetitions, from now on."""
        return Retries(self._patience_s)

    def _request(
        self,
        method: str,
        path: str,
        parameters: Parameters,
        headers: Mapping[str, str] | None = None,
        body: bytes | None = None,
    ) -> httpx.Response:
        retries = self.retries()
        while True:
            try:
                response = self._http.request(
                    method, path, params=list(parameters), headers=headers, content=body
                )
            except httpx.TransportError as error:
                problem = self.unreachable(error)
                # A wrong address shows at once; a service that restarts is waited for.
                if isinstance(error, httpx.ConnectError) and not self._has_answered:
                    raise problem from error
                retries.pause(problem)
                continue
            self._has_answered = True
            if response.is_success:
                return response
            refused = _exception(response)
            if not _is_temporary(refused):
                raise refused
            retries.pause(refused, _retry_after_s(response))

    def unreachable(self, error: httpx.TransportError) -> errors.Unreachable:
        """Exception for a connection that broke."""
        reason = str(error) or type(error).__name__
        return errors.Unreachable(f"no answer from {self._http.base_url}: {reason}")


class Retries:
    """Pauses between repetitions of a request, until the patience has run out."""

    def __init__(self, patience_s: float) -> None:
        self._end_s = time.monotonic() + patience_s
        self._pause_s = _PAUSES_S[0]

    def pause(self, error: errors.ScreeError, pause_s: float | None = None) -> None:
        """Pauses before the next repetition.

        Parameters
        ----------
        error : ScreeError
            What is raised if the patience ends before the pause.
        pause_s : float, optional
            Pause that the service asked for [s]; without it, each is twice the one before.
        """
        if pause_s is None:
            pause_s = self._pause_s
            self._pause_s = min(2 * self._pause_s, _PAUSES_S[1])
        if time.monotonic() + pause_s > self._end_s:
            raise error
        time.sleep(pause_s)


def given(**parameters: Value | None) -> list[tuple[str, Value]]:
    """Parameters that have a value."""
    return [(name, value) for name, value in parameters.items() if value is not None]


def _is_temporary(error: errors.ScreeError) -> bool:
    """Tells if a repetition may be answered otherwise.

    A key is in use while the service still stores a request whose connection broke.
    """
    in_use = isinstance(error, errors.Conflict) and error.kind == _KEY_IN_USE
    return in_use or isinstance(error, errors.Busy)


def _retry_after_s(response: httpx.Response) -> float | None:
    with contextlib.suppress(KeyError, ValueError):
        return float(response.headers["Retry-After"])
    return None


def _exception(response: httpx.Response) -> errors.ScreeError:
    if response.headers.get("Content-Type", "").startswith("application/problem+json"):
        return errors.refusal(cast(Problem, response.json()))
    beginning = response.text[:200]
    return errors.UnexpectedAnswer(f"{response.url}: {response.status_code}: {beginning}")


def _encoded(document: Mapping[str, Any]) -> bytes:
    # JSON has no NaN: a ValueError here says so before the service does.
    return json.dumps(document, default=_plain, allow_nan=False).encode()


def _plain(value: object) -> object:
    """Numbers and lists of NumPy's scalars and arrays, for JSON."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{value!r} has no place in a JSON document")
