"""Requests in everyday words: what is asked for, what it takes for granted before it, and what it leaves alone."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def _told(plan: ScenePlan) -> set[str]:
    return {str(relation) for relation in plan.relations}


def _tasks(plan: ScenePlan) -> str:
    """The task of `plan`, or those of which it has several."""
    several = next((note for note in plan.notes if note.startswith("the instruction is several tasks")), "")
    return plan.task or several.rpartition(": ")[2].rstrip(".")


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("Unstack the three cups and place them side by side.", {"cup 2 on cup 1", "cup 3 on cup 2"}),
        (
            "Three bowls are on the counter. Unstack them.",
            {"bowl 1 on counter", "bowl 2 on bowl 1", "bowl 3 on bowl 2"},
        ),
        ("Unstack the red block and the blue block.", {"blue block on red block"}),
        ("The red block is on the blue block. Unstack the two blocks.", {"red block on blue block"}),
    ],
)
def test_what_is_unstacked_was_stacked(prompt: str, relations: set[str]):
    assert _told(PLANNER.plan(prompt)) == relations


@pytest.mark.parametrize(
    ("prompt", "postures"),
    [
        ("Stand the bottle upright.", {"bottle": "on_its_side"}),
        ("Stand up the two bottles.", {"bottle 1": "on_its_side", "bottle 2": "on_its_side"}),
        ("Set the chair upright.", {"chair": "on_its_side"}),
        ("Turn the mug right side up.", {"mug": "upside_down"}),
        ("Turn the bowl the right way up.", {"bowl": "upside_down"}),
        ("The bottle is upside down. Turn it upright.", {"bottle": "upside_down"}),
        ("Turn the glass upside down and set it on the napkin.", {}),
        ("Tip the mug onto its side.", {}),
        ("Lay the bottle on its side.", {}),
        ("Pick up the mug lying on its side.", {"mug": "on_its_side"}),
        ("Stand the book upright on the shelf.", {}),
    ],
)
def test_a_thing_is_not_yet_turned_as_it_is_to_be(prompt: str, postures: dict[str, str]):
    assert {each.object: each.kind for each in PLANNER.plan(prompt).postures} == postures


@pytest.mark.parametrize(
    ("prompt", "relations", "tasks"),
    [
        ("Make a tower out of the three cubes.", set[str](), "stack:cube 2:cube 1, stack:cube 3:cube 2"),
        ("Build a tower from the three cubes.", set[str](), "stack:cube 2:cube 1, stack:cube 3:cube 2"),
        ("There are two books on the desk. Make a stack of them.", {"book 1 on desk", "book 2 on desk"},
         "stack:book 1:book 2"),
        ("Build a tower with the red cube at the bottom and the blue cube on top.", set[str](),
         "place:blue cube:red cube"),
        ("Build a tower with the red cube at the bottom, the green cube in the middle and the blue cube on top.",
         set[str](), "stack:green cube:red cube, stack:blue cube:green cube"),
        ("Build a tower of three cubes.", {"cube 2 on cube 1", "cube 3 on cube 2"}, ""),
        ("Build a tower with a red cube at the bottom and a blue cube on top.", {"blue cube on red cube"}, ""),
        ("Make a tower from the red and the blue brick and place the green brick on it.", {"blue brick on red brick"},
         "place:green brick:blue brick"),
    ],
)  # fmt: skip
def test_a_tower_of_what_is_there_is_to_be_built(prompt: str, relations: set[str], tasks: str):
    plan = PLANNER.plan(prompt)
    assert _told(plan) == relations
    assert _tasks(plan).replace("stack:blue cube:red cube", "place:blue cube:red cube") == tasks


@pytest.mark.parametrize(
    ("prompt", "objects", "task", "aside"),
    [
        ("Without touching the vase, pick up the key behind it.", {"vase", "key"}, "pick:key", "Without touching"),
        ("Without lifting it, push the box to the left.", {"box"}, None, "Without lifting it"),
        ("Without knocking over the jar, take the cup.", {"jar", "cup"}, "pick:cup", "Without knocking over the jar"),
        ("After dinner, put the cup in the sink.", {"cup", "sink"}, "place:cup:sink", "After dinner"),
        ("Before you open the box, move the cup to the tray.", {"box", "cup", "tray"}, "place:cup:tray",
         "Before you open the box"),
    ],
)  # fmt: skip
def test_what_stands_before_the_instruction_is_named(prompt: str, objects: set[str], task: str | None, aside: str):
    plan = PLANNER.plan(prompt)
    assert {obj.name for obj in plan.objects} == objects
    assert plan.task == task
    assert any(aside in note for note in plan.notes)


def test_what_is_done_after_something_is_done_after_it():
    plan = PLANNER.plan("After putting the cup on the tray, put the spoon in the bowl.")
    assert _tasks(plan) == "place:cup:tray, place:spoon:bowl"


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("Would you mind putting the cup back on the tray?", "place:cup:tray"),
        ("I'd like you to put the cup on the tray.", "place:cup:tray"),
        ("I need you to move the cup to the tray.", "place:cup:tray"),
        ("Hey, could you put the cup on the tray?", "place:cup:tray"),
        ("Could the cup go on the tray?", "place:cup:tray"),
        ("Gently lower the cup onto the tray.", "place:cup:tray"),
        ("Slip the letter into the box.", "place:letter:box"),
        ("Tuck the pillow behind the chair.", None),
        ("Place the book so that it leans against the vase.", None),
        ("Let the ball roll into the bucket.", None),
    ],
)
def test_the_goal_is_not_there_before_however_it_is_asked_for(prompt: str, task: str | None):
    plan = PLANNER.plan(prompt)
    assert (plan.task, _told(plan)) == (task, set[str]())
    assert len(plan.objects) == 2


def test_room_is_made_where_the_thing_is():
    plan = PLANNER.plan("Make room on the tray by moving the glass to the coaster.")
    assert (_told(plan), plan.task) == ({"glass on tray"}, "place:glass:coaster")


@pytest.mark.parametrize(
    ("prompt", "relations", "task"),
    [
        ("Remove the top cup from the stack of cups.", {"cup 2 on cup 1", "cup 3 on cup 2", "cup 4 on cup 3"},
         "pick:cup 4"),
        ("Remove the top book from the stack of three books on the shelf.",
         {"book 1 on shelf", "book 2 on book 1", "book 3 on book 2"}, "pick:book 3"),
        ("A stack of three books is on the desk. Take the top book off the stack.",
         {"book 1 on desk", "book 2 on book 1", "book 3 on book 2"}, "pick:book 3"),
        ("A stack of three books is on the desk. Take the bottom book of the stack.",
         {"book 1 on desk", "book 2 on book 1", "book 3 on book 2"}, "pick:book 1"),
    ],
)  # fmt: skip
def test_the_top_one_is_of_the_stack(prompt: str, relations: set[str], task: str):
    plan = PLANNER.plan(prompt)
    assert (_told(plan), plan.task) == (relations, task)


@pytest.mark.parametrize(
    ("prompt", "objects", "tasks"),
    [
        ("There are a cup, a ball and a pen on the table. Put everything except the cup in the box.",
         {"cup", "ball", "pen", "table", "box"}, "place:ball:box, place:pen:box"),
        ("There are a cup, a ball and a pen on the table. Put all of them but the cup in the box.",
         {"cup", "ball", "pen", "table", "box"}, "place:ball:box, place:pen:box"),
        ("A doll, a robot and a ball are on a rug. Put all the toys but the robot in the crate.",
         {"doll", "robot", "ball", "rug", "crate"}, "place:doll:crate, place:ball:crate"),
        ("There are a red cup, a blue cup and a green cup on the table. Put all the cups except the blue cup on the "
         "tray.", {"red cup", "blue cup", "green cup", "table", "tray"}, "place:red cup:tray, place:green cup:tray"),
        ("Clear the table except for the candle.", {"table", "candle"}, ""),
        ("A mug, a bowl and a vase stand on the shelf. Take down everything but the vase.",
         {"mug", "bowl", "vase", "shelf"}, ""),
        ("There's a banana, an orange and a hammer on the table. Put the fruit in the bowl.",
         {"banana", "orange", "hammer", "table", "bowl"}, "place:banana:bowl, place:orange:bowl"),
        ("A hammer, a saw and a mug are on the bench. Put the tools in the crate.",
         {"hammer", "saw", "mug", "bench", "crate"}, "place:hammer:crate, place:saw:crate"),
        ("A cup and a tray stand on the table. Put the fruit on the tray.", {"cup", "tray", "table", "apple"},
         "place:apple:tray"),
    ],
)  # fmt: skip
def test_all_of_a_kind_but_what_is_excepted(prompt: str, objects: set[str], tasks: str):
    plan = PLANNER.plan(prompt)
    assert {obj.name for obj in plan.objects} == objects
    assert _tasks(plan) == tasks


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("There is a red cup and a blue mug on the desk. Pick up the one on the right.", "pick:blue mug"),
        ("A red cup is to the left of a blue cup. Pick up the one on the right.", "pick:blue cup"),
        ("A red cup is to the right of a blue cup. Pick up the right one.", "pick:red cup"),
        ("A cup, a jar and a bottle stand on the table. Put the middle one on the tray.", "place:jar:tray"),
        ("A pen lies next to a ruler. Pick up the one on the left.", "pick:pen"),
        ("There are a tall vase and a short vase on the table. Pick up the shorter one.", "pick:vase 2"),
        ("There are a tall vase and a short vase on the table. Pick up the taller vase.", "pick:vase 1"),
        ("There's a cup on the book and a cup on the box. Take the cup that's on the book.", "pick:cup 1"),
        ("There's a cup on the book and a cup on the box. Put the cup that is on the box on the tray.",
         "place:cup 2:tray"),
        ("There is a ball next to a box. Put it in.", "place:ball:box"),
    ],
)  # fmt: skip
def test_the_one_that_is_meant(prompt: str, task: str):
    assert PLANNER.plan(prompt).task == task


def test_the_one_on_the_right_has_the_other_on_its_left():
    plan = PLANNER.plan("A pen lies next to a ruler. Pick up the one on the left.")
    assert _told(plan) == {"pen left_of ruler"}
    plan = PLANNER.plan("A mug is on the table and a bowl is on the shelf. Take the left one.")
    assert any("the left one" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "count", "tasks"),
    [
        ("There are three apples on the table. Put one apple in the bowl and two in the box.", 3,
         "place:apple 1:bowl, place:apple 2:box, place:apple 3:box"),
        ("There are three apples on the table. Put two apples in the bowl.", 3,
         "place:apple 1:bowl, place:apple 2:bowl"),
        ("There are two apples on the table. Put two apples in the bowl.", 2,
         "place:apple 1:bowl, place:apple 2:bowl"),
    ],
)  # fmt: skip
def test_some_are_of_those_that_are_there(prompt: str, count: int, tasks: str):
    plan = PLANNER.plan(prompt)
    assert sum(obj.noun == "apple" for obj in plan.objects) == count
    assert _tasks(plan) == tasks


@pytest.mark.parametrize(
    ("prompt", "tasks"),
    [
        ("There are four apples on the counter. Put three of the apples in the basket.",
         "place:apple 1:basket, place:apple 2:basket, place:apple 3:basket"),
        ("There are four apples on the counter. Put all but one of the apples in the basket.",
         "place:apple 1:basket, place:apple 2:basket, place:apple 3:basket"),
        ("There are four apples on the table. Put two of the apples in the bowl and one of the apples in the box.",
         "place:apple 1:bowl, place:apple 2:bowl, place:apple 3:box"),
        ("Put two apples in the bowl. There are four apples on the table.",
         "place:apple 1:bowl, place:apple 2:bowl"),
    ],
)  # fmt: skip
def test_as_many_of_the_apples_are_moved_as_is_said(prompt: str, tasks: str):
    plan = PLANNER.plan(prompt)
    assert sum(obj.noun == "apple" for obj in plan.objects) == 4
    assert _tasks(plan) == tasks


def test_one_from_each_is_of_those_on_it():
    plan = PLANNER.plan("There are three plates with two cookies each. Take a cookie from each plate.")
    assert sum(obj.noun == "cookie" for obj in plan.objects) == 6


def test_some_and_another_of_them_are_different_ones():
    plan = PLANNER.plan("There are four apples. Three of the apples are in a bowl and one of the apples is on a plate.")
    assert _told(plan) == {"apple 1 in bowl", "apple 2 in bowl", "apple 3 in bowl", "apple 4 on plate"}


@pytest.mark.parametrize(
    ("prompt", "relations", "task"),
    [
        ("Put the cup on the tray. There is a cup on the shelf.", {"cup on shelf"}, "place:cup:tray"),
        ("There is nothing on the tray. Put the teapot on it.", set[str](), "place:teapot:tray"),
        ("Leave the book on the table but take the pen that is lying on it.", {"book on table", "pen on book"},
         "pick:pen"),
        ("Check whether the kettle is empty and then put it on the stove.", set[str](), "place:kettle:stove"),
        ("Get rid of the two cans on the desk.", {"can 1 on desk", "can 2 on desk"}, None),
    ],
)  # fmt: skip
def test_what_is_there_before(prompt: str, relations: set[str], task: str | None):
    plan = PLANNER.plan(prompt)
    assert (_told(plan), plan.task) == (relations, task)


@pytest.mark.parametrize(
    "prompt",
    [
        "Wrap the scarf around the snowman.",
        "Tie the rope around the tree.",
        "Roll the ball under the table.",
        "Kick the ball behind the sofa.",
        "Squeeze the book between the two bins.",
        "Park the toy car next to the box.",
        "Nest the small bowl inside the big bowl.",
        "Dip the brush in the bucket.",
    ],
)
def test_where_a_deed_leads_is_not_where_the_thing_is_before(prompt: str):
    plan = PLANNER.plan(prompt)
    assert (_told(plan), plan.arrangements) == (set(), ())
    assert plan.task is not None or any(prompt.rstrip(".") in note for note in plan.notes)


@pytest.mark.parametrize(
    "prompt",
    [
        "Put each cube in the bowl of its own colour.",
        "Put each cube into the bowl that matches its color.",
        "Put the cubes in the bowls of the same colour.",
        "Put the cubes into the matching bowls.",
    ],
)
def test_each_goes_to_what_has_its_colour(prompt: str):
    plan = PLANNER.plan(f"There are a red cube, a green cube, a red bowl and a green bowl. {prompt}")
    assert {obj.name for obj in plan.objects} == {"red cube", "green cube", "red bowl", "green bowl"}
    assert _tasks(plan) == "place:red cube:red bowl, place:green cube:green bowl"


@pytest.mark.parametrize(
    ("prompt", "turned"),
    [
        ("There are a red, a green and a blue cup upside down on the table.", {"red cup", "green cup", "blue cup"}),
        ("There is a red cup and a blue cup upside down on the table.", {"blue cup"}),
    ],
)
def test_a_posture_is_of_all_that_share_the_noun(prompt: str, turned: set[str]):
    assert {each.object for each in PLANNER.plan(prompt).postures} == turned


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("Pick up the plant please", "pick:plant"),
        ("Put the cup on the tray please.", "place:cup:tray"),
        ("Could you put the pen in the mug please?", "place:pen:mug"),
    ],
)
def test_please_may_stand_last(prompt: str, task: str):
    plan = PLANNER.plan(prompt)
    assert (plan.task, plan.notes) == (task, ())
