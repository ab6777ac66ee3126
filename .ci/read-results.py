"""Runs a scene through the service and reads what it recorded as its users do:
the trajectory with NumPy, flow, bodies and channel with VTK, the library of ParaView."""

import io
import json
import pathlib
import sys
import tempfile
import urllib.request
import xml.etree.ElementTree
import zipfile

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader

SCENE = {
    "channel": {"inclination_deg": 30, "incline_length_m": 0.4, "runout_length_m": 0.4, "width_m": 0.1},
    "flow": {"volume_m3": 0.0003, "release": {"height_m": 0.04, "toe_distance_m": 0.05}},
    "bodies": [{"shape": {"cube": {"side_m": 0.04}}}],
    "duration_s": 0.2,
    "sample_interval_s": 0.01,
    "flow_snapshots": 3,
    "numerics": {"cell_size_m": 0.02, "points_per_cell": 4},
}


def get(path):
    with urllib.request.urlopen(sys.argv[1] + path) as answer:
        return answer.read()


request = urllib.request.Request(
    sys.argv[1] + "/v1/jobs", json.dumps(SCENE).encode(), {"Content-Type": "application/json"}
)
with urllib.request.urlopen(request) as answer:
    job = answer.headers["Location"]
pathlib.Path(sys.argv[2]).write_text(job.rsplit("/")[-1])
assert json.loads(get(job + "?wait=60s"))["status"] == "successful"

columns = json.loads(get(job + "/trajectory"))["columns"]
arrays = numpy.load(io.BytesIO(get(job + "/trajectory?format=npz")))
assert sorted(arrays.files) == sorted(columns)
for name in arrays.files:
    expected = columns[name]
    found = [mode.decode() for mode in arrays[name]] if name == "mode" else arrays[name].tolist()
    assert found == expected, name

table = numpy.genfromtxt(io.BytesIO(get(job + "/trajectory?format=csv&fields=time_s,position_m")), delimiter=",", names=True)
assert table["position_m_z"].tolist() == [position[2] for position in columns["position_m"]]



def blocks(path):
    """The blocks of an instant by their names."""
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    whole = reader.GetOutput()
    places = range(whole.GetNumberOfBlocks())
    return {whole.GetMetaData(k).Get(vtkCompositeDataSet.NAME()): whole.GetBlock(k) for k in places}


def at(time_s, column):
    """A column of the trajectory between two samples."""
    rows = numpy.array(columns[column])
    return numpy.array([numpy.interp(time_s, columns["time_s"], row) for row in rows.T])


def extent(time_s, side_m, radius_m):
    """Half the extent of the rounded cube along each axis."""
    orientation = at(time_s, "orientation")
    w, x, y, z = orientation / numpy.linalg.norm(orientation)
    turn = numpy.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    return numpy.abs(turn).sum(axis=1) * (side_m / 2 - radius_m) + radius_m


def check_flow(points, flow):
    assert points.GetNumberOfVerts() == len(flow["speed_m_s"]) > 0
    position = vtk_to_numpy(points.GetPoints().GetData())
    speed = vtk_to_numpy(points.GetPointData().GetArray("speed_m_s"))
    assert (position == numpy.array(flow["position_m"], dtype="f4")).all()
    assert (speed == numpy.array(flow["speed_m_s"], dtype="f4")).all()
    assert points.GetFieldData().GetArray("TimeValue").GetValue(0) == flow["time_s"]


def check_bodies(surface, time_s, body):
    points = vtk_to_numpy(surface.GetPoints().GetData())
    reach = extent(time_s, body["shape"]["cube"]["side_m"], body["sphero_radius_m"])
    centre = at(time_s, "position_m")
    # The rounding is a polyhedron, which may fall short of its sphere by a hundredth.
    near = 0.02 * body["sphero_radius_m"]
    assert numpy.abs(points.max(axis=0) - (centre + reach)).max() < near
    assert numpy.abs(points.min(axis=0) - (centre - reach)).max() < near
    cells = surface.GetCellData()
    assert set(vtk_to_numpy(cells.GetArray("body"))) == {0}
    for name in ["velocity_m_s", "angular_velocity_rad_s"]:
        assert numpy.abs(vtk_to_numpy(cells.GetArray(name)) - at(time_s, name)).max() < 1e-5, name


def check_channel(surface, channel):
    width, back = channel["width_m"], channel["incline_length_m"]
    rise = back * numpy.tan(numpy.radians(channel["inclination_deg"]))
    kind = vtk_to_numpy(surface.GetCellData().GetArray("boundary"))
    assert sorted(kind) == [0, 0, 1, 1, 1, 1, 2]
    low_x, high_x, low_y, high_y, low_z, high_z = surface.GetBounds()
    found = [low_x, high_x, low_y, high_y, low_z]
    assert numpy.allclose(found, [-back, channel["runout_length_m"], -width / 2, width / 2, 0.0])
    assert high_z > rise


scenario = json.loads(get(job))["scenario"]
with tempfile.TemporaryDirectory() as directory:
    zipfile.ZipFile(io.BytesIO(get(job + "/flow.zip"))).extractall(directory)
    collection = xml.etree.ElementTree.parse(pathlib.Path(directory, "flow.pvd"))
    sets = list(collection.iter("DataSet"))
    assert len(sets) == SCENE["flow_snapshots"]
    for data in sets:
        time_s = float(data.get("timestep"))
        parts = blocks(pathlib.Path(directory, data.get("file")))
        assert list(parts) == ["flow", "bodies", "channel"]
        check_flow(parts["flow"], json.loads(get(job + f"/flow?time_s={time_s!r}")))
        check_bodies(parts["bodies"], time_s, scenario["bodies"][0])
        check_channel(parts["channel"], scenario["channel"])

print(f"read with NumPy {numpy.__version__} and VTK: {len(columns['time_s'])} samples, {len(sets)} snapshots")
