"""Workers as a recipe starts them: its words, its environment and nothing else."""

import os
import signal
import subprocess
import time

from service import ENDED, Service, scene, until

JOBS = 3
HERE = os.environ["RECIPES_SCREE"]


def environment(text: str, database: str) -> dict[str, str]:
    """The variables of a file like packaging/work.env, with the database of the test."""
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    variables = dict(line.split("=", 1) for line in lines)
    assert "SCREE_DATABASE" in variables, variables
    return variables | {"SCREE_DATABASE": database}


def works(words: list[str], variables: dict[str, str], service: Service) -> str:
    """Runs `scree` with these words until it has done some jobs, and ends it as the recipe does."""
    assert words[0] == "work" and "--database" not in words, words
    assert not any("://" in word for word in words), "a URL among the arguments, for all to see"
    jobs = [service.submit(scene("tiny")) for _ in range(JOBS)]
    begun = time.monotonic()
    worker = subprocess.Popen([HERE, *words], env=variables, stderr=subprocess.PIPE, text=True)
    try:
        until("the jobs", lambda: worker.poll() or all(service.job(job)["status"] in ENDED for job in jobs), 60)
        if worker.poll():
            raise SystemExit(f"scree {' '.join(words)}: exit code {worker.returncode}: {worker.stderr.read()}")
        service.until_successful(jobs, 1)
        if "--until-empty" not in words:
            worker.send_signal(signal.SIGTERM)
        log = worker.communicate(timeout=30)[1]
    finally:
        worker.kill()
    assert worker.returncode == 0, log
    return f"{JOBS} jobs in {time.monotonic() - begun:.1f} s, and it left with exit code 0"


def seconds(words: list[str], option: str) -> float:
    """The value of an option such as `--grace 20s`."""
    value = words[words.index(option) + 1]
    assert value.endswith("s"), value
    return float(value[:-1])
