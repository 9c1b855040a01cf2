"""How often, until when and which way something is done or lies: noted, and the rest is read."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


@pytest.mark.parametrize(
    ("sentence", "task", "noted"),
    [
        ("Lift the bowl twice.", "pick:bowl", "twice"),
        ("Pick up the bowl three times.", "pick:bowl", "three times"),
        ("Put the egg in the bowl, until it rests there.", "place:egg:bowl", "until it rests there"),
        ("Knock on the box twice.", None, "twice"),
        ("Push the crate until it reaches the wall.", None, "until it reaches the wall"),
    ],
)
def test_how_often_and_until_when_are_noted(planner: GrammarPlanner, sentence: str, task: str | None, noted: str):
    plan = planner.plan(sentence)
    assert plan.task == task
    assert f'not modelled: "{noted}"' in plan.notes


@pytest.mark.parametrize(
    ("sentence", "task"),
    [
        ("Let's start by moving the egg to the bowl.", "place:egg:bowl"),
        ("Begin by putting the spoon in the jar.", "place:spoon:jar"),
        ("First, start by picking up the hat.", "pick:hat"),
    ],
)
def test_what_an_instruction_starts_by_is_its_task(planner: GrammarPlanner, sentence: str, task: str):
    plan = planner.plan(sentence)
    assert plan.task == task
    assert not any("not " in note for note in plan.notes)


@pytest.mark.parametrize("sentence", ["Firmly press down the lid of the box.", "Press down on the lid of the box."])
def test_pressing_down_is_a_deed(planner: GrammarPlanner, sentence: str):
    notes = planner.plan(sentence).notes
    assert any("no task does that" in note for note in notes)
    assert not any("not understood" in note for note in notes)


def test_parallel_to_each_other_is_side_by_side(planner: GrammarPlanner):
    plan = planner.plan("Three pens parallel to each other on a desk.")
    assert [(one.kind, len(one.objects)) for one in plan.arrangements] == [("side_by_side", 3)]
    assert 'not modelled: "parallel to each other"' in plan.notes


def test_parallel_to_a_thing_is_next_to_it(planner: GrammarPlanner):
    plan = planner.plan("The fork lies parallel to the spoon.")
    assert "fork next_to spoon" in map(str, plan.relations)
    assert 'not modelled: "parallel to"' in plan.notes


def test_parallel_rows_stay_rows(planner: GrammarPlanner):
    plan = planner.plan("Two rows of hats parallel to each other.")
    assert {one.kind for one in plan.arrangements} == {"row"}


def test_appliances_are_usual_ones_and_noted(planner: GrammarPlanner):
    plan = planner.plan("Three appliances on a counter.")
    assert sorted(obj.noun for obj in plan.objects) == ["blender", "counter", "kettle", "toaster"]
    assert any("which is not said" in note for note in plan.notes)
