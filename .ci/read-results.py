"""Runs a scene through the service and reads what it recorded as its users do:
the trajectory with NumPy, the snapshots with VTK, the library of ParaView."""

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
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

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

with tempfile.TemporaryDirectory() as directory:
    zipfile.ZipFile(io.BytesIO(get(job + "/flow.zip"))).extractall(directory)
    collection = xml.etree.ElementTree.parse(pathlib.Path(directory, "flow.pvd"))
    sets = list(collection.iter("DataSet"))
    assert len(sets) == SCENE["flow_snapshots"]
    for data in sets:
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(pathlib.Path(directory, data.get("file"))))
        reader.Update()
        points = reader.GetOutput()
        flow = json.loads(get(job + "/flow?time_s=" + data.get("timestep")))
        assert points.GetNumberOfVerts() == len(flow["speed_m_s"]) > 0
        position = vtk_to_numpy(points.GetPoints().GetData())
        speed = vtk_to_numpy(points.GetPointData().GetArray("speed_m_s"))
        assert (position == numpy.array(flow["position_m"], dtype="f4")).all()
        assert (speed == numpy.array(flow["speed_m_s"], dtype="f4")).all()
        assert points.GetFieldData().GetArray("TimeValue").GetValue(0) == flow["time_s"]

print(f"read with NumPy {numpy.__version__} and VTK: {len(columns['time_s'])} samples, {len(sets)} snapshots")
