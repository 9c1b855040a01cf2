"""Hunyuan3D's `api_server.py`: POST /send gives a uid, GET /status/{uid} the state and then the GLB in base64.

Older ones have only POST /generate, which answers with the GLB itself. Its shape is that of Hunyuan3D-2 and 2.1. Those
that were started with a text-to-image model understand text; the others want a picture. There is no way to cancel a
job, and one that fails is said to be "processing" for ever, so that it ends with the time allowed.
"""

from __future__ import annotations

import base64
import binascii
import re
from typing import Any

from pat3d.assets.generated.adapter import Made, Wish
from pat3d.assets.generated.client import MAX_JSON, Client, RefusedError
from pat3d.assets.mesh.importing import UpAxis
from pat3d.errors import AssetError

_UID = re.compile(r"[A-Za-z0-9-]{1,64}")
_NOBODY = "00000000-0000-0000-0000-000000000000"


class Hunyuan3D:
    """Servers with `/send`, `/status/{uid}` and `/generate`."""

    name = "hunyuan3d"
    up: UpAxis = "y"

    def answers(self, client: Client) -> bool:
        """Whether it tells the state of a job, even of one that it never had."""
        try:
            found = client.json(f"/status/{_NOBODY}")
        except AssetError:
            return False
        return isinstance(found, dict) and "status" in found

    def make(self, client: Client, wish: Wish) -> Made:
        """The mesh of `wish`.

        Raises:
            AssetError: there is none.
        """
        asked: dict[str, Any] = {"seed": wish.seed, "type": "glb", "texture": self._paints(client)}
        if wish.picture is not None:
            asked["image"] = base64.b64encode(wish.picture.data).decode()
        else:
            asked["text"] = wish.prompt
        try:
            sent = client.json("/send", data=asked)
        except RefusedError as error:
            if error.status not in (404, 405):
                raise
            return Made(data=client.bytes("/generate", data=asked))
        uid = sent.get("uid") if isinstance(sent, dict) else None
        if not isinstance(uid, str) or not _UID.fullmatch(uid):
            client.fail("its answer to /send has no uid")
        # Two meshes may come at once, the second without its texture.
        limit = 2 * (4 * client.settings.max_bytes // 3) + MAX_JSON
        while True:
            state = client.json(f"/status/{uid}", limit=limit)
            status = state.get("status") if isinstance(state, dict) else None
            if status == "completed":
                return Made(data=_decoded(client, state.get("model_base64")))
            if status not in ("processing", "texturing", "queued"):
                why = state.get("message") if isinstance(state, dict) else None
                client.fail(f"the job ended as {status!r}: {why}")
            client.wait()

    @staticmethod
    def _paints(client: Client) -> bool:
        """Whether the server makes textures: 2.1 always does, and waits for ever for one that is not asked for.

        Version 2 does where it was started so, does not tell, and fails silently where it was not.
        """
        try:
            found = client.json("/health", retries=0)
        except AssetError:
            return False
        return isinstance(found, dict) and "status" in found


def _decoded(client: Client, text: Any) -> bytes:
    """The bytes of a mesh that came as base64."""
    if not isinstance(text, str) or len(text) > 4 * client.settings.max_bytes // 3 + 4:
        client.fail("its answer holds no mesh, or one that is too large")
    try:
        return base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        client.fail("the mesh in its answer is not base64")
