"""Ordinary words that no source has as a name: stand-ins, meals, distractors, half rings, rooms, weights."""

from __future__ import annotations

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def _nouns(plan: ScenePlan) -> list[str]:
    return sorted(obj.noun for obj in plan.objects)


def _relations(plan: ScenePlan) -> set[str]:
    return set(map(str, plan.relations))


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("There is a cookbook.", "book"),
        ("There is a dictionary.", "book"),
        ("There is a bottle of shower gel.", "shampoo"),
        ("There is a tea light.", "candle"),
        ("There is a pair of earbuds.", "headphones"),
        ("There is a Rubik's cube.", "puzzle cube"),
        ("There is a chef's knife.", "knife"),
        ("There is a soy sauce bottle.", "soy sauce"),
    ],
)
def test_ordinary_names_are_known(prompt: str, noun: str) -> None:
    plan = PLANNER.plan(prompt)
    assert (_nouns(plan), plan.notes) == ([noun], ())


@pytest.mark.parametrize(
    ("prompt", "noun", "note"),
    [
        ("A slice of toast on a plate.", "bread", '"A slice of toast" is made as a "bread".'),
        ("Two sandals on a rug.", "slipper", '"Two sandals" is made as a "slipper".'),
        ("A piece of wood on a bench.", "wood block", '"piece of wood" is made as "wood block"'),
        ("A keyring on a desk.", "key", '"A keyring" is made as a "key".'),
        (
            "A microscope on a bench with the slides next to it.",
            "credit card",
            '"the slides" is made as a "credit card" of 0.075 m.',
        ),
    ],
)
def test_what_stands_in_is_named(prompt: str, noun: str, note: str) -> None:
    plan = PLANNER.plan(prompt)
    assert noun in _nouns(plan)
    assert note in plan.notes


@pytest.mark.parametrize(
    "prompt", ["A water heater and a rug.", "A carpet guillotine and a rug.", "A bagpipe on a bench."]
)
def test_names_that_end_in_another_thing_are_none_of_it(prompt: str) -> None:
    with pytest.raises(PromptError, match="is not in the catalogue"):
        PLANNER.plan(prompt)


def test_washers_among_bolts_are_of_steel() -> None:
    assert "steel washer" in _nouns(PLANNER.plan("Bolts and washers in a bowl."))
    assert "washing machine" in _nouns(PLANNER.plan("A washer next to a dryer."))


@pytest.mark.parametrize(
    ("prompt", "nouns", "note"),
    [
        ("A tray with breakfast.", ["bread", "egg", "mug", "tray"], '"breakfast": 3 assumed: bread, egg, mug'),
        (
            "Lunch is on the bench.",
            ["apple", "bench", "glass", "sandwich"],
            '"Lunch": 3 assumed: sandwich, apple, glass',
        ),
        ("The groceries are on the counter.", ["apple", "bread", "counter", "milk carton"], '"groceries": 3 assumed'),
        ("A plate with a salad.", ["cabbage", "cucumber", "plate", "tomato"], '"salad": 3 assumed'),
        ("A breakfast of two eggs and a bun on a plate.", ["bun", "egg", "egg", "plate"], "breakfast"),
    ],
)
def test_a_meal_is_a_few_usual_things(prompt: str, nouns: list[str], note: str) -> None:
    plan = PLANNER.plan(prompt)
    assert _nouns(plan) == nouns
    assert any(note in each for each in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("Set the table for dinner.", ["table"]),
        ("Put the lunch box on the bench.", ["bench", "lunch box"]),
        ("We are having lunch. Put the pan on the stove.", ["pan", "stove"]),
        ("Two plums for dessert on a plate.", ["plate", "plum", "plum"]),
    ],
)
def test_a_meal_that_is_a_time_is_nothing(prompt: str, nouns: list[str]) -> None:
    assert _nouns(PLANNER.plan(prompt)) == nouns


@pytest.mark.parametrize(
    ("prompt", "same", "away"),
    [
        ("A jug and a can on a bench with distractors.", "A jug and a can on a bench.", "with distractors"),
        ("A jug and a can on a bench with three distractors.", "A jug and a can on a bench.", "with three distractors"),
        ("With distractors: pick up the red can.", "Pick up the red can.", "With distractors"),
        ("Pick up the jug among other distractor objects.", "Pick up the jug.", "among other distractor objects"),
        ("Put the plum in the jug, with distractor objects on the bench.", "Put the plum in the jug.",
         "with distractor objects on the bench"),
        ("Two distractors and a jug on a bench.", "A jug on a bench.", "Two distractors and"),
        ("There are distractors on the bench. Pick up the jug.", "Pick up the jug.",
         "There are distractors on the bench"),
        ("Pick up the jug without touching the distractors.", "Pick up the jug.", "without touching the distractors"),
        ("Pick up the jug, ignoring the distractors.", "Pick up the jug.", "ignoring the distractors"),
    ],
)  # fmt: skip
def test_distractors_are_named_and_left_out(prompt: str, same: str, away: str) -> None:
    plan, plain = PLANNER.plan(prompt), PLANNER.plan(same)
    assert (_nouns(plan), _relations(plan), plan.task) == (_nouns(plain), _relations(plain), plain.task)
    assert f'not modelled: "{away}": which things those are is not said.' in plan.notes


@pytest.mark.parametrize(
    "prompt",
    [
        "Five jugs arranged in a semi-circle on a bench.",
        "Three jars stand in a neat semicircle.",
        "Five jugs in a half circle around a globe.",
        "A semicircle of jugs on a bench.",
    ],
)
def test_half_a_ring_is_noted(prompt: str) -> None:
    assert any("semicircle" in note for note in PLANNER.plan(prompt).notes)


@pytest.mark.parametrize(
    ("prompt", "same"),
    [
        ("A kitchen where a pot is on a stove and a kettle stands next to it.",
         "A pot is on a stove and a kettle stands next to it."),
        ("A workshop in which a hammer and a saw lie on a workbench.", "A hammer and a saw lie on a workbench."),
        ("Create a small office where two monitors stand on a desk.", "Two monitors stand on a desk."),
        ("A dining room in which four chairs surround a table.", "Four chairs surround a table."),
    ],
)  # fmt: skip
def test_a_room_where_something_is(prompt: str, same: str) -> None:
    plan, plain = PLANNER.plan(prompt), PLANNER.plan(same)
    assert (_nouns(plan), _relations(plan)) == (_nouns(plain), _relations(plain))
    assert plan.notes == plain.notes


def test_the_stand_is_the_nightstand() -> None:
    plan = PLANNER.plan("A bed with a nightstand beside it. A lamp and a globe are on the stand.")
    assert {"lamp on nightstand", "globe on nightstand"} <= _relations(plan)
    assert not plan.notes


def test_the_lid_is_that_of_the_box() -> None:
    plan = PLANNER.plan("Open the crate lid, put the plum in the crate and close the lid.")
    assert _nouns(plan) == ["crate", "plum"]


@pytest.mark.parametrize(
    ("prompt", "word"),
    [
        ("Put the heavier of the two cans on the scale.", "heavier"),
        ("Two cans: the heavier one is left of the lighter one.", "heavier"),
        ("Put the lighter one of the two balls in the crate.", "lighter"),
        ("Put the heaviest crate on the pallet.", "heaviest"),
    ],
)
def test_weights_are_named(prompt: str, word: str) -> None:
    plan = PLANNER.plan(prompt)
    assert "lighter" not in _nouns(plan)
    assert any(f'not modelled: "{word}"' in note for note in plan.notes)


def test_a_lighter_is_a_thing_too() -> None:
    assert _nouns(PLANNER.plan("The lighter is next to the candle.")) == ["candle", "lighter"]


def test_the_smallest_and_the_largest_are_two() -> None:
    plan = PLANNER.plan("Put the smallest crate inside the largest crate.")
    assert plan.task == "place:smaller crate:larger crate"


@pytest.mark.parametrize(
    ("prompt", "same"),
    [
        ("A jug is already on the bench.", "A jug is on the bench."),
        ("A vase adorns the bench.", "A vase is on the bench."),
        ("A desk area with two monitors.", "A desk with two monitors."),
        ("A jug and a pen are on the desk: nothing else is on the desk.", "A jug and a pen are on the desk."),
        ("A jug on a desk, nothing else.", "A jug on a desk."),
        ("A plate of fruit that stands on a bench.", "A plate of fruit stands on a bench."),
    ],
)
def test_read_alike_without_a_note(prompt: str, same: str) -> None:
    plan, plain = PLANNER.plan(prompt), PLANNER.plan(same)
    assert (_nouns(plan), _relations(plan)) == (_nouns(plain), _relations(plain))
    assert set(plan.notes) <= set(plain.notes)


def test_what_is_ready_to_eat_is_read_and_named() -> None:
    plan = PLANNER.plan("A bowl full of plums and pears ready to eat.")
    assert {"plum", "pear"} <= set(_nouns(plan))
    assert 'not modelled: "ready to eat"' in plan.notes


def test_what_is_inside_instead_of_beside_is_named() -> None:
    plan = PLANNER.plan("A crate on a bench, with tape and scissors next to it.")
    assert any('"tape" is in it' in note for note in plan.notes)
    assert not any("alone" in note for note in PLANNER.plan("A basket with plums and a jug beside it.").notes)
