"""Which scenes of a suite an environment goes through."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from pat3d.envs.physics.loading import LoadedScene
from pat3d.envs.suites.suite import Entry, Suite
from pat3d.errors import EnvironmentSetupError, SuiteError


class Selection:
    """Scenes of one split and kind of task; one of them is current."""

    def __init__(self, suite: Suite, entries: tuple[Entry, ...], only: int | None) -> None:
        self._suite, self._entries, self._only = suite, entries, only
        self.current = 0
        """Index of the scene in use, among those selected."""
        self._loaded: LoadedScene | None = None
        if only is not None:
            self._check(only)

    @staticmethod
    def of(
        suite: str | os.PathLike[str] | None, split: str | None, index: int | None, scene: Any, task: Any
    ) -> Selection | None:
        """The selection that an environment's arguments ask for; None where they name no suite.

        Raises:
            SuiteError: no such suite, split, kind of task or index.
            EnvironmentSetupError: the arguments contradict each other.
        """
        if suite is None:
            if split is not None or index is not None:
                raise EnvironmentSetupError("split and index are of a suite; give suite=FOLDER too.")
            return None
        if scene is not None:
            raise EnvironmentSetupError("give a scene or a suite, not both.")
        if task is not None and not isinstance(task, str):
            raise EnvironmentSetupError('the task of a suite is a kind of task such as "pick", or None for all.')
        found = Suite.open(suite)
        return Selection(found, found.select(split, task), index)

    @property
    def most_objects(self) -> int:
        """Objects of the suite's largest scene, so that all its splits share one observation space."""
        return self._suite.most_objects

    @property
    def count(self) -> int:
        """Of the scenes selected."""
        return len(self._entries)

    def take(self, index: int) -> tuple[LoadedScene, str]:
        """The scene of this index, and its task."""
        return self._take(self._check(index))

    def first(self) -> tuple[LoadedScene, str]:
        """The scene to begin with, and its task."""
        return self._take(self._only or 0)

    def next(self, random: np.random.Generator, index: Any) -> tuple[LoadedScene, str]:
        """The scene of `index`, the only one, or one drawn at random; and its task."""
        if index is not None:
            return self._take(self._check(index))
        return self._take(int(random.integers(len(self._entries))) if self._only is None else self._only)

    def _take(self, index: int) -> tuple[LoadedScene, str]:
        entry = self._entries[index]
        if self._loaded is None or index != self.current:
            self._loaded = self._suite.load(entry)
        self.current = index
        return self._loaded, entry.task

    def _check(self, index: Any) -> int:
        if isinstance(index, bool) or not isinstance(index, int | np.integer) or not 0 <= index < len(self._entries):
            raise SuiteError(f"index {index} of {len(self._entries)} scenes; valid are 0 to {len(self._entries) - 1}.")
        return int(index)
