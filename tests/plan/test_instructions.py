"""An instruction makes the scene before it, and its task."""

import pytest

from pat3d.envs.tasks.registry import parse_task
from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import chain

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "before", "task"),
    [
        ("put the soup in the basket", set(), "place:tomato soup:basket"),
        ("Stack the blue cube on the yellow one.", set(), "stack:blue cube:yellow cube"),
        ("Pick up the red mug.", set(), "pick:red mug"),
        ("Take the apple out of the bowl and put it on the plate.", {"apple in bowl"}, "place:apple:plate"),
        ("Put the red cup on the tray on the table", {"tray on table"}, "place:red cup:tray"),
        ("Put the apple on the table on the plate", {"apple on table"}, "place:apple:plate"),
        ("Pick up the marker from the table and put it in the mug.", {"marker on table"}, "place:marker:mug"),
        ("Could you please move the orange to the white plate?", set(), "place:orange:white plate"),
        ("Use the left arm to grab the shoe and place it on the mat.", set(), "place:shoe:mat"),
        ("The robot should put the spoon inside the mug.", set(), "place:spoon:mug"),
        ("unload the dish rack", set(), "unload:dish rack"),
        ("A mug is on a table. Put the mug on the tray.", {"mug on table"}, "place:mug:tray"),
    ],
)
def test_the_scene_before_and_the_task(prompt: str, before: set[str], task: str):
    plan = PLANNER.plan(prompt)
    assert {str(relation) for relation in plan.relations} == before
    assert plan.task == task
    assert parse_task(task).spec == task


@pytest.mark.parametrize(
    ("prompt", "note"),
    [
        ("open the wardrobe", 'not modelled: "open the wardrobe": no task does that.'),
        ("Slide the mug towards the bowl.", 'not modelled: "Slide the mug towards the bowl": no task does that.'),
        ("put the mug far from the bowl", 'not modelled: "put the mug far from the bowl": no task does that.'),
        ("close the laptop", 'not modelled: "close the laptop": no task does that.'),
    ],
)  # fmt: skip
def test_what_no_task_does_is_noted(prompt: str, note: str):
    plan = PLANNER.plan(prompt)
    assert plan.task is None
    assert note in plan.notes
    assert plan.relations == ()


@pytest.mark.parametrize(
    ("prompt", "task", "notes"),
    [
        ("put both the soup and the sauce in the basket",
         chain("place:tomato soup:basket", "place:tomato sauce:basket"), ()),
        ("put the mug behind the bowl", "beside:mug:behind:bowl", ()),
        ("Slide the mug closer to the bowl.", "beside:mug:next_to:bowl", ('not modelled: "closer"',)),
    ],
)  # fmt: skip
def test_what_takes_several_steps_or_is_beside_something_is_a_task(prompt: str, task: str, notes: tuple[str, ...]):
    plan = PLANNER.plan(prompt)
    assert (plan.task, plan.relations) == (task, ())
    assert tuple(note for note in plan.notes if "is made as" not in note) == notes


def test_what_is_there_already_is_no_task():
    plan = PLANNER.plan("A mug is on a tray. Put the mug on the tray.")
    assert plan.task is None
    assert 'not modelled: "Put the mug on the tray": no task does that.' in plan.notes


def test_opening_the_door_of_a_cabinet_is_a_step_and_of_an_oven_a_note():
    plan = PLANNER.plan("open the left door of the cabinet and put the bowl in it")
    assert plan.task == "chain:open:cabinet door:then:place:bowl:cabinet"
    assert 'not modelled: "left" of "the left door of the cabinet"' in plan.notes
    plan = PLANNER.plan("open the door of the oven and put the bowl in it")
    assert plan.task == "place:bowl:oven"
    assert 'not modelled: "open the door of the oven": no task does that.' in plan.notes


def test_what_is_told_of_indefinite_things_is_the_scene_to_make():
    plan = PLANNER.plan("Put two mugs on a shelf.")
    assert {str(relation) for relation in plan.relations} == {"mug 1 on shelf", "mug 2 on shelf"}
    assert plan.task is None
    assert any("is read as the scene to make" in note for note in plan.notes)


@pytest.mark.parametrize(
    "prompt", ["an open box on a desk", "a stack of plates", "a set of three mugs", "a close-up of a mug on a tray"]
)
def test_what_only_looks_like_an_instruction_describes(prompt: str):
    plan = PLANNER.plan(prompt)
    assert plan.task is None
    assert not any("no task" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "objects", "task", "noted"),
    [
        ("Use the towel to dry the pan on the stove.", "towel, pan, stove", None, "to dry the pan on the stove"),
        ("Gently press the kettle.", "kettle", None, "Gently press the kettle"),
        ("Put the lid on the pot to keep the soup warm.", "lid, pot", "place:lid:pot", "to keep the soup warm"),
        ("Grab the mug, walk to the counter, and put it on the tray.", "mug, counter, tray", "place:mug:tray",
         "walk to the counter"),
        ("Peel a banana to put it in the blender.", "banana, blender", "place:banana:blender", "Peel a banana"),
        ("From the shelf grab the red mug.", "red mug, shelf", "pick:red mug", ""),
        ("Give the brush to me.", "brush", "pick:brush", ""),
        ("Put the spoon in the cup and stir.", "spoon, cup", "place:spoon:cup", "stir"),
        ("Don't touch the vase; pick up the candle.", "vase, candle", "pick:candle", "Don't touch the vase"),
        ("To move the pear to the plate.", "pear, plate", "place:pear:plate", ""),
        ("After that, move the pear to the plate.", "pear, plate", "place:pear:plate", ""),
        ("Close the oven after placing the spoon inside the box.", "spoon, box, oven", "place:spoon:box",
         "Close the oven"),
    ],
)  # fmt: skip
def test_deeds_that_no_task_does_are_named_and_the_rest_is_read(sentence, objects, task, noted):
    plan = PLANNER.plan(sentence)
    assert (", ".join(obj.name for obj in plan.objects), plan.task) == (objects, task)
    assert any(noted in note for note in plan.notes) or not noted


@pytest.mark.parametrize(
    ("prompt", "task", "undone"),
    [
        ("Rinse the plum in the sink, take the plum out of the sink.", "pick:plum", "Rinse the plum in the sink"),
        ("Heat the soup, remove it from the stove.", "pick:tomato soup", "Heat the soup"),
    ],
)
def test_what_is_picked_after_something_no_task_does_is_the_task(prompt: str, task: str, undone: str):
    plan = PLANNER.plan(prompt)
    assert plan.task == task
    assert f'not modelled: "{undone}": no task does that.' in plan.notes


def test_what_is_picked_before_something_no_task_does_is_the_task():
    plan = PLANNER.plan("Take the plum and rinse it.")
    assert plan.task == "pick:plum"
    assert any("rinse" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("Put an apple in a basket and set the basket next to a vase.", {"apple in basket", "basket next_to vase"}),
        ("Place a mug on a tray. Put the tray to the left of a lamp.", {"mug on tray", "tray left_of lamp"}),
    ],
)
def test_what_a_scene_was_made_of_is_set_beside_something_in_it(prompt: str, relations: set[str]):
    plan = PLANNER.plan(prompt)
    assert {str(relation) for relation in plan.relations} == relations
    assert plan.task is None


def test_what_the_prompt_only_speaks_of_is_not_set_beside_anything():
    plan = PLANNER.plan("Put the apple in the basket and set the basket next to the vase.")
    assert (plan.task, plan.relations) == (chain("place:apple:basket", "beside:basket:next_to:vase"), ())
    assert plan.notes == ()
