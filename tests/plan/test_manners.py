"""Talk before a request, styles and orders are named in a note; the rest of the prompt is read as without them."""

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


@pytest.mark.parametrize(
    ("sentence", "same", "left_out"),
    [
        ("I'm throwing a party. Put the fork on the tray.", "Put the fork on the tray.", "I'm throwing a party"),
        ("We have a lesson today. Pick up the pen.", "Pick up the pen.", "We have a lesson today"),
        ("I am tired. Hand me the mug.", "Hand me the mug.", "I am tired"),
        ("A desk in the style of Mies and a lamp.", "A desk and a lamp.", "in the style of Mies"),
        ("Arrange the five jars by length.", "Arrange the five jars.", "by length"),
        (
            "Put four mugs in a crate such that the mugs do not touch.",
            "Put four mugs in a crate.",
            "such that the mugs do not touch",
        ),
        ("Two trays labelled A and B on a desk.", "Two trays on a desk.", "labelled A and B"),
    ],
)  # fmt: skip
def test_left_out_with_a_note(planner: GrammarPlanner, sentence: str, same: str, left_out: str) -> None:
    plan, plain = planner.plan(sentence), planner.plan(same)

    assert [(obj.name, obj.noun) for obj in plan.objects] == [(obj.name, obj.noun) for obj in plain.objects]
    assert (plan.relations, plan.task) == (plain.relations, plain.task)
    assert f'not modelled: "{left_out}"' in plan.notes


@pytest.mark.parametrize(
    "sentence",
    [
        "I'm holding a gizmo. Put the mug on the tray.",
        "My friend is on the sofa. Hand him the mug.",
        "I'm hungry.",
        "Three jars such that a spoon lies beside them.",
    ],
)
def test_what_may_be_there_is_not_left_out(planner: GrammarPlanner, sentence: str) -> None:
    with pytest.raises(PromptError):
        planner.plan(sentence)


def test_what_who_speaks_has_is_there(planner: GrammarPlanner) -> None:
    plan = planner.plan("I have a red mug. Put it on the tray.")

    assert [obj.noun for obj in plan.objects] == ["mug", "tray"]
    assert plan.task is not None


def test_labels_tell_apart(planner: GrammarPlanner) -> None:
    plan = planner.plan("Three crates labelled A, B and C stand in a row. Crate B holds a mug.")

    assert [str(relation) for relation in plan.relations if relation.supports] == ["mug in crate 2"]


@pytest.mark.parametrize(
    ("sentence", "same"),
    [
        (
            "Five mugs in a row, alternating white and green.",
            "Five mugs in a row, white, green, white, green and white.",
        ),
        ("The jar on the shelf is a green jar.", "The jar on the shelf is green."),
        ("The jar is a green one.", "The jar is green."),
        ("Restock the shelf by putting the jar on the shelf.", "Put the jar on the shelf."),
    ],
)
def test_the_same_scene(planner: GrammarPlanner, sentence: str, same: str) -> None:
    plan, plain = planner.plan(sentence), planner.plan(same)

    assert sorted((obj.name, obj.colours) for obj in plan.objects) == sorted(
        (obj.name, obj.colours) for obj in plain.objects
    )
    assert (set(plan.relations), plan.task) == (set(plain.relations), plain.task)


def test_an_unnamed_thing_is_at_fault(planner: GrammarPlanner) -> None:
    with pytest.raises(PromptError, match="Pick up the red object"):
        planner.plan("Pick up the red object and put it on the tray.")
