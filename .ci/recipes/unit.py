"""packaging/scree-work.service: its command with the environment that it names.

unit.py URL DATABASE
"""

import sys
from pathlib import Path

from service import Service
from worker import environment, seconds, works

PACKAGING = Path(__file__).parents[2] / "packaging"

lines = (PACKAGING / "scree-work.service").read_text().splitlines()
settings = dict(line.split("=", 1) for line in lines if "=" in line and not line.startswith("#"))
program, *words = settings["ExecStart"].split()
assert program == "/usr/local/bin/scree", program
assert float(settings["TimeoutStopSec"]) > seconds(words, "--grace")
assert settings["KillSignal"] == "SIGTERM" and "Environment" not in settings
named = Path(settings["EnvironmentFile"]).name
variables = environment((PACKAGING / named).read_text(), sys.argv[2])
print("scree-work.service:", works(words, variables, Service(sys.argv[1])))
