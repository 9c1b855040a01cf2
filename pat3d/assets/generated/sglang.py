"""SGLang's mesh endpoint: POST /v1/meshes (multipart) gives a job, GET /v1/meshes/{id} its state, .../content the GLB.

Its shape is that of `multimodal_gen/runtime/entrypoints/openai/mesh_api.py`. The models that it serves make meshes of
pictures: without one it answers 422.
"""

from __future__ import annotations

import re
import secrets
from typing import Any

from pat3d.assets.generated.adapter import Made, Wish
from pat3d.assets.generated.client import Client, RefusedError
from pat3d.assets.mesh.importing import UpAxis
from pat3d.errors import AssetError

_ID = re.compile(r"[A-Za-z0-9_.-]{1,128}")


class SGLang:
    """Servers with `/v1/meshes`."""

    name = "sglang"
    up: UpAxis = "y"

    def answers(self, client: Client) -> bool:
        """Whether it lists meshes."""
        try:
            found = client.json("/v1/meshes?limit=1")
        except RefusedError as error:
            if error.status in (404, 405):
                return False
            raise
        except AssetError:
            return False
        return isinstance(found, dict) and isinstance(found.get("data"), list)

    def make(self, client: Client, wish: Wish) -> Made:
        """The mesh of `wish`; an unfinished job is deleted when nobody waits for it any more.

        Raises:
            AssetError: there is none.
        """
        job = self._state(client, client.json("/v1/meshes", form=_form(wish)))
        path = f"/v1/meshes/{job['id']}"
        try:
            while job["status"] in ("queued", "in_progress", "processing", "running"):
                client.wait()
                job = self._state(client, client.json(path))
            if job["status"] != "completed":
                client.fail(f"job {job['id']} is {job['status']}: {job['error']}")
            if job["url"]:
                client.fail("it put the mesh on another server, which is not asked; run it without cloud storage")
            data = client.bytes(f"{path}/content")
        except BaseException:
            # An interrupt of the user's too: the accelerator is to be free for somebody else.
            client.delete(path)
            raise
        return Made(data=data, model=job["model"] or self._model(client))

    @staticmethod
    def _state(client: Client, said: Any) -> dict[str, str]:
        """The fields of a job that matter, each a text."""
        job = said if isinstance(said, dict) else {}
        error = job.get("error")
        fields = {name: job.get(name) for name in ("id", "status", "model", "url")}
        fields["error"] = error.get("message") if isinstance(error, dict) else error
        told = {name: value if isinstance(value, str) else "" for name, value in fields.items()}
        if not _ID.fullmatch(told["id"]) or not told["status"]:
            client.fail("its answer is no mesh job")
        return told

    @staticmethod
    def _model(client: Client) -> str:
        """The first model that it serves; empty where it does not tell."""
        try:
            served = client.json("/v1/models", retries=0)["data"][0]["id"]
        except (AssetError, KeyError, IndexError, TypeError):
            return ""
        return served[:200] if isinstance(served, str) else ""


def _form(wish: Wish) -> tuple[bytes, str]:
    """The fields as multipart/form-data (RFC 7578), and their content type."""
    boundary = secrets.token_hex(16)
    pieces: list[bytes] = []
    for name, value in (("prompt", wish.prompt), ("seed", str(wish.seed)), ("output_format", "glb")):
        head = f'--{boundary}\r\nContent-Disposition: form-data; name="{name}"\r\n\r\n'
        pieces.append(f"{head}{value}\r\n".encode())
    if wish.picture is not None:
        head = (
            f'--{boundary}\r\nContent-Disposition: form-data; name="image"; filename="{wish.picture.name}"\r\n'
            f"Content-Type: {wish.picture.kind}\r\n\r\n"
        )
        pieces += [head.encode(), wish.picture.data, b"\r\n"]
    return b"".join([*pieces, f"--{boundary}--\r\n".encode()]), f"multipart/form-data; boundary={boundary}"
