"""A clause that cannot be read is named in a note, what it names is there, and the rest of the prompt is read."""

from __future__ import annotations

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def relations(plan: ScenePlan) -> set[str]:
    return {f"{each.child} {each.kind} {each.parent}" for each in plan.relations}


def _names(prompt: str) -> set[str]:
    return {obj.name for obj in PLANNER.plan(prompt).objects}


@pytest.mark.parametrize(
    ("prompt", "names", "task", "unread"),
    [
        ("Put the scarf wherever the hat is.", {"scarf", "hat"}, None, "wherever the hat is"),
        ("Place the pear in the bowl before it burns.", {"pear", "bowl"}, "place:pear:bowl", "before it burns"),
        ("Put the spoon in the cup, the other way round.", {"spoon", "cup"}, "place:spoon:cup",
         "the other way round"),
        ("Put the ball in the box. Three if there are three.", {"ball", "box"}, "place:ball:box",
         "Three if there are three"),
        ("Put the ball in the box, but leave out the bat.", {"ball", "box"}, "place:ball:box",
         "but leave out the bat"),
        ("A vase is on the desk. The lamp does not.", {"vase", "desk", "lamp"}, None, "The lamp does not"),
        ("A jug is on a bench. It is not on the tray.", {"jug", "bench", "tray"}, None, "It is not on the tray"),
        ("Frob two red blocks.", {"red block 1", "red block 2"}, None, "Frob two red blocks"),
        ("A mug with socks spilling out.", {"mug", "sock 1", "sock 2"}, None, "A mug with socks spilling out"),
        ("Take the pear from the basket, and if you can, the plum as well.", {"pear", "basket", "plum"}, None,
         "and if you can"),
        ("Push the chair to the desk so that there are three in total.", {"chair", "desk"}, None,
         "so that there are three in total"),
    ],
)  # fmt: skip
def test_what_cannot_be_read_is_named_and_what_it_names_is_there(
    prompt: str, names: set[str], task: str | None, unread: str
):
    plan = PLANNER.plan(prompt)
    assert ({obj.name for obj in plan.objects}, plan.task) == (names, task)
    assert any(f'"{unread}"' in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "word"),
    [
        ("A pear is on the desk. A zorgle lies beside it.", "zorgle"),
        ("Put the ball in the box before the zorgle comes.", "zorgle"),
        ("Either a pear or a plum is on the tray.", "either"),
        ("Stack all cups but one.", "but"),
    ],
)
def test_what_cannot_be_made_or_is_left_open_is_refused(prompt: str, word: str):
    with pytest.raises(PromptError, match=f"(?i){word}"):
        PLANNER.plan(prompt)


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("Put the fork in the sink, then do the same with the spoon.",
         "chain:place:fork:sink:then:place:spoon:sink"),
        ("Pick up the red ball and put it in the box. Do the same with the green one.",
         "chain:place:red ball:box:then:place:green ball:box"),
        ("Load the crate with the pears on the rug.",
         "chain:place:pear 1:crate:then:place:pear 2:crate:then:place:pear 3:crate"),
        ("Microwave a mug and put it on the tray.", "place:mug:tray"),
        ("Now plump the cushion and put it on the sofa.", "place:cushion:sofa"),
        ("Placing lemon on plate", "place:lemon:plate"),
        ("Get it out with the stick and drop it in the crate.", None),
        ("A ball is under the sofa. Get it out with the stick and drop it in the crate.", "place:ball:crate"),
        ("Pick up tool and put it in the crate.", "place:hammer:crate"),
        ("Pick up the red cube, put it on the green cube and let go of it.", "place:red cube:green cube"),
    ],
)  # fmt: skip
def test_instructions_are_tasks(prompt: str, task: str | None):
    plan = PLANNER.plan(prompt)
    assert task is None or plan.task == task


@pytest.mark.parametrize(
    "prompt",
    ["Throw away the pear on the tray.", "Get rid of the pear on the tray.", "Dispose of the pear on the tray.",
     "Toss out the pear on the tray.", "Restock pear on the tray.", "Slide the pear to the right on the tray.",
     "Push the pear 5 cm to the left on the tray."],
)  # fmt: skip
def test_what_is_done_leaves_a_thing_where_it_is(prompt: str):
    plan = PLANNER.plan(prompt)
    assert relations(plan) == {"pear on tray"}
    assert plan.task is None
    assert any("no task does that" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "names", "held"),
    [
        ("Examine the coin using the light from the lamp.", {"coin", "lamp"}, set[str]()),
        ("Take everything out of the box except the ball.", {"box", "ball"}, {"ball in box"}),
        ("The plate can stay on the shelf.", {"plate", "shelf"}, {"plate on shelf"}),
    ],
)
def test_what_is_there_stands_as_said(prompt: str, names: set[str], held: set[str]):
    assert _names(prompt) == names
    assert relations(PLANNER.plan(prompt)) == held


def test_the_cap_of_what_is_no_body_is_of_its_container():
    plan = PLANNER.plan("take off the cap of salt")
    assert [obj.noun for obj in plan.objects] == ["salt shaker"]
    assert any("has no parts of its own" in note for note in plan.notes)
