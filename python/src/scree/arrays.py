"""Arrays by name."""

from __future__ import annotations

import io
from typing import Any, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray


class NamedArrays(Mapping[str, NDArray[Any]]):
    """Columns by name, each with n entries."""

    def __init__(self, columns: Mapping[str, NDArray[Any]]) -> None:
        self._columns = dict(columns)

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Column of this name."""
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        """Names of the columns."""
        return iter(self._columns)

    def __len__(self) -> int:
        """Number of columns."""
        return len(self._columns)


def read_npz(archive: bytes) -> dict[str, NDArray[Any]]:
    """Arrays of an NPZ archive."""
    with np.load(io.BytesIO(archive), allow_pickle=False) as arrays:
        return {name: arrays[name] for name in arrays.files}
