"""Trajectory of a body as arrays, as a table, and as a labelled dataset."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Mapping

import numpy as np
from numpy.typing import NDArray

from scree.arrays import NamedArrays, read_npz
from scree.columns import COLUMNS, Column

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

#: Names of the components of a vector, by their number: of a vector, of a quaternion.
_COMPONENTS = {3: ("axis", "xyz"), 4: ("quaternion", "wxyz")}


class BodyTrajectory(NamedArrays):
    """Trajectory of one body: its columns by name, each with n samples.

    =========================  =======  =======  ==========================================
    column                     shape    unit     meaning
    =========================  =======  =======  ==========================================
    ``time_s``                 (n,)     s        simulated time
    ``position_m``             (n, 3)   m        centre, x downstream, y across, z up
    ``orientation``            (n, 4)            unit quaternion w, x, y, z, body to channel
    ``velocity_m_s``           (n, 3)   m/s      velocity of the centre
    ``angular_velocity_rad_s`` (n, 3)   rad/s    in channel axes
    ``flow_force_n``           (n, 3)   N        force of the flow, mean since the last sample
    ``mode``                   (n,)              ``"resting"``, ``"sliding"``, …
    =========================  =======  =======  ==========================================

    `scree.columns.COLUMNS` lists all of them.

    Attributes
    ----------
    job_id : str
        Identifier of the job.
    body : int
        Index of the body in the scenario.
    """

    def __init__(self, job_id: str, body: int, columns: Mapping[str, NDArray[Any]]) -> None:
        super().__init__(columns)
        self.job_id = job_id
        self.body = body

    @classmethod
    def from_npz(cls, job_id: str, body: int, archive: bytes) -> BodyTrajectory:
        """Trajectory from the service's NPZ archive."""
        columns = read_npz(archive)
        # Modes are stored as bytes.
        text = {name: np.char.decode(a) for name, a in columns.items() if a.dtype.kind == "S"}
        return cls(job_id, body, {**columns, **text})

    def __repr__(self) -> str:
        """Body and shapes of the columns."""
        shapes = ", ".join(f"{name} {column.shape}" for name, column in self.items())
        return f"<BodyTrajectory of body {self.body}: {shapes}>"

    def rotation(self) -> NDArray[np.float64]:
        """Rotation matrices from body to channel axes.

        Returns
        -------
        ndarray, shape (n, 3, 3)
            ``rotation()[i] @ v`` is the vector v of the body in channel axes at sample i.
        """
        w, x, y, z = self["orientation"].T
        rows = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
        return np.moveaxis(np.array(rows), -1, 0)

    def to_pandas(self) -> pd.DataFrame:
        """Table with one row per sample, by ``time_s`` where that column is there.

        Returns
        -------
        pandas.DataFrame
            A vector's components are columns of their own, ``position_m_x``, as in the
            service's CSV. ``attrs["units"]`` has the unit of each column.

        Raises
        ------
        ImportError
            pandas is not installed (``pip install 'scree[pandas]'``).
        """
        import pandas as pd

        table: dict[str, NDArray[Any]] = {}
        units: dict[str, str] = {}
        for name, column in self.items():
            parts = {name: column}
            if column.ndim == 2:
                _, letters = _COMPONENTS[column.shape[1]]
                parts = {f"{name}_{letter}": column[:, i] for i, letter in enumerate(letters)}
            table.update(parts)
            units.update(dict.fromkeys(parts, _about(name).unit))
        frame = pd.DataFrame(table)
        if "time_s" in frame:
            frame = frame.set_index("time_s")
        frame.attrs = {"job_id": self.job_id, "body": self.body, "units": units}
        return frame

    def to_xarray(self) -> xr.Dataset:
        """Dataset over ``time_s``, with ``axis`` (x, y, z) and ``quaternion`` (w, x, y, z).

        Returns
        -------
        xarray.Dataset
            Each variable has the attributes ``units`` and ``long_name``.

        Raises
        ------
        ImportError
            xarray is not installed (``pip install 'scree[xarray]'``).
        """
        import xarray as xr

        dataset = xr.Dataset(attrs={"job_id": self.job_id, "body": self.body})
        for name, column in self.items():
            dimensions = ["time_s"]
            if column.ndim == 2:
                dimension, letters = _COMPONENTS[column.shape[1]]
                dimensions.append(dimension)
                dataset.coords[dimension] = list(letters)
            attributes = {"units": _about(name).unit, "long_name": _about(name).description}
            dataset[name] = (dimensions, column, attributes)
        return dataset


def _about(name: str) -> Column:
    """Unit and meaning of a column; a newer service may have more columns."""
    return COLUMNS.get(name, Column("1", name))
