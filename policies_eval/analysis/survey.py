"""What the scenes of a suite are like before anybody acts: what is in view, what words mean, what there is to do."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from pat3d.envs.suites.suite import Entry, Suite

VIEWS = ("agentview", "closeview")
"""Cameras in which an object may be in view."""


@dataclass(frozen=True, kw_only=True)
class Surveyed:
    """One scene of a suite at its start."""

    place: int
    split: str
    kind: str
    instruction: str
    wordings: int
    """Ways in which the instruction is said."""
    ambiguous: tuple[str, ...]
    """Objects of the task that no words mean alone."""
    seen: dict[str, dict[str, float]]
    """Share of every camera's picture that an object of the task covers, by camera and object."""
    nouns: tuple[str, ...]
    """Of the objects that are moved."""
    sources: tuple[str, ...]
    """Where those are: "ground", "in" or "on" something."""
    grasps: tuple[str, ...]
    """How they are best taken: "from above", "from the side", or "leaning"."""
    reach: tuple[float, ...]
    """How far from the robot's base they are [m]."""

    def to_json(self) -> dict[str, Any]:
        """As plain JSON data."""
        return asdict(self)

    @staticmethod
    def from_json(data: dict[str, Any]) -> Surveyed:
        """From what `to_json` gave."""
        kept: dict[str, Any] = {
            name: tuple(value) if isinstance(value, list) else value for name, value in data.items()
        }
        return Surveyed(**kept)

    def least_seen(self, camera: str) -> float:
        """Of the objects of the task, the share that the smallest one covers."""
        return min(self.seen[camera].values(), default=0.0)


def spread(entries: Sequence[Entry], count: int) -> tuple[Entry, ...]:
    """`count` of the scenes, evenly over the suite; all where there are no more."""
    if count >= len(entries):
        return tuple(entries)
    return tuple(entries[number * len(entries) // count] for number in range(count))


def survey(
    suite: Suite, entries: Sequence[Entry], tell: Callable[[int, int], None] = lambda done, of: None
) -> tuple[Surveyed, ...]:
    """Look at scenes of a suite.

    Raises:
        UnsettledSceneError: a scene is not as it was verified.
    """
    found = []
    for number, entry in enumerate(entries):
        found.append(look(suite, entry))
        tell(number + 1, len(entries))
    return tuple(found)


def look(suite: Suite, entry: Entry) -> Surveyed:
    """Look at one scene, in the room that it is in."""
    from pat3d.envs.env import TabletopEnv
    from pat3d.envs.suites.sight import about, shares
    from pat3d.envs.tasks.naming import called
    from pat3d.scene.model import GROUND

    suite.verify(entry)
    env = TabletopEnv(
        scene=suite.folder.scene(entry.place),
        task=entry.task,
        robot=suite.request.robot,
        room=entry.room,
        max_objects=None,
    )
    try:
        env.reset(seed=0)
        scene = env.scene
        needs = env.task.needs(scene)
        moved = (*needs.grasp, *needs.push)
        named = about(env.task, scene)
        kinds = {rel.child: rel.kind for rel in scene.relations if rel.supports}
        seen = {camera: shares(env.pictures, scene, camera, named) for camera in VIEWS}
        best = [env.placement.grasps[name][0] for name in needs.grasp]
        return Surveyed(
            place=entry.place,
            split=entry.split,
            kind=entry.kind,
            instruction=env.instruction,
            wordings=len(env.task.wordings(scene)),
            ambiguous=tuple(name for name in named if called(scene, name) is None),
            seen=seen,
            nouns=tuple(scene[name].asset.noun for name in moved),
            sources=tuple("ground" if scene.parent(name) == GROUND else kinds.get(name, "on") for name in moved),
            grasps=tuple(_way(grasp.lean) for grasp in best),
            reach=tuple(round(float(env.placement.reach.get(name, 0.0)), 4) for name in moved),
        )
    finally:
        env.close()


def coverage(surveyed: Sequence[Surveyed]) -> dict[str, dict[str, int]]:
    """How often there is what: kinds of tasks, nouns, sources, grasps, and distances in steps of 10 cm."""
    counted: dict[str, Counter[str]] = {
        "task": Counter(one.kind for one in surveyed),
        "noun": Counter(noun for one in surveyed for noun in one.nouns),
        "from": Counter(source for one in surveyed for source in one.sources),
        "grasp": Counter(grasp for one in surveyed for grasp in one.grasps),
        "distance": Counter(f"{int(10 * reach) / 10:.1f} m" for one in surveyed for reach in one.reach),
    }
    return {
        name: dict(sorted(counts.items(), key=lambda item: (-item[1], item[0]))) for name, counts in counted.items()
    }


def _way(lean: float) -> str:
    """Of a grasp that leans by so much [rad]."""
    return "from above" if not lean else "from the side" if lean > 1.2 else "leaning"
