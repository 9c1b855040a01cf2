"""A vessel upside down over something stands around it where it has room there; else a note says that it does not."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from pat3d.generation.pipeline import generate
from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    "prompt",
    [
        "A cup turned over covers a marble on a tray.",
        "A marble is under an upside-down cup on a tray.",
        "A marble is hidden below an inverted cup on a tray.",
        "The marble on the tray is covered by a cup.",
        "A cup is upside down over a marble on a tray.",
    ],
)
def test_a_vessel_over_something_is_upside_down_around_it(prompt: str):
    plan = PLANNER.plan(prompt)
    assert {str(relation) for relation in plan.relations} == {"marble on tray", "cup on tray"}
    assert [(one.kind, one.objects, one.of, one.arranged) for one in plan.arrangements] == [
        ("under", ("marble",), ("cup",), True)
    ]
    assert [(one.object, one.kind) for one in plan.postures] == [("cup", "upside_down")]
    assert not [note for note in plan.notes if "hidden" not in note]


def test_several_small_things_are_under_one_vessel():
    plan = PLANNER.plan("Two coins are under an upside-down bowl on a tray.")
    assert [(one.kind, one.objects, one.of, one.arranged) for one in plan.arrangements] == [
        ("under", ("coin 1", "coin 2"), ("bowl",), True)
    ]
    assert plan.parent("bowl") == plan.parent("coin 2") == "tray"
    assert not plan.notes


@pytest.mark.parametrize(
    ("prompt", "note"),
    [
        ("A mug upside down covers a watermelon.",
         'not arranged: "A mug" over "a watermelon"; it is placed next to it'),
        ("A bucket covers three lemons.", 'not arranged: "A bucket" over "three lemons"; it is placed next to it'),
        ("A ball lies under an upside-down teacup.",
         'not arranged: "A ball" under "an upside-down teacup"; it is placed next to it'),
    ],
)  # fmt: skip
def test_what_has_no_room_there_stands_beside_it(prompt: str, note: str):
    plan = PLANNER.plan(prompt)
    assert note in plan.notes
    assert {relation.kind for relation in plan.relations} == {"next_to"}


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A bowl upside down on a plate.", {"bowl on plate"}),
        ("A towel covers a bowl.", {"towel on bowl"}),
        ("A blanket is over the bed.", {"blanket on bed"}),
        ("Two cups upside down, each over a marble.", set[str]()),
    ],
)
def test_what_lies_over_something_lies_on_it(prompt: str, relations: set[str]):
    plan = PLANNER.plan(prompt)
    assert {str(relation) for relation in plan.relations} == relations
    assert plan.notes in ((), ('"A towel" is made as a "towel"',))


@pytest.mark.slow
def test_in_mujoco_the_bowl_stands_around_what_it_covers(tmp_path: Path):
    generate("An upside-down bowl covers a walnut on a tray.", out=tmp_path / "scene")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "scene" / "mjcf" / "scene.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    for _ in range(500):
        mujoco.mj_step(model, data)
    bowl, walnut = (data.body(name) for name in ("bowl", "walnut"))
    assert np.linalg.norm((bowl.xipos - walnut.xipos)[:2]) < 0.05
    assert bowl.xipos[2] > walnut.xipos[2]
    assert bowl.xmat[8] < -0.99
