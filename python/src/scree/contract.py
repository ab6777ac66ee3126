"""Documents of the contract, made from api/openapi.json by make_contract.py."""

from __future__ import annotations

from typing_extensions import Any, Dict, List, Literal, Optional, TypeAlias, TypedDict, Union

from typing_extensions import NotRequired

Approach: TypeAlias = Literal['auto', 'full', 'slab']
"""
Computation of a flow that does not vary across the channel yet.
"""


Archive: TypeAlias = bytes
"""
A ZIP archive.
"""


class Attempt(TypedDict):
    """
    One attempt at a job.
    """

    attempt: int
    """
    Number of the attempt, from 1.
    """
    detail: Optional[str]
    """
    Details of the end; null if there are none.
    """
    ended: Optional[str]
    """
    End time; null while the attempt continues.
    """
    ending: Optional[str]
    """
    Kind of end: successful, failed, dismissed, handed-back (the service
    stopped), cut-off (the service died), expired (the lease ran out),
    infrastructure (the service could not run the job); null while the attempt continues.
    """
    owner: str
    """
    Name of the service whose worker made the attempt.
    """
    resumed_from_s: Optional[float]
    """
    Simulated time of the saved state from which the attempt resumed [s]; null: it began at
    the start.
    """
    started: str
    """
    Start time (RFC 3339).
    """


class Ball(TypedDict):
    """
    A ball. It has no other sphero radius than its own.
    """

    radius_m: float
    """
    Radius [m].
    """


class BallShape(TypedDict):
    """
    A ball. It has no other sphero radius than its own.
    """

    ball: Ball


Basis: TypeAlias = Literal['converging', 'scattered', 'same', 'one_refinement_run', 'never_happened', 'sometimes_happened', 'nothing']
"""
Basis of an uncertainty interval.
"""


class BatchAnswer(TypedDict):
    """
    Result of a batch: its jobs, in its order.
    """

    ids: List[str]
    """
    Identifiers of the jobs.
    """


AngularVelocityRad: TypeAlias = float


OrientationItem: TypeAlias = float


VelocityM: TypeAlias = float


class BodyEnergy(TypedDict):
    """
    Energy balance of a body: kinetic + potential + stored = start + work of the flow + work of
    bodies − dissipated + made.
    """

    body_work_j: float
    """
    Energy received from other bodies: work of prescribed motions, and half of the difference
    of a contact's work on this and on the other free body [J].
    """
    dissipated_j: float
    """
    Energy dissipated by damping and slip in its contacts with walls and bodies [J].
    """
    flow_work_j: float
    """
    Work of the flow on it [J].
    """
    kinetic_j: float
    """
    Kinetic energy at the end [J].
    """
    made_j: float
    """
    Unaccounted energy: created by the computation if positive, lost if negative [J].
    """
    made_share: float
    """
    Largest rise of `made_j` above its running minimum, over the sum of the largest kinetic and
    stored energy, all energy exchanged with flow and bodies, the potential energy of its rises
    and falls, and m g times its radius. A run ends beyond 0.01.
    """
    potential_j: float
    """
    Potential energy, relative to the floor, at the end [J].
    """
    start_j: float
    """
    Kinetic, potential and stored energy at the start [J].
    """
    stored_j: float
    """
    Energy stored in its contacts with walls and bodies at the end; half of that stored in
    contacts with other free bodies [J].
    """


SidesMItem: TypeAlias = float


class Box(TypedDict):
    """
    A box with its faces along the axes.
    """

    sides_m: List[SidesMItem]
    """
    Distances between opposite faces [x, y, z] [m]; rounding does not move them.
    """


class BoxShape(TypedDict):
    """
    A box with its faces along the axes.
    """

    box: Box


class Capsule(TypedDict):
    """
    A capsule along x: a cylinder with a half ball on either end. It has no other sphero radius than its own.
    """

    length_m: float
    """
    Length from tip to tip, along the body's x axis [m]; above twice the radius.
    """
    radius_m: float
    """
    Radius of the cylinder and of its round ends [m].
    """


class CapsuleShape(TypedDict):
    """
    A capsule along x: a cylinder with a half ball on either end. It has no other sphero radius than its own.
    """

    capsule: Capsule


class Channel(TypedDict):
    """
    Incline and floor between two side walls. x runs downstream and is 0 at the foot of the
    incline; y runs across and is 0 on the centre line; z runs up and is 0 on the floor.
    """

    base_friction: NotRequired[float]
    """
    Coulomb friction between flow and incline or floor.
    """
    inclination_deg: float
    """
    Inclination θ of the incline [°].
    """
    incline_length_m: float
    """
    Horizontal length l0 of the incline [m].
    """
    runout_length_m: float
    """
    Horizontal length l1 of the floor [m].
    """
    side_friction: NotRequired[float]
    """
    Coulomb friction between flow and the vertical walls (sides and back).
    """
    width_m: NotRequired[float]
    """
    Distance between the side walls [m].
    """


class Choice(TypedDict):
    """
    A reduction of the computation.
    """

    decided_by: Optional[str]
    """
    Field of the scenario that overrides the decision, as a JSON pointer; null if there is
    none.
    """
    error: str
    """
    Error caused by the reduction.
    """
    taken: bool
    """
    True if the reduction is made.
    """
    what: str
    """
    Reduction that was considered.
    """
    why: str
    """
    Reason for or against the reduction.
    """


class Conformance(TypedDict):
    """
    Conformance classes.
    """

    conformsTo: List[str]
    """
    Their URIs.
    """


class Conservation(TypedDict):
    """
    Checks that tell whether the run can be trusted.
    """

    angular_momentum_from_shifting: float
    """
    Relative angular momentum created by particle redistribution; the residual does not include
    it.
    """
    angular_momentum_residual: float
    """
    Largest relative residual of the angular momentum balance.
    """
    energy_residual: float
    """
    Largest relative rise of mechanical energy.
    """
    mass_error: float
    """
    Relative error of the mass balance.
    """
    max_body_overlap_ratio: float
    """
    Largest overlap of a body with a wall or another body, over its sphero radius (the smaller
    of two).
    """
    max_overlap_ratio: float
    """
    Largest overlap of a point with a body, over the sum of point radius and sphero radius.
    """
    momentum_residual: float
    """
    Largest relative residual of the linear momentum balance.
    """
    penetration_corrections: int
    """
    Number of penetration corrections of points out of a body.
    """
    points_lost: int
    """
    Points lost in any other way.
    """
    points_outflow: int
    """
    Points that left through the open end.
    """


class Cost(TypedDict):
    """
    Cost of the answer.
    """

    cell_size_m: float
    """
    Cell size [m].
    """
    point_steps: int
    """
    Sub-steps summed over the points that took part.
    """
    point_steps_per_s: float
    """
    Point-steps (sub-steps of one point) per second of wall time [1/s].
    """
    points: int
    """
    Material points at the start.
    """
    sound_speed_m_s: Optional[float]
    """
    Speed of sound in use, √(K/ρ) [m/s]; null without a flow.
    """
    steps: int
    """
    Transfers between points and grid.
    """
    substeps: int
    """
    Acoustic sub-steps.
    """
    threads: int
    """
    Solver threads.
    """
    wall_s: float
    """
    Wall time [s].
    """


Coupling: TypeAlias = Literal['half_spacing', 'source_paper']
"""
Contact formulation between points and bodies.
"""


class Cube(TypedDict):
    """
    A cube.
    """

    side_m: float
    """
    Distance between opposite faces [m]; rounding does not move them.
    """


class CubeShape(TypedDict):
    """
    A cube.
    """

    cube: Cube


class EndedEarly(TypedDict):
    """
    Early stop of a run, with bounds on the changes that the rest of the run could have made.
    """

    body_bound_m: float
    """
    Bound on the further displacement of any body [m].
    """
    front_bound_m: Optional[float]
    """
    Bound on the further advance of the front [m]; null without a flow.
    """
    outflow_bound_kg: NotRequired[Optional[float]]
    """
    Bound on the further outflow through the open end [kg]; null without a flow.
    """
    reason: str
    """
    Reason for the early stop.
    """
    time_s: float
    """
    Time of the early stop [s].
    """


Ending: TypeAlias = Literal['auto', 'full']
"""
Condition that ends a run.
"""


class Failure(TypedDict):
    """
    Failure of a job: an RFC 9457 problem document without the HTTP status,
    since no request failed. The numbers of the failure are members beside the text.
    """

    detail: str
    """
    Description of this occurrence.
    """
    title: str
    """
    Name of the kind, for people.
    """
    type: str
    """
    Kind of failure, as a stable name.
    """


class FieldError(TypedDict):
    """
    Fault of one field of the body or one parameter of the query.
    """

    allowed: str
    """
    Allowed values, in words or as a range.
    """
    detail: str
    """
    One sentence for people.
    """
    parameter: NotRequired[Optional[str]]
    """
    Name of the query parameter, or of the header.
    """
    pointer: NotRequired[Optional[str]]
    """
    JSON pointer (RFC 6901) into the body, "" for the whole document.
    """
    unit: Optional[str]
    """
    Unit of value and range; null if there is none.
    """
    value: Any
    """
    Value received, shortened if it is a long text; null if it is missing.
    """


class FlowSnapshot(TypedDict):
    """
    The flow at one instant.
    """

    job_id: str
    """
    The job.
    """
    points: int
    """
    Number of points in the flow at that time.
    """
    position_m: List[List[float]]
    """
    Position of each kept point [m].
    """
    speed_m_s: List[float]
    """
    Speed of each kept point [m/s].
    """
    thinning: int
    """
    Thinning factor: one in this many points is kept.
    """
    time_s: float
    """
    Simulated time [s].
    """


class Health(TypedDict):
    """
    Health of the service.
    """

    status: str
    """
    Always "ok"; an unhealthy service answers with a problem.
    """
    version: str
    """
    Version of the service.
    """


class Hint(TypedDict):
    """
    Warning about a scenario: something that is allowed, but probably not intended or unexpectedly
    costly.
    """

    detail: str
    """
    One sentence for people.
    """
    field: str
    """
    Field that the warning is about, as a JSON pointer.
    """


JobStatus: TypeAlias = Literal['accepted', 'running', 'successful', 'failed', 'dismissed']
"""
State of a job, in the words of OGC API – Processes.
"""


class Link(TypedDict):
    """
    Link to a resource.
    """

    href: str
    """
    Its address.
    """
    rel: str
    """
    Relation to the document that has the link.
    """
    title: str
    """
    Name for people.
    """
    type: str
    """
    Media type of the resource.
    """


PrincipalAx: TypeAlias = List[float]


class MassProperties(TypedDict):
    """
    Mass properties of a rounded body about its centre of mass.
    """

    mass_kg: float
    """
    Mass [kg].
    """
    principal_axes: List[PrincipalAx]
    """
    Unit vectors of the principal axes in body axes, right-handed; for about equal moments,
    those nearest to the body axes.
    """
    principal_moments_kg_m2: List[float]
    """
    Principal moments of inertia, the smallest first [kg m²].
    """
    volume_m3: float
    """
    Volume [m³].
    """


class Material(TypedDict):
    """
    Granular material.
    """

    bulk_density_kg_m3: NotRequired[float]
    """
    Density of the bulk at rest [kg/m³].
    """
    grain_density_kg_m3: NotRequired[float]
    """
    Density of a grain [kg/m³].
    """
    grain_diameter_m: NotRequired[float]
    """
    Diameter d of a grain in the inertial number [m].
    """
    limiting_friction: NotRequired[float]
    """
    Friction at large inertial number μ_2; equal to μ_s: Drucker–Prager.
    """
    poissons_ratio: NotRequired[float]
    """
    Poisson's ratio.
    """
    reference_inertial_number: NotRequired[float]
    """
    Inertial number I0 half-way between the two frictions.
    """
    static_friction: NotRequired[float]
    """
    Friction at rest μ_s.
    """
    youngs_modulus_pa: NotRequired[Optional[float]]
    """
    Young's modulus [Pa]; `null`: from the sound speed.
    """


Mode: TypeAlias = Literal['resting', 'sliding', 'rolling', 'saltating', 'carried']
"""
Mode of motion of a body.
"""


TimesSItem: TypeAlias = float


class Motion1(TypedDict):
    """
    Motion by a table: velocities are linear between its times, and constant before the first
    and after the last one.
    """

    angular_velocity_rad_s: NotRequired[List[List[AngularVelocityRad]]]
    """
    Angular velocity about the centre at each of the times, in channel axes [rad/s];
    without times a single one.
    Default: zeros.
    """
    times_s: List[TimesSItem]
    """
    Times of a table, each after the one before [s]; left out: constant velocities.
    Default: left out.
    """
    velocity_m_s: NotRequired[List[List[VelocityM]]]
    """
    Velocity of the centre at each of the times, in channel axes [m/s]; without times a
    single one.
    Default: zeros.
    """


class Motion2(TypedDict):
    """
    Constant motion.
    """

    angular_velocity_rad_s: NotRequired[List[AngularVelocityRad]]
    """
    Angular velocity about the centre, in channel axes [rad/s].
    Default: zeros.
    """
    velocity_m_s: NotRequired[List[VelocityM]]
    """
    Velocity of the centre, in channel axes [m/s].
    Default: zeros.
    """


Motion: TypeAlias = Union[Motion1, Motion2]
"""
Prescribed motion of a body, in channel axes.
"""


class OutputFormat(TypedDict):
    """
    Format of an output.
    """

    mediaType: NotRequired[Optional[str]]
    """
    Media type, which is that of the process description.
    """


VerticesMItemItem: TypeAlias = float


VerticesMItem: TypeAlias = List[VerticesMItemItem]


class Polyhedron(TypedDict):
    """
    The convex hull of 4 to 32 points.
    """

    vertices_m: List[VerticesMItem]
    """
    Points [x, y, z] whose convex hull is the body before rounding, in body axes with any origin [m].
    """


class PolyhedronShape(TypedDict):
    """
    The convex hull of 4 to 32 points.
    """

    polyhedron: Polyhedron


class Position(TypedDict):
    """
    Centre of a body.
    """

    downstream_m: NotRequired[float]
    """
    x of the centre of mass [m].
    Default: the longest side of a cube or box, the length of a ball or capsule, else the largest distance of two vertices.
    """
    elevation_m: NotRequired[Optional[float]]
    """
    z of the centre of mass [m]; `null`: rests on the bed under the centre.
    """
    lateral_m: NotRequired[float]
    """
    y of the centre of mass [m].
    """


Precision: TypeAlias = Literal['single', 'double']
"""
Arithmetic precision of points and grid; bodies, time and audits are in 64 bits.
"""


class Problem(TypedDict):
    """
    Problem document: reason why a request failed (RFC 9457).
    """

    detail: str
    """
    Cause of this occurrence.
    """
    error_id: NotRequired[Optional[str]]
    """
    Identifier of the details of an internal error in the service's log.
    """
    errors: NotRequired[List[FieldError]]
    """
    All faults of the request, field by field.
    """
    status: int
    """
    HTTP status.
    """
    title: str
    """
    Name of the kind, for people.
    """
    type: str
    """
    Kind of problem, as a stable name.
    """


class ProcessSummary(TypedDict):
    """
    Description of a process, in short.
    """

    description: str
    """
    Purpose.
    """
    id: str
    """
    Name of the process.
    """
    jobControlOptions: List[str]
    """
    Modes in which it may be executed.
    """
    keywords: List[str]
    """
    Words to find it by.
    """
    links: List[Link]
    """
    Links to its description and its execution.
    """
    outputTransmission: List[str]
    """
    Ways in which outputs are given.
    """
    title: str
    """
    Name for people.
    """
    version: str
    """
    Version of the process, which is that of the service.
    """


class Progress(TypedDict):
    """
    Progress of a run. All zero before the start.
    """

    eta_s: Optional[float]
    """
    Expected remaining wall time [s], from the present speeds of flow and bodies and the pace of
    the computation; null before the first steps and once the run has ended.
    """
    fraction: float
    """
    Fraction of the expected wall time that is over, 0..1; never decreases.
    """
    point_steps_per_s: float
    """
    Point-steps (sub-steps of one point) per second of wall time so far [1/s].
    """
    simulated_time_s: float
    """
    Simulated time [s].
    """
    steps: int
    """
    Steps (transfers between points and grid) so far.
    """
    substeps: int
    """
    Acoustic sub-steps so far.
    """


class Provenance(TypedDict):
    """
    Provenance: all conditions that must be equal for equal answers, and a fingerprint to compare
    them.
    """

    fingerprint: Optional[str]
    """
    Fingerprint of all records of the run, 64 hexadecimal digits: equal
    fingerprints mean equal bits. Null unless successful.
    """
    instructions: Optional[str]
    """
    Instruction set of the kernels (baseline, AVX2, AVX-512); null before the
    start.
    """
    scenario_hash: str
    """
    BLAKE3 of the scenario's JSON with every default filled in, as the job
    shows it, 64 hexadecimal digits.
    """
    solver_commit: Optional[str]
    """
    Commit of the program that runs the job; null before the start.
    """
    solver_version: str
    """
    Version of the solver that runs the job, or that validated it if it has not started.
    """
    threads: Optional[int]
    """
    Number of solver threads at the start of the last attempt; null before the start. Jobs that
    run at the same time share the cores, so that it changes on the way; results do not depend on
    it.
    """


Quantity: TypeAlias = Literal['onset_time_s', 'peak_speed_m_s', 'peak_speed_time_s', 'stop_time_s', 'displacement_m', 'path_length_m', 'front_m', 'runout_m']
"""
A quantity of the outcome, by its key.
"""


ReferenceOnly: TypeAlias = Literal['reference']


RegularSolid: TypeAlias = Literal['tetrahedron', 'cube', 'octahedron', 'dodecahedron', 'icosahedron']
"""
A solid with equal regular faces.
"""


class Release(TypedDict):
    """
    The release: as wide as the channel, with vertical front and back and an upper face parallel to
    the slope.
    """

    height_m: NotRequired[float]
    """
    Thickness normal to the slope [m].
    """
    toe_distance_m: NotRequired[float]
    """
    Horizontal distance of the front from the foot [m].
    """


ResponseForm: TypeAlias = Literal['raw', 'document']
"""
Form of a synchronous answer.
"""


Role: TypeAlias = Literal['coarser', 'reduced_stiffness', 'answer']
"""
Purpose of a run.
"""


class RunCost(TypedDict):
    """
    One of the runs behind an uncertainty interval.
    """

    cell_size_m: float
    """
    Cell size [m].
    """
    cells_per_body: Optional[float]
    """
    Cells across the thinnest body; null without bodies.
    """
    failure: Optional[str]
    """
    Reason of the failure; null if the run succeeded.
    """
    point_steps: Optional[int]
    """
    Sub-steps summed over the points that took part; null if the run failed.
    """
    role: Role
    """
    Purpose of the run.
    """
    sound_speed_m_s: float
    """
    Speed of sound in the bulk [m/s].
    """
    wall_s: Optional[float]
    """
    Wall time [s]; null if the run failed.
    """


Share: TypeAlias = Literal['whole', 'half', 'slab']
"""
Share of the flow that is computed; images stand for the rest.
"""


class Stage(TypedDict):
    """
    Part of a run during which the same share of the flow is computed.
    """

    expected_substeps: int
    """
    Expected number of sub-steps before the expected end.
    """
    points: int
    """
    Points of the share.
    """
    share: Share
    """
    Share of the flow.
    """
    substeps: int
    """
    Expected number of sub-steps.
    """


class StatusInfo(TypedDict):
    """
    State of a job.
    """

    created: str
    """
    Time of acceptance.
    """
    finished: NotRequired[str]
    """
    Time at which the job ended; absent before.
    """
    jobID: str
    """
    Identifier.
    """
    links: List[Link]
    """
    Links to the job and, once it has ended, to its results.
    """
    message: NotRequired[str]
    """
    The scenario's title; absent if it is empty.
    """
    processID: str
    """
    The process, always `simulation`.
    """
    progress: int
    """
    Share of the run that is done [%].
    """
    started: NotRequired[str]
    """
    Time of the last claim by a worker; absent before the first.
    """
    status: JobStatus
    """
    State.
    """
    type: str
    """
    Kind of job, always `process`.
    """
    updated: str
    """
    Time of the last change of the state.
    """


Svg: TypeAlias = str
"""
An SVG document.
"""


Symmetry: TypeAlias = Literal['auto', 'full', 'mirror']
"""
Computation of a scene that is symmetric about the centre plane.
"""


class TargetReport(TypedDict):
    """
    Result of the target.
    """

    asked: float
    """
    Requested largest distance of the interval from the value, over the value.
    """
    body: Optional[int]
    """
    Index of the body whose quantity it is; null for a quantity of the flow.
    """
    met: bool
    """
    True if the distance reached is no larger than the requested one.
    """
    quantity: Quantity
    """
    Quantity to which the target applies.
    """
    reached: Optional[float]
    """
    Distance reached, over the value; null if the interval has an open end or the value is 0.
    """
    reason: Optional[str]
    """
    Reason why the target was not met; null if it was met.
    """


class TrajectoryColumns(TypedDict):
    """
    Columns of a trajectory, all of equal length, in the order of the trajectory document; with
    `fields` only those. Forces and torques are means since the sample before.
    """

    angular_velocity_rad_s: NotRequired[List[List[float]]]
    """
    Angular velocity, world axes [rad/s].
    """
    body_force_n: NotRequired[List[List[float]]]
    """
    Force of other bodies, fixed ones included [N].
    """
    body_torque_nm: NotRequired[List[List[float]]]
    """
    Torque of other bodies about the centre [N m].
    """
    flow_force_n: NotRequired[List[List[float]]]
    """
    Force of the flow [N].
    """
    flow_torque_nm: NotRequired[List[List[float]]]
    """
    Torque of the flow about the centre [N m].
    """
    mode: NotRequired[List[Mode]]
    """
    Mode of motion.
    """
    orientation: NotRequired[List[List[float]]]
    """
    Unit quaternion [w, x, y, z].
    """
    position_m: NotRequired[List[List[float]]]
    """
    Centre [x, y, z] [m].
    """
    submerged_fraction: NotRequired[List[float]]
    """
    Share of the body's height below the surface of the flow, 0..1.
    """
    time_s: NotRequired[List[float]]
    """
    Simulated time [s].
    """
    touching_points: NotRequired[List[int]]
    """
    Material points in contact.
    """
    velocity_m_s: NotRequired[List[List[float]]]
    """
    Velocity of the centre [m/s].
    """
    wall_force_n: NotRequired[List[List[float]]]
    """
    Force of the walls [N].
    """
    wall_torque_nm: NotRequired[List[List[float]]]
    """
    Torque of the walls about the centre [N m].
    """


class UncertaintyInterval(TypedDict):
    """
    A quantity with the interval in which its grid-converged value (h → 0) is expected.
    """

    basis: Basis
    """
    Basis of the interval.
    """
    high: Optional[float]
    """
    Upper end; null if there is none: the event may also never happen.
    """
    low: Optional[float]
    """
    Lower end; null if there is none.
    """
    order: Optional[float]
    """
    Observed order of convergence; null if the values don't converge.
    """
    value: Optional[float]
    """
    Value of the answer, equal to that in the outcome; null if the event did not happen.
    """


ValueOnly: TypeAlias = Literal['value']


class WallTime(TypedDict):
    """
    Forecast of the wall time of a run on this machine, with its refinement runs.
    """

    expected_s: Optional[float]
    """
    Expected wall time [s]; null with a target, whose cells are found by its first runs.
    """
    high_s: float
    """
    Upper bound of the likely wall time [s]: for the whole duration, or a target's whole budget.
    """
    low_s: float
    """
    Lower bound of the likely wall time [s].
    """
    threads: int
    """
    Number of solver threads of the forecast.
    """


class Accuracy(TypedDict):
    """
    Requested accuracy of the answer, and whether it reports uncertainty intervals.
    """

    body: NotRequired[int]
    """
    Index of the body whose quantity that is.
    """
    budget_point_steps: NotRequired[float]
    """
    Point-steps (sub-steps of one point) that may be spent on `target`, those of all runs
    together.
    """
    error_bars: NotRequired[bool]
    """
    Coarser runs give every quantity of the outcome an uncertainty interval.
    """
    quantity: NotRequired[Optional[Quantity]]
    target: NotRequired[Optional[float]]
    """
    Largest distance of the ends of the interval of `quantity` from its value, over the value;
    met by the choice of cells; `null`: `numerics` chooses them. The outcome then has intervals,
    too.
    """


class AccuracyReport(TypedDict):
    """
    Runs behind the intervals, and the result of the target.
    """

    extra_cost: float
    """
    Point-steps of all other runs, over those of the run of the answer.
    """
    extra_wall_cost: Optional[float]
    """
    Wall time of all other runs, over that of the run of the answer; null if the latter took no
    time. Larger in small scenes, where the fixed cost of a step prevails.
    """
    runs: List[RunCost]
    """
    All runs, in the order in which they were made.
    """
    target: Optional[TargetReport]


class BodyErrorBars(TypedDict):
    """
    Uncertainty intervals of a body's quantities, under the keys of its outcome.
    """

    displacement_m: UncertaintyInterval
    """
    Interval of `displacement_m`.
    """
    final_position_m: List[UncertaintyInterval]
    """
    Interval of each component of `final_position_m`.
    """
    onset_time_s: UncertaintyInterval
    """
    Interval of `onset_time_s`.
    """
    path_length_m: UncertaintyInterval
    """
    Interval of `path_length_m`.
    """
    peak_speed_m_s: UncertaintyInterval
    """
    Interval of `peak_speed_m_s`.
    """
    peak_speed_time_s: UncertaintyInterval
    """
    Interval of `peak_speed_time_s`.
    """
    stop_time_s: UncertaintyInterval
    """
    Interval of `stop_time_s`.
    """


class BodyOutcome(TypedDict):
    """
    Outcome of one body.
    """

    displacement_m: float
    """
    Net horizontal displacement of the centre [m].
    """
    energy: Optional[BodyEnergy]
    error_bars: Optional[BodyErrorBars]
    final_orientation: List[float]
    """
    Orientation at the end [w, x, y, z].
    """
    final_position_m: List[float]
    """
    Centre at the end [m].
    """
    first_contact_time_s: Optional[float]
    """
    Time of the first contact with the flow [s]; null if there was none.
    """
    mass_properties: MassProperties
    """
    Mass and principal moments of inertia.
    """
    onset_time_s: Optional[float]
    """
    First time at which the centre is a fortieth of the body's size (cube root of its volume)
    from its initial position [s].
    """
    path_length_m: float
    """
    Length of the centre's path [m].
    """
    peak_speed_m_s: float
    """
    Largest speed of the centre [m/s].
    """
    peak_speed_time_s: Optional[float]
    """
    Time of the largest speed of the centre [s]; null for a body that never moved.
    """
    stop_time_s: Optional[float]
    """
    Time from which on the body is at rest until the end [s]; null if it still moves or never
    moved.
    """


class ByReference(TypedDict):
    """
    An output that is given by reference.
    """

    format: NotRequired[Optional[OutputFormat]]
    transmissionMode: NotRequired[Optional[ReferenceOnly]]


class ByValue(TypedDict):
    """
    An output that is given by value.
    """

    format: NotRequired[Optional[OutputFormat]]
    transmissionMode: NotRequired[Optional[ValueOnly]]


class Flow(TypedDict):
    """
    The granular flow.
    """

    material: NotRequired[Material]
    """
    Material.
    Default: all defaults.
    """
    release: NotRequired[Release]
    """
    Position and shape of the release.
    Default: all defaults.
    """
    volume_m3: float
    """
    Released volume [m³]; 0 is a flow without points, anything else below 1e-15 is refused.
    """


class FlowErrorBars(TypedDict):
    """
    Uncertainty intervals of the flow's quantities, under the keys of its outcome.
    """

    front_m: UncertaintyInterval
    """
    Interval of `front_m`.
    """
    outflow_mass_kg: UncertaintyInterval
    """
    Interval of `outflow_mass_kg`.
    """
    runout_m: UncertaintyInterval
    """
    Interval of `runout_m`.
    """


class FlowOutcome(TypedDict):
    """
    Outcome of the flow.
    """

    error_bars: Optional[FlowErrorBars]
    excluded_volume_m3: float
    """
    Volume of the release that was not placed because a body occupies it [m³].
    """
    front_m: Optional[float]
    """
    Position x beyond which 0.1 % of the released mass lies, mass that left through the open end
    included [m]; null without a flow.
    """
    outflow_mass_kg: float
    """
    Mass that left through the open end [kg].
    """
    runout_m: Optional[float]
    """
    Front minus the initial toe [m]; null without a flow.
    """


class JobList(TypedDict):
    """
    A page of jobs, newest first.
    """

    jobs: List[StatusInfo]
    """
    The jobs.
    """
    links: List[Link]
    """
    Links to this page and to the next one, if there is one.
    """


class LandingPage(TypedDict):
    """
    Landing page of OGC API – Processes.
    """

    description: str
    """
    Purpose of the service.
    """
    links: List[Link]
    """
    Links to its resources.
    """
    title: str
    """
    Name of the service.
    """


class Numerics(TypedDict):
    """
    Numerical choices; null: automatic.
    """

    approach: NotRequired[Approach]
    """
    Computation of a flow before it varies across the channel.
    Default: `"auto"`.
    """
    cell_size_m: NotRequired[Optional[float]]
    """
    Size of a grid cell [m].
    """
    coupling: NotRequired[Coupling]
    """
    Formulation of contacts between points and bodies.
    Default: `"half_spacing"`.
    """
    courant: NotRequired[Optional[float]]
    """
    Courant number of the acoustic sub-step.
    """
    ending: NotRequired[Ending]
    """
    End of the run.
    Default: `"auto"`.
    """
    flow_courant: NotRequired[Optional[float]]
    """
    Courant number of the flow's own step.
    """
    points_per_cell: NotRequired[int]
    """
    Material points per cell.
    """
    precision: NotRequired[Precision]
    """
    Arithmetic of points and grid.
    Default: `"single"`.
    """
    sound_speed_m_s: NotRequired[Optional[float]]
    """
    √(K/ρ) of the bulk [m/s]; not together with `youngs_modulus_pa`.
    """
    symmetry: NotRequired[Symmetry]
    """
    Use of the symmetry of a scene about the centre plane: computation by halves.
    Default: `"auto"`.
    """
    threads: NotRequired[Optional[int]]
    """
    Solver threads.
    """


class PlannedCost(TypedDict):
    """
    Cost of a run.
    """

    body_substeps: int
    """
    Sub-steps of the bodies' own, summed over the free bodies, of a run of the whole duration in
    which all of them stay in contact.
    """
    cell_size_m: float
    """
    Cell size [m].
    """
    expected_end_s: float
    """
    Time at which the run is expected to end [s].
    """
    memory_bytes: int
    """
    Memory of the run while the release is set up or once the flow has spread, whichever is more
    [bytes]. Records that the caller keeps are not part of it.
    """
    point_steps: int
    """
    Sub-steps summed over the computed points, of a run of the whole duration.
    """
    points: int
    """
    Material points of the flow at the start.
    """
    stages: List[Stage]
    """
    Parts of the run, one after the other, by the share of the flow that is computed.
    """
    steps: int
    """
    Transfers between points and grid of a run of the whole duration.
    """
    substeps: int
    """
    Acoustic sub-steps of a run of the whole duration.
    """


class PlannedRefinementRun(TypedDict):
    """
    A planned run behind uncertainty intervals.
    """

    cell_size_m: float
    """
    Cell size [m].
    """
    expected_s: float
    """
    Expected wall time [s].
    """
    point_steps: int
    """
    Sub-steps summed over its points, for the whole duration.
    """
    role: Role
    """
    Purpose of the run.
    """


class ProcessDescription(ProcessSummary):
    """
    Description of a process.
    """

    inputs: Dict[str, Any]
    """
    Its inputs by name, each with the schema of its value (OpenAPI 3.0).
    """
    outputs: Dict[str, Any]
    """
    Its outputs by name, each with the schema of its value (OpenAPI 3.0).
    """


class ProcessList(TypedDict):
    """
    The processes.
    """

    links: List[Link]
    """
    Link to this list.
    """
    processes: List[ProcessSummary]
    """
    Each in short.
    """


class Regular(TypedDict):
    """
    A regular solid that lies on a face, one edge of which runs along y.
    """

    size_m: float
    """
    Length of its edges before they are rounded [m].
    """
    solid: RegularSolid
    """
    Kind of solid.
    """


class RegularShape(TypedDict):
    """
    A regular solid that lies on a face, one edge of which runs along y.
    """

    regular: Regular


class RequestedOutputs(TypedDict):
    """
    Outputs that are asked for; all if none is named.
    """

    aerial: NotRequired[Optional[ByReference]]
    flow: NotRequired[Optional[ByReference]]
    motion: NotRequired[Optional[ByReference]]
    outcome: NotRequired[Optional[ByValue]]
    trajectory: NotRequired[Optional[ByReference]]


Shape: TypeAlias = Union[
    CubeShape,
    BoxShape,
    RegularShape,
    PolyhedronShape,
    BallShape,
    CapsuleShape,
]
"""
Shape of a body before rounding; rounding does not move its faces.
"""


class Trajectory(TypedDict):
    """
    The trajectory of one body.
    """

    body: int
    """
    Index of the body in the scenario.
    """
    columns: TrajectoryColumns
    """
    Columns with one entry per sample.
    """
    job_id: str
    """
    The job.
    """


class Body(TypedDict):
    """
    A rigid body.
    """

    angular_velocity_rad_s: NotRequired[List[AngularVelocityRad]]
    """
    Angular velocity at the start, in channel axes [rad/s].
    """
    contact_modulus_pa: NotRequired[Optional[float]]
    """
    Hertz contact modulus E* with rigid walls [Pa]; of two bodies 1/E* = 1/E_A + 1/E_B.
    """
    density_kg_m3: NotRequired[float]
    """
    Density [kg/m³].
    """
    fixed: NotRequired[bool]
    """
    A fixed body is a barrier.
    """
    flow_friction: NotRequired[float]
    """
    Coulomb friction with the flow.
    """
    flow_restitution: NotRequired[float]
    """
    Restitution with the flow.
    """
    friction: NotRequired[float]
    """
    Coulomb friction with walls and other bodies; of two bodies √(μ_A μ_B).
    """
    motion: NotRequired[Optional[Motion]]
    orientation: NotRequired[Optional[List[OrientationItem]]]
    """
    Quaternion [w, x, y, z] from body to channel axes, instead of yaw.
    """
    position: NotRequired[Position]
    """
    Initial position of its centre.
    Default: all defaults.
    """
    restitution: NotRequired[float]
    """
    Restitution with walls and other bodies.
    """
    rolling_friction: NotRequired[float]
    """
    Rolling resistance on walls and other bodies: the couple of a contact is at most this × its
    equivalent radius × its normal force; of two bodies the larger.
    """
    shape: Shape
    """
    The shape before rounding: `{"cube": {…}}`.
    """
    sphero_radius_m: NotRequired[float]
    """
    Radius of the sphere that rounds edges and vertices [m].
    Default: 1/20 of the thickness, the diameter of the largest ball inside (of a cube: the side); of a ball or capsule its radius.
    """
    velocity_m_s: NotRequired[List[VelocityM]]
    """
    Velocity of the centre at the start [m/s].
    """
    yaw_deg: NotRequired[float]
    """
    Turn about the normal of the bed under the centre, x towards y [°].
    """


class Plan(TypedDict):
    """
    Plan of a run: its computation, its reductions with their reasons, and its cost.
    """

    choices: List[Choice]
    """
    Every reduction that was considered.
    """
    cost: PlannedCost
    """
    Cost of the run.
    """
    hints: NotRequired[List[Hint]]
    """
    Warnings to check before the run; absent from plans of an older version.
    """


class Planned(TypedDict):
    """
    A plan, the runs behind uncertainty intervals, and the expected wall time of all.
    """

    plan: Plan
    """
    Computation, reductions and cost of the run.
    """
    refinement_runs: List[PlannedRefinementRun]
    """
    Runs made before that of the answer; with a target, the first ones.
    """
    wall_time: WallTime
    """
    Expected wall time of all runs on a worker of this service.
    """


class Scenario(TypedDict):
    """
    A scenario. Fields with a default may be left out; the service's answer has all of them filled
    in, and null stands for "automatic".
    """

    accuracy: NotRequired[Accuracy]
    """
    Accuracy asked of the answer.
    Default: all defaults.
    """
    bodies: List[Body]
    """
    The bodies; `[]`: none.
    """
    channel: Channel
    """
    The channel.
    """
    duration_s: NotRequired[float]
    """
    Simulated time [s]; 0 gives the start alone.
    Default: twice the time at which the flow is expected to have come to rest, at least as long as every table of a prescribed motion; 3 without a flow.
    """
    flow: Optional[Flow]
    flow_snapshots: NotRequired[int]
    """
    Number of snapshots of the flow, evenly spread, both ends included, each at the end of the
    step that holds its time; 1: the start.
    """
    gravity_m_s2: NotRequired[float]
    """
    Gravity, along −z [m/s²].
    """
    numerics: NotRequired[Numerics]
    """
    Numerical choices.
    Default: all defaults.
    """
    sample_interval_s: NotRequired[float]
    """
    Time between samples, which lie at its multiples and at the end [s]; changes no bit of the
    motion.
    """
    title: NotRequired[str]
    """
    Free text.
    """


class ScenarioInput(TypedDict):
    """
    A scenario as the value of an input.
    """

    mediaType: NotRequired[Optional[str]]
    """
    Its media type, `application/json`.
    """
    value: Scenario
    """
    The bare scenario.
    """


class BatchJob(TypedDict):
    """
    One of many scenarios.
    """

    labels: NotRequired[List[str]]
    """
    Additional labels of this job.
    """
    scenario: Scenario
    """
    The scenario.
    """


class Inputs(TypedDict):
    """
    Inputs of the process.
    """

    scenario: ScenarioInput
    """
    The scenario.
    """


class Outcome(TypedDict):
    """
    The answer in short. Null stands for an event that did not happen.
    """

    accuracy: Optional[AccuracyReport]
    bodies: List[BodyOutcome]
    """
    One entry per body, in the scenario's order.
    """
    conservation: Conservation
    """
    Checks that tell whether the run can be trusted.
    """
    cost: Cost
    """
    Cost of the run, without the runs behind intervals.
    """
    ended_early: Optional[EndedEarly]
    flow: FlowOutcome
    """
    The flow.
    """
    plan: Optional[Plan]
    remarks: List[str]
    """
    Sentences for people: what happened to the bodies and the flow, and how the run ended.
    """


class OutcomeValue(TypedDict):
    """
    An outcome as the value of an output.
    """

    mediaType: str
    """
    Its media type.
    """
    value: Outcome
    """
    The outcome.
    """


class Results(TypedDict):
    """
    Results of a job by the names of its outputs.
    """

    aerial: NotRequired[Link]
    """
    Picture of flow and bodies from above.
    """
    flow: NotRequired[Link]
    """
    Snapshots of the flow.
    """
    motion: NotRequired[Link]
    """
    Picture of the bodies' motion.
    """
    outcome: NotRequired[OutcomeValue]
    """
    The answer in short.
    """
    trajectory: NotRequired[Link]
    """
    Trajectory of the first body; absent without a body.
    """


class Batch(TypedDict):
    """
    Many scenarios in one request.
    """

    jobs: List[BatchJob]
    """
    The jobs.
    """
    labels: NotRequired[List[str]]
    """
    Labels of every job.
    """


class Execute(TypedDict):
    """
    Request for an execution.
    """

    inputs: Inputs
    """
    The inputs.
    """
    outputs: NotRequired[RequestedOutputs]
    """
    Outputs of a synchronous answer; all unless given.
    """
    response: NotRequired[Optional[ResponseForm]]


class Job(TypedDict):
    """
    A job.
    """

    attempt: int
    """
    Number of attempts, that is claims by a worker.
    """
    attempts: List[Attempt]
    """
    All attempts, in order.
    """
    created: str
    """
    Time of acceptance (RFC 3339).
    """
    finished: Optional[str]
    """
    Time at which the job ended; null before.
    """
    id: str
    """
    Identifier.
    """
    labels: List[str]
    """
    Its labels, in order.
    """
    outcome: Optional[Outcome]
    plan: Optional[Plan]
    problem: Optional[Failure]
    progress: Progress
    """
    Progress so far.
    """
    provenance: Provenance
    """
    Provenance of the answer.
    """
    scenario: Scenario
    """
    The scenario with every default filled in.
    """
    started: Optional[str]
    """
    Time of the last claim by a worker; null while the job waits.
    """
    status: JobStatus
    """
    State.
    """
    submitter: Optional[str]
    """
    Name of the access token of the submitter; null if none is required.
    """


class JobSummary(TypedDict):
    """
    A job, without its scenario and its answer.
    """

    created: str
    """
    Time of acceptance (RFC 3339).
    """
    finished: Optional[str]
    """
    Time at which the job ended; null before.
    """
    id: str
    """
    Identifier.
    """
    labels: List[str]
    """
    Its labels, in order.
    """
    outcome: NotRequired[Optional[Outcome]]
    progress: Progress
    """
    Progress so far.
    """
    started: Optional[str]
    """
    Time of the last claim by a worker; null before the first.
    """
    status: JobStatus
    """
    State.
    """
    title: str
    """
    The scenario's title.
    """


class JobPage(TypedDict):
    """
    A page of jobs, newest first.
    """

    jobs: List[JobSummary]
    """
    The jobs of this page.
    """
    next_cursor: Optional[str]
    """
    Value of `cursor` for the next page; null on the last page.
    """
