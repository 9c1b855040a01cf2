"""Parts of several as numbers, groups of colours, and what only tells what things are like or which way they face."""

from __future__ import annotations

from collections import Counter

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import steps, told

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "colours", "note"),
    [
        ("Half of the eight jars are red.", {"red": 4, "": 4}, ""),
        ("A third of the nine jars are blue.", {"blue": 3, "": 6}, '"A third of the nine jars" is read as 3 of them.'),
        ("Six jars on a tray, every second jar is red.", {"red": 3, "": 3},
         '"every second jar" is read as 3 of them; which ones is not modelled.'),
        ("Eight jars on a tray, every other jar is red.", {"red": 4, "": 4},
         '"every other jar" is read as 4 of them; which ones is not modelled.'),
        ("Half the jars are red.", {"red": 3}, '"Half the jars": of how many is not said.'),
        ("Eight jars, half of them red and half of them blue, on a tray.", {"red": 4, "blue": 4}, ""),
        ("Of the six jars, half are red.", {"red": 3, "": 3}, ""),
    ],
)  # fmt: skip
def test_a_part_of_several_is_a_number(prompt: str, colours: dict[str, int], note: str) -> None:
    plan = PLANNER.plan(prompt)
    made = Counter(obj.colours[0] if obj.colours else "" for obj in plan.objects if obj.noun == "jar")
    assert made == colours
    assert not note or note in plan.notes


def test_a_part_of_what_is_moved_is_a_number() -> None:
    plan = PLANNER.plan("Six figs are on a mat. Put two thirds of the figs in the bowl.")
    assert steps(plan) == [f"place:fig {n}:bowl" for n in (1, 2, 3, 4)]
    assert '"two thirds of the figs" is read as 4 of them.' in plan.notes


def test_every_second_of_nobody_knows_how_many_is_refused() -> None:
    with pytest.raises(PromptError, match="every second"):
        PLANNER.plan("Every second jar is red.")


def test_warm_and_cool_are_groups_of_colours() -> None:
    plan = PLANNER.plan("Three warm-coloured cups and three cool-colored jars on a table.")
    assert [obj.colours[0] for obj in plan.objects[:6]] == ["red", "orange", "yellow", "blue", "green", "purple"]
    assert 'not modelled: of what colour "a warm-coloured cup" is' in PLANNER.plan("a warm-coloured cup").notes
    kept = PLANNER.plan("A red cup, a green cup and a blue cup are on a mat. Put the warm-coloured cup on the tray.")
    assert steps(kept) == ["place:red cup:tray"]
    assert 'not modelled: "light" of "two light cups"' in PLANNER.plan("two light cups").notes
    assert not PLANNER.plan("two light blue cups").notes


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "note"),
    [
        ("The soup pot smells frumious.", "soup pot", "", "smells frumious"),
        ("The towel got soggy and lies on a bench.", "towel, bench", "towel on bench", "got soggy"),
        ("A bagel that has gone mimsy is on a plate.", "bagel, plate", "bagel on plate", "that has gone mimsy"),
        ("The knife looks slithy and dangerous.", "knife", "", "looks slithy and dangerous"),
        ("The pillow feels lumpy.", "pillow", "", "feels lumpy"),
        ("The bench became brillig.", "bench", "", "became brillig"),
        ("A sofa facing south.", "sofa", "", "facing south"),
        ("A bench facing north-west on a rug.", "bench, rug", "bench on rug", "facing north-west"),
        ("Two chairs face the east.", "chair 1, chair 2", "", "face the east"),
        ("Three cups in a tight cluster on a tray.", "cup 1, cup 2, cup 3, tray",
         "cup 1 on tray, cup 2 on tray, cup 3 on tray", "in a tight cluster"),
        ("Two pens in a queue on a desk.", "pen 1, pen 2, desk", "pen 1 on desk, pen 2 on desk", "in a queue"),
    ],
)  # fmt: skip
def test_what_a_thing_is_like_names_nothing(prompt: str, objects: str, relations: str, note: str) -> None:
    assert told(PLANNER.plan(prompt)) == (objects, relations, None, [f'not modelled: "{note}"'])


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("The cat stays on the sofa.", "cat on sofa"),
        ("The cup goes on the tray.", "cup on tray"),
        ("A cluster of figs in a crate.", "fig 1 in crate, fig 2 in crate, fig 3 in crate"),
    ],
)
def test_where_a_thing_is_is_read_behind_the_same_verbs(prompt: str, relations: str) -> None:
    assert told(PLANNER.plan(prompt))[1] == relations


def test_the_remaining_one_is_one_of_them() -> None:
    plan = told(PLANNER.plan("Two jars are on a tray. One of them is red, the remaining one is blue."))
    assert plan == ("red jar, blue jar, tray", "red jar on tray, blue jar on tray", None, [])


def test_a_place_of_several_that_is_inserted_is_a_sentence_of_its_own() -> None:
    plan = told(PLANNER.plan("A desk with two monitors and, in front of them, a keyboard."))
    assert plan[:2] == ("desk, monitor 1, monitor 2, keyboard", "monitor 1 on desk, monitor 2 on desk, "
                        "keyboard on desk, keyboard in_front_of monitor 1, keyboard in_front_of monitor 2")  # fmt: skip
