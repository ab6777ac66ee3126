"""The service that belongs to this program."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import httpx
import pytest

import scree
from scree.local_service import find_binary


def is_gone(url: str) -> bool:
    try:
        httpx.get(f"{url}/healthz", trust_env=False)
    except httpx.TransportError:
        return True
    return False


def test_it_stops_with_its_block() -> None:
    with scree.LocalService() as service:
        assert service.is_running
        folder = Path(service._folder.name)
        assert (folder / "scree.db").is_file()
    assert not service.is_running
    assert not folder.exists()
    assert is_gone(service.url)


def test_it_ends_with_a_program_that_is_killed(tmp_path: Path) -> None:
    text = "import scree, time; print(scree.LocalService().url, flush=True); time.sleep(60)"
    command = [sys.executable, "-c", text]
    # The killed program leaves the folder of the database there.
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    with subprocess.Popen(command, stdout=subprocess.PIPE, env=environment) as program:
        assert program.stdout is not None
        url = program.stdout.readline().decode().strip()
        assert not is_gone(url)
        program.kill()
    end = time.monotonic() + 10
    while not is_gone(url):
        assert time.monotonic() < end
        time.sleep(0.05)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no process groups")
def test_ctrl_c_is_not_for_the_service(service: scree.LocalService) -> None:
    assert os.getpgid(service._process.pid) != os.getpgid(0)


def test_configuration_files_beside_the_caller_are_left_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    configs = tmp_path / "configs"
    configs.mkdir()
    (configs / "service.toml").write_text("not a configuration")
    monkeypatch.chdir(tmp_path)
    with scree.LocalService() as service:
        assert service.is_running


def test_a_binary_that_is_not_there(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(scree.LocalServiceError, match="no program no-such-program"):
        scree.LocalService("no-such-program")
    monkeypatch.delenv("SCREE_BINARY", raising=False)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(scree.LocalServiceError, match="SCREE_BINARY"):
        scree.LocalService()


def test_a_binary_on_the_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = tmp_path / "scree"
    shutil.copy(find_binary(), program)
    monkeypatch.delenv("SCREE_BINARY", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert find_binary() == str(program)


def test_a_service_that_does_not_start_tells_why(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SCREE_WORKERS__COUNT", "100000")
    with pytest.raises(scree.LocalServiceError, match=r"did not start: .*workers"):
        scree.LocalService()
