"""packaging/kubernetes: against Kubernetes' own schemas, what these don't know, and the containers'
commands.

    manifests.py URL DATABASE FOLDER     FOLDER: for the configuration of a service
"""

import json
import os
import re
import subprocess
import sys
import urllib.error
import urllib.request
from pathlib import Path

import kubernetes_validate
import yaml

from service import Service, until
from worker import HERE, environment, seconds, works

ROOT = Path(__file__).parents[2]
# The oldest with all that is used, and the newest that the package knows.
VERSIONS = ("1.27", kubernetes_validate.latest_version())


def manifests(name: str) -> list[dict]:
    found = list(yaml.safe_load_all((ROOT / "packaging/kubernetes" / name).read_text()))
    for manifest in found:
        for version in VERSIONS:
            kubernetes_validate.validate(manifest, version, strict=True)
    return found


def hardened(pod: dict):
    """The pod runs as a user without rights, and has its secrets from secrets."""
    [container] = pod["containers"]
    user, own = pod["securityContext"], container["securityContext"]
    assert user["runAsNonRoot"] and user["runAsUser"] > 0
    assert own["readOnlyRootFilesystem"] and not own["allowPrivilegeEscalation"]
    assert own["capabilities"]["drop"] == ["ALL"]
    assert not pod["automountServiceAccountToken"]
    assert not pod["enableServiceLinks"], "SCREE_PORT is no key of the configuration"
    assert all("value" not in variable for variable in container["env"])
    [database] = container["env"]
    assert database["valueFrom"]["secretKeyRef"]["key"] == database["name"] == "SCREE_DATABASE"
    assert "memory" in container["resources"]["limits"]


def workers(url: str, database: str):
    [job] = manifests("workers.yaml")
    spec, pod = job["spec"], job["spec"]["template"]["spec"]
    hardened(pod)
    assert spec["parallelism"] > 1 and "completions" not in spec, "not a queue of work"
    assert pod["restartPolicy"] == "Never", "which podFailurePolicy needs"
    [container] = pod["containers"]
    words = container["args"]
    assert pod["terminationGracePeriodSeconds"] > seconds(words, "--grace")
    assert words[words.index("--threads") + 1] == container["resources"]["limits"]["cpu"]
    text = (ROOT / "packaging/work.env").read_text()
    print("workers.yaml:", works(words, environment(text, database), Service(url)))


def answer(url: str, **headers) -> int:
    try:
        with urllib.request.urlopen(urllib.request.Request(url, headers=headers), timeout=30) as found:
            return found.status
    except urllib.error.HTTPError as error:
        return error.code


def with_token(folder: Path) -> tuple[Path, str]:
    """configs/service.toml with the section that `scree token` prints, and the token."""
    told = subprocess.run(
        [HERE, "token", "lab", "--scope", "submit", "--scope", "read"], check=True, text=True, capture_output=True
    )
    config = folder / "service.toml"
    section = told.stdout[told.stdout.index("[[tokens]]") :]
    config.write_text((ROOT / "configs/service.toml").read_text() + "\n" + section)
    [token] = set(re.findall(r"scree_\w+", told.stdout + told.stderr))
    return config, token


def service(database: str, folder: Path):
    deployment, front = manifests("service.yaml")
    pod = deployment["spec"]["template"]["spec"]
    hardened(pod)
    [container] = pod["containers"]
    labels = deployment["spec"]["template"]["metadata"]["labels"]
    assert front["spec"]["selector"] == deployment["spec"]["selector"]["matchLabels"] == labels
    assert front["spec"]["ports"][0]["targetPort"] == container["ports"][0]["name"]
    paths = {container[probe]["httpGet"]["path"] for probe in ("startupProbe", "livenessProbe", "readinessProbe")}
    assert paths <= set(json.loads((ROOT / "api/openapi.json").read_text())["paths"]), paths

    # The same command, with its file elsewhere and on the loopback interface.
    config, token = with_token(folder)
    words = container["args"]
    assert words[:3] == ["serve", "--workers", "0"]
    listen = words.index("--listen") + 1
    assert words[listen].endswith(f":{container['ports'][0]['containerPort']}")
    mounted = container["volumeMounts"][0]["mountPath"]
    words = [word.replace(mounted, str(config.parent)) for word in words]
    words[listen] = "127.0.0.1:0"
    process = subprocess.Popen(
        [HERE, *words], env={"SCREE_DATABASE": database}, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    try:
        url = re.search(r"http://\S+", process.stdout.readline())[0]
        until("the probes", lambda: all(answer(url + path) == 200 for path in paths), 10)
        assert answer(f"{url}/v1/jobs") == 401
        assert answer(f"{url}/v1/jobs", Authorization=f"Bearer {token}") == 200
    finally:
        process.terminate()
    assert process.wait(30) == 0
    print(f"service.yaml: answers {', '.join(sorted(paths))}, and asks for a token")


os.umask(0o077)
workers(sys.argv[1], sys.argv[2])
service(sys.argv[2], Path(sys.argv[3]))
