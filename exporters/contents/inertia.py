"""The same inertia in other principal axes.

Where two moments of a body are equal its principal axes are any in a plane, and which ones a computer finds depends on
its rounding. What counts is the tensor.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import ExportError, SpecError
from pat3d.exporters.common.frames import rotation_of
from pat3d.exporters.common.xml_files import in_body_axes, numbers, tensor
from pat3d.exporters.contents.values import same_numbers
from pat3d.geometry.pose import Pose

_PRODUCTS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")


@dataclass(frozen=True, kw_only=True, eq=False)
class _Inertial:
    mass: float
    """[kg]"""
    centre: NDArray[np.float64]
    """[m], shape (3,)."""
    inertia: NDArray[np.float64]
    """About the centre, in the axes of the body [kg m^2], shape (3, 3)."""


def same_inertia(found: ET.Element, expected: ET.Element) -> bool:
    """Whether two <inertial> of MJCF, URDF or SDF give a body the same mass properties and say nothing else."""
    here, there = _read(found), _read(expected)
    return (
        here is not None
        and there is not None
        and same_numbers(here.mass, there.mass)
        and same_numbers(here.centre, there.centre)
        and same_tensor(here.inertia, there.inertia)
    )


def same_tensor(found: NDArray[np.float64], expected: NDArray[np.float64], relative: float = 1e-9) -> bool:
    """Whether two tensors [kg m^2], shape (3, 3), differ by less than `relative` of their size."""
    return bool(np.linalg.norm(found - expected) <= relative * np.linalg.norm(expected))


def _read(element: ET.Element) -> _Inertial | None:
    """Mass properties where `element` is written as we write it; None for anything else."""
    try:
        if set(element.attrib) == {"pos", "quat", "mass", "diaginertia"} and not len(element):
            return _mjcf(element)
        layout = {child.tag: child for child in element}
        if element.attrib or len(layout) != len(element):
            return None
        if set(layout) == {"origin", "mass", "inertia"}:
            return _urdf(layout)
        return _sdf(layout) if set(layout) == {"pose", "mass", "inertia"} else None
    except (ExportError, SpecError):
        return None


def _mjcf(element: ET.Element) -> _Inertial:
    moments = np.diag(numbers(element.get("diaginertia"), 3, "diaginertia"))
    turn = Pose(quat_wxyz=tuple(numbers(element.get("quat"), 4, "quat")))  # type: ignore[arg-type]
    return _Inertial(
        mass=float(numbers(element.get("mass"), 1, "mass")[0]),
        centre=numbers(element.get("pos"), 3, "pos"),
        inertia=in_body_axes(moments, turn.rotation),
    )


def _urdf(layout: dict[str, ET.Element]) -> _Inertial | None:
    origin, mass, inertia = layout["origin"], layout["mass"], layout["inertia"]
    if set(origin.attrib) != {"xyz", "rpy"} or set(mass.attrib) != {"value"} or set(inertia.attrib) != set(_PRODUCTS):
        return None
    moments = tensor(*(float(numbers(inertia.get(key), 1, key)[0]) for key in _PRODUCTS))
    return _Inertial(
        mass=float(numbers(mass.get("value"), 1, "mass")[0]),
        centre=numbers(origin.get("xyz"), 3, "xyz"),
        inertia=in_body_axes(moments, rotation_of(*numbers(origin.get("rpy"), 3, "rpy"))),
    )


def _sdf(layout: dict[str, ET.Element]) -> _Inertial | None:
    pose, mass, inertia = layout["pose"], layout["mass"], layout["inertia"]
    parts = {child.tag: child for child in inertia}
    bare = not (mass.attrib or inertia.attrib or any(child.attrib for child in inertia))
    if pose.attrib != {"rotation_format": "quat_xyzw"} or not bare or sorted(parts) != sorted(_PRODUCTS):
        return None
    x, y, z, *turn = numbers(pose.text, 7, "pose")
    moments = tensor(*(float(numbers(parts[key].text, 1, key)[0]) for key in _PRODUCTS))
    rotation = Pose(quat_wxyz=(turn[3], turn[0], turn[1], turn[2])).rotation
    return _Inertial(
        mass=float(numbers(mass.text, 1, "mass")[0]),
        centre=np.array([x, y, z]),
        inertia=in_body_axes(moments, rotation),
    )
