"""Scenarios of the tests."""

from __future__ import annotations

from typing import Any

#: A second of work: 0.0003 m³ of coarse points.
SMALL: dict[str, Any] = {
    "title": "small",
    "channel": {
        "inclination_deg": 30,
        "incline_length_m": 0.4,
        "runout_length_m": 0.4,
        "width_m": 0.1,
    },
    "flow": {"volume_m3": 0.0003, "release": {"height_m": 0.04, "toe_distance_m": 0.05}},
    "bodies": [{"shape": {"cube": {"side_m": 0.04}}}],
    "duration_s": 0.2,
    "sample_interval_s": 0.01,
    "flow_snapshots": 3,
    "numerics": {"cell_size_m": 0.02, "points_per_cell": 4},
}

#: Nothing but the start.
START = {**SMALL, "title": "start", "duration_s": 0}

#: Minutes of work, for a run that is stopped.
LONG = {
    **SMALL,
    "title": "long",
    "duration_s": 60,
    "numerics": {"cell_size_m": 0.005, "points_per_cell": 8, "ending": "full"},
}

#: A cube on the incline.
PLACED = [{**SMALL["bodies"][0], "position": {"downstream_m": 0.1}}]

#: Cubes that stay where they are put.
STUDY: dict[str, Any] = {
    "title": "where it stands",
    "scenario": {**START, "bodies": PLACED},
    "inputs": [
        {
            "pointer": "/bodies/0/position/downstream_m",
            "distribution": {"uniform": {"from": 0.1, "to": 0.2}},
        },
        {
            "pointer": "/bodies/0/position/lateral_m",
            "distribution": {"uniform": {"from": -0.02, "to": 0.02}},
        },
    ],
    "design": {"sobol": {"members": 32, "seed": 1}},
    "questions": [
        {"rest": {"body": 0, "regions": [0.5, 0.8]}},
        {"sensitivity": {"quantity": "rest_x_m", "body": 0}},
    ],
}

#: A few members of the same kind, without a question.
FEW: dict[str, Any] = {
    **STUDY,
    "title": "a few",
    "design": {"sobol": {"members": 4, "seed": 2}},
    "questions": [],
}
