"""Grasps of one object by two hands at once, far enough from one another for both."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product

import numpy as np

from pat3d.envs.grasping.grasp import Grasp, find_grasps, torque
from pat3d.envs.robots.arms import make_robot, measure_gripper
from pat3d.errors import TaskError
from pat3d.scene.model import Scene

TRIED = 40
"""Grasps of each arm that are paired, at most."""

PAIRS_KEPT = 30
"""Pairs, at most."""

BESIDE = 0.006
"""Kept beside a hand along the direction in which its fingers close [m]."""

ACROSS = 0.035
"""Half extent of a hand across that direction [m], on the side without its camera."""

CLEAR = 0.01
"""Between the hands [m]."""

EVEN = 2.0
"""Worth of a pair whose middle is at the object's, for each metre that it is not [1/m]; apart counts 1 a metre."""

FIRM = math.cos(math.radians(20.0))
"""Least cosine between the closing direction and the surfaces at which one hand holds something alone: what is round
and taken above its middle, or by an end that tapers, slips out."""

STEADY, HANGING = 0.15, 0.5
"""By how much what is handed over may turn the fingers of the hand that offers it, and of the one that takes it, for
each kilogram that the arm carries [N m/kg]: what is offered stays level."""

LEVEL = 2.0
"""What the offering hand's distance from the middle counts, squared, where the taking one's counts 1."""


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
    found_by = {arm: find_grasps(scene, name, measure_gripper(arm), count=TRIED) for arm in set(arms)}
    lefts, rights = (found_by[arm] for arm in arms)
    centre = scene[name].pose.apply(np.array([scene[name].asset.mass_properties.centre_of_mass]))[0].tolist()
    if not wide:
        lefts = _firm(arms[0], lefts, name, mass, centre, STEADY)
        rights = _firm(arms[1], rights, name, mass, centre, HANGING)
    found = []
    for left, right in product(lefts, rights):
        apart = np.subtract(right.position, left.position)
        if float(np.hypot(*apart[:2])) >= sum(map(_needed, arms, (left, right), (apart, apart))) + CLEAR:
            aside = [np.subtract(one.position, centre)[:2] for one in (left, right)]
            if wide:
                worth = float(np.hypot(*apart[:2])) - EVEN * float(np.linalg.norm(np.mean(aside, axis=0)))
            else:
                worth = -float(LEVEL * aside[0] @ aside[0] + aside[1] @ aside[1])
            found.append((worth, left, right))
    if not found:
        places = "places" if wide else "places at which one hand holds it firmly and"
        raise TaskError(f'"{name}" offers no two {places} that are far enough from one another for two hands.')
    found.sort(key=lambda one: -one[0])
    return [(left, right) for _, left, right in found[:PAIRS_KEPT]]


def _firm(
    arm: str, grasps: Sequence[Grasp], name: str, mass: float, centre: Sequence[float], most: float
) -> list[Grasp]:
    """Those by which one hand holds it alone, without it turning far in the fingers or slipping out of them."""
    most = most * make_robot(arm).payload
    firm = [one for one in grasps if torque(one, mass, centre) <= most and one.facing >= FIRM]
    if grasps and not firm:
        raise TaskError(
            f'"{name}" ({mass:.1f} kg) cannot be handed over: it would turn in the fingers of {arm} or slip out.'
        )
    return firm


def _needed(arm: str, grasp: Grasp, towards: np.ndarray) -> float:
    """From the middle of a hand to where it ends in a direction [m]."""
    angle = math.atan2(towards[1], towards[0]) - grasp.closing
    along = measure_gripper(arm).hand[0] / 2 + BESIDE
    return along * abs(math.cos(angle)) + ACROSS * abs(math.sin(angle))
