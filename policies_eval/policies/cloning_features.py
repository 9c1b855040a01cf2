"""What a cloned policy sees of an object, a hand and a goal.

It is written in the frames that matter for a grasp: the hand relative to the object, in the object's frame and in the
world's, so that a few dozen demonstrations are enough for new places of the object.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import EvaluationError
from pat3d.geometry.rotations import matrix_of

FEATURES = 33


def features(observation: Mapping[str, Any]) -> NDArray[np.float32]:
    """What the network sees of a state observation, shape (FEATURES,).

    Raises:
        EvaluationError: not a state observation, or one of two arms.
    """
    missing = {"eef_pos", "eef_quat", "gripper_pos", "target"} - observation.keys()
    if "left_eef_pos" in observation:
        raise EvaluationError("a cloned policy moves one arm; here are two.")
    if missing:
        raise EvaluationError(f'a cloned policy needs obs="state"; {", ".join(sorted(missing))} are missing.')
    target = np.asarray(observation["target"], dtype=np.float64)
    hand = np.asarray(observation["eef_pos"], dtype=np.float64)
    hand_rotation, rotation = matrix_of(observation["eef_quat"]), matrix_of(target[3:7])
    away, goal = target[:3] - hand, target[7:10] - target[:3]
    fingers = np.asarray(observation["gripper_pos"], dtype=np.float64)[:2]
    return np.concatenate(
        [
            away,
            rotation.T @ away,
            hand_rotation.T @ away,
            goal,
            [hand[2]],
            fingers,
            hand_rotation[:, :2].ravel(),
            (rotation.T @ hand_rotation)[:, :2].ravel(),
            rotation[:, :2].ravel(),
        ]
    ).astype(np.float32)
