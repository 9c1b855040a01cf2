"""Two USD layers compared: every prim, property, relationship, variant and piece of metadata that either states.

Layers and not composed stages: what a layer states in a variant that is not selected is there as well.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from pat3d.errors import ExportError
from pat3d.exporters.contents.inertia import same_tensor
from pat3d.exporters.contents.values import FOREIGN, RELATIVE, same_numbers, shown
from pat3d.exporters.usd.openusd import Gf, Sdf, Tf
from pat3d.scene.obj_files import MAX_FILE_BYTES

_SINGLE = 1e-6
"""Relative accuracy of what is kept in single precision."""

_AXES = frozenset({"physics:diagonalInertia", "physics:principalAxes"})


def layer_differences(found: Path, expected: Path) -> Iterator[str]:
    """What one layer states and the other does not, or states otherwise.

    Raises:
        ExportError: a layer cannot be read.
    """
    here, there = _open(found), _open(expected)
    mine, theirs = _specs(here), _specs(there)
    for path in mine:
        if path not in theirs and not _below(path, mine, theirs):
            yield f"{path} is there, which {FOREIGN}"
    for path in theirs:
        if path not in mine and not _below(path, theirs, mine):
            yield f"{path} is missing"
    turned: set[str] = set()
    for path in mine:
        if path not in theirs:
            continue
        name = path.rpartition(".")[2]
        for line in _spec(mine[path], theirs[path], path):
            owner = path.rpartition(".")[0]
            if name in _AXES and owner not in turned and _same_inertia(mine, theirs, owner):
                turned.add(owner)
            if not (name in _AXES and owner in turned):
                yield line


def _open(path: Path) -> Any:
    try:
        if path.stat().st_size > MAX_FILE_BYTES:
            raise ExportError(f"{path.name}: larger than {MAX_FILE_BYTES} bytes.")
        # Not by name: layers stay cached by path for as long as anything holds them.
        layer = Sdf.Layer.OpenAsAnonymous(str(path))
    except OSError as error:
        raise ExportError(f"{path.name}: cannot be read ({error.strerror or error}).") from error
    except Tf.ErrorException as error:
        raise ExportError(f"{path.name}: not readable USD ({str(error).strip()}).") from error
    if not layer:
        raise ExportError(f"{path.name}: not readable USD.")
    return layer


def _specs(layer: Any) -> dict[str, Any]:
    """Everything that the layer states, by its path."""
    paths: list[Any] = []
    layer.Traverse(Sdf.Path.absoluteRootPath, paths.append)
    return {str(path): layer.GetObjectAtPath(path) for path in sorted(paths)}


def _below(path: str, mine: dict[str, Any], theirs: dict[str, Any]) -> bool:
    """Whether what holds `path` is told already."""
    parent = str(Sdf.Path(path).GetParentPath())
    return parent in mine and parent not in theirs


def _spec(found: Any, expected: Any, path: str) -> Iterator[str]:
    if found is None or expected is None:
        # The targets of a relationship or a connection have no object; the lists that hold them are compared.
        return
    mine, theirs = set(found.ListInfoKeys()), set(expected.ListInfoKeys())
    for key in sorted(mine - theirs):
        yield f"{path} has {key} = {shown(_info(found, key))}, which {FOREIGN}"
    for key in sorted(theirs - mine):
        yield f"{path} lacks {key} = {shown(_info(expected, key))}"
    relative = RELATIVE if "typeName" in theirs and _is_double(_info(expected, "typeName")) else _SINGLE
    for key in sorted(mine & theirs):
        one, other = _info(found, key), _info(expected, key)
        if not _same(one, other, relative):
            yield f"{path} has {key} = {shown(one)} instead of {shown(other)}"


class _Opaque:
    """A value that OpenUSD does not hand to Python; equal to no other."""

    def __str__(self) -> str:
        return "something"


def _info(spec: Any, key: str) -> Any:
    try:
        return spec.GetInfo(key)
    except TypeError:
        return _Opaque()


def _is_double(kind: Any) -> bool:
    return "double" in str(kind) or str(kind).removesuffix("[]")[-1:] == "d"


def _same(found: Any, expected: Any, relative: float) -> bool:
    if type(found) is not type(expected):
        return False
    here, there = _numbers(found), _numbers(expected)
    if here is None or there is None:
        return bool(found == expected)
    return same_numbers(here, there, relative)


def _numbers(value: Any) -> NDArray[np.float64] | None:
    """A number, vector, quaternion, or array of them as floats; None for anything else."""
    if isinstance(value, str | bool):
        return None
    if isinstance(value, Gf.Quatf | Gf.Quatd | Gf.Quath):
        return np.array([value.GetReal(), *value.GetImaginary()], dtype=np.float64)
    try:
        return np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        return None


def _same_inertia(mine: dict[str, Any], theirs: dict[str, Any], owner: str) -> bool:
    """Whether the moments and axes of a prim give the same tensor in both layers."""
    tensors = []
    for specs in (mine, theirs):
        moments, axes = (specs.get(f"{owner}.physics:{name}") for name in ("diagonalInertia", "principalAxes"))
        if moments is None or axes is None or moments.default is None or axes.default is None:
            return False
        turn, values = _numbers(axes.default), _numbers(moments.default)
        if turn is None or values is None or not np.isfinite(turn).all() or np.linalg.norm(turn) == 0.0:
            return False
        rotation = Rotation.from_quat(turn, scalar_first=True).as_matrix()
        tensors.append(rotation @ np.diag(values) @ rotation.T)
    return same_tensor(tensors[0], tensors[1], _SINGLE)
