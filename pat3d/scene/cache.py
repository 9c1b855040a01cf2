"""A content-addressed store of arrays on disk: the key is a hash of everything the arrays depend on."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pat3d.scene.replacement import replaced_file

if TYPE_CHECKING:
    # Who only asks where the cache is (reading a sentence) waits for no numpy.
    import numpy as np
    from numpy.typing import NDArray


def cache_root(cache_dir: str | os.PathLike[str] | None = None) -> Path:
    """`cache_dir`, else $PAT3D_CACHE, else $XDG_CACHE_HOME/pat3d, else ~/.cache/pat3d."""
    if cache_dir is not None:
        return Path(cache_dir)
    if os.environ.get("PAT3D_CACHE"):
        return Path(os.environ["PAT3D_CACHE"])
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "pat3d"


def data_root() -> Path:
    """What is kept for good: $PAT3D_DATA, else $XDG_DATA_HOME/pat3d, else ~/.local/share/pat3d."""
    if os.environ.get("PAT3D_DATA"):
        return Path(os.environ["PAT3D_DATA"])
    return Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share") / "pat3d"


def content_key(arrays: Mapping[str, NDArray[Any]], options: Mapping[str, Any]) -> str:
    """SHA-256 of `arrays` (types and shapes included) and JSON-serialisable `options`, as hex digits."""
    import numpy as np

    digest = hashlib.sha256(json.dumps(options, sort_keys=True).encode())
    for name, array in sorted(arrays.items()):
        digest.update(f"{name} {array.dtype.str} {array.shape}".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


def load_points(path: Path) -> list[NDArray[np.float64]] | None:
    """Point sets [m], each of shape (n, 3), from `path`; None where there is none or it is damaged."""
    import numpy as np

    try:
        with np.load(path, allow_pickle=False) as data:
            points, counts = data["points"], data["counts"]
    except Exception:
        # A damaged archive raises whatever its damage happens to hit (zip, zlib, header, missing key).
        return None
    numeric = points.dtype == np.float64 and points.ndim == 2 and np.issubdtype(counts.dtype, np.integer)
    if not numeric or points.shape[1] != 3 or counts.ndim != 1 or not len(counts):
        return None
    if counts.min() < 4 or counts.sum() != len(points) or not np.isfinite(points).all():
        return None
    return np.split(points, np.cumsum(counts)[:-1])


def load_record(path: Path) -> dict[str, Any]:
    """What was stored beside the points at `path`; empty where there is nothing readable."""
    import numpy as np

    try:
        with np.load(path, allow_pickle=False) as data:
            record = json.loads(str(data["record"]))
    except Exception:
        # As for the points: damage raises anything.
        return {}
    return record if isinstance(record, dict) else {}


def store_points(path: Path, parts: list[NDArray[np.float64]], record: Mapping[str, Any] | None = None) -> None:
    """Write point sets, and a JSON-serialisable `record`, to `path` atomically; an unwritable folder is left alone."""
    import numpy as np

    counts = np.array([len(points) for points in parts])
    with suppress(OSError), replaced_file(path) as temporary, temporary.open("wb") as file:
        np.savez(file, points=np.concatenate(parts), counts=counts, record=np.array(json.dumps(record or {})))
