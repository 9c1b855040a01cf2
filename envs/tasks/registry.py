"""From "pick:red mug" to a task, and the tasks that a scene allows."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from typing import Any

from pat3d.envs.tasks.arrange import Retrieve, Sort, Unload
from pat3d.envs.tasks.beside import Beside
from pat3d.envs.tasks.chain import Chain
from pat3d.envs.tasks.goals import Rearrange, rearrangement
from pat3d.envs.tasks.manipulate import Lift, Pick, Place, Stack
from pat3d.envs.tasks.opening import Close, Open
from pat3d.envs.tasks.push import Push, push_task
from pat3d.envs.tasks.task import Task, split
from pat3d.envs.tasks.together import Carry, HandOver
from pat3d.errors import TaskError
from pat3d.scene.model import Scene
from pat3d.scene.task_spec import AND_THEN

TASKS: dict[str, type[Task]] = {
    kind.kind: kind
    for kind in (
        Pick,
        Lift,
        Place,
        Stack,
        Sort,
        Unload,
        Retrieve,
        Chain,
        Rearrange,
        Push,
        Beside,
        Open,
        Close,
        Carry,
        HandOver,
    )
}
"""Every kind of task by the first word of its specification."""


def parse_task(spec: str) -> Task:
    """The task that `spec` describes: "pick:red mug", "place:green apple:blue bowl", "sort".

    Raises:
        TaskError: an unknown kind or the wrong number of names; the message says what is valid.
    """
    kind, arguments = split(spec)
    if kind not in TASKS:
        raise TaskError(f'no task "{kind}". Tasks: {", ".join(task.form for task in TASKS.values())}.')
    if kind == Chain.kind:
        return Chain(steps=tuple(_step(text) for text in ":".join(arguments).split(AND_THEN)))
    if kind == Rearrange.kind:
        return rearrangement(arguments)
    if kind == Push.kind:
        return push_task(arguments)
    task: Any = TASKS[kind]
    names = [field.name for field in fields(task)]
    if len(arguments) != len(names) or not all(arguments):
        raise TaskError(f'"{spec}" does not fit "{task.form}".')
    return task(**dict(zip(names, arguments, strict=True)))


def _step(spec: str) -> Task:
    """One step of a chain."""
    if split(spec)[0] == Chain.kind:
        raise TaskError("a chain is no step of a chain.")
    return parse_task(spec)


def possible_tasks(scene: Scene) -> Iterator[Task]:
    """Every task that the scene's tree and sizes allow one arm, but for chains, rearrangements and `beside`."""
    names = [obj.name for obj in scene.objects]
    for kind in TASKS.values():
        if kind in (Chain, Rearrange, Beside, Carry, HandOver):
            continue
        count = len(fields(kind))
        combinations = (
            [()] if count == 0 else [(a,) for a in names] if count == 1 else [(a, b) for a in names for b in names]
        )
        for arguments in combinations:
            task = parse_task(":".join((kind.kind, *arguments)))
            try:
                task.check(scene)
            except TaskError:
                continue
            yield task
