"""Meshes that servers have made, kept by what was asked: prompt, seed, picture, server, settings."""

from __future__ import annotations

import hashlib
import json
import struct
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pat3d.assets.generated.adapter import Adapter, Wish
from pat3d.assets.generated.client import Client
from pat3d.assets.generated.hunyuan import Hunyuan3D
from pat3d.assets.generated.settings import ServerSettings
from pat3d.assets.generated.sglang import SGLang
from pat3d.errors import AssetError
from pat3d.scene.cache import cache_root
from pat3d.scene.replacement import write_bytes, write_text

ADAPTERS: tuple[Adapter, ...] = (SGLang(), Hunyuan3D())
"""Kinds of server, in the order in which they are tried."""
VERSION = 1
"""Of what is asked; another one asks anew."""
MESH, RECORD = "mesh.glb", "record.json"


@dataclass(frozen=True, kw_only=True)
class Fetched:
    """A mesh as a file, alone in its folder, so that what it refers to cannot be found."""

    path: Path
    record: dict[str, Any]
    """Provenance: server, protocol, model, prompt, seed, sha256."""
    up: str


def fetch(settings: ServerSettings, wish: Wish, *, connect: Callable[[ServerSettings], Client] = Client) -> Fetched:
    """The mesh of `wish`: the one that is kept, else a new one of the server.

    Raises:
        AssetError: the server cannot be reached, takes too long, or gives no GLB file.
    """
    folder = cache_root() / "meshes" / _key(settings, wish)
    if (kept := _kept(folder)) is not None:
        return kept
    client = connect(settings)
    adapter = next((one for one in ADAPTERS if one.answers(client)), None)
    if adapter is None:
        names = ", ".join(one.name for one in ADAPTERS)
        raise AssetError(f"mesh server {settings.server}: it speaks none of the protocols known here ({names}).")
    try:
        made = adapter.make(client, wish)
    except AssetError as error:
        if wish.picture is None and any(word in str(error).lower() for word in ("image", "picture")):
            raise AssetError(
                f"{error} It makes meshes of pictures: put one into a folder that PAT3D_MESH_PICTURES names."
            ) from error
        raise
    check_glb(made.data, settings.server)
    record = {
        "server": settings.server,
        "protocol": adapter.name,
        **({"model": made.model} if made.model else {}),
        "prompt": wish.prompt,
        "seed": wish.seed,
        **({"picture": _sha256(wish.picture.data)} if wish.picture else {}),
        "sha256": _sha256(made.data),
    }
    try:
        folder.mkdir(parents=True, exist_ok=True)
        write_bytes(folder / MESH, made.data)
        write_text(folder / RECORD, json.dumps({**record, "up": adapter.up}))
    except OSError as error:
        raise AssetError(f'"{folder}" cannot be written: {error}.') from error
    return Fetched(path=folder / MESH, record=record, up=adapter.up)


def forget(fetched: Fetched) -> None:
    """Keep a mesh that turned out to be of no use no longer, so that the next run asks again."""
    (fetched.path.parent / RECORD).unlink(missing_ok=True)
    fetched.path.unlink(missing_ok=True)


def check_glb(data: bytes, server: str) -> None:
    """Refuse what is no whole GLB file (glTF 2.0, section 4.4), before anything parses it.

    Raises:
        AssetError: it is something else, or cut off.
    """
    if len(data) < 20 or data[:4] != b"glTF":
        raise AssetError(f"mesh server {server}: what it sent is no GLB file ({len(data)} bytes).")
    version, length = struct.unpack_from("<II", data, 4)
    if version != 2 or length != len(data):
        raise AssetError(
            f"mesh server {server}: its GLB file says version {version} and {length} bytes, and has {len(data)} bytes."
        )


def _kept(folder: Path) -> Fetched | None:
    """What is kept in `folder`, unless it is damaged."""
    try:
        record = json.loads((folder / RECORD).read_text(encoding="utf-8"))
        data = (folder / MESH).read_bytes()
        up = record.pop("up")
        whole = record["sha256"] == _sha256(data)
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None
    known = up in {one.up for one in ADAPTERS}
    return Fetched(path=folder / MESH, record=record, up=up) if whole and known else None


def _key(settings: ServerSettings, wish: Wish) -> str:
    picture = _sha256(wish.picture.data) if wish.picture else None
    return _sha256(json.dumps([VERSION, settings.url, wish.prompt, wish.seed, picture]).encode())


def _sha256(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
