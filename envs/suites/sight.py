"""How much of a picture the objects of a task cover at the start, and that it is enough."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from pat3d.scene.model import Scene

if TYPE_CHECKING:
    from pat3d.envs.rendering.pictures import Pictures
    from pat3d.envs.tasks.rehearsal import Workplace
    from pat3d.envs.tasks.task import Task

SIDE = 128
"""Of the pictures in which objects are looked for [pixel]."""

AGENT = "agentview"
"""The camera in whose picture objects have to be seen."""


LEAST = 0.5
"""Share of that picture [%] that every object of a task covers in a suite, unless it asks for another."""

DIGITS = 3
"""After the point, of shares that are written down [%]."""


class UnseenError(Exception):
    """An object of the task covers too little of the picture."""


def shares(pictures: Pictures, scene: Scene, camera: str, names: Iterable[str]) -> dict[str, float]:
    """Share of a camera's picture that each of the objects covers now, in [0, 1]."""
    picture = pictures.take(camera, SIDE, SIDE, segmentation=True).segmentation
    numbers = {obj.name: number for number, obj in enumerate(scene.objects)}
    return {name: float((picture == numbers[name] + 2).mean()) for name in names}


def about(task: Task, scene: Scene) -> tuple[str, ...]:
    """Objects that a task moves or names, what is moved first."""
    return tuple(dict.fromkeys((*task.needs(scene).grasp, *task.names)))


def require_seen(work: Workplace, percent: float) -> dict[str, float]:
    """How much of the agent's picture every object of the task covers [%], which is `percent` at least.

    Rays decide, as they are the same wherever a suite is made; what is behind something else, or the robot, counts not.

    Raises:
        UnseenError: one of them covers less; says which and how much.
    """
    from pat3d.envs.rendering.pictures import Pictures

    pictures = Pictures(work.simulation, "cpu")
    try:
        seen = shares(pictures, work.scene, AGENT, about(work.task, work.scene))
    finally:
        pictures.close()
    if not seen:
        return {}
    name = min(seen, key=lambda one: seen[one])
    if 100.0 * seen[name] < percent:
        raise UnseenError(f'"{name}" covers {100.0 * seen[name]:.2f} % of the picture at the start, not {percent:g} %.')
    return {one: round(100.0 * share, DIGITS) for one, share in seen.items()}
