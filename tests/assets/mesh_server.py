"""A server on the loopback that speaks SGLang's and Hunyuan3D's mesh APIs, and does what the tests say on the way."""

from __future__ import annotations

import base64
import email
import email.policy
import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, Literal

from tests.loopback import Reply, listening


@dataclass(kw_only=True)
class Server:
    """What the server does, and what it was asked."""

    kind: Literal["sglang", "hunyuan", "hunyuan21", "generate"]
    mesh: bytes
    """A GLB file."""
    url: str = ""
    busy: int = 0
    """Questions about a job that it answers with "not yet"."""
    faults: dict[str, list[Reply]] = field(default_factory=dict)
    """Given in place of its own answers, by method and path ("POST /send"), one a request."""
    needs_picture: bool = False
    requests: list[str] = field(default_factory=list)
    """Methods and paths."""
    asked: list[dict[str, Any]] = field(default_factory=list)
    """Fields of the jobs."""
    keys: list[str | None] = field(default_factory=list)

    def count(self, start: str) -> int:
        """Requests whose method and path begin with `start`."""
        return sum(request.startswith(start) for request in self.requests)

    def answer(self, method: str, path: str, headers: Any, body: bytes) -> Reply:
        """As the server of its kind answers."""
        self.requests.append(f"{method} {path}")
        self.keys.append(headers["Authorization"])
        for start, replies in self.faults.items():
            if f"{method} {path}".startswith(start) and replies:
                return replies.pop(0)
        answers = _sglang if self.kind == "sglang" else _hunyuan
        return answers(self, method, path.split("?")[0], headers, body) or said({"detail": "Not Found"}, 404)


def said(data: Any, status: int = 200, **headers: str) -> Reply:
    """JSON."""
    names = {name.replace("_", "-"): text for name, text in headers.items()}
    return Reply(status=status, body=json.dumps(data).encode(), headers=names)


def _glb(mesh: bytes) -> Reply:
    return Reply(body=mesh, headers={"Content-Type": "model/gltf-binary"})


def _sglang(self: Server, method: str, path: str, headers: Any, body: bytes) -> Reply | None:
    job = {"id": "job-1", "object": "mesh", "model": "", "status": "queued", "progress": 0, "url": None, "error": None}
    if (method, path) == ("GET", "/v1/meshes"):
        return said({"object": "list", "data": []})
    if (method, path) == ("GET", "/v1/models"):
        return said({"object": "list", "data": [{"id": "tencent/Hunyuan3D-2", "object": "model"}]})
    if (method, path) == ("POST", "/v1/meshes"):
        # The standard library's reader of MIME is the oracle for our multipart bodies.
        head = f"Content-Type: {headers['Content-Type']}\r\n\r\n".encode()
        parts = email.message_from_bytes(head + body, policy=email.policy.HTTP)
        fields = {
            part.get_param("name", header="content-disposition"): part.get_payload(decode=True)
            for part in parts.iter_parts()
        }
        self.asked.append(fields)
        if self.needs_picture and "image" not in fields:
            return said({"detail": "Field 'image' or 'url' is required for mesh generation"}, 422)
        return said(job)
    if (method, path) == ("GET", "/v1/meshes/job-1"):
        self.busy -= 1
        return said(job if self.busy >= 0 else {**job, "status": "completed", "progress": 100})
    if (method, path) == ("GET", "/v1/meshes/job-1/content"):
        return _glb(self.mesh)
    return said({**job, "status": "deleted"}) if (method, path) == ("DELETE", "/v1/meshes/job-1") else None


def _hunyuan(self: Server, method: str, path: str, headers: Any, body: bytes) -> Reply | None:
    if method == "POST" and path in ("/send", "/generate"):
        if self.kind == "generate" and path == "/send":
            return None
        self.asked.append(json.loads(body))
        if self.needs_picture and "image" not in self.asked[-1]:
            return said({"detail": [{"loc": ["body", "image"], "msg": "Field required"}]}, 422)
        return said({"uid": "a-b-c"}) if path == "/send" else _glb(self.mesh)
    if path == "/health" and self.kind == "hunyuan21":
        return said({"status": "healthy", "worker_id": "1"})
    if path.startswith("/status/"):
        self.busy -= 1 if path.endswith("/a-b-c") else 0
        if not path.endswith("/a-b-c") or self.busy >= 0:
            return said({"status": "processing"})
        return said({"status": "completed", "model_base64": base64.b64encode(self.mesh).decode()})
    return None


@contextmanager
def serving(kind: Any, mesh: bytes, **more: Any) -> Iterator[Server]:
    """A server of `kind` whose meshes are all `mesh`."""
    made = Server(kind=kind, mesh=mesh, **more)
    with listening(made.answer) as made.url:
        yield made
