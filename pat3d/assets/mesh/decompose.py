"""Convex decomposition of closed meshes with CoACD, isolated in a process and cached by content."""

from __future__ import annotations

import importlib.metadata
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import AssetError
from pat3d.scene.cache import cache_root, content_key, load_points, store_points

DEFAULT_OPTIONS: dict[str, Any] = {
    "threshold": 0.05,
    "preprocess_mode": "off",
    "mcts_iterations": 60,
    "mcts_nodes": 10,
    "merge": True,
    "decimate": False,
    "seed": 0,
}
"""CoACD's parameters: no voxel preprocessing (it lowers bases) and no decimation (it damages them)."""

_VERSION = 1


@dataclass(frozen=True, kw_only=True, eq=False)
class Decomposition:
    """Convex pieces of a solid, before reduction."""

    parts: list[NDArray[np.float64]]
    """Points of each piece [m], shape (n, 3)."""
    options: dict[str, Any]
    """CoACD's parameters, its version included."""
    cached: bool
    seconds: float
    """Wall time [s], near zero from the cache."""


def decompose(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int32],
    *,
    timeout: float = 120.0,
    cpu_limit: float | None = None,
    cache_dir: str | os.PathLike[str] | None = None,
    **options: Any,
) -> Decomposition:
    """Cut a closed mesh into convex pieces whose union contains it.

    The same mesh and options give the same pieces: the seed is fixed, and results are kept under
    `cache_dir` (default: see `cache_root`) and never computed twice.

    Args:
        vertices: [m], shape (vertices, 3).
        faces: a closed manifold, counter-clockwise from outside, shape (faces, 3).
        timeout: [s], after which the computation is stopped.
        cpu_limit: [s] of the processor, after which it is stopped, too; None for any.
        cache_dir: where pieces are kept.
        options: CoACD parameters that differ from DEFAULT_OPTIONS.

    Raises:
        AssetError: the mesh is no closed surface, or CoACD failed, crashed or ran out of time.
    """
    _check_closed(vertices, faces)
    vertices = np.ascontiguousarray(vertices, dtype=np.float64)
    faces = np.ascontiguousarray(faces, dtype=np.int32)
    chosen = {**DEFAULT_OPTIONS, **options, "coacd": importlib.metadata.version("coacd")}
    key = content_key({"vertices": vertices, "faces": faces}, {**chosen, "format": _VERSION})
    path = cache_root(cache_dir) / "coacd" / f"{key}.npz"
    start = time.monotonic()
    parts = load_points(path)
    cached = parts is not None
    if parts is None:
        settings = {name: value for name, value in chosen.items() if name != "coacd"}
        parts = _run(vertices, faces, settings, timeout, cpu_limit)
        store_points(path, parts)
    return Decomposition(parts=parts, options=chosen, cached=cached, seconds=time.monotonic() - start)


def _check_closed(vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> None:
    """Refuse what makes CoACD abort or hang: no faces, NaN, flat, open."""
    if len(faces) < 4 or len(vertices) < 4:
        raise AssetError(f"a mesh of {len(faces)} faces is no solid; convex decomposition needs a closed surface.")
    if not np.isfinite(vertices).all():
        raise AssetError("the mesh has vertices that are not finite; convex decomposition needs finite ones.")
    extents = np.ptp(vertices, axis=0)
    if extents.min() <= 1e-9 * extents.max():
        raise AssetError("the mesh is flat; convex decomposition needs a solid.")
    edges = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
    code = edges[:, 0] * len(vertices) + edges[:, 1]
    twin = edges[:, 1] * len(vertices) + edges[:, 0]
    if not np.array_equal(np.sort(code), np.sort(twin)) or len(np.unique(code)) != len(code):
        raise AssetError("the mesh is open or not manifold; repair it before convex decomposition.")


def _run(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int32],
    options: dict[str, Any],
    timeout: float,
    cpu_limit: float | None,
) -> list[NDArray[np.float64]]:
    from pat3d.assets.mesh import coacd_worker

    with tempfile.TemporaryDirectory(prefix="pat3d-") as folder:
        source, target = Path(folder, "mesh.npz"), Path(folder, "parts.npz")
        np.savez(source, vertices=vertices, faces=faces, options=np.array(json.dumps(options)))
        # -P keeps the worker's folder off the module path, where our file names could shadow others.
        command = [sys.executable, "-P", str(coacd_worker.__file__), str(source), str(target)]
        command += [] if cpu_limit is None else [str(max(1, math.ceil(cpu_limit)))]
        with open(Path(folder, "log"), "w+b") as log:
            process = subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True
            )
            try:
                code = process.wait(timeout)
            except subprocess.TimeoutExpired:
                raise AssetError(
                    f"convex decomposition of {len(faces)} faces did not end within {timeout:g} s and was stopped; "
                    'simplify the mesh, or choose parts "hull" or "box".'
                ) from None
            finally:
                if process.poll() is None:
                    os.killpg(process.pid, signal.SIGKILL)
                    process.wait()
            log.seek(0)
            said = log.read()[-2000:].decode(errors="replace").strip().splitlines()
        if cpu_limit is not None and code == -signal.SIGXCPU:
            raise AssetError(
                f"convex decomposition of {len(faces)} faces was given up after the {cpu_limit:.3g} s of processor "
                'time that were left for it; allow more with --cpu-limit, simplify the mesh, or choose parts "hull" '
                'or "box".'
            )
        if code:
            reason = signal.Signals(-code).name if code < 0 else f"exit code {code}"
            raise AssetError(
                f"convex decomposition failed ({reason}{': ' + said[-1] if said else ''}); "
                'check the mesh, or choose parts "hull" or "box".'
            )
        parts = load_points(target)
    if parts is None:
        raise AssetError("convex decomposition returned no usable parts.")
    return parts
