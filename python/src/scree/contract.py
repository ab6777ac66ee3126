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


class BuriedQuestion(TypedDict):
    """
    Question how likely a body ends below the surface.
    """

    body: int
    """
    Index of the body in the scenario.
    """
    deeper_than_m: float
    """
    Depth below the surface that is exceeded [m], not negative.
    """


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


Coordinates: TypeAlias = Literal['map', 'local']
"""
Coordinates in which places on a terrain are given.
"""


class Correlation(TypedDict):
    """
    Rank correlation of two inputs.
    """

    inputs: List[int]
    """
    Indices of the two inputs in the list of inputs.
    """
    rank: float
    """
    Spearman's rank correlation ρ, −1 < ρ < 1. Where a discrete distribution ties many values,
    that of the drawn values is nearer to 0.
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


class DensityGrid(TypedDict):
    """
    Density of resting places at the nodes of a grid.
    """

    density_per_m2: List[float]
    """
    Density at the nodes [1/m²], the first axis fastest.
    """
    nodes: List[int]
    """
    Numbers of nodes.
    """
    origin_m: List[float]
    """
    First node, downstream and across [m].
    """
    spacing_m: List[float]
    """
    Distances of the nodes [m].
    """


class EffectMoment(TypedDict):
    """
    Statistic of the effects.
    """

    standard_error: float
    """
    Standard error by the jackknife (Tukey 1958), which for a mean is s/√r.
    """
    value: float
    """
    Value, in the unit of the quantity.
    """


class ElementaryEffect(TypedDict):
    """
    Elementary effects of one input: changes of the quantity over the change of the input's
    probability, so in the unit of the quantity for the whole range of the input.
    """

    deviation: EffectMoment
    """
    Standard deviation σ of the effects, large for an input that interacts or acts non-linearly.
    """
    effects: int
    """
    Number of effects behind it.
    """
    effects_left_out: int
    """
    Effects left out because a member lacks the quantity.
    """
    mean: EffectMoment
    """
    Mean μ of the effects (Morris 1991).
    """
    mean_size: EffectMoment
    """
    Mean μ* of their sizes, by which inputs are ranked (Campolongo, Cariboni & Saltelli 2007).
    """


class ElementaryEffects(TypedDict):
    """
    Elementary effects of the inputs on a quantity.
    """

    inputs: List[ElementaryEffect]
    """
    Effects of the inputs, in their order.
    """


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


class ExceedsQuestion(TypedDict):
    """
    Question how likely a quantity exceeds thresholds.
    """

    body: NotRequired[Optional[int]]
    """
    Index of the body whose quantity it is; none: one of the whole run.
    """
    quantity: str
    """
    Name of the quantity in the members' outcomes.
    """
    thresholds: List[float]
    """
    Thresholds, in the unit of the quantity.
    """


class ExplicitDesign(TypedDict):
    """
    Values of every member, given one by one; for probabilities they are equally likely draws.
    """

    members: List[List[Any]]
    """
    Members, each with a value for each input in the order of the inputs.
    """


FactorialLevels: TypeAlias = Union[int, List[int]]
"""
Numbers of levels.
"""


class FailedMember(TypedDict):
    """
    Outcome of a run that failed.
    """

    reason: str
    """
    Reason, one of few words so that equal reasons are counted together.
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


class FinerLevel(TypedDict):
    """
    Level of finer cells.
    """

    cell_size_m: float
    """
    Cell size [m], smaller than that of the level before by a factor of 1.2 to 4.
    """
    members: int
    """
    Number of members, at least 8 and at most those of the level before: the first of the design.
    """


FlowFrames: TypeAlias = bytes
"""
Snapshots of the flow in binary.
"""


FlowMapFile: TypeAlias = bytes
"""
A GeoTIFF or an ESRI ASCII grid.
"""


class FlowMapLinks(TypedDict):
    """
    Files of a map.
    """

    ascii: str
    """
    ESRI ASCII grid.
    """
    geotiff: str
    """
    GeoTIFF.
    """


class FlowSnapshot(TypedDict):
    """
    The flow at one instant.
    """

    job_id: str
    """
    The job.
    """
    point_id: List[int]
    """
    Identifier of each kept point: the same material point has the same in all snapshots.
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


class ForecastLevel(TypedDict):
    """
    Level that an accuracy is expected to take.
    """

    cell_size_m: float
    """
    Cell size [m].
    """
    members: int
    """
    Members.
    """
    point_steps_per_member: float
    """
    Work of a member [point-steps].
    """


class FullFactorialDesign(TypedDict):
    """
    All combinations of levels. The levels of an input are the middles of equally likely parts of
    its distribution, the quantiles at (k + ½)/n, so all members are equally likely. The last input
    changes fastest.
    """

    levels: FactorialLevels
    """
    Numbers of levels.
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


class LatinHypercubeDesign(TypedDict):
    """
    Latin hypercube (McKay, Beckman & Conover 1979): each input's range is cut into as many equally
    likely strata as there are members, and each stratum has one member at a random place in it.
    It cannot be enlarged.
    """

    members: int
    """
    Number of members.
    """
    seed: int
    """
    Seed of the order of the strata and the places within.
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


class ListDistribution(TypedDict):
    """
    List of equally likely numbers.
    """

    values: List[float]
    """
    Numbers, at least one.
    """


class LognormalDistribution(TypedDict):
    """
    Lognormal distribution, given by two of its quantiles.
    """

    median: float
    """
    Median, positive, in the unit of the input.
    """
    p95: float
    """
    95 % quantile, above the median.
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


class MeanQuestion(TypedDict):
    """
    Question for the mean of a quantity.
    """

    body: NotRequired[Optional[int]]
    """
    Index of the body whose quantity it is; none: one of the whole run.
    """
    quantity: str
    """
    Name of the quantity in the members' outcomes.
    """


class MemberBody(TypedDict):
    """
    Body at the end of a member's run.
    """

    buried_m: float
    """
    Depth of its centre below the surface [m]; 0 if not below.
    """
    hit: bool
    """
    True if the flow hit it.
    """
    moving: bool
    """
    True if it still moves, so that the position is not where it rests.
    """
    quantities: NotRequired[Dict[str, float]]
    """
    Further quantities by name, the unit in the name, such as `displacement_m`; what did not
    happen is left out.
    """
    rest_m: List[float]
    """
    Position of its centre at the end: downstream, across, up [m].
    """


class MemberFailures(TypedDict):
    """
    Failures for one reason.
    """

    members: int
    """
    Number of members.
    """
    reason: str
    """
    Reason.
    """


class MemberOutcome2(TypedDict):
    """
    The run failed; its quantities could have been anything.
    """

    failed: FailedMember
    """
    The run failed; its quantities could have been anything.
    """


Mode: TypeAlias = Literal['resting', 'sliding', 'rolling', 'saltating', 'carried']
"""
Mode of motion of a body.
"""


class MorrisDesign(TypedDict):
    """
    Trajectories (Morris 1991): each begins at a random point of a grid of levels and moves one
    input after the other, in random order, by half the levels. The levels are the middles of
    equally likely parts, the quantiles at (k + ½)/p, since an unbounded distribution has no end
    for a level to lie at; so a step is ½ of probability.
    """

    levels: int
    """
    Number p of levels, even.
    """
    seed: int
    """
    Seed of the trajectories.
    """
    trajectories: int
    """
    Number r of trajectories, at least 2; there are r (d + 1) members for d inputs.
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


Needed: TypeAlias = Literal['nothing', 'members', 'finer_level', 'smaller_cells', 'budget', 'larger_design', 'successes']
"""
Need of a study for its accuracy; of one that has ended, the need that it ended with.
"""


class OneAtATimeDesign(TypedDict):
    """
    One input after the other at each of its levels, all others at their medians. Member 0 has all
    inputs at their medians, which an odd number of levels does not repeat. The levels are the
    quantiles at (k + ½)/n.
    """

    levels: int
    """
    Number of levels of each input, at least 2.
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
    Centre of a body. In a channel it has `downstream_m` and `lateral_m`, on a terrain `east_m` and
    `north_m`.
    """

    downstream_m: NotRequired[float]
    """
    x of the centre of mass in a channel [m].
    Default: the longest side of a cube or box, the length of a ball or capsule, else the largest distance of two vertices.
    """
    east_m: NotRequired[float]
    """
    Easting of the centre of mass on a terrain, in its coordinates [m].
    Default: none, required on a terrain.
    """
    elevation_m: NotRequired[Optional[float]]
    """
    z of the centre of mass [m]; `null`: rests on the ground under the centre.
    """
    lateral_m: NotRequired[float]
    """
    y of the centre of mass in a channel [m].
    """
    north_m: NotRequired[float]
    """
    Northing of the centre of mass on a terrain, in its coordinates [m].
    Default: none, required on a terrain.
    """


Precision: TypeAlias = Literal['single', 'double']
"""
Arithmetic precision of points and grid; bodies, time and audits are in 64 bits.
"""


class Probability(TypedDict):
    """
    Probability of an event, from the members in which it happened.
    """

    estimate: NotRequired[Optional[float]]
    """
    Share of the known members in which it happened; none without a known member.
    """
    happened: int
    """
    Members in which it happened.
    """
    known: int
    """
    Members of which it is known whether it happened.
    """
    lower: float
    """
    Lower bound: that of Clopper & Pearson (1934) if it happened in no unknown member. With
    several levels it counts as many draws as the multilevel estimate is worth (Korn & Graubard
    1998), and holds the numerical error.
    """
    unknown: int
    """
    Members of which it is not: failed, pending, or without the quantity.
    """
    upper: float
    """
    Upper bound: that if it happened in every unknown member.
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


class Quantile(TypedDict):
    """
    Quantile of a quantity.
    """

    estimate: NotRequired[Optional[float]]
    """
    Estimate from the known members, type 8 of Hyndman & Fan (1996), whose median is right for
    any distribution; none without a known member.
    """
    lower: NotRequired[Optional[float]]
    """
    Lower bound; none if the members are too few for one.
    """
    probability: float
    """
    Probability of a smaller value.
    """
    upper: NotRequired[Optional[float]]
    """
    Upper bound; none if the members are too few for one.
    """


class QuantilesQuestion(TypedDict):
    """
    Question for quantiles of a quantity.
    """

    body: NotRequired[Optional[int]]
    """
    Index of the body whose quantity it is; none: one of the whole run.
    """
    probabilities: List[float]
    """
    Probabilities of the quantiles, each 0 < p < 1.
    """
    quantity: str
    """
    Name of the quantity in the members' outcomes.
    """


Quantity: TypeAlias = Literal['onset_time_s', 'peak_speed_m_s', 'peak_speed_time_s', 'stop_time_s', 'displacement_m', 'path_length_m', 'front_m', 'runout_m']
"""
A quantity of the outcome, by its key.
"""


class QuantityOnLevel(TypedDict):
    """
    A quantity on a level.
    """

    mean: float
    """
    Mean on the level.
    """
    standard_deviation: float
    """
    Standard deviation, over the members, of what the level adds: of the residuals of a regression
    on the inputs, and on all but the coarsest on the next coarser level.
    """


RasterFile: TypeAlias = bytes
"""
A GeoTIFF or an ESRI ASCII grid.
"""


ReferenceOnly: TypeAlias = Literal['reference']


class RegionPolygon(TypedDict):
    """
    Polygon with holes.
    """

    holes_m: List[List[List[float]]]
    """
    Rings of the holes, likewise, clockwise.
    """
    outer_m: List[List[float]]
    """
    Outer ring, downstream and across [m], counter-clockwise; its first corner is repeated at
    the end.
    """


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


class RestAtom(TypedDict):
    """
    Place at which many members come to rest exactly.
    """

    members: int
    """
    Members that rest there.
    """
    place_m: List[float]
    """
    Place, downstream and across [m].
    """
    radius_m: float
    """
    Distance up to which a place is this one [m].
    """
    share: float
    """
    Their share of the members with a known place.
    """


class RestQuestion(TypedDict):
    """
    Question where a body comes to rest.
    """

    body: int
    """
    Index of the body in the scenario.
    """
    regions: List[float]
    """
    Probabilities of the regions, each 0 < p < 1.
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


class SaltelliDesign(TypedDict):
    """
    Two independent samples A and B, and for each input i the mixture AB_i, A with the column i of
    B (Saltelli et al. 2010). A and B are the first and second half of the dimensions of one
    sequence of Sobol' points. The members of a row follow each other, A, B, AB_0, AB_1, …, so a
    design can be enlarged.
    """

    base_members: int
    """
    Number N of rows, a power of two; there are N (d + 2) members for d inputs.
    """
    seed: int
    """
    Seed of the scrambling.
    """


class SensitivityMeasures2(TypedDict):
    """
    Elementary effects of Morris trajectories.
    """

    elementary: ElementaryEffects
    """
    Elementary effects of Morris trajectories.
    """


class SensitivityQuestion(TypedDict):
    """
    Question which inputs a quantity depends on.
    """

    body: NotRequired[Optional[int]]
    """
    Index of the body whose quantity it is; none: one of the whole run.
    """
    quantity: str
    """
    Name of the quantity in the members' outcomes.
    """


Share: TypeAlias = Literal['whole', 'half', 'slab']
"""
Share of the flow that is computed; images stand for the rest.
"""


class SobolDesign(TypedDict):
    """
    Sobol' points with nested uniform scrambling (Owen 1997) by hash (Burley 2020). Member i
    depends on the seed and i alone, so a design can be enlarged. Each power of two of members is
    balanced; beyond 2¹⁶ every further 2¹⁶ members have a scrambling of their own.
    """

    members: int
    """
    Number of members, a power of two.
    """
    seed: int
    """
    Seed of the scrambling.
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


class StoppingRule(TypedDict):
    """
    Stopping rule: the design is doubled until the regions' area settles or a limit is reached.
    """

    area_changes_less_than: float
    """
    Relative change of the region's area by a doubling below which the answer is settled.
    """
    budget_point_steps: NotRequired[Optional[float]]
    """
    Most work in point-steps; none: no limit.
    """
    max_members: int
    """
    Most members.
    """
    region: float
    """
    Probability of the region that is watched; the rest questions have it.
    """


class StudyAccuracy(TypedDict):
    """
    Target of the accuracy of a mean: members and finer levels are added until sampling error and
    numerical error together are within it.
    """

    body: NotRequired[Optional[int]]
    """
    Index of the body whose quantity it is; none: one of the whole run.
    """
    budget_point_steps: NotRequired[float]
    """
    Most work in point-steps, 1e12 if left out.
    """
    finest_cell_size_m: NotRequired[Optional[float]]
    """
    Smallest cells that may be taken [m]; none: no limit but those of a scenario.
    """
    quantity: str
    """
    Name of the quantity whose mean it is about.
    """
    target: float
    """
    Largest distance of the ends of the mean's interval from the mean, over the mean,
    0.001 <= x <= 1.
    """


class StudyAnswer3(TypedDict):
    """
    Probability that the body ends below the surface.
    """

    buried: Probability
    """
    Probability that the body ends below the surface.
    """


class StudyAnswer5(TypedDict):
    """
    Quantiles of the quantity.
    """

    quantiles: List[Quantile]
    """
    Quantiles of the quantity.
    """


class StudyEstimate(TypedDict):
    """
    Estimate with bounds.
    """

    lower: float
    """
    Lower bound.
    """
    upper: float
    """
    Upper bound.
    """
    value: float
    """
    Estimate.
    """


class StudyForecast(TypedDict):
    """
    Levels that an accuracy is expected to take.
    """

    gain: float
    """
    That over the work of the levels: how many times cheaper they are.
    """
    is_expected_to_be_met: bool
    """
    True if cells may get as small, and work as much, as the target is expected to take.
    """
    levels: List[ForecastLevel]
    """
    Levels, the coarsest first.
    """
    one_level_members: int
    """
    Members of the finest level alone with the same sampling error.
    """
    one_level_point_steps: float
    """
    Their work [point-steps].
    """
    point_steps: float
    """
    Work of all their members [point-steps].
    """


class StudyLevel(TypedDict):
    """
    Level of a study.
    """

    cell_size_m: float
    """
    Cell size [m].
    """
    finished: int
    """
    Those of them whose run came to its end.
    """
    members: int
    """
    Members on the level.
    """
    point_steps_per_member: float
    """
    Mean work of such a member [point-steps], or what it is expected to be.
    """


class StudyMean(TypedDict):
    """
    Mean of a quantity.
    """

    estimate: NotRequired[Optional[float]]
    """
    Estimate, on the finest level; none of fewer than two known members.
    """
    known: int
    """
    Members whose quantity is known.
    """
    lower: NotRequired[Optional[float]]
    """
    Lower bound: sampling and numerical error below the estimate.
    """
    numerical_error: NotRequired[Optional[float]]
    """
    Half width that cells of the finest level add to it; none on one level, which does not tell.
    """
    sampling_error: NotRequired[Optional[float]]
    """
    Half width of the interval that sampling alone asks for.
    """
    unknown: int
    """
    Members whose quantity is not: failed, pending, or without it. For the bounds they lie
    anywhere between the smallest known value and the largest.
    """
    upper: NotRequired[Optional[float]]
    """
    Upper bound, likewise.
    """


class StudyQuestion1(TypedDict):
    """
    Where a body comes to rest.
    """

    rest: RestQuestion
    """
    Where a body comes to rest.
    """


class StudyQuestion2(TypedDict):
    """
    Probability that a quantity exceeds thresholds.
    """

    exceeds: ExceedsQuestion
    """
    Probability that a quantity exceeds thresholds.
    """


class StudyQuestion3(TypedDict):
    """
    Probability that a body ends below the surface.
    """

    buried: BuriedQuestion
    """
    Probability that a body ends below the surface.
    """


class StudyQuestion4(TypedDict):
    """
    Mean of a quantity.
    """

    mean: MeanQuestion
    """
    Mean of a quantity.
    """


class StudyQuestion5(TypedDict):
    """
    Quantiles of a quantity.
    """

    quantiles: QuantilesQuestion
    """
    Quantiles of a quantity.
    """


class StudyQuestion6(TypedDict):
    """
    Inputs that a quantity depends on.
    """

    sensitivity: SensitivityQuestion
    """
    Inputs that a quantity depends on.
    """


StudyQuestion: TypeAlias = Union[
    StudyQuestion1,
    StudyQuestion2,
    StudyQuestion3,
    StudyQuestion4,
    StudyQuestion5,
    StudyQuestion6,
]
"""
Question to a study.
"""


StudyStatus: TypeAlias = Literal['running', 'successful', 'failed', 'dismissed']
"""
State of a study, in the words of OGC API – Processes.
"""


class StudySummary(TypedDict):
    """
    A study without its document.
    """

    created: str
    """
    Time of submission (RFC 3339).
    """
    finished: Optional[str]
    """
    Time at which the study ended; null before.
    """
    id: str
    """
    Identifier.
    """
    members: int
    """
    Members of its design, on all levels together.
    """
    members_ended: int
    """
    Members whose job has ended.
    """
    members_made: int
    """
    Members that have been made so far.
    """
    status: StudyStatus
    """
    State.
    """
    title: str
    """
    Title.
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


class Terrain(TypedDict):
    """
    A terrain: a height map instead of a channel. In the computation x runs east and y north from
    the south-western corner of the map, and z up from a whole number of metres below its lowest
    place.
    """

    base_friction: NotRequired[float]
    """
    Coulomb friction between flow and ground, where no map of it is given.
    """
    base_friction_map: NotRequired[Optional[str]]
    """
    Map of that friction: the SHA-256 of its file; `null`: it is the same everywhere.
    """
    coordinates: NotRequired[Coordinates]
    """
    Coordinates of places in the scenario.
    Default: `"map"`.
    """
    height_map: str
    """
    Height map: the SHA-256 of its file in 64 hexadecimal digits.
    """


TerrainFormat: TypeAlias = Literal['geotiff', 'esri-ascii-grid']
"""
Format of a terrain's file.
"""


TerrainPurpose: TypeAlias = Literal['height-map', 'surface', 'thickness', 'friction']
"""
Purpose of a file's values.
"""


PolygonMItemItem: TypeAlias = float


PolygonMItem: TypeAlias = List[PolygonMItemItem]


class TerrainRelease(TypedDict):
    """
    A release on a terrain: an area by a polygon, or by a map.
    """

    polygon_m: NotRequired[Optional[List[PolygonMItem]]]
    """
    Corners of the area, easting and northing in the terrain's coordinates [m]; `null`: a map
    gives it.
    Default: left out.
    """
    surface_map: NotRequired[Optional[str]]
    """
    Map of the surface with the release still in place: the SHA-256 of its file. What lies above
    the height map is released.
    """
    thickness_m: NotRequired[Optional[float]]
    """
    Vertical thickness within the polygon [m].
    Default: left out.
    """
    thickness_map: NotRequired[Optional[str]]
    """
    Map of the vertical thickness: the SHA-256 of its file.
    """
    time_s: NotRequired[float]
    """
    Time of the release [s].
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


TriangularDistribution = TypedDict(
    'TriangularDistribution',
    {
        'from': float,
        'mode': float,
        'to': float,
    },
)


TruncationRange = TypedDict(
    'TruncationRange',
    {
        'from': float,
        'to': float,
    },
)


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


UniformDistribution = TypedDict(
    'UniformDistribution',
    {
        'from': float,
        'to': float,
    },
)


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


class WeightedValue(TypedDict):
    """
    Value of a choice.
    """

    value: Any
    """
    Any JSON value that the scenario may have at the input's place.
    """
    weight: float
    """
    Weight, positive; its share of the sum of the weights is the probability.
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

    burial_depth_m: float
    """
    Depth of its highest place below the surface of the flow round it at the end, along the
    normal of the bed [m]; 0 if it stands out.
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


class ChoiceDistribution(TypedDict):
    """
    Choice among values with weights.
    """

    values: List[WeightedValue]
    """
    Values, at least one.
    """


class Design1(TypedDict):
    """
    Scrambled Sobol' points, for probabilities and regions.
    """

    sobol: SobolDesign
    """
    Scrambled Sobol' points, for probabilities and regions.
    """


class Design2(TypedDict):
    """
    Latin hypercube.
    """

    latin_hypercube: LatinHypercubeDesign
    """
    Latin hypercube.
    """


class Design3(TypedDict):
    """
    All combinations of levels.
    """

    full_factorial: FullFactorialDesign
    """
    All combinations of levels.
    """


class Design4(TypedDict):
    """
    Trajectories of elementary effects, for screening.
    """

    morris: MorrisDesign
    """
    Trajectories of elementary effects, for screening.
    """


class Design5(TypedDict):
    """
    Two samples and their mixtures, for Sobol' indices.
    """

    saltelli: SaltelliDesign
    """
    Two samples and their mixtures, for Sobol' indices.
    """


class Design6(TypedDict):
    """
    One input after the other away from the median.
    """

    one_at_a_time: OneAtATimeDesign
    """
    One input after the other away from the median.
    """


class Design7(TypedDict):
    """
    Values of every member, given.
    """

    explicit: ExplicitDesign
    """
    Values of every member, given.
    """


Design: TypeAlias = Union[Design1, Design2, Design3, Design4, Design5, Design6, Design7]
"""
Design of a study's members.
"""


class Distribution1(TypedDict):
    """
    Every number of a range equally likely.
    """

    uniform: UniformDistribution
    """
    Every number of a range equally likely.
    """


class Distribution3(TypedDict):
    """
    Normal logarithm.
    """

    lognormal: LognormalDistribution
    """
    Normal logarithm.
    """


class Distribution4(TypedDict):
    """
    Density a triangle.
    """

    triangular: TriangularDistribution
    """
    Density a triangle.
    """


class Distribution5(TypedDict):
    """
    Any JSON values with weights.
    """

    choice: ChoiceDistribution
    """
    Any JSON values with weights.
    """


class Distribution6(TypedDict):
    """
    Numbers that are equally likely.
    """

    list: ListDistribution
    """
    Numbers that are equally likely.
    """


class Exceedance(TypedDict):
    """
    Probability that a quantity exceeds a threshold.
    """

    probability: Probability
    """
    Probability of a larger value.
    """
    threshold: float
    """
    Threshold, in the unit of the quantity.
    """


class FinishedMember(TypedDict):
    """
    Outcome of a run that came to its end.
    """

    bodies: NotRequired[List[MemberBody]]
    """
    Bodies, in the order of the scenario.
    """
    quantities: NotRequired[Dict[str, float]]
    """
    Quantities of the whole run by name, the unit in the name; what did not happen is left out.
    """


class FirstOrderIndex(TypedDict):
    """
    First-order index of one input: the share of the variance that it explains alone. With
    correlated inputs it has what they explain through it too.
    """

    classes: int
    """
    Number of classes that the values were cut into.
    """
    first_order: StudyEstimate
    """
    Index, with shifted bootstrap percentiles.
    """


class FirstOrderIndices(TypedDict):
    """
    First-order indices of a quantity from random members.
    """

    inputs: List[FirstOrderIndex]
    """
    Indices of the inputs, in their order.
    """
    members: int
    """
    Members with the quantity.
    """
    members_left_out: int
    """
    Members left out because they lack it.
    """


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
    Position and shape of the release in a channel.
    Default: all defaults.
    """
    releases: NotRequired[List[TerrainRelease]]
    """
    Releases on a terrain.
    Default: none, required on a terrain.
    """
    volume_m3: NotRequired[float]
    """
    Released volume in a channel [m³]; 0 is a flow without points, anything else below 1e-15 is
    refused.
    Default: none, required in a channel.
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


class FlowMap(TypedDict):
    """
    A map of a job's flow: a value for each cell of its height map, or for each square of them if
    they are finer than the cells of the computation.
    """

    links: FlowMapLinks
    """
    Files.
    """
    name: str
    """
    Name.
    """
    unit: str
    """
    Unit of the values.
    """


class FlowMapList(TypedDict):
    """
    The maps of a job's flow.
    """

    job_id: str
    """
    The job.
    """
    maps: List[FlowMap]
    """
    Its maps; none before it has succeeded, and without a flow.
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
    included [m]; null without a flow. On a terrain the horizontal distance from the middle of
    the release beyond which 1 % of it lies, null once so much has left the map; with several
    releases the run-out plus the largest distance within a release.
    """
    outflow_mass_kg: float
    """
    Mass that left through the open end, or over the edges of a terrain [kg].
    """
    runout_m: Optional[float]
    """
    Front minus the initial toe [m]; null without a front. On a terrain the distance beyond the
    circle round the release, with several releases beyond all of their circles.
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


class MemberCounts(TypedDict):
    """
    Counts of a study's members, each on every level that it is on.
    """

    failed: int
    """
    Members whose run failed.
    """
    failures: List[MemberFailures]
    """
    Failures by reason, the most frequent first.
    """
    finished: int
    """
    Members whose run came to its end.
    """
    pending: int
    """
    Members without an outcome yet.
    """


class MemberOutcome1(TypedDict):
    """
    The run came to its end.
    """

    finished: FinishedMember
    """
    The run came to its end.
    """


MemberOutcome: TypeAlias = Union[MemberOutcome1, MemberOutcome2, Literal['pending']]
"""
Outcome of a member.
"""


class NormalDistribution(TypedDict):
    """
    Normal distribution.
    """

    mean: float
    """
    Mean before truncation, in the unit of the input.
    """
    sd: float
    """
    Standard deviation before truncation, in the unit of the input.
    """
    truncate: NotRequired[Optional[TruncationRange]]


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


class Region(TypedDict):
    """
    Smallest area that holds a body at rest with a given probability.
    """

    area_m2: float
    """
    Area within the outline [m²].
    """
    area_standard_error_m2: float
    """
    Standard error of the area, from resampled members [m²].
    """
    atoms: int
    """
    Number of atoms that belong to it, the first in the list.
    """
    level_per_m2: NotRequired[Optional[float]]
    """
    Density at its edge [1/m²]; none if the atoms are enough.
    """
    members: Probability
    """
    Share of the members within, with bounds that members of unknown place widen.
    """
    polygons: List[RegionPolygon]
    """
    Its outline.
    """
    probability: float
    """
    Probability.
    """
    smoothed_probability: float
    """
    Probability that the smoothed density has within, atoms included. It differs from the
    probability asked for by what the smoothing moves over the edge.
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


class RestDistribution(TypedDict):
    """
    Distribution of a body's resting places.
    """

    atoms: List[RestAtom]
    """
    Places at which many members come to rest exactly, such as that of a body which the flow
    leaves alone; the most frequent first.
    """
    bandwidth_m: NotRequired[Optional[List[float]]]
    """
    Bandwidths of the density downstream and across [m].
    """
    density: NotRequired[Optional[DensityGrid]]
    moving: int
    """
    Members whose run ended with the body still moving; their places are unknown.
    """
    noise_ratio: NotRequired[Optional[float]]
    """
    Variance of the density over that with independent draws, from differences between parts
    of the members: 1 of independent ones, less of a balanced design.
    """
    numerical_error_m: NotRequired[Optional[List[float]]]
    """
    Half width of what the cells of the finest level may shift the places by, downstream and
    across [m]; none of a study on one level.
    """
    regions: List[Region]
    """
    Regions, in the order in which they were asked for.
    """
    too_few_members_for: List[float]
    """
    Probabilities asked for whose region takes more members.
    """


class SensitivityMeasures3(TypedDict):
    """
    First-order indices of any other design with random members.
    """

    first_order: FirstOrderIndices
    """
    First-order indices of any other design with random members.
    """


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


class SobolIndex(TypedDict):
    """
    Sobol' indices of one input.
    """

    first_order: StudyEstimate
    """
    Share of the variance that the input explains alone (Saltelli et al. 2010, table 2, b).
    """
    total: StudyEstimate
    """
    Share of the variance that the input has a part in (Jansen 1999).
    """


class SobolIndices(TypedDict):
    """
    Sobol' indices of a quantity.
    """

    inputs: List[SobolIndex]
    """
    Indices of the inputs, in their order.
    """
    rows: int
    """
    Rows of the design of which every member has the quantity.
    """
    rows_left_out: int
    """
    Rows left out because a member lacks it.
    """


class StudyAccuracyReached(TypedDict):
    """
    Accuracy that a study has reached.
    """

    gain: NotRequired[Optional[float]]
    """
    Their work over the work so far: how many times cheaper the levels are.
    """
    levels: List[QuantityOnLevel]
    """
    The quantity on the levels with enough members, the coarsest first.
    """
    mean: StudyMean
    """
    Mean that the accuracy is about.
    """
    needed: Needed
    """
    Need for the target; of a study that has ended, the one that it ended with.
    """
    one_level_members: NotRequired[Optional[int]]
    """
    Members of the finest level alone whose mean would have the same sampling error.
    """
    point_steps: float
    """
    Work so far [point-steps].
    """
    reached: NotRequired[Optional[float]]
    """
    That distance so far; none of too few members.
    """
    target: float
    """
    Largest distance of the interval's ends from the mean that was asked for, over the mean.
    """


class StudyAnswer1(TypedDict):
    """
    Distribution of the body's resting place.
    """

    rest: RestDistribution
    """
    Distribution of the body's resting place.
    """


class StudyAnswer2(TypedDict):
    """
    Probability of each threshold.
    """

    exceeds: List[Exceedance]
    """
    Probability of each threshold.
    """


class StudyAnswer4(TypedDict):
    """
    Mean of the quantity.
    """

    mean: StudyMean
    """
    Mean of the quantity.
    """


class StudyChanges(TypedDict):
    """
    Changes to a study; what is left out stays.
    """

    accuracy: NotRequired[Optional[StudyAccuracy]]
    design: NotRequired[Optional[Design]]
    finer_levels: NotRequired[Optional[List[FinerLevel]]]
    """
    Levels that begin with the present ones' cell sizes.
    """
    questions: NotRequired[Optional[List[StudyQuestion]]]
    """
    Other questions.
    """
    stop: NotRequired[Optional[StoppingRule]]


class StudyCost(TypedDict):
    """
    Cost of the members of a study.
    """

    accuracy: Optional[StudyForecast]
    max_members: int
    """
    Most members, if a stopping rule enlarges the design; else those of the design.
    """
    member_memory_bytes: int
    """
    Largest memory of a member [bytes].
    """
    members: int
    """
    Members of the design, on all levels together.
    """
    members_costed: int
    """
    Members whose cost was found; the others of a level are taken to cost as much on average.
    """
    point_steps: float
    """
    Work of all members of the design [point-steps].
    """
    point_steps_per_member: float
    """
    Mean work of a member [point-steps].
    """


class StudyPage(TypedDict):
    """
    A page of studies, newest first.
    """

    next_cursor: Optional[str]
    """
    Value of `cursor` for the next page; null on the last page.
    """
    studies: List[StudySummary]
    """
    The studies of this page.
    """


class TerrainDescription(TypedDict):
    """
    Description of a terrain's raster.
    """

    cell_size_m: float
    """
    Side of a cell [m].
    """
    columns: int
    """
    Number of cells towards the east.
    """
    epsg: Optional[int]
    """
    EPSG code of the coordinate reference system; null if the file has none.
    """
    format: TerrainFormat
    """
    Format of the file.
    """
    highest_m: Optional[float]
    """
    Highest value [m]; null for coefficients of friction.
    """
    holes: int
    """
    Number of cells without a value.
    """
    lowest_m: Optional[float]
    """
    Lowest value [m]; null for coefficients of friction.
    """
    mean_slope_deg: Optional[float]
    """
    Mean slope [°], by Horn's method; null unless the values are heights.
    """
    purpose: TerrainPurpose
    """
    Purpose of the values when the file first came.
    """
    rows: int
    """
    Number of cells towards the north.
    """
    south_m: float
    """
    Northing of the southern edge [m].
    """
    steepest_slope_deg: Optional[float]
    """
    Steepest slope [°]; null unless the values are heights.
    """
    west_m: float
    """
    Easting of the western edge [m], in the map's coordinates.
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
    Angular velocity at the start, in the axes of the ground [rad/s].
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
    Quaternion [w, x, y, z] from body axes to those of the ground, instead of yaw.
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


class Distribution2(TypedDict):
    """
    Normal, perhaps truncated.
    """

    normal: NormalDistribution
    """
    Normal, perhaps truncated.
    """


Distribution: TypeAlias = Union[
    Distribution1,
    Distribution2,
    Distribution3,
    Distribution4,
    Distribution5,
    Distribution6,
]
"""
Distribution of one input.
"""


class ListedMember(TypedDict):
    """
    A member of a study.
    """

    job: Optional[str]
    """
    Its job, which other studies may share; null if its scenario is not allowed.
    """
    level: int
    """
    Level of its cells, 0 the coarsest.
    """
    member: int
    """
    Number in the design.
    """
    outcome: Optional[MemberOutcome]
    status: Optional[JobStatus]
    values: List[Any]
    """
    Values of its inputs, in the order of the study's.
    """


class MemberPage(TypedDict):
    """
    Members of a study on a level, in the order of the design.
    """

    members: List[ListedMember]
    """
    The members of this page.
    """
    next: Optional[int]
    """
    Value of `from` for the next page; null on the last page.
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


class PlannedStudy(TypedDict):
    """
    Plan of a study.
    """

    cost: StudyCost
    """
    Cost of the members.
    """
    wall_time: WallTime
    """
    Expected wall time of the design's members, or of those that an accuracy is expected to take,
    on all workers of this service, if they have nothing else to do.
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
    channel: NotRequired[Channel]
    """
    Channel; a scenario has either a channel or a terrain.
    Default: none, required in a channel.
    """
    duration_s: NotRequired[float]
    """
    Simulated time [s]; 0 gives the start alone.
    Default: twice the time at which the flow is expected to have come to rest, at least as long as every table of a prescribed motion; 3 without a flow.
    """
    flow: Optional[Flow]
    flow_snapshot_points: NotRequired[int]
    """
    Largest number of points in a snapshot of the flow, which is thinned evenly to it: the same
    material points in all snapshots.
    """
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
    terrain: NotRequired[Terrain]
    """
    Terrain; a scenario has either a channel or a terrain.
    Default: left out.
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


class SensitivityMeasures1(TypedDict):
    """
    First-order and total indices of a Saltelli design.
    """

    sobol: SobolIndices
    """
    First-order and total indices of a Saltelli design.
    """


SensitivityMeasures: TypeAlias = Union[
    SensitivityMeasures1,
    SensitivityMeasures2,
    SensitivityMeasures3,
]
"""
Sensitivity of a quantity, by the method that the design is for.
"""


class StoredTerrain(TerrainDescription):
    """
    A terrain.
    """

    bytes: int
    """
    Length of the file [bytes].
    """
    created: str
    """
    Time at which the file first came (RFC 3339).
    """
    hash: str
    """
    SHA-256 of the file, 64 hexadecimal digits in lower case: the name of the terrain.
    """
    submitter: Optional[str]
    """
    Name of the access token with which it first came; null if none is required.
    """


class StudyAnswer6(TypedDict):
    """
    Inputs that the quantity depends on; none if it does not vary or too few members have it.
    """

    sensitivity: Optional[SensitivityMeasures]


StudyAnswer: TypeAlias = Union[
    StudyAnswer1,
    StudyAnswer2,
    StudyAnswer3,
    StudyAnswer4,
    StudyAnswer5,
    StudyAnswer6,
]
"""
Answer to a question, of the question's name.
"""


class StudyAnswers(TypedDict):
    """
    Answers to a study.
    """

    accuracy: NotRequired[Optional[StudyAccuracyReached]]
    answers: List[StudyAnswer]
    """
    Answers, in the order of the questions.
    """
    levels: NotRequired[List[StudyLevel]]
    """
    Levels, the coarsest first; none of a study on one level.
    """
    members: MemberCounts
    """
    Members by the fate of their runs, those of all levels.
    """


class StudyInput(TypedDict):
    """
    Uncertain input.
    """

    distribution: NotRequired[Optional[Distribution]]
    pointer: str
    """
    Place in the scenario, a JSON pointer (RFC 6901) to what is there or to a new key of an
    object that is there.
    """


class TerrainPage(TypedDict):
    """
    A page of terrains, newest first.
    """

    next_cursor: Optional[str]
    """
    Value of `cursor` for the next page; null on the last page.
    """
    terrains: List[StoredTerrain]
    """
    The terrains of this page.
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


class Study(TypedDict):
    """
    Study: a scenario, its uncertain inputs, the design of the members, and the questions.
    """

    accuracy: NotRequired[Optional[StudyAccuracy]]
    correlations: NotRequired[List[Correlation]]
    """
    Rank correlations of pairs of inputs; all other pairs are independent.
    """
    design: Design
    """
    Design of the members.
    """
    finer_levels: NotRequired[List[FinerLevel]]
    """
    Levels of finer cells, the coarsest first, beside the scenario's own cells, level 0; none: the
    scenario's alone.
    """
    inputs: List[StudyInput]
    """
    Uncertain inputs, at least one.
    """
    questions: NotRequired[List[StudyQuestion]]
    """
    Questions to be answered.
    """
    scenario: Any
    """
    Scenario that every member changes; what is in it is none of the study's business.
    """
    stop: NotRequired[Optional[StoppingRule]]
    title: NotRequired[str]
    """
    Free text.
    """


class StudyState(StudySummary):
    """
    A study.
    """

    problem: Optional[Failure]
    study: Study
    """
    The study, as enlarged last.
    """
    submitter: Optional[str]
    """
    Name of the access token of the submitter; null if none is required.
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
