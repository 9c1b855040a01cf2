"""What a cloned policy sees of a state observation, from everything to next to nothing.

    task      the hand, the object to take and where it goes: what the task needs, told by the environment
    objects   the hand and all objects, but not which of them is meant: no language
    words     the hand and the words of the instruction: no picture, no pose of any object
    robot     the hand and the time alone

What a policy does with less than "task" shows what a suite gives away.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import EvaluationError
from pat3d.geometry.rotations import matrix_of
from pat3d.policies_eval.policies.cloning_features import FEATURES, features

Array = NDArray[np.float32]

KINDS = ("task", "objects", "words", "robot")

CLOCK = tuple(range(0, 400, 40))
"""Steps at which the humps stand that tell the time."""

_HAND = 11
"""Position, two axes and two fingers of the hand; a finger is of as many values as a gripper has, at most two."""

_ROW = 13
"""Of an object: whether it is there, its place, its place seen from the hand, two of its axes."""

MAX_WORDS, MAX_ROWS, LONGEST_WORD = 2_000, 200, 40


@dataclass(frozen=True, kw_only=True)
class Inputs:
    """What of an observation goes into a network."""

    kind: str = "task"
    """One of KINDS."""
    vocabulary: tuple[str, ...] = ()
    """Words that are known, of "words" alone."""
    rows: int = 0
    """Objects at most, of "objects" alone."""

    def __post_init__(self) -> None:
        good = (
            self.kind in KINDS
            and 0 <= self.rows <= MAX_ROWS
            and len(self.vocabulary) <= MAX_WORDS
            and all(isinstance(word, str) and len(word) <= LONGEST_WORD for word in self.vocabulary)
        )
        if not good:
            raise EvaluationError(f'inputs that are none: "{self.kind}". Inputs: {", ".join(KINDS)}.')

    @staticmethod
    def of(kind: str, instructions: Iterable[str], rows: int) -> Inputs:
        """Those of a kind for demonstrations with these instructions and scenes of at most so many objects."""
        if kind == "words":
            return Inputs(kind=kind, vocabulary=tuple(sorted({word for one in instructions for word in words_of(one)})))
        return Inputs(kind=kind, rows=rows if kind == "objects" else 0)

    @property
    def size(self) -> int:
        """Of what `see` returns."""
        if self.kind == "task":
            return FEATURES
        return _HAND + len(CLOCK) + len(self.vocabulary) + _ROW * self.rows

    def see(self, observation: Mapping[str, Any], instruction: str, step: int) -> Array:
        """What the network gets, shape (size,).

        Args:
            observation: of the state of one arm.
            instruction: of the episode.
            step: number of the action, from 0.

        Raises:
            EvaluationError: not such an observation.
        """
        if self.kind == "task":
            return features(observation)
        parts = [_hand(observation), _clock(step)]
        if self.kind == "words":
            said = set(words_of(instruction))
            parts.append(np.array([word in said for word in self.vocabulary], dtype=np.float64))
        elif self.kind == "objects":
            parts.append(self._objects(observation))
        return np.concatenate(parts).astype(np.float32)

    def to_json(self) -> dict[str, Any]:
        """As plain JSON data."""
        return {"kind": self.kind, "vocabulary": list(self.vocabulary), "rows": self.rows}

    @staticmethod
    def from_json(data: Any) -> Inputs:
        """From what `to_json` gave; of checkpoints that say nothing, "task".

        Raises:
            EvaluationError: it is something else.
        """
        if data is None:
            return Inputs()
        try:
            return Inputs(kind=data["kind"], vocabulary=tuple(data["vocabulary"]), rows=int(data["rows"]))
        except (KeyError, TypeError, ValueError) as error:
            raise EvaluationError(f"inputs that are none: {error}") from error

    def _objects(self, observation: Mapping[str, Any]) -> NDArray[np.float64]:
        """Of every row of "objects", zero where there is none."""
        poses = np.asarray(observation["objects"], dtype=np.float64)[: self.rows]
        hand = np.asarray(observation["eef_pos"], dtype=np.float64)
        found = np.zeros((self.rows, _ROW))
        for number, pose in enumerate(poses):
            if np.any(pose[3:]):
                axes = matrix_of(pose[3:])[:, :2].ravel()
                found[number] = [1.0, *pose[:3], *(pose[:3] - hand), *axes]
        return found.ravel()


def words_of(instruction: str) -> list[str]:
    """The words of an instruction."""
    return [word[:LONGEST_WORD] for word in re.findall(r"[a-z]+", instruction.lower())]


def _hand(observation: Mapping[str, Any]) -> NDArray[np.float64]:
    if "left_eef_pos" in observation:
        raise EvaluationError("a cloned policy moves one arm; here are two.")
    try:
        fingers = np.zeros(2)
        opening = np.asarray(observation["gripper_pos"], dtype=np.float64)[:2]
        fingers[: len(opening)] = opening
        axes = matrix_of(observation["eef_quat"])[:, :2].ravel()
        place = np.asarray(observation["eef_pos"], dtype=np.float64)
        return np.concatenate([place, axes, fingers])
    except KeyError as error:
        raise EvaluationError(f"a cloned policy needs state observations; {error} is missing.") from None


def _clock(step: int) -> NDArray[np.float64]:
    """The time as humps, so that a network can tell one moment from another; all flat after the last."""
    width = CLOCK[1] - CLOCK[0]
    return np.maximum(0.0, 1.0 - np.abs(np.array(CLOCK) - step) / width)
