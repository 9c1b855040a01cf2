"""What a task is to bring about beside something must not be so yet in the layout: the mug left of the plate."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from pat3d.errors import LayoutError
from pat3d.generation.request import derived_seed
from pat3d.layout.lateral import Seen, related
from pat3d.scene.arrangements import Arrangement
from pat3d.scene.model import Relation, Scene, parent_of
from pat3d.scene.relations import RELATION_WORDS
from pat3d.scene.task_spec import steps_of

TRIES = 8
"""Layouts that are drawn at most until none of it is so; of three drawn by chance, about two leave a side free."""

Step = tuple[str, str, str]
"""What is moved, the relation that is wanted, and the landmark."""


Placed = tuple[Scene, tuple[str, ...]]
"""A scene as it is laid out, and the layout's notes."""


def with_task_to_do(
    place: Callable[[int, tuple[Arrangement, ...]], Placed],
    seed: int,
    task: str | None,
    relations: tuple[Relation, ...],
) -> Placed:
    """The first scene of seeds drawn from `seed` in which nothing is yet where `task` is to put it.

    Where there is none, the last one is without its task, and a note says why.

    Args:
        place: makes the scene of a seed, by wishes that are no arrangements of the scene.
        seed: the first to be tried.
        task: see pat3d.scene.task_spec.
        relations: the scene tree, which says what stands on one surface.

    Raises:
        LayoutError: nothing can be laid out.
    """
    asked = beside_steps(task)
    wishes = _apart(asked, relations)

    def placed(number: int) -> Placed:
        own = derived_seed(seed, "not yet", number) if number else seed
        try:
            return place(own, wishes)
        except LayoutError:
            if not wishes:
                raise
        return place(own, ())

    scene, notes = placed(0)
    for number in range(1, TRIES):
        if not done_already(scene, asked):
            return scene, notes
        scene, notes = placed(number)
    if not (done := done_already(scene, asked)):
        return scene, notes
    told = ", ".join(f'"{moved}" {RELATION_WORDS[kind]} "{landmark}"' for moved, kind, landmark in done)
    return replace(scene, task=None), (*notes, f"the task is left out: every layout tried has {told} already.")


def beside_steps(task: str | None) -> tuple[Step, ...]:
    """The steps of `task` that put something beside what no earlier step moves."""
    told = steps_of(task) if task is not None else []
    found = ((at, step) for at, step in enumerate(told) if step[0] == "beside" and len(step) == 4)
    return tuple((step[1], step[2], step[3]) for at, step in found if step[3] not in [one[1] for one in told[:at]])


def _apart(steps: Sequence[Step], relations: tuple[Relation, ...]) -> tuple[Arrangement, ...]:
    """What a layout is asked for so that nothing is next to its landmark yet; things on one surface are, by chance."""
    return tuple(
        Arrangement(kind="far_from", objects=(moved,), of=(landmark,))
        for moved, relation, landmark in steps
        if relation == "next_to" and parent_of(moved, relations) == parent_of(landmark, relations)
    )


def done_already(scene: Scene, steps: Sequence[Step]) -> list[Step]:
    """The `steps` that nobody has to do in `scene`."""
    return [step for step in steps if related(step[1], _seen(scene, step[0]), _seen(scene, step[2]))]


def _seen(scene: Scene, name: str) -> Seen:
    obj = scene[name]
    points = obj.pose.apply(np.concatenate([part.vertices for part in obj.asset.parts]))
    return Seen.of(points, obj.pose.apply(np.array([obj.asset.mass_properties.centre_of_mass]))[0])
