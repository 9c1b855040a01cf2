"""Beside one another, as it is asked for: specifications, refusals, words, chains and suites."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("gymnasium")


from pat3d.assets.shapes import box
from pat3d.envs.suites.composition import draft, pointed
from pat3d.envs.suites.request import TASKS, Request
from pat3d.envs.tasks.beside import RELATIONS, Beside, drawn_beside
from pat3d.envs.tasks.chain import Chain
from pat3d.envs.tasks.registry import parse_task, possible_tasks
from pat3d.envs.tasks.rewording import fault
from pat3d.errors import TaskError
from pat3d.scene.model import Relation
from tests.envs.beside_scenes import CUBE, SLAB, on_a_board, on_a_table
from tests.scenes import GAP, asset_of, placed, scene_of


@pytest.fixture(scope="module")
def table():
    return on_a_table()


@pytest.fixture(scope="module")
def boarded():
    return on_a_board()


@pytest.mark.parametrize("relation", RELATIONS)
def test_a_specification_is_read_back(relation):
    task = parse_task(f"beside:red mug:{relation}:plate")
    assert task == Beside(target="red mug", relation=relation, landmark="plate")
    assert parse_task(task.spec) == task
    assert task.names == ("red mug", "plate")


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        ("beside:mug", r'does not fit "beside:OBJECT:RELATION:LANDMARK, where RELATION is left_of, right_of, in_front'),
        ("beside:mug:plate", "does not fit"),
        ("beside:mug:left_of:", "does not fit"),
        ("beside:mug:left_of:plate:jar", "does not fit"),
        ("beside:mug:on:plate", 'no relation "on". Relations: left_of, right_of, in_front_of, behind, next_to'),
        ("beside:mug:around:plate", 'no relation "around"'),
    ],
)
def test_what_is_no_specification_is_answered_with_what_would_be_one(spec, message):
    with pytest.raises(TaskError, match=message):
        parse_task(spec)


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        ("beside:cup:left_of:plate", '"cup" is not in the scene. Objects that can move'),
        ("beside:mug:left_of:cup", '"cup" is not in the scene. Objects: '),
        ("beside:mug:left_of:mug", '"mug" cannot be put beside itself'),
        ("beside:jar:left_of:lid", '"lid" stands on "jar"'),
        ("beside:jar:behind:mug", '"jar" carries "lid" and cannot'),
        ("beside:mug:right_of:plate", '"mug" is to the right of "plate" already'),
        ("beside:mug:in_front_of:plate", '"mug" is in front of "plate" already'),
        ("beside:mug:left_of:lid", 'no room for "mug" to the left of "lid": in the way is the edge of the surface'),
    ],
)
def test_what_cannot_be_or_is_done_is_refused(table, spec, message):
    with pytest.raises(TaskError, match=message):
        parse_task(spec).check(table)


def test_what_is_next_to_something_already_is_not_put_there():
    """Up to a quarter of a metre of gap, as for scenes."""
    scenes = [
        scene_of(placed("a", CUBE, (0.0, 0.0, GAP)), placed("b", CUBE, (0.04 + gap, 0.0, GAP))) for gap in (0.24, 0.26)
    ]
    with pytest.raises(TaskError, match='"a" is next to "b" already'):
        parse_task("beside:a:next_to:b").check(scenes[0])
    parse_task("beside:a:next_to:b").check(scenes[1])


def test_what_is_in_the_way_is_named(table):
    """A long wall stands where the mug should go, and leaves room on the other sides."""
    wall = placed("wall", asset_of(box(0.14, 0.3, 0.06)), (-0.24, 0.05, GAP))
    others = [obj for obj in table.objects if obj.name in ("mug", "plate")]
    blocked = scene_of(*others, wall)
    with pytest.raises(TaskError, match='no room for "mug" to the left of "plate": in the way is "wall"'):
        parse_task("beside:mug:left_of:plate").check(blocked)
    parse_task("beside:mug:behind:plate").check(blocked)


@pytest.mark.parametrize("kind", ["in", "hangs_from"])
def test_what_stands_on_no_surface_has_nothing_beside_it(kind):
    scene = scene_of(
        placed("mug", CUBE, (0.3, 0.0, GAP)),
        placed("box", SLAB, (0.0, 0.0, GAP)),
        placed("pea", CUBE, (0.0, 0.0, 0.03 + 2 * GAP)),
        relations=(Relation(child="pea", kind=kind, parent="box"),),
    )
    with pytest.raises(TaskError, match='"pea" does not stand on a surface but in, from or across "box"'):
        parse_task("beside:mug:left_of:pea").check(scene)


def test_instructions_say_where_and_mean_their_task(table):
    said = [parse_task(f"beside:mug:{relation}:plate").instruction(table) for relation in RELATIONS]
    assert said == [
        "put the mug to the left of the plate", "put the mug to the right of the plate",
        "put the mug in front of the plate", "put the mug behind the plate", "put the mug next to the plate",
    ]  # fmt: skip
    for relation in RELATIONS:
        task = parse_task(f"beside:mug:{relation}:plate")
        wordings = task.wordings(table)
        assert len(set(wordings)) == len(wordings) >= 5
        assert [fault(one, task, table) for one in wordings] == [None] * len(wordings)


@pytest.mark.parametrize(
    ("relation", "sentence", "why"),
    [
        ("left_of", "Set the mug down on the left side of the plate.", None),
        ("left_of", "Put the mug to the right of the plate.", "it does not say"),
        ("left_of", "Put the plate to the left of the mug.", 'it does not say that "mug" goes to the left of "plate"'),
        ("left_of", "Look at the mug to the left of the plate.", "it does not say that something is put"),
        ("left_of", "Put the mug next to the plate.", "it does not say"),
        ("next_to", "Leave the mug beside the plate, please.", None),
        ("next_to", "Put the mug on the plate.", "it does not say that"),
        ("next_to", "Put the mug to the left of the plate.", '"left" changes'),
        ("behind", "Move the mug to a place behind the plate.", None),
        ("behind", "Put the mug in front of the plate.", "it does not say"),
        ("in_front_of", "Place the mug right in front of the plate.", '"right" changes'),
    ],
)
def test_sentences_of_others_mean_it_or_not(table, relation, sentence, why):
    found = fault(sentence, parse_task(f"beside:mug:{relation}:plate"), table)
    assert found is None if why is None else why in str(found)


CHAIN = "chain:beside:mug:left_of:plate:then:place:lid:plate"


def test_a_chain_has_steps_beside_something(table):
    task = parse_task(CHAIN)
    assert isinstance(task, Chain)
    assert task.steps[0] == Beside(target="mug", relation="left_of", landmark="plate")
    assert parse_task(task.spec) == task
    task.check(table)
    assert task.instruction(table).startswith("first put the mug to the left of the plate, then put the lid on")
    assert task.names == ("mug", "plate", "lid")


def test_no_step_of_a_chain_moves_what_something_is_beside(table, boarded):
    for spec, moved in (
        ("chain:beside:mug:left_of:plate:then:pick:plate", "plate"),
        ("chain:beside:plate:next_to:mug:then:beside:mug:left_of:plate", "mug"),
    ):
        with pytest.raises(TaskError, match=f'another step moves "{moved}"'):
            parse_task(spec).check(table)
    with pytest.raises(TaskError, match='another step moves "board"'):
        parse_task("chain:beside:mug:right_of:plate:then:pick:board").check(boarded)
    parse_task("chain:beside:mug:left_of:plate:then:lift:plate").check(table)


def test_what_other_tasks_are_possible_stays(table):
    assert not [task for task in possible_tasks(table) if isinstance(task, Beside)]
    assert "beside" not in Request().tasks
    assert Request(tasks=("beside",)).tasks == ("beside",)
    assert TASKS[:5] == ("pick", "place", "stack", "sort", "unload")


@pytest.mark.parametrize("candidate", range(3))
def test_a_suite_draws_relations_that_its_scene_leaves_open(candidate):
    request = Request(tasks=("beside",), scenes=4)
    first = draft(request, 0, candidate)
    kind, target, landmark = first.task.split(":")
    assert (kind, target) == ("beside", first.moved[0])
    assert landmark in first.places
    names = [obj.name for obj in first.plan.objects if obj.name not in (target, landmark)]
    scene = scene_of(
        placed(target, CUBE, (0.3, 0.1, GAP)),
        placed(landmark, SLAB, (-0.1, 0.0, GAP)),
        *(placed(name, CUBE, (0.1 * number, 0.4, GAP)) for number, name in enumerate(names)),
    )
    found = {pointed(first, scene, number).task for number in range(6)}
    assert len(found) > 1
    for spec in found:
        parse_task(spec).check(scene)
    assert pointed(first, scene, 2) == pointed(first, scene, 2)


def test_drawn_relations_are_refused_where_none_is_possible():
    near = scene_of(placed("a", CUBE, (0.0, 0.0, GAP)), placed("b", CUBE, (0.1, 0.0, GAP)))
    with pytest.raises(TaskError, match="can be put to no side"):
        drawn_beside(near, "a", "a", np.random.default_rng(0))
