"""The frames of a run as ParaView's own reader sees them (make test-paraview): moments, particles, arrays, values.

Usage: pvpython paraview_test.py RUN CASE, the folder of a whole run and the file of its case; what is expected comes from that,
summary.json, log.csv and frames.pvd by other means. Ends with "N passed, M failed".
"""

import csv
import json
import math
import sys
import tomllib
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from paraview import servermanager
from paraview.simple import PVDReader

run = Path(sys.argv[1])
sys.path.insert(0, str(Path(__file__).parent.parent / "tools" / "python"))
from frames import read_frame

passed = failed = 0


def check(what, right, found=""):
    global passed, failed
    passed, failed = passed + bool(right), failed + (not right)
    print(f"{'passed' if right else 'FAILED'}  {what}" + (f": {found}" if str(found) else ""))


def near(one, other, within=1e-12):
    return abs(one - other) <= within * max(abs(one), abs(other), 1e-300)


final = json.loads((run / "summary.json").read_text())["final"]
with (run / "log.csv").open(newline="") as file:
    last = list(csv.DictReader(file))[-1]
listed = [(float(e.get("timestep")), e.get("file")) for e in ElementTree.parse(run / "frames.pvd").getroot().iter("DataSet")]
path = run / listed[-1][1]
ours = read_frame(path)
count = len(ours["position"])

reader = PVDReader(FileName=str(run / "frames.pvd"))
reader.UpdatePipelineInformation()
times = list(reader.TimestepValues)
check("as many moments as frames", times == [time for time, _ in listed], len(times))
check("the last one is the end of the run", near(times[-1], final["time"], 1e-9), times[-1])

for time, name in (listed[0], listed[len(listed) // 2]):
    reader.UpdatePipeline(time)
    data = servermanager.Fetch(reader)
    there = len(read_frame(run / name)["position"])
    check(f"particles at {time:g} s", data.GetNumberOfPoints() == there and data.GetNumberOfCells() == there, data.GetNumberOfPoints())

reader.UpdatePipeline(times[-1])
data = servermanager.Fetch(reader)
arrays = {data.GetPointData().GetArrayName(k): data.GetPointData().GetArray(k) for k in range(data.GetPointData().GetNumberOfArrays())}
components = {"velocity": 3, "angular_velocity": 3, "radius": 1, "contacts": 1, "id": 1} | ({"serial": 1} if "serial" in ours else {})
check("arrays and their components", {name: a.GetNumberOfComponents() for name, a in arrays.items()} == components, sorted(arrays))
check("velocity is the array of vectors", data.GetPointData().GetVectors().GetName() == "velocity")
for particle in (0, count // 2, count - 1):
    check(f"particle {particle} is in its place, to the last bit", data.GetPoint(particle) == tuple(ours["position"][particle]), data.GetPoint(particle))
    check("... with its velocity", arrays["velocity"].GetTuple3(particle) == tuple(ours["velocity"][particle]))
    check("... and its number", arrays["id"].GetValue(particle) == particle)
axial = math.fsum(arrays["velocity"].GetTuple3(k)[2] for k in range(count)) / count
check("mean axial velocity is that of the summary", near(axial, final["mean_axial_velocity"], 1e-9), axial)
speed = max(math.hypot(*arrays["velocity"].GetTuple3(k)) for k in range(count))
check("so is the maximum speed", near(speed, final["max_speed"], 1e-12), speed)
contacts = sum(arrays["contacts"].GetValue(k) for k in range(count))
check("contacts add up to those of the log", contacts == 2 * int(last["pair contacts"]) + int(last["wall contacts"]), contacts)
field = data.GetFieldData()
step = field.GetArray("step")
check("the step is field data", step is not None and step.GetValue(0) == int(last["step"]))
if "pressure drop [Pa]" in last:
    gradient = field.GetArray("pressure_gradient")
    slices = gradient.GetNumberOfTuples()
    mean = math.fsum(gradient.GetValue(k) for k in range(slices)) / slices
    length = tomllib.loads(Path(sys.argv[2]).read_text())["pipe"]["length"]
    check("the pressure gradient is field data, and times the pipe's length the pressure drop", near(mean * length, float(last["pressure drop [Pa]"]), 1e-9), f"{slices} slices")
print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0)
