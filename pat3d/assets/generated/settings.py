"""Which server makes meshes, how long it may take, and the key, which comes from the environment alone."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import urlsplit

from pat3d.assets.mesh.load import MAX_BYTES
from pat3d.errors import AssetError

KEY, SECONDS, PICTURES = "PAT3D_MESH_KEY", "PAT3D_MESH_TIMEOUT", "PAT3D_MESH_PICTURES"
"""Environment variables."""
LONGEST = 86_400.0
"""[s]"""


@dataclass(frozen=True, kw_only=True)
class ServerSettings:
    """A server that makes meshes."""

    url: str
    """Up to where its own paths begin: "http://127.0.0.1:8080"."""
    key: str = field(default="", repr=False)
    seconds: float = 900.0
    """Longest wait for one mesh [s]."""
    answer_seconds: float = 60.0
    """Longest silence in one answer [s]; where the server makes the mesh meanwhile, `seconds` counts."""
    poll_seconds: float = 2.0
    """Between questions whether a mesh is ready [s]."""
    retries: int = 4
    """Requests more where the server is busy, fails, or cannot be reached."""
    max_bytes: int = MAX_BYTES
    """Of a mesh."""
    pictures: Path | None = None
    """Folder of pictures of what is asked for, `teapot_dinosaur.png`, for servers that make meshes of pictures."""

    def __post_init__(self) -> None:
        try:
            parts = urlsplit(self.url)
            good = parts.scheme in ("http", "https") and bool(parts.hostname) and (parts.port or 1) > 0
        except ValueError:
            good, parts = False, urlsplit("")
        if not good or parts.username or parts.password or parts.query or parts.fragment:
            raise AssetError(
                "a mesh server is mesh:http(s)://host:port, without a user, a password or a query; "
                f'its key is {KEY}. Got a URL of host "{parts.hostname or ""}".'
            )
        if not 0.0 < self.seconds <= LONGEST:
            raise AssetError(f"{SECONDS} must be from 0 to {LONGEST:g} s, got {self.seconds:g}.")

    @property
    def server(self) -> str:
        """Host and port, as reports name them."""
        return urlsplit(self.url).netloc

    def hidden(self, text: str) -> str:
        """`text` without the key, which servers like to repeat in their errors."""
        return text.replace(self.key, "***") if self.key else text


def server_settings(url: str, environment: Mapping[str, str] | None = None) -> ServerSettings:
    """The settings for the server at `url`, with what `environment` (the process's own) adds.

    Raises:
        AssetError: the URL or a variable is not valid.
    """
    given = os.environ if environment is None else environment
    try:
        seconds = float(given.get(SECONDS) or ServerSettings.seconds)
    except ValueError:
        raise AssetError(f"{SECONDS} must be a number of seconds, got {given[SECONDS]!r}.") from None
    pictures = Path(given[PICTURES]) if given.get(PICTURES) else None
    if pictures is not None and not pictures.is_dir():
        raise AssetError(f'{PICTURES}: there is no folder "{pictures}".')
    return ServerSettings(url=url.rstrip("/"), key=given.get(KEY, ""), seconds=seconds, pictures=pictures)
