"""What stands around an instruction: which thing is meant, talk before it, what a table is laid with."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import chain


def _plan(text):
    return GrammarPlanner().plan(text)


def _relations(plan):
    return {(each.child, each.kind, each.parent) for each in plan.relations}


@pytest.mark.parametrize(
    ("text", "objects", "relations", "task"),
    [
        ("Push the cup next to the kettle, the one that is on the tray.", {"cup", "kettle", "tray"},
         {("cup", "on", "tray")}, "beside:cup:next_to:kettle"),
        ("Push the ball behind the vase, the one that is in the basket.", {"ball", "vase", "basket"},
         {("ball", "in", "basket")}, "beside:ball:behind:vase"),
        ("Put the cup on the tray, the one next to the lamp.", {"cup", "tray", "lamp"},
         {("cup", "next_to", "lamp")}, "place:cup:tray"),
        ("Take the cup, the one on the tray, and put it in the sink.", {"cup", "tray", "sink"},
         {("cup", "on", "tray")}, "place:cup:sink"),
    ],
)  # fmt: skip
def test_the_one_behind_a_command_is_what_is_moved(text, objects, relations, task):
    plan = _plan(text)
    assert {obj.name for obj in plan.objects} == objects
    assert _relations(plan) == relations
    assert plan.task == task
    assert any("is read as said of" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("text", "count", "said"),
    [
        ("Hang the mug on the mug tree, please - the one with the green handle.", 2, "green handle"),
        ("Put the cup on the shelf, please - the one with the blue handle.", 2, "blue handle"),
        ("Hang the cup on the mug tree - the one with the red stripe.", 2, "red stripe"),
        ("Turn the bottle around, the one with the green cap.", 1, "cap"),
    ],
)
def test_a_part_by_which_one_is_meant_makes_no_second_one(text, count, said):
    plan = _plan(text)
    assert len(plan.objects) == count
    assert any(said in note and len(note) < len(text) for note in plan.notes)


@pytest.mark.parametrize(
    ("text", "relation", "task"),
    [
        ("I spilled my juice, get the sponge next to the sink and clean it up.", ("sponge", "next_to", "sink"), None),
        ("My hands are dirty, get the soap next to the sink.", ("soap", "next_to", "sink"), "pick:soap"),
        ("The milk is spilled, take the napkin beside the cup.", ("napkin", "next_to", "cup"), "pick:napkin"),
        ("I am thirsty, bring me the bottle behind the glass.", ("bottle", "behind", "glass"), "pick:bottle"),
        ("I burned my dinner, put the pan next to the stove in the sink.", ("pan", "next_to", "stove"),
         "place:pan:sink"),
        ("The cup is on the tray, put it on the shelf.", ("cup", "on", "tray"), "place:cup:shelf"),
    ],
)  # fmt: skip
def test_a_command_behind_talk_keeps_its_places(text, relation, task):
    plan = _plan(text)
    assert _relations(plan) == {relation}
    assert task is None or plan.task == task


@pytest.mark.parametrize(
    ("text", "tasks", "said"),
    [
        ("Set the table for two: plate, fork on the left, knife on the right.",
         ["place:plate:table", "place:fork:table", "place:knife:table"], ["for two", "on the left", "on the right"]),
        ("Lay the table: plate, fork left, knife right.",
         ["place:plate:table", "place:fork:table", "place:knife:table"], ["left", "right"]),
        ("Prepare the tray: a cup, a spoon next to it, a napkin under it.",
         ["place:cup:tray", "place:spoon:tray", "place:napkin:tray"], ["next to it", "under it"]),
        ("Set up the desk: keyboard in the middle, two red mugs behind it.",
         ["place:keyboard:desk", "place:red mug 1:desk", "place:red mug 2:desk"], ["in the middle", "behind it"]),
    ],
)  # fmt: skip
def test_what_a_table_is_laid_with_is_put_on_it(text, tasks, said):
    plan = _plan(text)
    assert not _relations(plan)
    assert plan.task == chain(*tasks)
    assert all(f'not modelled: "{each}"' in plan.notes for each in said)


@pytest.mark.parametrize(
    "text",
    ["Put the phone on the base.", "Put the red cup on the base, then pick up the fork.", "Put the lid on the base."],
)
def test_a_part_of_nothing_is_told(text):
    assert any('"on the base": nothing is named' in note for note in _plan(text).notes)


@pytest.mark.parametrize(
    ("text", "relations", "task"),
    [
        ("Move the salt from the left of the kettle to the right of it.", {("salt shaker", "left_of", "kettle")},
         "beside:salt shaker:right_of:kettle"),
        ("Move the cup from the left side of the plate to the right side of the plate.",
         {("cup", "left_of", "plate")}, "beside:cup:right_of:plate"),
        ("Move the cup from the front of the plate to the back of it.", {("cup", "in_front_of", "plate")},
         "beside:cup:behind:plate"),
        ("Take the cup from the left of the plate.", {("cup", "left_of", "plate")}, "pick:cup"),
        ("Pick up the cup from the right of the lamp and put it on the tray.", {("cup", "right_of", "lamp")},
         "place:cup:tray"),
        ("Move the red cup from the left of the blue cup to the tray.", {("red cup", "left_of", "blue cup")},
         "place:red cup:tray"),
        ("Move the cup from the left side of the tray to the shelf.", {("cup", "on", "tray")}, "place:cup:shelf"),
    ],
)  # fmt: skip
def test_the_side_something_is_taken_from_is_there_before(text, relations, task):
    plan = _plan(text)
    assert _relations(plan) == relations
    assert plan.task == task


@pytest.mark.parametrize(
    ("text", "count", "task"),
    [
        ("Take the book at the bottom of the stack of four and lay it on the desk.", 5, "place:book 1:desk"),
        ("Take the bottom book of the stack of three and lay it on the desk.", 4, "place:book 1:desk"),
        ("Take the top cup from the stack of three and put it on the tray.", 4, "place:cup 3:tray"),
    ],
)
def test_a_stack_of_a_number_is_of_what_is_taken_from_it(text, count, task):
    plan = _plan(text)
    assert len(plan.objects) == count
    assert plan.task == task


@pytest.mark.parametrize(
    ("text", "task", "said"),
    [
        ("Put the rose in the vase before she arrives.", "place:rose:vase", "before she arrives"),
        ("Put the rose in the vase before the guests come.", "place:rose:vase", "before the guests come"),
        ("Put the cup on the tray before we leave.", "place:cup:tray", "before we leave"),
        ("Put the cup nearest to you on the shelf.", "place:cup:shelf", "nearest to you"),
        ("Pass the hammer, not the saw.", "pick:hammer", "not the saw"),
    ],
)
def test_what_is_asked_is_read_without_what_no_scene_has(text, task, said):
    plan = _plan(text)
    assert plan.task == task
    assert any(said in note for note in plan.notes)


@pytest.mark.parametrize(
    ("text", "tasks"),
    [
        ("Put both cups, the red cup and the blue one, on the tray.", ["place:red cup:tray", "place:blue cup:tray"]),
        (
            "Move both different mugs, the green mug and the white mug, to the shelf.",
            ["place:green mug:shelf", "place:white mug:shelf"],
        ),
    ],
)
def test_both_of_two_are_moved(text, tasks):
    plan = _plan(text)
    assert plan.task == chain(*tasks)
    assert not _relations(plan)


def test_raising_is_lifting():
    assert _plan("Raise the red cup.").task == "pick:red cup"
