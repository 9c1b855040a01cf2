"""Which model on which server: from the environment, else from `pat3d.toml`; the key from the environment alone."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from pat3d.errors import ModelError

HOSTED = "https://api.openai.com/v1"
"""The server where none is named."""
FILE = "pat3d.toml"
"""In the current folder, unless PAT3D_CONFIG names another file; its table `model` holds the settings."""
MAX_FILE_BYTES = 2**20
KEYS = ("PAT3D_MODEL_KEY", "OPENAI_API_KEY")
"""Environment variables of the key. The second goes only to a server that the environment names, never the file."""

_TEXTS = {"name": "PAT3D_MODEL", "base_url": "PAT3D_MODEL_URL", "vision": "PAT3D_MODEL_VISION"}
_NUMBERS = {"timeout": (1.0, 3600.0), "retries": (0, 20), "temperature": (0.0, 2.0)}


@dataclass(frozen=True, kw_only=True)
class ModelSettings:
    """A model on a server."""

    name: str
    base_url: str = HOSTED
    vision: str = ""
    """The model that looks at pictures; empty for the same one."""
    key: str = field(default="", repr=False)
    timeout: float = 120.0
    """Longest wait for one answer [s]."""
    retries: int = 4
    """Requests more where the server is busy, fails, or cannot be reached."""
    temperature: float | None = None
    """None for the server's own; some models refuse to be given one."""

    def __post_init__(self) -> None:
        parts = urlsplit(self.base_url)
        if parts.scheme not in ("http", "https") or not parts.hostname or parts.username or parts.password:
            raise ModelError(
                f"the model's base URL must be http(s)://host/v1 without a user or password, got a URL of host "
                f'"{parts.hostname or ""}".'
            )
        if not self.name.strip():
            raise ModelError("the model's name is empty.")
        for name, (least, most) in _NUMBERS.items():
            value = getattr(self, name)
            if value is not None and not least <= value <= most:
                raise ModelError(f"the model's {name} must be from {least:g} to {most:g}, got {value}.")

    @property
    def server(self) -> str:
        """Host and port, as reports name them."""
        return urlsplit(self.base_url).netloc

    def hidden(self, text: str) -> str:
        """`text` without the key, which servers like to repeat in their errors."""
        return text.replace(self.key, "***") if self.key else text


def load_settings(environment: Mapping[str, str] | None = None, folder: Path | None = None) -> ModelSettings:
    """The settings of `environment` (the process's own) and of the file in `folder` (the current one).

    Raises:
        ModelError: no model is named, or a setting is not valid.
    """
    given = os.environ if environment is None else environment
    path = Path(given["PAT3D_CONFIG"]) if given.get("PAT3D_CONFIG") else (folder or Path()) / FILE
    table = _table(path, required=bool(given.get("PAT3D_CONFIG")))
    urls = [given[name] for name in ("PAT3D_MODEL_URL", "OPENAI_BASE_URL") if given.get(name)]
    values: dict[str, Any] = {**table, **{name: given[var] for name, var in _TEXTS.items() if given.get(var)}}
    if urls:
        values["base_url"] = urls[0]
    if "name" not in values:
        raise ModelError(
            "no language model is named. Set PAT3D_MODEL (and PAT3D_MODEL_URL for a server such as "
            f'http://localhost:11434/v1), or write [model] name = "..." in {FILE}; the key is PAT3D_MODEL_KEY.'
        )
    # A file that came with somebody's folder must not send the user's hosted key to its own server.
    names = KEYS if urls or "base_url" not in table else KEYS[:1]
    return ModelSettings(**values, key=next((given[name] for name in names if given.get(name)), ""))


def _table(path: Path, *, required: bool) -> dict[str, Any]:
    """The table `model` of the file; empty where there is no file."""
    if not path.is_file() and not required:
        return {}
    try:
        if path.stat().st_size > MAX_FILE_BYTES:
            raise ModelError(f"{path} is larger than {MAX_FILE_BYTES} bytes.")
        table = tomllib.loads(path.read_text(encoding="utf-8")).get("model", {})
    except (OSError, ValueError) as error:
        raise ModelError(f"{path}: cannot be read: {error}") from error
    valid = (*_TEXTS, *_NUMBERS)
    if not isinstance(table, dict):
        raise ModelError(f'{path}: "model" must be a table: [model].')
    for name, value in table.items():
        if "key" in name.lower() or "token" in name.lower():
            raise ModelError(f"{path}: keys do not belong in a file; set PAT3D_MODEL_KEY and delete [model] {name}.")
        if name not in valid:
            raise ModelError(f'{path}: no setting "{name}" of a model. Valid: {", ".join(valid)}.')
        kinds = str if name in _TEXTS else int if name == "retries" else (int, float)
        if not isinstance(value, kinds) or isinstance(value, bool):
            raise ModelError(f"{path}: [model] {name} has a value of the wrong type: {value!r}.")
    return dict(table)
