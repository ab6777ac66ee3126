"""OWSLib takes a scenario from the description of its process to the results, and dismisses a job.
What it prints is the transcript in docs/ogc.md."""

import sys
import time

from owslib import __version__
from owslib.ogcapi.processes import Processes
from owslib.util import http_delete, http_get

SCENARIO = {
    "title": "by OWSLib",
    "channel": {"inclination_deg": 40, "incline_length_m": 1, "runout_length_m": 1},
    "flow": {"volume_m3": 0.002},
    "bodies": [{"shape": {"cube": {"side_m": 0.04}}}],
    "duration_s": 0.2,
}
ENDLESS = SCENARIO | {"title": "to be dismissed", "duration_s": 600, "numerics": {"ending": "full"}}


def inputs(scenario):
    return {"scenario": {"value": scenario}}


def show(call, answer):
    print(f"{call:<34} {answer}")


def last_words(names):
    return ", ".join(name.rsplit("/", 1)[-1] for name in names)


def ended(job):
    while (state := http_get(job).json())["status"] in ("accepted", "running"):
        time.sleep(0.1)
    return state


print(f"OWSLib {__version__}")
service = Processes(sys.argv[1])
show("Processes(url).links", last_words(link["rel"] for link in service.links))
classes = service.conformance()["conformsTo"]
show("conformance()", last_words(classes))
listed = service.processes()
show("processes()", ", ".join(f"{process['id']} {process['version']}" for process in listed))
described = service.process(listed[0]["id"])
scenario = described["inputs"]["scenario"]["schema"]
assert scenario["type"] == "object" and scenario["properties"]["gravity_m_s2"]["default"] == 9.81
show("process('simulation')", f"in: scenario ({', '.join(scenario['required'])}, …)")
show("", f"out: {', '.join(described['outputs'])}")

results = service.execute("simulation", inputs(SCENARIO))
moved = results["outcome"]["value"]["bodies"][0]["displacement_m"]
assert moved > 0
show("execute(…)", f"{', '.join(results)}; body 0 moved {moved:.3f} m")
only = service.execute("simulation", inputs(SCENARIO), {"outcome": {}}, response="raw")
assert only["bodies"][0]["displacement_m"] == moved
show("execute(…, {'outcome': {}}, 'raw')", "the bare outcome, with the same motion")

accepted = service.execute("simulation", inputs(SCENARIO), async_=True)
job = service.response_headers["Location"]
assert service.response_headers["Preference-Applied"] == "respond-async"
show("execute(…, async_=True)", f"{accepted['status']}, Location {job.split('/', 3)[3]}")
state = ended(job)
assert state["status"] == "successful" and state["finished"] >= state["started"] >= state["created"]
show("http_get(Location)", f"{state['status']}, progress {state['progress']}")
place = next(link["href"] for link in state["links"] if link["rel"].endswith("/results"))
results = http_get(place).json()
show("http_get(link 'results')", ", ".join(results))
table = http_get(results["trajectory"]["href"])
assert table.headers["Content-Type"] == results["trajectory"]["type"] == "text/csv"
lines = table.text.splitlines()
show("http_get(trajectory['href'])", f"{len(lines) - 1} samples: {lines[0][:24]}…")
for output in ("flow", "motion", "aerial"):
    answer = http_get(results[output]["href"])
    assert answer.ok and answer.headers["Content-Type"] == results[output]["type"], output

service.execute("simulation", inputs(ENDLESS), async_=True)
job = service.response_headers["Location"]
early = http_get(f"{job}/results")
show("http_get(Location + '/results')", f"{early.status_code} {last_words([early.json()['type']])}")
state = http_delete(job).json()
assert state["status"] == "dismissed"
show("http_delete(Location)", state["status"])
try:
    service.process("sorting")
except RuntimeError as error:
    assert "no-such-process" in str(error)
    show("process('sorting')", "RuntimeError: …/no-such-process")
try:
    service.api()
except RuntimeError as error:
    show("api()", f"RuntimeError: {error} (of OpenAPI 3.0)")
