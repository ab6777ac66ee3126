"""A local service, shared by all tests, and a job and a study that have ended well."""

from __future__ import annotations

from typing import Iterator

import pytest
import scenes

import scree


@pytest.fixture(scope="session")
def service() -> Iterator[scree.LocalService]:
    with scree.LocalService() as service:
        yield service


@pytest.fixture(scope="session")
def client(service: scree.LocalService) -> Iterator[scree.Client]:
    with scree.Client(service.url) as client:
        yield client


@pytest.fixture(scope="session")
def job(client: scree.Client) -> scree.JobHandle:
    return client.submit(scenes.SMALL).wait(60)


@pytest.fixture(scope="session")
def study(client: scree.Client) -> scree.StudyHandle:
    return client.submit_study(scenes.STUDY).wait(60)
