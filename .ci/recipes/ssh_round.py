"""packaging/ssh with the `ssh` of the path: workers until the queue is empty, then workers that are
asked to end, and lose the command that started them.

    ssh_round.py NAME URL DATABASE
"""

import atexit
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from service import Service, scene, until

COMMAND = Path(__file__).parents[2] / "packaging/ssh/scree-work-on"
PASSWORD = "seen-by-nobody"

name, url, database = sys.argv[1:]
service = Service(url)
# The server trusts all; the word is there to be looked for.
variables = os.environ | {"SCREE_DATABASE": database.replace("scree@", f"scree:{PASSWORD}@")}


def start(*words: str) -> subprocess.Popen:
    """The command in a group of its own, as a terminal would start it; a check that fails leaves none."""
    process = subprocess.Popen(
        [COMMAND, *words],
        env=variables,
        text=True,
        start_new_session=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    atexit.register(end_group, process.pid)
    return process


def end_group(group: int):
    try:
        os.killpg(group, signal.SIGKILL)
    except ProcessLookupError:
        pass


def ended(process: subprocess.Popen, code: int) -> str:
    try:
        told = process.communicate(timeout=40)[0]
    finally:
        process.kill()
    assert process.returncode == code, f"{process.returncode}: {told}"
    return told


def command_lines() -> str:
    found = []
    for entry in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            found.append(entry.read_bytes().replace(b"\0", b" ").decode(errors="replace"))
        except OSError:
            continue
    return "\n".join(found)


def until_empty():
    jobs = [service.submit(scene("tiny")) for _ in range(6)]
    begun = time.monotonic()
    told = ended(start("one", "two", "--", "--threads", "1"), 0)
    took = time.monotonic() - begun
    service.until_successful(jobs, 1)
    assert "one: " in told and "two: " in told, told
    assert PASSWORD not in told
    print(f"{name}: 6 jobs by two hosts in {took:.1f} s")


def released(how: str, stop, code: int):
    """A worker with a long job is stopped somehow, and its job is released."""
    job = service.submit(scene("long"))
    process = start("one", "--", "--threads", "1", "--grace", "10s")
    service.until_under_way(job, 1)
    assert "scree-work-on" in command_lines() and PASSWORD not in command_lines()
    begun = time.monotonic()
    stop(process)
    attempt = until("its release", lambda: (a := service.attempt(job, 1)) and a["ending"] and a, 40)
    took = time.monotonic() - begun
    service.dismiss(job)
    assert attempt["ending"] == "handed-back", attempt
    ended(process, code)
    print(f"{name}: {how}: released after {took:.2f} s")


def kill_connection(process: subprocess.Popen):
    """kill -9 of the ssh of a command."""
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
            group = os.getpgid(int(entry.name))
        except OSError:
            continue
        # The program itself, or the script that stands for it.
        if group == process.pid and any(word.endswith(b"/ssh") or word == b"ssh" for word in words[:2]):
            os.kill(int(entry.name), signal.SIGKILL)


def a_host_that_is_not_there():
    job = service.submit(scene("tiny"))
    told = ended(start("nowhere", "one", "--", "--threads", "1"), 1)
    service.until_successful([job], 1)
    assert "nowhere: ended with exit code 255" in told, told
    print(f"{name}: a host that can't be reached is told, and the others work")


# Whoever starts this in the background may have had it ignored, and what ignores it can't be told
# to heed it by a program that it starts.
signal.signal(signal.SIGINT, signal.default_int_handler)
until_empty()
released("SIGTERM", lambda process: process.terminate(), 0)
released("Ctrl-C", lambda process: os.killpg(process.pid, signal.SIGINT), 0)
released("kill -9 of the command", lambda process: process.kill(), -signal.SIGKILL)
if name == "sshd":
    released("kill -9 of ssh", kill_connection, 1)
a_host_that_is_not_there()
