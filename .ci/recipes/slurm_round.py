"""Workers of the Slurm recipe on the cluster of check-slurm: short jobs by an array, then a job whose
worker is asked to end, killed, cancelled, and at the end of its time.

    slurm_round.py URL FILE FOLDER   FILE: the workers' environment; FOLDER: where tasks write their logs
"""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

from service import Service, scene, until

RECIPE = Path(__file__).parents[2] / "packaging/slurm/scree-work.sbatch"
SHORT_JOBS = 24
# A node of 2 CPUs runs two tasks of one CPU; further ones wait, as they do on a cluster.
SIZE = ["--cpus-per-task=1", "--time=10"]


def endless() -> dict:
    """A scene that takes minutes."""
    return scene("long", title="endless", duration_s=600, numerics={"cell_size_m": 0.01, "ending": "full"})


service = Service(sys.argv[1])
environment = sys.argv[2]
logs = Path(sys.argv[3])


def run(*command: str) -> str:
    return subprocess.run(command, check=True, text=True, capture_output=True).stdout


def sbatch(*options: str) -> str:
    """Submits the recipe as it is, with other sizes; the number of the array."""
    return run("sbatch", "--parsable", *SIZE, *options, str(RECIPE), environment).strip()


def states(array: str) -> dict[str, str]:
    """State and exit code of each task that has begun, by its number in the array."""
    found = {}
    for line in run("scontrol", "--oneliner", "show", "job", array).splitlines():
        words = dict(re.findall(r"(\w+)=(\S*)", line))
        if words["ArrayTaskId"].isdigit():
            found[words["ArrayTaskId"]] = f"{words['JobState']} {words['ExitCode']}"
    return found


def all_left(array: str, patience_s: float = 60):
    """Waits until no task is there any more."""
    until(f"the end of array {array}", lambda: not run("squeue", "--noheader", "--jobs", array), patience_s)


def task_of(array: str, attempt: dict) -> str:
    """Number of the task whose worker makes an attempt: workers tell their names in their logs."""
    for log in logs.glob(f"scree-work-{array}_*.log"):
        if attempt["owner"] in log.read_text():
            return log.stem.rsplit("_", 1)[1]
    raise SystemExit(f"no task of array {array} is {attempt['owner']}")


def worker_of(array: str, task: str) -> int:
    """Number of the process that a task's batch shell has become."""
    found = []
    wanted = {f"SLURM_ARRAY_JOB_ID={array}".encode(), f"SLURM_ARRAY_TASK_ID={task}".encode()}
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            words = set((entry / "environ").read_bytes().split(b"\0"))
        except OSError:
            continue
        if wanted <= words:
            found.append(int(entry.name))
    # One: there is no shell above it.
    [worker] = found
    return worker


def ending(identifier: str, number: int, kind: str, patience_s: float = 30) -> float:
    """Waits for the end of an attempt, and for its kind; the time that took."""
    begun = time.monotonic()
    attempt = until(
        f"the end of attempt {number}",
        lambda: (a := service.attempt(identifier, number)) and a["ending"] and a,
        patience_s,
    )
    assert attempt["ending"] == kind, attempt
    return time.monotonic() - begun


def successor(identifier: str, number: int) -> dict:
    """The next attempt, once its worker has said from where it goes on."""
    return until(
        f"attempt {number}, from a saved state",
        lambda: (a := service.attempt(identifier, number)) and a["resumed_from_s"] and a,
    )


def left_in_order(array: str, task: str):
    until(f"the end of task {task}", lambda: states(array)[task].startswith("COMPLETED"))
    assert states(array)[task] == "COMPLETED 0:0", states(array)


def short_jobs() -> str:
    """Many short jobs and an undisturbed long one; the fingerprint of that."""
    jobs = [service.submit(scene("tiny", title=f"tiny {n}")) for n in range(SHORT_JOBS)]
    jobs.append(service.submit(scene("long")))
    begun = time.monotonic()
    array = sbatch("--array=0-1")
    ended = service.until_successful(jobs)
    took = time.monotonic() - begun
    all_left(array)
    assert set(states(array).values()) == {"COMPLETED 0:0"}, states(array)
    owners = [job["attempts"][0]["owner"] for job in ended[:-1]]
    shares = " and ".join(str(owners.count(owner)) for owner in sorted(set(owners)))
    print(f"{len(jobs)} jobs by 2 tasks: {took:.1f} s from sbatch on; of the short ones {shares} each")
    return ended[-1]["provenance"]["fingerprint"]


def ended_and_killed(fingerprint: str):
    """TERM to a worker, then kill -9 of the next one."""
    job = service.submit(scene("long"))
    other = service.submit(endless())
    array = sbatch("--array=0-2")
    first = task_of(array, service.until_under_way(job, 1))
    run("scancel", "--signal=TERM", "--batch", f"{array}_{first}")
    released = ending(job, 1, "handed-back")
    begun = time.monotonic()
    second = successor(job, 2)
    waited = time.monotonic() - begun
    left_in_order(array, first)
    print(
        f"SIGTERM: released after {released:.2f} s with exit code 0; taken by another task after {waited:.2f} s, "
        f"from {second['resumed_from_s']:.1f} s of 240 s simulated"
    )

    service.until_under_way(job, 2)
    # The other task has its own job, and takes this one after it: it must be there until then.
    os.kill(worker_of(array, task_of(array, second)), signal.SIGKILL)
    expired = ending(job, 2, "expired")
    service.dismiss(other)
    third = successor(job, 3)
    [ended] = service.until_successful([job])
    assert len({a["owner"] for a in ended["attempts"]}) == 3, ended["attempts"]
    assert ended["provenance"]["fingerprint"] == fingerprint, "other bits"
    print(
        f"kill -9: the lease of {os.environ['SCREE_QUEUE__LEASE_S']} s ran out after {expired:.2f} s; "
        f"another task went on from {third['resumed_from_s']:.1f} s, to the fingerprint of an undisturbed run"
    )
    all_left(array)


def cancelled():
    """scancel without options, which sends SIGTERM, and SIGKILL after KillWait."""
    job = service.submit(endless())
    array = sbatch("--array=0")
    service.until_under_way(job, 1, 0.1)
    run("scancel", array)
    released = ending(job, 1, "handed-back")
    print(f"scancel: released after {released:.2f} s")
    all_left(array)
    service.dismiss(job)


def out_of_time():
    """The warning before the end of the allocation, which --max-time of the recipe is too late for."""
    job = service.submit(endless())
    begun = time.monotonic()
    array = sbatch("--array=0", "--time=2")
    service.until_under_way(job, 1, 0.1)
    ending(job, 1, "handed-back", 120)
    after = time.monotonic() - begun
    left_in_order(array, "0")
    print(f"time limit of 120 s: released {after:.0f} s after sbatch, and left in order")
    service.dismiss(job)


ended_and_killed(short_jobs())
cancelled()
out_of_time()
