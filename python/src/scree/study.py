"""A study of the service, from its submission to its answers."""

from __future__ import annotations

import time
from typing import Any, Callable, Iterable, Iterator, cast
from urllib.parse import quote

from typing_extensions import Literal, Self

from scree import contract
from scree.errors import StudyDismissed, StudyFailed, StudyWaitTimeout
from scree.member_table import MemberTable
from scree.picture import Picture
from scree.transport import Transport, given

#: Members of one page of a list, the most that the service gives.
MEMBERS_PAGE = 1000

#: Time between two looks at a study that runs [s].
_PACE_S = 0.5

StudyProgressFunction = Callable[[contract.StudyState], object]


class StudyHandle:
    """A study by its identifier; answers are read from the service when they are asked for.

    Answers, members, maps and pictures are there while the study runs, from the members that
    have ended so far.

    Attributes
    ----------
    id : str
        Identifier of the study.
    """

    def __init__(
        self, transport: Transport, study_id: str, document: contract.StudyState | None = None
    ) -> None:
        self.id = study_id
        self._transport = transport
        self._document = document

    def __repr__(self) -> str:
        """Identifier and the state last seen."""
        state = "" if self._document is None else f", {self._document['status']}"
        return f"<StudyHandle {self.id}{state}>"

    @property
    def document(self) -> contract.StudyState:
        """The study as last received: state, numbers of members, the study as changed last."""
        return self._document or self.refresh()

    @property
    def status(self) -> contract.StudyStatus:
        """State as last received; `refresh` asks the service again."""
        return self.document["status"]

    @property
    def has_ended(self) -> bool:
        """True unless the study ran when it was last received."""
        return self.status != "running"

    def refresh(self) -> contract.StudyState:
        """The study as it is now."""
        document = cast(contract.StudyState, self._transport.get(self._path).json())
        self._document = document
        return document

    def wait(
        self, timeout_s: float | None = None, progress: StudyProgressFunction | None = None
    ) -> Self:
        """Waits for the end of the study.

        Parameters
        ----------
        timeout_s : float, optional
            Longest time to wait [s]; without it there is no limit.
        progress : callable, optional
            Called about twice a second, and at the end, with the study: ``members`` of its
            design, ``members_made``, ``members_ended``, ….

        Returns
        -------
        StudyHandle
            This study, with all its answers.

        Raises
        ------
        StudyFailed
            The study failed: ``problem`` says why. A failed member is no failure of the study.
        StudyDismissed
            The study was dismissed.
        StudyWaitTimeout
            The time is over. The study goes on.
        """
        end_s = float("inf") if timeout_s is None else time.monotonic() + timeout_s
        while True:
            document = self.refresh()
            if progress is not None:
                progress(document)
            if self.has_ended:
                self._check_success(document)
                return self
            left_s = end_s - time.monotonic()
            if left_s <= 0:
                raise StudyWaitTimeout(self.id, cast(float, timeout_s))
            time.sleep(min(_PACE_S, left_s))

    def answers(self) -> contract.StudyAnswers:
        """Answers to all questions, in their order, each with its uncertainty."""
        return cast(contract.StudyAnswers, self._transport.get(f"{self._path}/answers").json())

    def members(self, level: int = 0) -> Iterator[contract.ListedMember]:
        """Members in the order of the design, read page by page: values, job and outcome.

        Parameters
        ----------
        level : int, optional
            Level of their cells, 0 the coarsest.
        """
        path, parameters = f"{self._path}/members", given(level=level, limit=MEMBERS_PAGE)
        return self._transport.entries(path, parameters, of="members", place=("from", "next"))

    def table(self) -> MemberTable:
        """Inputs and quantities of the members that have ended, as arrays by name."""
        answer = self._transport.get(f"{self._path}/members.npz")
        return MemberTable.from_npz(self.id, answer.content)

    def rest_geojson(self, question: int | None = None) -> dict[str, Any]:
        """Regions in which a body comes to rest, as GeoJSON.

        Coordinates are those of the channel, x downstream and y across [m].

        Parameters
        ----------
        question : int, optional
            Place of the question in the study; without it, the first about a resting place.

        Raises
        ------
        NotFound
            There is no such question.
        """
        answer = self._transport.get(f"{self._path}/rest.geojson", given(question=question))
        return cast("dict[str, Any]", answer.json())

    def rest_geotiff(self, question: int | None = None) -> bytes:
        """Density of the places where a body comes to rest, as GeoTIFF [1/m²].

        Parameters
        ----------
        question : int, optional
            As for `rest_geojson`.

        Raises
        ------
        NotFound
            There is no such question, or too few members have come to rest (yet).
        """
        return self._transport.get(f"{self._path}/rest.tif", given(question=question)).content

    def picture(
        self, name: Literal["rest", "sensitivity", "scatter"], question: int | None = None
    ) -> Picture:
        """Picture of the answers so far, as SVG.

        Parameters
        ----------
        name : {"rest", "sensitivity", "scatter"}
            Where a body comes to rest; what a quantity depends on; or quantities against inputs.
        question : int, optional
            Place of the question in the study; without it, the first of this kind. A picture of
            quantities against inputs is of no question.

        Raises
        ------
        NotFound
            There is no such question, or no answer to it (yet).
        """
        answer = self._transport.get(f"{self._path}/{name}.svg", given(question=question))
        return Picture(answer.text)

    def change(
        self,
        *,
        design: contract.Design | None = None,
        finer_levels: Iterable[contract.FinerLevel] | None = None,
        accuracy: contract.StudyAccuracy | None = None,
        stop: contract.StoppingRule | None = None,
        questions: Iterable[contract.StudyQuestion] | None = None,
    ) -> Self:
        """Changes the study, which goes on if it had ended; no run is lost.

        Parameters
        ----------
        design : dict, optional
            A design that has the present one's members first.
        finer_levels : iterable of dict, optional
            Levels of which the first have the present ones' cell sizes.
        accuracy : dict, optional
            Another accuracy.
        stop : dict, optional
            Another stopping rule.
        questions : iterable of dict, optional
            Other questions, in place of all the present ones.

        Raises
        ------
        InvalidRequest
            The changed study is not allowed: the text names each field.
        Conflict
            The study has failed or is dismissed, or was changed meanwhile.
        """
        levels = None if finer_levels is None else list(finer_levels)
        asked = None if questions is None else list(questions)
        changes = {
            "design": design,
            "finer_levels": levels,
            "accuracy": accuracy,
            "stop": stop,
            "questions": asked,
        }
        changed = {name: value for name, value in changes.items() if value is not None}
        self._document = self._transport.patch(self._path, changed).json()
        return self

    def dismiss(self) -> Self:
        """Dismisses the study: its members stop, unless another study has them too.

        Raises
        ------
        Conflict
            The study has succeeded or failed.
        """
        self._document = self._transport.delete(self._path).json()
        return self

    def remove(self) -> None:
        """Removes the study, which has ended, and the jobs that are its alone.

        Raises
        ------
        Conflict
            The study has not ended.
        NotFound
            There is no such study (any more).
        """
        self._transport.delete(self._path, [("remove", "ended")])

    @property
    def _path(self) -> str:
        return f"/v1/studies/{quote(self.id, safe='')}"

    def _check_success(self, document: contract.StudyState) -> None:
        if document["problem"] is not None:
            raise StudyFailed(self.id, document["problem"])
        if document["status"] == "dismissed":
            raise StudyDismissed(self.id)
