"""packaging/Dockerfile, where it can't be built: what a linter does not know of it, and the worker of
its comment.

    image.py URL DATABASE
"""

import json
import re
import subprocess
import sys
from pathlib import Path

from service import Service
from worker import environment, works

PACKAGING = Path(__file__).parents[2] / "packaging"
SECRET = re.compile(r"passw|secret|token|credential|private|database|://[^/]*:[^/]*@", re.IGNORECASE)


def instructions(text: str) -> list[tuple[str, str]]:
    """Word and rest of each instruction."""
    lines = [line for line in text.splitlines() if not line.lstrip().startswith("#")]
    joined = re.sub(r"\\\n\s*", " ", "\n".join(lines))
    return [tuple(line.strip().split(None, 1)) for line in joined.splitlines() if line.strip()]


def stages(text: str) -> dict[str, list[tuple[str, str]]]:
    """Instructions of each stage by its name; that of the image is the last one."""
    found: dict[str, list[tuple[str, str]]] = {}
    for word, rest in instructions(text):
        if word == "FROM":
            name = rest.partition(" AS ")[2] or f"stage {len(found)}"
            found[name] = []
        found[name].append((word, rest))
    return found


def check(text: str):
    all_stages = stages(text)
    for instruction in (i for stage in all_stages.values() for i in stage):
        word, rest = instruction
        if word in ("ENV", "ARG", "LABEL"):
            assert not SECRET.search(rest), f"a secret that stays in the image: {word} {rest}"
        if word == "COPY" and (source := re.match(r"--from=(\S+)", rest)):
            assert source[1] in all_stages, f"no stage {source[1]}"
        if word == "RUN":
            command = re.sub(r"^(--\S+\s+)+", "", rest)
            subprocess.run(["sh", "-n", "-c", command], check=True)
    image = list(all_stages.values())[-1]
    last = dict(image)
    assert last["FROM"] == "scratch", last["FROM"]
    user = last["USER"].split(":")[0]
    assert user.isdigit() and int(user) > 0, f"the user {user} may be root"
    assert json.loads(last["ENTRYPOINT"]) == ["/scree"], "a shell as the first process would get SIGTERM"
    assert json.loads(last["CMD"])[0] == "serve"
    # The folder is made, and given to the user, where there is a shell.
    made = " ".join(rest for word, rest in all_stages["build"] if word == "RUN")
    assert f"chown {last['USER']} /image{last['VOLUME']}" in made


def worker_of_comment(text: str) -> tuple[list[str], list[str]]:
    """Options of `docker run`, and words for the program."""
    comment = re.sub(r"\\\n#\s*", " ", text)
    [command] = re.findall(r"^#\s+docker run (.* scree work.*)$", comment, re.MULTILINE)
    options, _, words = command.partition(" scree ")
    return options.split(), words.split()


text = (PACKAGING / "Dockerfile").read_text()
check(text)
options, words = worker_of_comment(text)
grace, stop = words[words.index("--grace") + 1], options[options.index("--stop-timeout") + 1]
assert float(grace.rstrip("s")) < float(stop), "docker kills before the jobs are saved"
assert "--env-file" in options and "--env" not in options
variables = environment((PACKAGING / "work.env").read_text(), sys.argv[2])
print("Dockerfile:", works(words, variables, Service(sys.argv[1])))
