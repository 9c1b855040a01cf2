"""A place that may be said of a thing or of what that is on: the other reading is told, or a note names the words."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.telling import tell
from tests.plan.vocabulary import steps

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "first", "otherwise"),
    [
        ("A jug on a tray behind a vase.", "tray behind vase", "A jug and a vase are on the tray. The jug is behind"),
        ("Two cans stand on a tray to the left of a jar.", "tray left_of jar", "Two cans and a jar are on the tray."),
        ("A spoon on the plate next to a fork.", "plate next_to fork", "A spoon and a fork are on the plate."),
    ],
)
def test_a_description_of_two_places_is_told_both_ways(prompt: str, first: str, otherwise: str):
    plan = PLANNER.plan(prompt)
    assert first in {str(relation) for relation in plan.relations}
    assert otherwise in plan.otherwise


@pytest.mark.parametrize(
    "prompt",
    [
        "A pear in a bowl next to a jug.",  # what is in the bowl is where the bowl is
        "A cup on a saucer next to a jug.",  # nothing else stands on the saucer
        "A fork on a plate next to a jug.",  # no jug stands on a plate
        "A jug on a table next to a chair.",  # no chair stands on a table
        "A jar is on the table. A can is on a tray next to the jar.",  # where the jar is, is said
    ],
)
def test_what_has_one_plausible_reading_is_told_once(prompt: str):
    assert not PLANNER.plan(prompt).otherwise


@pytest.mark.parametrize(
    ("prompt", "relations", "task", "notes"),
    [
        ("Put the jar on the tray, next to the can.", {"can on tray"}, "place:jar:tray",
         {'not modelled: "next to the can"'}),
        ("Put the pear in the basket, beside the other two pears.", {"pear 2 in basket", "pear 3 in basket"},
         "place:pear 1:basket", {'not modelled: "beside the other two pears"'}),
        ("Put the can that is on the box back on the shelf, behind the jar.", {"can on box", "jar on shelf"},
         "place:can:shelf", {'not modelled: "behind the jar"'}),
        ("Put the jar on the bench next to the can.", {"can on bench"}, "place:jar:bench",
         {'not modelled: "next to the can"'}),
        ("Put the pear in the bowl, next to the jug.", {"bowl next_to jug"}, "place:pear:bowl", set[str]()),
        ("Put the spoon on the plate next to the fork.", {"plate next_to fork"}, "place:spoon:plate",
         {'"next to the fork" is read as said of "the plate", not of where on it.'}),
        ("Put the spoon on the plate next to the jug.", {"plate next_to jug"}, "place:spoon:plate", set[str]()),
    ],
)  # fmt: skip
def test_a_goal_keeps_its_first_place(prompt: str, relations: set[str], task: str, notes: set[str]):
    plan = PLANNER.plan(prompt)
    assert ({str(relation) for relation in plan.relations}, plan.task, set(plan.notes)) == (relations, task, notes)


def test_a_second_place_of_what_is_made_up_is_in_the_scene():
    relations = {str(relation) for relation in PLANNER.plan("Put a jar on a tray, to the left of a can.").relations}
    assert relations == {"jar on tray", "can on tray", "jar left_of can"}


@pytest.mark.parametrize(
    ("prompt", "posed"),
    [
        ("A jug stands on the bench upside down.", {"jug"}),
        ("A can is on the crate, on its side.", {"can"}),
        ("There are two cups on a tray, upside down.", {"cup 1", "cup 2"}),
        ("A jar lies next to a can, on its side.", {"jar"}),
        ("A can lies next to a jar lying on its side.", {"jar"}),
        ("A bench with a jug upside down.", {"jug"}),
    ],
)
def test_a_posture_behind_a_place_is_of_what_stands_there(prompt: str, posed: set[str]):
    assert {posture.object for posture in PLANNER.plan(prompt).postures} == posed


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("Two crates, and a ball to the right of both.", {"ball right_of crate 1", "ball right_of crate 2"}),
        ("A jug and a can on a bench, and a spoon behind both.",
         {"jug on bench", "can on bench", "spoon on bench", "spoon behind jug", "spoon behind can"}),
        ("Two trays, and a cup on both.", {"cup 1 on tray 1", "cup 2 on tray 2"}),
    ],
)  # fmt: skip
def test_one_thing_is_beside_both_and_one_is_on_each(prompt: str, relations: set[str]):
    assert {str(relation) for relation in PLANNER.plan(prompt).relations} == relations


@pytest.mark.parametrize(
    ("prompt", "there"),
    [
        ("A radio with a ball next to it, and a jug in the corner of the bench.", ("jug",)),
        ("A jar, and a can at the edge of the table.", ("can",)),
        ("A jar and a can at the edge of the table.", ("jar", "can")),
    ],
)
def test_only_the_last_of_what_is_told_apart_is_at_the_edge(prompt: str, there: tuple[str, ...]):
    plan = PLANNER.plan(prompt)
    assert [each.objects for each in plan.arrangements] == [there]
    assert len({plan.parent(name) for name in ("jug", "radio", "jar", "can") if name in plan.tree().get("bench", ())
                or name in plan.tree().get("table", ())}) == 1  # fmt: skip


@pytest.mark.parametrize(
    ("prompt", "parent"),
    [
        ("A jug on a coaster, and a lamp in the corner of the workbench.", "workbench"),
        ("A can on a stack of two books and a clock at the edge of the desk.", "desk"),
        ("A can on a box beside a desk with a clock on the left side of it.", "ground"),
        ("A cat on a rug and a clock at the edge of the desk.", "ground"),
        ("A jug on a coaster and a clock on the desk.", "ground"),
    ],
)
def test_what_carries_something_is_on_the_table_of_its_sentence(prompt: str, parent: str):
    plan = PLANNER.plan(prompt)
    names = [obj.name for obj in plan.objects]
    assert plan.parent(next(name for name in ("coaster", "book 1", "box", "rug") if name in names)) == parent


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A kettle on the stove with a lid on it.", {"kettle on stove", "lid on kettle"}),
        ("A jug on the desk and another one on the shelf with a spoon in it.",
         {"jug 1 on desk", "jug 2 on shelf", "spoon in jug 2"}),
        ("A toolbox stands on the bench holding a wrench.", {"toolbox on bench", "wrench in toolbox"}),
        ("A can stands on a bench holding three jugs.",
         {"can on bench", "jug 1 on bench", "jug 2 on bench", "jug 3 on bench"}),
        ("A jug, a can and a ball, which is to the left of a box, are on the bench.",
         {"jug on bench", "can on bench", "ball on bench", "box on bench", "ball left_of box"}),
        ("A lid lies on the bench.", {"lid on bench"}),
    ],
)  # fmt: skip
def test_what_holds_and_what_a_relative_clause_is_of(prompt: str, relations: set[str]):
    assert {str(relation) for relation in PLANNER.plan(prompt).relations} == relations


@pytest.mark.parametrize(
    ("prompt", "relations", "tasks"),
    [
        ("Empty the crate: put the jug on the shelf.", {"jug in crate"}, ["place:jug:shelf"]),
        ("Unpack the crate: put the jug on the shelf and the can on the bench.", {"jug in crate", "can in crate"},
         ["place:jug:shelf", "place:can:bench"]),
        ("Clear the bench: put the jug on the shelf.", {"jug on bench"}, ["place:jug:shelf"]),
        ("Sort the toys: put the doll in the crate.", set[str](), ["place:doll:crate"]),
        ("Fill the crate with the jug from the basket.", {"jug in basket"}, ["place:jug:crate"]),
        ("Make a tower from the red and the blue brick, then place the green brick on it.",
         {"blue brick on red brick"}, ["place:green brick:blue brick"]),
    ],
)  # fmt: skip
def test_what_follows_says_how(prompt: str, relations: set[str], tasks: list[str]):
    plan = PLANNER.plan(prompt)
    assert {str(relation) for relation in plan.relations} == relations
    assert steps(plan) == tasks


def test_a_tower_built_first_carries_what_is_put_on_top():
    for built in ("Build a tower out of two bricks, then", "Build a tower of two bricks and"):
        relations = {str(relation) for relation in PLANNER.plan(f"{built} put a ball on top.").relations}
        assert relations == {"brick 2 on brick 1", "ball on brick 2"}


def test_what_is_poured_leaves_the_vessels_apart():
    plan = PLANNER.plan("Fill the glass with water from the jug.")
    assert plan.relations == ()
    assert any("Fill the glass with water from the jug" in note for note in plan.notes)


def test_only_the_top_of_a_stack_is_told_as_turned():
    plan = PLANNER.plan("A stack of three jugs, the top one upside down.")
    assert "The top of the three jugs is upside down." in tell(plan)


@pytest.mark.parametrize(
    ("prompt", "edge", "note"),
    [
        ("Two cans stand along the back edge of the bench.", ("can 1", "can 2"),
         'not modelled: "back" of the edge of "the bench"'),
        ("A jug close to the edge of the shelf.", ("jug",), ""),
        ("A jug near the rear left corner of the desk.", ("jug",),
         'not modelled: "rear left" of the corner of "the desk"'),
    ],
)  # fmt: skip
def test_near_an_edge_is_on_top(prompt: str, edge: tuple[str, ...], note: str):
    plan = PLANNER.plan(prompt)
    assert plan.arrangements[0].objects == edge
    assert plan.parent(edge[0]) == plan.arrangements[0].of[0]
    assert not note or note in plan.notes


@pytest.mark.parametrize(
    ("prompt", "relation"),
    [
        ("On the left of the lamp stands a jug. In front of it is a can.", "can in_front_of jug"),
        ("Behind the lamp stands a jug. In front of it is a can.", "can in_front_of lamp"),
        ("Two stools face each other across a table with a lamp on it.", "lamp on table"),
        ("A clock is at the edge of the table and a vase of flowers in the middle.", "flowers in vase"),
        ("Take the test tube out of the rack.", "test tube in test tube rack"),
    ],
)
def test_it_and_what_is_in_something(prompt: str, relation: str):
    assert relation in {str(each) for each in PLANNER.plan(prompt).relations}


@pytest.mark.parametrize(
    ("prompt", "relation", "task"),
    [
        ("Put the spoon in the cup that is next to the plate.", "cup next_to plate", "place:spoon:cup"),
        ("Put the pen in the mug which is behind the book.", "mug behind book", "place:pen:mug"),
        ("Put the spoon in the cup that is on the saucer.", "cup on saucer", "place:spoon:cup"),
        ("Take the pen and put it in the mug that is between the book and the jar.", "book left_of mug",
         "place:pen:mug"),
        ("Put the red block on the blue block, which is next to the green one.", "blue block next_to green block",
         "place:red block:blue block"),
        ("Put the red block on the block to the left of the yellow one.", "block left_of yellow block",
         "place:red block:block"),
    ],
)  # fmt: skip
def test_what_tells_which_one_the_goal_is_is_said_of_the_goal(prompt, relation, task):
    plan = PLANNER.plan(prompt)
    assert plan.task == task
    assert relation in map(str, plan.relations)
    assert not any("not modelled" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "row"),
    [
        ("A pen in a cup, a bowl and a jar stand in a row on a table.", ("cup", "bowl", "jar")),
        ("A red cube on a blue cube, a green cube and a yellow cube in a row.",
         ("blue cube", "green cube", "yellow cube")),
        ("A desk with a monitor and three pens in a row.", ("pen 1", "pen 2", "pen 3")),
        ("A table with a lamp, a plant in a pot and four books in a row.", ("book 1", "book 2", "book 3", "book 4")),
        ("A bowl, a plate with a fork, and a cup in a row.", ("bowl", "plate", "cup")),
    ],
)  # fmt: skip
def test_a_row_is_of_what_stands_beside_each_other(prompt, row):
    plan = PLANNER.plan(prompt)
    assert [each.objects for each in plan.arrangements if each.kind == "row"] == [row]
    assert "lamp in flower pot" not in map(str, plan.relations)
