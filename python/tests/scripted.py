"""A server that answers as a test tells it to, one request after the other."""

from __future__ import annotations

import contextlib
import json
import threading
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Callable, Iterator, Mapping, Union


@dataclass
class Request:
    """A request as received."""

    method: str
    path: str
    headers: Mapping[str, str]
    body: bytes


@dataclass
class Answer:
    """An answer to be sent."""

    status: int
    body: bytes | object = b""
    headers: Mapping[str, str] = field(default_factory=dict)


#: What to do with a request: None breaks the connection without an answer.
Step = Callable[[Request], Union[Answer, None]]


def problem(status: int, kind: str, **headers: str) -> Step:
    document = {
        "type": f"urn:scree:problem:{kind}",
        "title": kind,
        "status": status,
        "detail": "as the test says",
    }
    names = {name.replace("_", "-"): value for name, value in headers.items()}
    content = {"Content-Type": "application/problem+json"}
    return lambda _: Answer(status, document, {**content, **names})


def answer(status: int, body: object = b"", **headers: str) -> Step:
    names = {name.replace("_", "-"): value for name, value in headers.items()}
    return lambda _: Answer(status, body, names)


@contextlib.contextmanager
def server(*steps: Step) -> Iterator[tuple[str, list[Request]]]:
    """Address of a server that takes these steps, and the requests that it has received."""
    requests: list[Request] = []
    script = iter(steps)

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            length = int(self.headers.get("Content-Length", 0))
            body = self.rfile.read(length)
            request = Request(self.command, self.path, dict(self.headers), body)
            requests.append(request)
            reply = next(script)(request)
            self.close_connection = True
            if reply is None:
                return
            content = reply.body
            data = content if isinstance(content, bytes) else json.dumps(content).encode()
            self.send_response(reply.status)
            for name, value in reply.headers.items():
                self.send_header(name, value)
            self.send_header("Content-Length", str(len(data)))
            self.end_headers()
            self.wfile.write(data)

        do_POST = do_PATCH = do_DELETE = do_GET  # noqa: N815 -- the names that http.server looks for

        def log_message(self, *_: object) -> None:
            pass

    http = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    thread = threading.Thread(target=http.serve_forever, args=(0.05,))
    thread.start()
    try:
        yield f"http://127.0.0.1:{http.server_port}", requests
    finally:
        http.shutdown()
        thread.join()
        http.server_close()
