"""The rule on joints: their two sides are together at the start."""

from __future__ import annotations

from typing import Any

import numpy as np

from pat3d.check.usd_lint.file import Faults, LintFile
from pat3d.exporters.usd.openusd import UsdPhysics
from pat3d.exporters.usd.stage import matrix, quaternion, transformed, value, without_scale
from pat3d.geometry.pose import Pose

JOINT_GAP = 1e-4
"""[m], by which the two sides of a joint may be apart at the start."""

JOINT_TURN = 1e-3
"""[rad], by which the two sides of a hinge or weld may be turned at the start."""

_HINGES = {"PhysicsRevoluteJoint", "PhysicsFixedJoint"}
_POINTS = {"PhysicsSphericalJoint", *_HINGES}


def joint(file: LintFile) -> Faults:
    """Joints whose sides are apart or turned against one another, or that join what is not there."""
    for prim in file.stage.Traverse():
        if not prim.IsA(UsdPhysics.Joint):
            continue
        api, sides = UsdPhysics.Joint(prim), []
        for ends, position, rotation in (
            (api.GetBody0Rel(), api.GetLocalPos0Attr(), api.GetLocalRot0Attr()),
            (api.GetBody1Rel(), api.GetLocalPos1Attr(), api.GetLocalRot1Attr()),
        ):
            targets = ends.GetTargets()
            end = file.stage.GetPrimAtPath(targets[0]) if targets else file.stage.GetPseudoRoot()
            if not end:
                yield prim, f"{ends.GetName()} names {targets[0]}, which is not in the file."
                break
            place = matrix(end, file.cache) if targets else np.eye(4)
            local = Pose(quat_wxyz=_unit(rotation)).rotation
            axes = without_scale(place)[0][:3, :3] @ local
            point = np.array(value(position, (0.0, 0.0, 0.0)), dtype=np.float64)
            sides.append((transformed(point[None], place)[0], axes))
        if len(sides) < 2:
            continue
        gap = float(np.linalg.norm(sides[0][0] - sides[1][0]))
        if not gap <= JOINT_GAP and prim.GetTypeName() in _POINTS:
            yield prim, f"its two sides are {1e3 * gap:.3g} mm apart and snap together at the start."
        if prim.GetTypeName() in _HINGES:
            turn = float(np.linalg.norm(sides[0][1] - sides[1][1]) / np.sqrt(2.0))
            if not turn <= JOINT_TURN:
                yield prim, f"its two sides are turned by {turn:.3g} rad and snap together at the start."


def _unit(attribute: Any) -> Any:
    """The rotation in a quaternion attribute as quat_wxyz; none where it holds no rotation."""
    quat = value(attribute, None)
    size = 0.0 if quat is None else np.linalg.norm(quaternion(quat))
    return tuple((quaternion(quat) / size).tolist()) if 0.0 < size < np.inf else (1.0, 0.0, 0.0, 0.0)
