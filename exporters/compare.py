"""Is what was written the Scene? Every format reloaded by its own parsers and compared, body by body.

The relative error of mass, inertia and friction, the distance of the centres of mass and of each hull from the scene's
in object lengths, and the distance and angle between the poses all have to be at most a millionth.
"""

from __future__ import annotations

import importlib.util
import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.errors import ExportError, Pat3dError
from pat3d.exporters.common.objects import body_names
from pat3d.exporters.common.readback import BodyReadback
from pat3d.exporters.hull_distance import hulls_apart
from pat3d.exporters.left_out import left_out
from pat3d.geometry.hulls import slivers
from pat3d.geometry.normals import triangle_areas
from pat3d.scene.model import Scene, SceneObject

TOLERANCE = 1e-6
"""Largest error that passes: relative, or in metres and radians for poses."""

QUANTITIES = ("mass", "centre", "inertia", "friction", "hulls", "position", "rotation")


@dataclass(frozen=True, kw_only=True)
class BodyParity:
    """Errors of one object; None where the reader does not say, or where it has no effect because it is fixed."""

    name: str
    """Of the object."""
    mass: float | None
    """Relative."""
    centre: float | None
    """Distance of the centres of mass over the object's longest side."""
    inertia: float | None
    """Relative, of the tensor and of each principal moment, whichever is larger."""
    friction: float | None
    """Relative."""
    hulls: float | None
    """Of the worst convex part: how far it reaches beyond the scene's, or that beyond it, over the object's longest
    side; infinite where their number differs."""
    position: float
    """[m]"""
    rotation: float
    """[rad]"""


@dataclass(frozen=True, kw_only=True)
class Reading:
    """What one parser found."""

    reader: str
    """Name and version: "MuJoCo 3.9.0"."""
    bodies: tuple[BodyParity, ...] = ()
    failures: tuple[str, ...] = ()
    """One line for everything that differs."""

    @property
    def worst(self) -> dict[str, float | None]:
        """The largest error of every quantity; None where the reader does not say."""
        found = {}
        for quantity in QUANTITIES:
            errors = [getattr(body, quantity) for body in self.bodies]
            found[quantity] = max((error for error in errors if error is not None), default=None)
        return found


@dataclass(frozen=True, kw_only=True)
class ParityReport:
    """What every parser at hand found in one export."""

    format: str
    path: str
    readings: tuple[Reading, ...]
    absent: tuple[str, ...] = ()
    """Parsers that are not installed."""
    left_out: tuple[str, ...] = ()
    """What of the scene the format cannot hold, or only in part, a line each."""

    @property
    def failures(self) -> tuple[str, ...]:
        """One line for everything that differs, said once."""
        return tuple(dict.fromkeys(line for reading in self.readings for line in reading.failures))

    @property
    def passed(self) -> bool:
        """Every parser found the Scene."""
        return not self.failures

    @property
    def worst(self) -> dict[str, float | None]:
        """The largest error of every quantity that any parser found."""
        found = [reading.worst for reading in self.readings]
        return {
            quantity: max((one[quantity] for one in found if one[quantity] is not None), default=None)  # type: ignore[type-var]
            for quantity in QUANTITIES
        }

    @property
    def largest(self) -> float:
        """The largest error of all."""
        return max((error for error in self.worst.values() if error is not None), default=0.0)

    def moved(self, before: Path, after: Path) -> ParityReport:
        """The same report after the folder `before` has become `after`."""
        here, there = str(before), str(after)
        readings = [
            replace(reading, failures=tuple(line.replace(here, there) for line in reading.failures))
            for reading in self.readings
        ]
        return replace(self, path=self.path.replace(here, there), readings=tuple(readings))

    def as_dict(self) -> dict[str, Any]:
        """Plain data for report.json."""
        readings = [{**asdict(reading), "worst": reading.worst} for reading in self.readings]
        return {
            "format": self.format,
            "passed": self.passed,
            "failures": list(self.failures),
            "worst": self.worst,
            "tolerance": TOLERANCE,
            "readings": readings,
            "absent": list(self.absent),
            "left_out": list(self.left_out),
        }


@dataclass(frozen=True, kw_only=True)
class _Reader:
    name: str
    package: str | None
    """Distribution to import from; None for our own reading."""
    read: Callable[[Path], Sequence[BodyReadback]]
    silent: frozenset[str] = frozenset()
    """Quantities that it does not report, "fixed" among them."""


def parity(scene: Scene, path: str | Path) -> ParityReport:
    """Reload the export at `path` and compare it with `scene`.

    Args:
        scene: what was written.
        path: a written file, or its folder.

    Raises:
        ExportError: there is no export at `path`.
    """
    kind, main = locate(Path(path))
    readings, absent = [], []
    for reader in _READERS[kind](main):
        if reader.package is not None and importlib.util.find_spec(_MODULES[reader.package]) is None:
            absent.append(reader.name)
            continue
        version = "" if reader.package is None else f" {_version(reader.package)}"
        try:
            found = reader.read(main)
        except Pat3dError as error:
            readings.append(Reading(reader=reader.name + version, failures=(str(error),)))
            continue
        readings.append(_reading(scene, found, reader, reader.name + version, main))
    if not readings:
        raise ExportError(f"{main}: no reader is installed. Install one of: {', '.join(absent)}.")
    return ParityReport(
        format=kind,
        path=str(main),
        readings=tuple(readings),
        absent=tuple(absent),
        left_out=left_out(scene, kind),
    )


def differences(scene: Scene, path: str | Path) -> tuple[str, ...]:
    """Where the export at `path` differs from `scene`, a line each; none where they agree."""
    return parity(scene, path).failures


def locate(path: Path) -> tuple[str, Path]:
    """Format and main file of the export at `path`.

    Raises:
        ExportError: there is none.
    """
    mains = {
        "mjcf": ("scene.xml",),
        "usd": ("scene.usdc", "scene.usda", "scene.usdz", "scene.usd"),
        "urdf": ("manifest.json",),
        "sdf": ("scene.sdf",),
    }
    if path.is_dir():
        for kind, names in mains.items():
            for name in names:
                if (path / name).is_file():
                    return kind, path / name
    elif path.is_file():
        for kind, names in mains.items():
            if path.name in names or path.suffix in (f".{kind}", *(Path(name).suffix for name in names)):
                return kind, path
    known = ", ".join(name for names in mains.values() for name in names)
    raise ExportError(f"{path} holds no export; expected one of: {known}.")


def _reading(scene: Scene, found: Sequence[BodyReadback], reader: _Reader, name: str, path: Path) -> Reading:
    slugs = body_names(scene)
    there = {body.name: body for body in found}
    seen: set[int] = set()
    bodies, failures = [], []
    for obj in scene.objects:
        body = there.pop(slugs[obj.name], None)
        if body is None:
            failures.append(f'"{obj.name}" is missing from {path}.')
            continue
        if "fixed" not in reader.silent and body.fixed != obj.fixed:
            now, then = ("fixed", "free") if body.fixed else ("free", "fixed")
            failures.append(f'"{obj.name}" is {then} in the scene but {now} in {path}.')
        if id(obj.asset) not in seen:
            seen.add(id(obj.asset))
            failures += _narrow_faces(obj)
        errors = _errors(obj, body, reader.silent)
        bodies.append(errors)
        failures += _lines(obj, body, errors, path)
    if "fixed" not in reader.silent:
        loose = [body.name for body in there.values() if not body.fixed]
        failures += [f'the body "{body}" of {path} is not in the scene.' for body in loose]
    return Reading(reader=name, bodies=tuple(bodies), failures=tuple(failures))


def _narrow_faces(obj: SceneObject) -> list[str]:
    """Convex parts that some engine refuses for a face without a normal, a line each."""
    lines = []
    for number, part in enumerate(obj.asset.parts):
        if len(bad := slivers(part.vertices, part.faces)):
            area = 1e6 * float(triangle_areas(part.vertices[part.faces[bad[:1]]])[0])
            lines.append(f'"{obj.name}": convex part {number} has a face of {area:.2g} mm^2, which is a sliver.')
    return lines


def _errors(obj: SceneObject, body: BodyReadback, silent: frozenset[str]) -> BodyParity:
    properties, asset = obj.asset.mass_properties, obj.asset
    inertia = np.array(properties.inertia)
    errors: dict[str, float | None] = {
        "friction": _relative(body.friction, asset.material.friction),
        "hulls": None if "hulls" in silent else hulls_apart(obj.asset, body.hulls),
        "mass": None,
        "centre": None,
        "inertia": None,
    }
    if not obj.fixed:
        offset = np.linalg.norm(np.asarray(body.centre) - properties.centre_of_mass)
        tensor = np.linalg.norm(np.asarray(body.inertia) - inertia) / np.linalg.norm(inertia)
        errors["mass"] = _relative(body.mass, properties.mass)
        errors["centre"] = float(offset / asset.size.max())
        errors["inertia"] = max(float(tensor), _moments(body.inertia, inertia))
    errors = {name: None if name in silent else error for name, error in errors.items()}
    turn = np.asarray(body.pose.rotation) @ obj.pose.rotation.T
    # The angle from the antisymmetric part keeps its accuracy near zero, where the trace loses half its digits.
    sine = 0.5 * np.linalg.norm([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    return BodyParity(
        name=obj.name,
        position=float(np.linalg.norm(np.subtract(body.pose.position, obj.pose.position))),
        rotation=math.atan2(float(sine), 0.5 * (float(np.trace(turn)) - 1.0)),
        **errors,  # type: ignore[arg-type]
    )


def _moments(found: np.ndarray, expected: np.ndarray) -> float:
    """Largest relative error of a principal moment."""
    if not np.isfinite(found).all():
        return math.nan
    there, here = np.linalg.eigvalsh(found), np.linalg.eigvalsh(expected)
    return float(np.max(np.abs(there - here) / here))


def _relative(found: float, expected: float) -> float:
    return abs(found - expected) / (abs(expected) or 1.0)


def _lines(obj: SceneObject, body: BodyReadback, errors: BodyParity, path: Path) -> list[str]:
    """What is wrong with one object, a line each; NaN is wrong."""
    wrong = [name for name in QUANTITIES if (error := getattr(errors, name)) is not None and not error <= TOLERANCE]
    lines = []
    if "position" in wrong or "rotation" in wrong:
        lines.append(
            f'"{obj.name}" stands elsewhere in {path}: {1e3 * errors.position:.3g} mm away, turned by '
            f"{math.degrees(errors.rotation):.3g} degrees."
        )
    if "mass" in wrong:
        mass = obj.asset.mass_properties.mass
        lines.append(f'"{obj.name}" weighs {body.mass:.4g} kg in {path} instead of {mass:.4g} kg.')
    if "friction" in wrong:
        friction = obj.asset.material.friction
        lines.append(f'"{obj.name}" has friction {body.friction:.4g} in {path} instead of {friction:.4g}.')
    for name, words in (("centre", "centre of mass"), ("inertia", "inertia"), ("hulls", "convex parts")):
        if name in wrong:
            lines.append(f'"{obj.name}": the {words} in {path} differ by {getattr(errors, name):.2g} (relative).')
    return lines


_MODULES = {"mujoco": "mujoco", "usd-core": "pxr", "yourdfpy": "yourdfpy", "pybullet": "pybullet", "drake": "pydrake"}
"""Module of every distribution that a reader imports."""


def _version(package: str) -> str:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return ""


def _mjcf_readers(path: Path) -> tuple[_Reader, ...]:
    from pat3d.exporters.mjcf.reader import read_mjcf

    return (_Reader(name="MuJoCo", package="mujoco", read=read_mjcf),)


def _urdf_readers(path: Path) -> tuple[_Reader, ...]:
    from pat3d.exporters.engines import read_with_drake, read_with_pybullet, read_with_yourdfpy
    from pat3d.exporters.urdf.reader import read_directives, read_urdf

    return (
        _Reader(name="manifest and objects", package=None, read=lambda path: read_urdf(path.parent)),
        _Reader(name="model directives", package=None, read=lambda path: read_directives(path.parent)),
        _Reader(
            name="yourdfpy",
            package="yourdfpy",
            read=lambda path: read_with_yourdfpy(path.parent),
            silent=frozenset({"friction", "fixed"}),
        ),
        _Reader(
            name="PyBullet",
            package="pybullet",
            read=lambda path: read_with_pybullet(path.parent),
            silent=frozenset({"hulls"}),
        ),
        _Reader(name="Drake", package="drake", read=lambda path: read_with_drake(path.parent)),
    )


def _sdf_readers(path: Path) -> tuple[_Reader, ...]:
    from pat3d.exporters.engines import read_with_drake
    from pat3d.exporters.sdf.reader import read_sdf

    ours = _Reader(name="world", package=None, read=read_sdf)
    return (ours, _Reader(name="Drake", package="drake", read=read_with_drake))


def _usd_readers(path: Path) -> tuple[_Reader, ...]:
    from pat3d.exporters.usd.reader import read_usd

    return (_Reader(name="OpenUSD", package="usd-core", read=read_usd),)


_READERS: dict[str, Callable[[Path], tuple[_Reader, ...]]] = {
    "mjcf": _mjcf_readers,
    "usd": _usd_readers,
    "urdf": _urdf_readers,
    "sdf": _sdf_readers,
}
