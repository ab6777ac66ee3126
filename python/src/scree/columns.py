"""Columns of a trajectory, made from api/openapi.json by make_contract.py."""

from typing import Dict, NamedTuple


class Column(NamedTuple):
    """Unit and meaning of a column; the unit is "1" where there is none."""

    unit: str
    description: str


COLUMNS: Dict[str, Column] = {
    "angular_velocity_rad_s": Column("rad/s", "Angular velocity, world axes"),
    "body_force_n": Column("N", "Force of other bodies, fixed ones included"),
    "body_torque_nm": Column("N m", "Torque of other bodies about the centre"),
    "flow_force_n": Column("N", "Force of the flow"),
    "flow_torque_nm": Column("N m", "Torque of the flow about the centre"),
    "mode": Column("1", "Mode of motion"),
    "orientation": Column("1", "Unit quaternion [w, x, y, z]"),
    "position_m": Column("m", "Centre [x, y, z]"),
    "submerged_fraction": Column("1", "Share of the body's height below the surface of the flow, 0..1"),
    "time_s": Column("s", "Simulated time"),
    "touching_points": Column("1", "Material points in contact"),
    "velocity_m_s": Column("m/s", "Velocity of the centre"),
    "wall_force_n": Column("N", "Force of the walls"),
    "wall_torque_nm": Column("N m", "Torque of the walls about the centre"),
}
