"""A local service, shared by all tests, and one job that has ended well."""

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
