"""A client made by openapi-python-client takes a scenario from its submission to its results."""

import io
import sys
import time

import numpy
from scree_client import Client
from scree_client.api.jobs import dismiss, list_, show, submit
from scree_client.api.plans import plan
from scree_client.api.results import flow, flow_archive, trajectory, trajectory_csv, trajectory_npz
from scree_client.models import (
    Body, Channel, Cube, CubeShape, Flow, Job, JobStatus, Position, Scenario, TrajectoryFieldsItem,
)

client = Client(base_url=sys.argv[1])
scenario = Scenario(
    title="made by a generated client",
    channel=Channel(inclination_deg=40, incline_length_m=1, runout_length_m=1),
    flow=Flow(volume_m3=0.002),
    bodies=[Body(shape=CubeShape(cube=Cube(side_m=0.04)), position=Position(downstream_m=0.1))],
    duration_s=0.5,
    sample_interval_s=0.05,
    flow_snapshots=3,
)
planned = plan.sync(client=client, body=scenario)
assert planned.plan.cost.points > 0
job = submit.sync(client=client, body=scenario, label=["client:python"])
assert isinstance(job, Job), job
while job.status in (JobStatus.ACCEPTED, JobStatus.RUNNING):
    job = show.sync(job.id, client=client, wait="10s")
assert job.status == JobStatus.SUCCESSFUL, job
assert job.outcome.bodies[0].displacement_m > 0
page = list_.sync(client=client, label="client:python", status=[JobStatus.SUCCESSFUL])
assert job.id in [listed.id for listed in page.jobs]

whole = trajectory.sync(job.id, client=client)
assert len(whole.columns.position_m) == len(whole.columns.time_s) == 11
some = trajectory.sync(
    job.id, client=client, fields=[TrajectoryFieldsItem.TIME_S, TrajectoryFieldsItem.MODE]
)
assert not some.columns.position_m and len(some.columns.mode) == 11
archive = trajectory_npz.sync(job.id, client=client)
columns = numpy.load(io.BytesIO(archive.payload.read()))
assert columns["position_m"].tolist() == whole.columns.position_m
table = trajectory_csv.sync(job.id, client=client)
assert len(table.splitlines()) == 12
snapshot = flow.sync(job.id, client=client, time_s=0.1)
assert len(snapshot.position_m) == len(snapshot.speed_m_s) > 0
assert flow_archive.sync(job.id, client=client).payload.read(2) == b"PK"
refused = dismiss.sync(job.id, client=client)
assert refused.status == 409 and refused.type_ == "urn:scree:problem:job-ended"
print("python: plan, submit, wait, list, trajectory, NPZ, flow, archive, problem")
