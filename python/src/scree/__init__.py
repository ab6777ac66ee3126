"""Client of Scree, a simulation service for granular flows and the bodies they carry.

`run` computes a scenario, with a service of its own or with one at an address; `Client` does
all that a service can. Documents are those of the contract (`scree.contract`): SI units, and
keys that name them; x runs downstream, y across, z up.

Examples
--------
>>> job = scree.run({
...     "channel": {"inclination_deg": 40, "incline_length_m": 1, "runout_length_m": 2},
...     "flow": {"volume_m3": 0.01},
...     "bodies": [{"shape": {"cube": {"side_m": 0.04}}}],
... })
>>> job.outcome["bodies"][0]["peak_speed_m_s"]
>>> job.trajectory().to_pandas()
"""

from scree.client import Client, run
from scree.errors import (
    Busy,
    Conflict,
    InvalidRequest,
    JobDismissed,
    JobError,
    JobFailed,
    JobNotEnded,
    LocalServiceError,
    NotFound,
    NotPermitted,
    RequestRefused,
    ScreeError,
    StudyDismissed,
    StudyError,
    StudyFailed,
    StudyWaitTimeout,
    UnexpectedAnswer,
    Unreachable,
    WaitTimeout,
)
from scree.events import JobEvent
from scree.flow import FlowPoints
from scree.job import JobHandle
from scree.local_service import LocalService
from scree.member_table import MemberTable
from scree.picture import Picture
from scree.study import StudyHandle
from scree.trajectory import BodyTrajectory

__all__ = [
    "BodyTrajectory",
    "Busy",
    "Client",
    "Conflict",
    "FlowPoints",
    "InvalidRequest",
    "JobDismissed",
    "JobError",
    "JobEvent",
    "JobFailed",
    "JobHandle",
    "JobNotEnded",
    "LocalService",
    "LocalServiceError",
    "MemberTable",
    "NotFound",
    "NotPermitted",
    "Picture",
    "RequestRefused",
    "ScreeError",
    "StudyDismissed",
    "StudyError",
    "StudyFailed",
    "StudyHandle",
    "StudyWaitTimeout",
    "UnexpectedAnswer",
    "Unreachable",
    "WaitTimeout",
    "run",
]
