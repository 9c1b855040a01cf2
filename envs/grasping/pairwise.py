"""Grasps of one object by two hands at once, far enough from one another for both."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import permutations

import numpy as np

from pat3d.envs.grasping.grasp import Grasp, find_grasps, torque
from pat3d.envs.robots.arms import make_robot, measure_gripper
from pat3d.errors import TaskError
from pat3d.scene.model import Scene

TRIED = 40
"""Grasps of each arm that are paired, at most."""

PAIRS_KEPT = 30
"""Pairs, at most."""

ALONG, ACROSS = 0.11, 0.045
"""Half extents of a hand along the direction in which its fingers close, and across it [m]."""

CLEAR = 0.015
"""Between the hands [m]."""

EVEN = 2.0
"""Worth of a pair whose middle is at the object's, for each metre that it is not [1/m]; apart counts 1 a metre."""

FIRM = math.cos(math.radians(20.0))
"""Least cosine between the closing direction and the surfaces at which one hand holds something alone: what is round
and taken above its middle, or by an end that tapers, slips out."""

STEADY = 0.15
"""What is handed over may turn the fingers by this for each kilogram that the arm carries [N m/kg]."""


def paired_grasps(scene: Scene, name: str, arms: Sequence[str], *, wide: bool) -> list[tuple[Grasp, Grasp]]:
    """Grasps of the left and of the right arm that two hands can have together, best first.

    Args:
        scene: at rest.
        name: of the object.
        arms: names of the left and the right one.
        wide: those far from one another first, by which two hands carry it; otherwise those near its middle, by either
            of which one hand holds it steadily.

    Raises:
        TaskError: it is too heavy, or no two places to take it are far enough from one another.
    """
    mass = scene[name].asset.mass_properties.mass
    payload = sum(make_robot(arm).payload for arm in arms)
    if mass > payload:
        raise TaskError(f'"{name}" weighs {mass:.1f} kg, two arms carry {payload:.1f} kg.')
    known = {arm: find_grasps(scene, name, measure_gripper(arm), count=TRIED) for arm in set(arms)}
    centre = scene[name].pose.apply(np.array([scene[name].asset.mass_properties.centre_of_mass]))[0]
    if not wide:
        known = {arm: _steady(arm, grasps, name, mass, centre) for arm, grasps in known.items()}
    found = []
    pairs = permutations(known[arms[0]], 2) if arms[0] == arms[1] else None
    for left, right in pairs or ((a, b) for a in known[arms[0]] for b in known[arms[1]]):
        apart = np.subtract(right.position, left.position)
        if float(np.hypot(*apart[:2])) >= _needed(left, apart) + _needed(right, apart) + CLEAR:
            aside = [np.subtract(one.position, centre)[:2] for one in (left, right)]
            if wide:
                worth = float(np.hypot(*apart[:2])) - EVEN * float(np.linalg.norm(np.mean(aside, axis=0)))
            else:
                worth = -float(np.sum(np.square(aside)))
            found.append((worth, left, right))
    if not found:
        places = "places" if wide else "places at which one hand holds it firmly and"
        raise TaskError(f'"{name}" offers no two {places} that are far enough from one another for two hands.')
    found.sort(key=lambda one: -one[0])
    return [(left, right) for _, left, right in found[:PAIRS_KEPT]]


def _steady(arm: str, grasps: Sequence[Grasp], name: str, mass: float, centre: np.ndarray) -> list[Grasp]:
    """Those by which one hand holds it alone, without it turning far in the fingers or slipping out of them."""
    most = STEADY * make_robot(arm).payload
    steady = [one for one in grasps if torque(one, mass, centre) <= most and one.facing >= FIRM]
    if grasps and not steady:
        raise TaskError(
            f'"{name}" ({mass:.1f} kg) cannot be handed over: it would turn in the fingers of {arm} or slip out.'
        )
    return steady


def _needed(grasp: Grasp, towards: np.ndarray) -> float:
    """From the middle of a hand to where it ends in a direction [m]."""
    angle = math.atan2(towards[1], towards[0]) - grasp.closing
    return ALONG * abs(math.cos(angle)) + ACROSS * abs(math.sin(angle))
