"""What "the cup to the left of the plate" means where several cups were named: one of them."""

from __future__ import annotations

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan


def read(prompt: str) -> ScenePlan:
    return GrammarPlanner().plan(prompt)


def related(plan: ScenePlan, kind: str) -> list[tuple[str, str]]:
    return [(each.child, each.parent) for each in plan.relations if each.kind == kind]


def test_what_is_told_by_its_side_is_one_of_several():
    plan = read("Three lemons and a tray are on a bench. The lemon to the right of the tray is green.")
    assert related(plan, "right_of") == [("green lemon", "tray")]
    assert [obj.colours for obj in plan.objects if obj.noun == "lemon"] == [("green",), (), ()]
    assert len([pair for pair in related(plan, "on") if pair[1] == "bench"]) == 4


def test_each_side_tells_another_one():
    plan = read(
        "Two lemons and a tray are on a bench. The lemon to the right of the tray is green. "
        "The lemon to the left of the tray is red."
    )
    assert related(plan, "right_of") == [("green lemon", "tray")]
    assert related(plan, "left_of") == [("red lemon", "tray")]


def test_what_tells_the_nearest_is_noted():
    for near in ("nearest to", "that is closest to", "that's nearer", "closer to"):
        plan = read(f"There are two jars and a pan on a shelf. Pick up the jar {near} the pan.")
        assert related(plan, "next_to") == [("jar 1", "pan")]
        assert {pair[1] for pair in related(plan, "on")} == {"shelf"}
        assert str(plan.task) == "pick:jar 1"
        word = near.split()[-1] if near.split()[-1] != "to" else near.split()[-2]
        assert any(word in note and "one of 2" in note for note in plan.notes)


def test_what_tells_the_farthest_is_noted_and_said_of_one():
    plan = read("There are two jars and a pan on a shelf. The jar farthest from the pan is red.")
    assert [obj.colours for obj in plan.objects if obj.noun == "jar"] == [("red",), ()]
    assert any("farthest from the pan" in note for note in plan.notes)


def test_the_one_named_again_is_the_same():
    plan = read(
        "Two jars and a pan are on a shelf. The jar to the left of the pan is red. The jar holds a spoon. "
        "Pick up the jar."
    )
    assert related(plan, "in") == [("spoon", "red jar")]
    assert str(plan.task) == "pick:red jar"


def test_each_speaks_of_all_that_are_listed():
    plan = read("Two green jars and a white one on a shelf, with a pencil in each.")
    assert sorted(parent for _, parent in related(plan, "in")) == ["green jar 1", "green jar 2", "white jar"]
    assert len(related(plan, "on")) == 3
    plan = read("A bowl and two jars are on a shelf, each with an egg in it.")
    assert sorted(parent for _, parent in related(plan, "in")) == ["bowl", "jar 1", "jar 2"]
    plan = read("Two sealed cartons and an open one on a shelf, with a label on each.")
    assert [obj.noun for obj in plan.objects].count("box") == 3
    assert len(related(plan, "on")) == 3


def test_colours_that_alternate():
    for prompt in (
        "A row of four jars that alternate between red and green on a shelf.",
        "Four jars in a row on a shelf, alternating red and green.",
        "Four jars in a line on a shelf, alternately red and green.",
    ):
        plan = read(prompt)
        row = next(one.objects for one in plan.arrangements if one.kind == "row")
        colours = {obj.name: obj.colours for obj in plan.objects}
        assert [colours[name] for name in row] == [("red",), ("green",)] * 2
        assert {parent for _, parent in related(plan, "on")} == {"shelf"}
        assert not plan.notes
