"""Grasps by a hand that comes from the side, for what cannot be taken from above."""

from __future__ import annotations

import math

from pat3d.envs.grasping.grasp import Grasp, apart, search
from pat3d.envs.robots.robot import Gripper
from pat3d.scene.model import Scene

LEANS = (math.radians(40.0), math.radians(70.0))
"""Angles of the approach from straight down [rad]."""

HEADINGS = tuple(math.radians(angle) for angle in range(0, 360, 45))
"""Directions from which the hand comes [rad], about z from +x."""

LEANING_ANGLES = 4
"""Directions of closing that are tried over half a turn."""

LEANING_BITE = 0.02
"""Least extent of the object between the pads [m]: what is held from the side hangs."""

LEANING_PAYLOAD = 1.0
"""Heavier objects [kg] turn in a hand that took them from the side."""

LEANING_HOVER = 0.16
"""The hand comes down beside the object this far before its grasp [m]."""

LEANING_MARGIN = 0.2
"""Least distance of every joint from its limits [rad]: the arm is led by its hand and would run into them."""

WRIST = (0.1, 0.16)
"""Distance of the arm's last joints from the fingertips, and their width [m]."""


def find_leaning_grasps(scene: Scene, name: str, gripper: Gripper, *, count: int = 12) -> list[Grasp]:
    """Grasps of object `name` by a hand that comes from the side, where it gets by everything else, best first.

    Args:
        scene: objects at rest.
        name: of the object.
        gripper: what it can take.
        count: of grasps.
    """
    found: list[Grasp] = []
    for lean in LEANS:
        for heading in HEADINGS:
            found += search(scene, name, gripper, lean=lean, heading=heading, angles=LEANING_ANGLES, wrist=WRIST)
    found = [one for one in found if one.bite >= LEANING_BITE]
    return apart(sorted(found, key=lambda grasp: -grasp.score), count)
