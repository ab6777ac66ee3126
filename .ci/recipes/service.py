"""A service under test, as a client sees it. Needs nothing but Python."""

import json
import time
import urllib.error
import urllib.request
from pathlib import Path

HERE = Path(__file__).parent
ENDED = ("successful", "failed", "dismissed")


def scene(name: str, **changes) -> dict:
    """A scenario of this folder with other values at its top level."""
    return json.loads((HERE / f"{name}.json").read_text()) | changes


def until(what: str, condition, patience_s: float = 30):
    """The first value of the condition that is true; polled, since events are not what is tested."""
    end = time.monotonic() + patience_s
    while time.monotonic() < end:
        if value := condition():
            return value
        time.sleep(0.02)
    raise SystemExit(f"not within {patience_s:g} s: {what}")


class Service:
    def __init__(self, url: str):
        self.url = url

    def ask(self, method: str, path: str, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.url + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return json.load(answer)
        except urllib.error.HTTPError as error:
            raise SystemExit(f"{method} {path}: {error.read().decode()}") from error

    def submit(self, scenario: dict) -> str:
        return self.ask("POST", "/v1/jobs", scenario)["id"]

    def job(self, identifier: str) -> dict:
        return self.ask("GET", f"/v1/jobs/{identifier}")

    def dismiss(self, identifier: str):
        self.ask("DELETE", f"/v1/jobs/{identifier}")

    def until_successful(self, identifiers: list[str], patience_s: float = 120) -> list[dict]:
        """The documents of these jobs, once all of them have ended as they should."""
        return [self.successful(identifier, patience_s) for identifier in identifiers]

    def successful(self, identifier: str, patience_s: float) -> dict:
        def ended():
            job = self.job(identifier)
            return job["status"] in ENDED and job

        job = until(f"the end of {identifier}", ended, patience_s)
        if job["status"] != "successful":
            raise SystemExit(f"{identifier} is {job['status']}: {job.get('problem')}")
        return job

    def attempt(self, identifier: str, number: int) -> dict | None:
        """An attempt at a job, once it has begun."""
        attempts = self.job(identifier)["attempts"]
        return attempts[number - 1] if len(attempts) >= number else None

    def until_under_way(self, identifier: str, number: int, computed_s: float = 10) -> dict:
        """An attempt at a job, once it has computed that much of simulated time."""

        def under_way():
            job = self.job(identifier)
            attempts = job["attempts"]
            if len(attempts) < number or job["status"] != "running":
                return None
            begun_at = attempts[number - 1]["resumed_from_s"] or 0
            return (job["progress"] or {}).get("simulated_time_s", 0) > begun_at + computed_s and attempts[number - 1]

        return until(f"attempt {number} at {identifier} under way", under_way)
