"""The package beside the service it belongs to."""

from __future__ import annotations

import importlib.metadata
import subprocess
import sys
from typing import get_args

import httpx

import scree
from scree import contract


def test_versions_and_documents_are_those_of_the_service(service: scree.LocalService) -> None:
    served = httpx.get(f"{service.url}/openapi.json", trust_env=False).json()
    assert importlib.metadata.version("scree") == served["info"]["version"]
    schemas = served["components"]["schemas"]
    assert set(contract.Scenario.__annotations__) == set(schemas["Scenario"]["properties"])
    assert set(contract.Study.__annotations__) == set(schemas["Study"]["properties"])
    assert list(get_args(contract.JobStatus)) == schemas["JobStatus"]["enum"]
    assert list(get_args(contract.StudyStatus)) == schemas["StudyStatus"]["enum"]


def test_the_package_is_typed() -> None:
    files = importlib.metadata.files("scree") or []
    assert "scree/py.typed" in map(str, files)


def test_optional_packages_are_not_needed() -> None:
    text = (
        "import scree, sys; assert not {'pandas', 'xarray', 'matplotlib'} & set(sys.modules);"
        "sys.modules['pandas'] = None; trajectory = scree.BodyTrajectory('1', 0, {});"
        "trajectory.to_pandas()"
    )
    result = subprocess.run([sys.executable, "-c", text], stderr=subprocess.PIPE, check=False)
    assert b"pandas" in result.stderr.splitlines()[-1]
