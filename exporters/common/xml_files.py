"""What the readers of the XML formats share: strict XML, numbers, convex volumes, inertia in the body frame."""

from __future__ import annotations

import itertools
import math
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pat3d.errors import ExportError
from pat3d.scene.obj_files import read_obj

MAX_XML_BYTES = 64 * 2**20


def read_xml(path: Path, tag: str) -> ET.Element:
    """The root of an XML file, which must be `tag`.

    Raises:
        ExportError: unreadable, too large, not XML, or something else.
    """
    try:
        if path.stat().st_size > MAX_XML_BYTES:
            raise ExportError(f"{path}: larger than {MAX_XML_BYTES} bytes.")
        root = ET.parse(path).getroot()
    except OSError as error:
        raise ExportError(f"{path}: cannot be read ({error.strerror or error}).") from error
    except ET.ParseError as error:
        raise ExportError(f"{path}: not well-formed XML ({error}).") from error
    if root.tag != tag:
        raise ExportError(f"{path}: the root is <{root.tag}>; expected <{tag}>.")
    return root


def only(parent: ET.Element, tag: str, where: str) -> ET.Element:
    """The one child `tag` of `parent`.

    Raises:
        ExportError: there is none, or several.
    """
    found = parent.findall(tag)
    if len(found) != 1:
        raise ExportError(f"{where}: <{parent.tag}> has {len(found)} <{tag}>; expected one.")
    return found[0]


def numbers(words: str | None, count: int, where: str) -> NDArray[np.float64]:
    """`count` finite numbers.

    Raises:
        ExportError: they are something else.
    """
    try:
        values = np.array([float(word) for word in (words or "").split()])
    except ValueError as error:
        raise ExportError(f"{where}: {error}.") from error
    if len(values) != count or not np.isfinite(values).all():
        raise ExportError(f'{where}: expected {count} finite numbers, got "{words}".')
    return values


def beside(file: str | None, folder: Path, root: Path) -> Path:
    """The file that a path in a document of `folder` means; it may not leave `root`.

    Raises:
        ExportError: it does.
    """
    path = (folder / (file or "")).resolve()
    if not file or not path.is_relative_to(root.resolve()):
        raise ExportError(f'"{file}" is no file inside {root}.')
    return path


def in_body_axes(moments: NDArray[np.float64], axes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Inertia tensor [kg m^2] in the axes of the body, given in those of `axes` (columns); both shape (3, 3)."""
    return axes @ moments @ axes.T


def tensor(ixx: float, iyy: float, izz: float, ixy: float, ixz: float, iyz: float) -> NDArray[np.float64]:
    """A symmetric matrix, shape (3, 3)."""
    return np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])


def convex_volume(points: NDArray[np.float64]) -> float:
    """Volume [m^3] of the convex hull of `points` [m], shape (n, 3); NaN where they span none."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        return float(ConvexHull(points).volume)
    except (QhullError, ValueError):
        return math.nan


def box_corners(size: ArrayLike) -> NDArray[np.float64]:
    """The corners [m] of a box of this size [m] about the origin, shape (8, 3)."""
    return np.array(list(itertools.product((-0.5, 0.5), repeat=3))) * np.asarray(size, dtype=np.float64)


class MeshCorners:
    """The vertices of mesh files, each read once."""

    def __init__(self) -> None:
        self._known: dict[Path, NDArray[np.float64]] = {}

    def of(self, path: Path) -> NDArray[np.float64]:
        """[m], shape (vertices, 3)."""
        if path not in self._known:
            self._known[path] = np.asarray(read_obj(path)[0], dtype=np.float64)
        return self._known[path]


def common(values: list[float]) -> float:
    """The value that all share; NaN where they differ or there is none."""
    return values[0] if values and all(value == values[0] for value in values) else math.nan
