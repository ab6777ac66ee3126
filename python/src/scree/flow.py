"""The flow at one instant, as arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scree.contract import FlowSnapshot


@dataclass(frozen=True)
class FlowPoints:
    """Material points of a snapshot, evenly thinned to n of them.

    Attributes
    ----------
    time_s : float
        Simulated time [s].
    points : int
        Number of points in the flow at that time.
    thinning : int
        One in this many points is kept.
    point_id : ndarray of uint32, shape (n,)
        Identifiers, ascending: the same material point has the same in all snapshots.
    position_m : ndarray of float32, shape (n, 3)
        Positions, x downstream, y across, z up [m].
    speed_m_s : ndarray of float32, shape (n,)
        Speeds [m/s].
    """

    time_s: float
    points: int
    thinning: int
    point_id: NDArray[np.uint32]
    position_m: NDArray[np.float32]
    speed_m_s: NDArray[np.float32]

    @classmethod
    def from_document(cls, document: FlowSnapshot) -> FlowPoints:
        """Points from the service's document."""
        return cls(
            time_s=document["time_s"],
            points=document["points"],
            thinning=document["thinning"],
            point_id=np.array(document["point_id"], dtype=np.uint32),
            position_m=np.array(document["position_m"], dtype=np.float32).reshape(-1, 3),
            speed_m_s=np.array(document["speed_m_s"], dtype=np.float32),
        )
