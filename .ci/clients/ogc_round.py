"""A client generated from OGC's own contract (PyPI: ogc-api-processes-client), whose models check
every answer, takes a scenario from its submission to its results, and dismisses a job."""

import sys
import time

from ogc_api_processes_client.api.capabilities_api import CapabilitiesApi
from ogc_api_processes_client.api.conformance_declaration_api import ConformanceDeclarationApi
from ogc_api_processes_client.api.dismiss_api import DismissApi
from ogc_api_processes_client.api.job_list_api import JobListApi
from ogc_api_processes_client.api.process_description_api import ProcessDescriptionApi
from ogc_api_processes_client.api.process_list_api import ProcessListApi
from ogc_api_processes_client.api.result_api import ResultApi
from ogc_api_processes_client.api.status_api import StatusApi
from ogc_api_processes_client.api_client import ApiClient
from ogc_api_processes_client.api_client_wrapper import ApiClientWrapper
from ogc_api_processes_client.configuration import Configuration
from ogc_api_processes_client.exceptions import ApiException
from ogc_api_processes_client.models.status_code import StatusCode

client = ApiClient(Configuration(host=sys.argv[1]))
page = CapabilitiesApi(client).get_landing_page()
assert {"self", "service-desc", "conformance"} <= {link.rel for link in page.links}
classes = ConformanceDeclarationApi(client).get_conformance_classes()
assert "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/core" in classes.conforms_to
assert [process.id for process in ProcessListApi(client).get_processes().processes] == ["simulation"]
described = ProcessDescriptionApi(client).get_process_description("simulation")
schema = described.inputs["scenario"].var_schema.actual_instance
assert schema.type == "object" and "channel" in schema.properties

scenario = {
    "title": "by a client of OGC",
    "channel": {"inclination_deg": 40, "incline_length_m": 1, "runout_length_m": 1},
    "flow": {"volume_m3": 0.002},
    "bodies": [{"shape": {"cube": {"side_m": 0.04}}}],
    "duration_s": 0.2,
}


def execute(scenario):
    # The generated model of an input loses objects; `execute_simple` sends the request as it is.
    request = {"inputs": {"scenario": {"value": scenario}}}
    headers = {"Content-Type": "application/json", "Prefer": "respond-async"}
    return ApiClientWrapper(client.configuration).execute_simple("simulation", request, _headers=headers)


accepted = execute(scenario)
while (state := StatusApi(client).get_status(accepted.job_id)).status in ("accepted", "running"):
    time.sleep(0.1)
assert state.status == StatusCode.SUCCESSFUL and state.progress == 100 and state.type == "process"
results = ResultApi(client).get_result(accepted.job_id)
assert results["flow"].actual_instance.href.endswith("/flow.zip")
assert accepted.job_id in [job.job_id for job in JobListApi(client).get_jobs().jobs]

endless = scenario | {"duration_s": 600, "numerics": {"ending": "full"}}
accepted = execute(endless)
for refused, name in [(accepted.job_id, "result-not-ready"), ("none", "no-such-job")]:
    try:
        ResultApi(client).get_result(refused)
        raise SystemExit(f"results of {refused}")
    except ApiException as exception:
        assert exception.status == 404 and name in exception.body, exception
assert DismissApi(client).dismiss(accepted.job_id).status == StatusCode.DISMISSED
print("client of OGC's contract: every answer read by its models")
