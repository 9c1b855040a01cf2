"""Remeshing by fTetWild (Hu et al. 2020), with triangles of one size, as the paper does before it counts."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from pat3d.check.metrics.interpenetration import EDGE, Surface
from pat3d.check.metrics.subject import Body, Subject
from pat3d.errors import CheckError

ENVELOPE = 1e-3
"""How far fTetWild may move a surface, over the diagonal of the object [-]; its default."""
SECONDS = 300.0
"""Longest wait for one object."""


def can_remesh() -> bool:
    """Whether pytetwild is installed."""
    return find_spec("pytetwild") is not None


def remeshed(subject: Subject, *, envelope: float = ENVELOPE) -> list[Surface]:
    """The surfaces of the objects with edges of about EDGE of the scene's diagonal.

    Raises:
        CheckError: fTetWild fails on an object; the message names it.
    """
    edge = EDGE * subject.diagonal
    return [_remeshed(body, edge, envelope) for body in subject.bodies]


def _remeshed(body: Body, edge: float, envelope: float) -> Surface:
    from pat3d.check.metrics import remesh_worker

    with tempfile.TemporaryDirectory(prefix="pat3d-") as folder:
        source, target = Path(folder, "mesh.npz"), Path(folder, "surface.npz")
        np.savez(source, vertices=body.vertices, faces=body.visual.faces, edge=edge, envelope=envelope)
        # -P keeps the worker's folder off the module path, where our file names could shadow others.
        command = [sys.executable, "-P", str(remesh_worker.__file__), str(source), str(target)]
        try:
            # fTetWild leaves a file in its working directory.
            done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=SECONDS, cwd=folder)
        except subprocess.TimeoutExpired:
            raise CheckError(f'fTetWild did not remesh "{body.name}" within {SECONDS:g} s.') from None
        if done.returncode or not target.is_file():
            said = done.stderr[-2000:].decode(errors="replace").strip().splitlines()
            raise CheckError(
                f'fTetWild cannot remesh "{body.name}" (exit code {done.returncode}{": " + said[-1] if said else ""}).'
            )
        with np.load(target, allow_pickle=False) as data:
            return data["vertices"], data["faces"]
