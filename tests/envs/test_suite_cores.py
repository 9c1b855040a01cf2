"""The cores of a suite's compositions: what each moves, and from and to which things; processes that check a suite."""

from __future__ import annotations

import operator

import numpy as np
import pytest

from pat3d.envs.suites import check
from pat3d.envs.suites.composer import Composer, ExhaustedError
from pat3d.envs.suites.pools import partition
from pat3d.envs.suites.structures import CORES, Core
from pat3d.envs.tasks.registry import parse_task

KNOWN = [(kind, core) for kind, cores in CORES.items() for core in cores]


def named(spec: str) -> list[str]:
    """The kind of a task and the objects that it names; points and relations are drawn with the scene."""
    if spec.startswith(("rearrange:", "beside:")):
        return spec.split(":")
    if spec.startswith("push:"):
        return spec.split(":")[:2]
    task = parse_task(spec)
    return [task.kind, *task.names]


def built(core: Core, count: int = 8) -> list[tuple[Composer, list[str]]]:
    """Compositions of a core alone, with the words of their tasks."""
    nouns = partition(0)["train"]
    found = []
    for seed in range(10 * count):
        composer = Composer(np.random.default_rng(seed), moved=nouns, others=nouns)
        try:
            found.append((composer, named(core.build(composer))))
        except ExhaustedError:
            continue
        if len(found) == count:
            return found
    raise AssertionError(f"{core.name} hardly ever finds its things")


@pytest.mark.parametrize(("kind", "core"), KNOWN, ids=lambda one: getattr(one, "name", one))
def test_a_core_adds_as_many_things_as_it_says_and_its_task_moves_some_of_them(kind, core):
    for composer, (task, *named) in built(core):
        names = [obj.name for obj in composer.objects]
        assert task == kind
        assert len(set(names)) == core.size
        assert {*named, *composer.moved, *composer.places} <= set(names)
        assert composer.moved
        # Everything that the task names is moved, or is where something comes from or goes to.
        assert set(named) <= {*composer.moved, *composer.places}
        assert not set(composer.moved) & set(composer.places)
        assert len(set(composer.places)) == len(composer.places)


@pytest.mark.parametrize(
    "core", [core for kind in ("pick", "place", "stack", "unload") for core in CORES[kind]], ids=lambda core: core.name
)
def test_places_are_what_things_are_moved_from_and_what_they_are_moved_to(core):
    for composer, (task, *named) in built(core):
        sources = {one.parent for one in composer.relations if one.child in composer.moved}
        goals = {named[1]} if task in ("place", "stack") else set()
        assert set(composer.places) == sources | goals
        # What is stacked on carries nothing yet.
        assert task == "place" or not goals & {one.parent for one in composer.relations}


@pytest.mark.parametrize("core", CORES["retrieve"], ids=lambda core: core.name)
def test_what_is_retrieved_is_under_a_tower_whose_top_is_its_place(core):
    for composer, (_, target) in built(core):
        above = {one.parent: one.child for one in composer.relations}
        tower = [target]
        while tower[-1] in above:
            tower.append(above[tower[-1]])
        assert len(tower) == core.size
        assert (composer.moved, composer.places) == ([target], [tower[-1]])


class Pool:
    """In place of processes."""

    made: list[int]

    def __init__(self, workers, mp_context) -> None:
        assert mp_context.get_start_method() == "spawn"
        self.made.append(workers)

    def __enter__(self):
        return self

    def __exit__(self, *_) -> None:
        pass

    def map(self, function, things, chunksize):
        assert chunksize > 0
        return [function(thing) for thing in things]


@pytest.mark.parametrize("workers", [1, 2, 5])
def test_one_worker_checks_in_its_own_process_and_more_of_them_in_as_many_others(workers, monkeypatch):
    monkeypatch.setattr(Pool, "made", [], raising=False)
    monkeypatch.setattr(check, "ProcessPoolExecutor", Pool)
    with check._mapping(workers) as apply:
        assert list(apply(operator.neg, (3, -1, 2))) == [-3, 1, -2]
    assert Pool.made == ([workers] if workers > 1 else [])
