"""Sampled tabletop compositions: objects, what carries them, the sentence that says so, and the task they are for.

A composition is a core, which the task needs, a side group beside it, and loose objects up to the number asked for.
Core and side group together are the composition's structure. Some structures, and some nouns of moved objects, occur in
no training scene: they are what validation and testing by layout and by object are about.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from pat3d.envs.suites.composer import Composer, ExhaustedError
from pat3d.envs.suites.fixtures import fixtures
from pat3d.envs.suites.pools import partition
from pat3d.envs.suites.request import MAX_OBJECTS, Request
from pat3d.envs.suites.structures import CORES, NEXT, SIDES, TO_A_SIDE, Core
from pat3d.envs.tasks.beside import Beside, drawn_beside
from pat3d.envs.tasks.goals import Rearrange, rearranged
from pat3d.envs.tasks.push import Push, drawn_neighbour, drawn_push, drawn_shift
from pat3d.envs.tasks.task import split
from pat3d.generation.request import derived_seed
from pat3d.plan.scene_plan import ScenePlan
from pat3d.scene.model import Scene

SILHOUETTE = 0.0026
"""Width times height of what covers a percent of the agent's picture, roughly [m^2]: smaller things are hardly ever
accepted where so much has to be visible, so they are not tried."""

_DRAWS = 200
"""Of nouns and colours for one composition; most need one."""


@dataclass(frozen=True, kw_only=True)
class Draft:
    """A scene before anything of it is made."""

    plan: ScenePlan
    task: str
    """As `parse_task` reads it, but for points and distances, see `pointed`."""
    structure: str
    """Core and side group."""
    moved: tuple[str, ...]
    """Names of the objects that the task is to move."""
    places: tuple[str, ...]
    """Names of what they are moved from or to, apart from the ground."""
    scene_seed: int


def draft(request: Request, place: int, candidate: int) -> Draft:
    """The `candidate`-th composition for a place of the suite, both from 0; the same arguments give the same one."""
    seed = derived_seed(request.seed, "suite", place, candidate)
    kind, own = request.task_of(place), request.split_of(place)
    part, _, held_out = own.partition("/")
    structures = structure_splits(request, kind)["train" if held_out == "object" else part]
    nouns, level = partition(request.seed), request.clutter_of(place)
    if level is not None:
        structures = [one for one in structures if one[1].size + request.alike <= level] or structures
    for draw in range(_DRAWS):
        rng = np.random.default_rng([seed, draw])
        core, side = structures[int(rng.integers(len(structures)))]
        shown = part if held_out == "object" else "train"
        composer = Composer(rng, moved=nouns[shown], others=nouns["train"], fixtures=fixtures(request.seed)[shown])
        try:
            composer.least_silhouette = SILHOUETTE * request.visible
            if request.alike:
                composer.size_words(kind)
            task = core.build(composer)
            side.build(composer)
            composer.lookalikes(request.alike)
            least = core.size + side.size + request.alike
            if level is None:
                least = max(request.objects[0], least)
                composer.fill(int(rng.integers(least, request.objects[1] + 1)))
            else:
                composer.fill(max(core.size + level, least))
        except ExhaustedError:
            continue
        return Draft(
            plan=composer.plan(),
            task=task,
            structure=_name(core, side),
            moved=tuple(composer.moved),
            places=tuple(composer.places),
            scene_seed=derived_seed(seed, "scene"),
        )
    raise RuntimeError(f"no composition for place {place} of {request}")


DRAWS = {Rearrange.kind: 1, Push.kind: 6, Beside.kind: 6}
"""Goals that are drawn for a scene, one after the other, until the robot can do one, by kind of task."""


def pointed(made: Draft, scene: Scene, number: int = 0) -> Draft:
    """The draft with the points, the distance or the side to which its objects go drawn where its scene has room.

    Args:
        made: a draft.
        scene: made of it.
        number: of the draw.

    Raises:
        TaskError: it leaves none.
    """
    kind, names = split(made.task)
    random = np.random.default_rng(derived_seed(made.scene_seed, "points", *([number] if number else [])))
    if kind == Rearrange.kind:
        return replace(made, task=rearranged(scene, names, random).spec)
    if kind == Push.kind:
        drawn = next((how for end, how in _PUSHES.items() if made.task.endswith(end)), drawn_push)
        return replace(made, task=drawn(scene, names[0], random).spec)
    if kind == Beside.kind:
        return replace(made, task=drawn_beside(scene, names[0], names[1], random).spec)
    return made


_PUSHES = {TO_A_SIDE: drawn_shift, NEXT: drawn_neighbour}


def structure_splits(request: Request, kind: str) -> dict[str, list[tuple[Core, Core]]]:
    """The structures of a task, dealt to "train", "val" and "test"; a tenth and at least one to each of the last."""
    most = MAX_OBJECTS if request.clutter else request.objects[1]
    cores = [core for core in CORES[kind] if core.steps == 1 or not request.steps or core.steps in request.steps]
    known = [(core, side) for core in cores for side in SIDES if core.size + side.size + request.alike <= most]
    order = np.random.default_rng([request.seed, *f"structures {kind}".encode()]).permutation(len(known))
    few = max(1, round(len(known) / 10))
    dealt = [known[place] for place in order]
    return {"val": dealt[:few], "test": dealt[few : 2 * few], "train": dealt[2 * few :]}


def structure_names(request: Request, kind: str) -> dict[str, list[str]]:
    """`structure_splits` in words."""
    return {
        part: sorted(_name(core, side) for core, side in found)
        for part, found in structure_splits(request, kind).items()
    }


def _name(core: Core, side: Core) -> str:
    return f"{core.name} + {side.name}"
