"""A service of one's own: the binary `scree`, on a free port of the loopback interface."""

from __future__ import annotations

import atexit
import os
import re
import shutil
import subprocess
import tempfile
import threading
from pathlib import Path

from typing_extensions import Self

from scree.errors import LocalServiceError

#: Time for the service to stop, beyond its own `limits.drain_timeout_s` [s].
_STOP_S = 20.0
_ADDRESS = re.compile(r"listening on (http://\S+)")


class LocalService:
    """A service that this program starts, and that ends with it.

    Its database is in a temporary folder, removed at the end unless this program is killed.
    Its configuration is the built-in one, apart from ``SCREE_…`` in the environment.

    Parameters
    ----------
    binary : str or os.PathLike, optional
        The binary; without it ``$SCREE_BINARY``, or else ``scree`` on the path.

    Raises
    ------
    LocalServiceError
        There is no such binary, or it stops at once.

    Examples
    --------
    >>> with scree.LocalService() as service:
    ...     client = scree.Client(service.url)
    """

    def __init__(self, binary: str | os.PathLike[str] | None = None) -> None:
        program = find_binary(binary)
        self._folder = tempfile.TemporaryDirectory(prefix="scree-")
        folder = Path(self._folder.name)
        self._log = folder / "log"
        command = [program, "serve", "--listen", "127.0.0.1:0"]
        # The service ends with its input, that is with this program, however it ends.
        command += ["--until-stdin-ends", "--database", str(folder / "scree.db")]
        with self._log.open("wb") as log:
            self._process = subprocess.Popen(  # noqa: S603 -- the binary that the caller named
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
                # Configuration files beside the caller are none of its.
                cwd=folder,
                # Ctrl-C interrupts the caller; the service and its results stay.
                start_new_session=True,
            )
        try:
            self.url = self._read_address()
        except BaseException:
            self.stop()
            raise

    @property
    def is_running(self) -> bool:
        """True until the service ends."""
        return self._process.poll() is None

    def stop(self) -> None:
        """Stops the service and removes its database; its jobs are gone."""
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()
        try:
            self._process.wait(_STOP_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._folder.cleanup()

    def __enter__(self) -> Self:
        """The service itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Stops the service."""
        self.stop()

    def _read_address(self) -> str:
        assert self._process.stdout is not None  # noqa: S101 -- it is piped
        line = self._process.stdout.readline().decode()
        address = _ADDRESS.match(line)
        if address is None:
            self._process.wait(_STOP_S)
            log = self._log.read_text(encoding="utf-8", errors="replace").strip()
            raise LocalServiceError(f"the local service did not start: {log or line}")
        return address[1]


def find_binary(binary: str | os.PathLike[str] | None = None) -> str:
    """Path of the binary: that one, ``$SCREE_BINARY``, or ``scree`` on the path.

    Raises
    ------
    LocalServiceError
        There is none.
    """
    named = binary or os.environ.get("SCREE_BINARY")
    found = shutil.which(os.fspath(named or "scree"))
    if found is None:
        raise LocalServiceError(
            f"no program {os.fspath(named)}"
            if named
            else "no program scree on the path: `cargo install --path . --locked` in Scree's "
            "repository puts it there; or name it in $SCREE_BINARY, or a service by its url"
        )
    # The service has a folder of its own, from which a relative path leads elsewhere.
    return str(Path(found).absolute())


_shared: LocalService | None = None
_lock = threading.Lock()


def shared() -> LocalService:
    """The local service of this process: started at the first call, stopped at exit."""
    global _shared
    with _lock:
        if _shared is None or not _shared.is_running:
            _shared = LocalService()
            atexit.register(_shared.stop)
        return _shared
