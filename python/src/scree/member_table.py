"""Members of a study as arrays, and as a table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Mapping

from numpy.typing import NDArray

from scree.arrays import NamedArrays, read_npz

if TYPE_CHECKING:
    import pandas as pd


class MemberTable(NamedArrays):
    """Members of a study that have ended: columns by name, each with n members.

    =========================  ============================================================
    column                     meaning
    =========================  ============================================================
    ``member``                 number in the design
    ``channel.base_friction``  an input: its pointer, with dots for slashes
    ``runout_m``               a quantity of the flow
    ``body0.displacement_m``   a quantity of a body, by its index in the scenario
    =========================  ============================================================

    NaN stands where there is no number: the member failed, the thing did not happen, or the
    value of the input is a text. `StudyHandle.members` gives reasons and texts.

    Attributes
    ----------
    study_id : str
        Identifier of the study.
    """

    def __init__(self, study_id: str, columns: Mapping[str, NDArray[Any]]) -> None:
        super().__init__(columns)
        self.study_id = study_id

    @classmethod
    def from_npz(cls, study_id: str, archive: bytes) -> MemberTable:
        """Members from the service's NPZ archive."""
        return cls(study_id, read_npz(archive))

    def __repr__(self) -> str:
        """Study and names of the columns."""
        return f"<MemberTable of study {self.study_id}: {', '.join(self)}>"

    def to_pandas(self) -> pd.DataFrame:
        """Table with one row per member.

        Raises
        ------
        ImportError
            pandas is not installed (``pip install 'scree[pandas]'``).
        """
        import pandas as pd

        frame = pd.DataFrame(dict(self))
        frame.attrs = {"study_id": self.study_id}
        return frame
