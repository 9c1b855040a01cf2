import pytest

from pat3d.generation.request import objects_of_plan
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.progress import silent


def colours(prompt, seed=0):
    objects = objects_of_plan(GrammarPlanner().plan(prompt), seed, silent)
    return [one.asset.provenance["colours"][0] for one in objects]


@pytest.mark.parametrize("noun", ["mug", "book", "block"])
def test_equal_objects_have_different_colours_and_the_same_seed_the_same(noun):
    found = colours(f"Four {noun}s on the floor.")
    assert len(set(found)) == len(found) == 4
    assert found == colours(f"Four {noun}s on the floor.")
    assert len({tuple(colours(f"Four {noun}s on the floor.", seed)) for seed in range(6)}) > 1


def test_what_is_said_of_colours_holds():
    assert set(colours("Four red mugs on the floor.")) == {"red"}


def test_plates_come_as_a_set():
    assert len(set(colours("Four plates on the floor."))) == 1


@pytest.mark.parametrize(("noun", "expected"), [("apple", {"red", "crimson"}), ("banana", {"yellow"})])
def test_fruit_has_the_colour_that_everybody_thinks_of(noun, expected):
    assert {colour for seed in range(8) for colour in colours(f"Two {noun}s.", seed)} <= expected
