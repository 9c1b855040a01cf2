"""Of what is said of several things, of chains of places and of requests: a wrong plan is noted, a true one is not."""

from __future__ import annotations

import pytest

from pat3d.plan.audit.auditor import audited
from pat3d.plan.scene_plan import PlannedObject, Posture, ScenePlan
from pat3d.scene.relations import Relation
from tests.plan.vocabulary import Table

TABLE = Table()
KINDS = ("on", "in", "next_to", "left_of", "right_of", "behind", "in_front_of")


def find(name: str) -> str | None:
    known = TABLE.find(name)
    return None if known is None else known.noun


def plan(prompt: str, objects: str, edges: str = "", *, task: str | None = None, turned: str = "") -> ScenePlan:
    """A plan of objects written "mug 1=two mugs=red; table=a table" and edges written "mug 1 on table; ..."."""
    made = []
    for each in objects.split("; "):
        name, phrase, *colours = each.split("=")
        noun = " ".join(word for word in name.split() if not word.isdigit() and word not in colours)
        made.append(PlannedObject(name=name, noun=noun, phrase=phrase, colours=tuple(colours)))
    relations = []
    for edge in filter(None, edges.split("; ")):
        kind = next(word for word in edge.split() if word in KINDS)
        child, parent = edge.split(f" {kind} ")
        relations.append(Relation(child=child, kind=kind, parent=parent))  # type: ignore[arg-type]
    postures = tuple(Posture(object=name, kind="upside_down", said="upside down", arranged=True)
                     for name in filter(None, turned.split("; ")))  # fmt: skip
    return ScenePlan(
        prompt=prompt, objects=tuple(made), relations=tuple(relations), task=task, postures=postures
    )  # fmt: skip


def notes(told: ScenePlan) -> tuple[str, ...]:
    return audited(told, find, ("table", "shelf", "bench")).notes


BOXES = "box 1=Both boxes; box 2=Both boxes; ball 1=a ball"
CUPS = "cup 1=Three cups; cup 2=Three cups; cup 3=Three cups"


@pytest.mark.parametrize(
    ("prompt", "objects", "wrong", "said", "more", "right"),
    [
        ("Both boxes hold a ball.", BOXES, "ball 1 in box 1", "1 of them have it", "; ball 2=a ball",
         "ball 1 in box 1; ball 2 in box 2"),
        ("A cup stands behind the bowl, left of the vase, and next to the box.",
         "cup=A cup; bowl=the bowl; vase=the vase; box=the box",
         "cup behind bowl; bowl left_of vase; cup next_to box", '"left of the vase" is read as said of "bowl"', "",
         "cup behind bowl; cup left_of vase; cup next_to box"),
        ("On the table next to the vase lies a spoon.", "table=the table; vase=the vase; spoon=a spoon",
         "spoon on table; table next_to vase", '"next to the vase" is read as said of "table"', "",
         "spoon on table; vase on table; spoon next_to vase"),
        ("A table on which there is a book on which a cup stands.", "table=A table; book=a book; cup=a cup",
         "book on table; cup on table", '"cup" is not read as there', "", "book on table; cup on book"),
        ("The first of three boxes holds a ball, and the other two boxes hold a cup.",
         "box 1=three boxes; box 2=three boxes; box 3=three boxes; ball=a ball; cup 1=a cup; cup 2=a cup",
         "ball in box 1; cup 1 in box 4; cup 2 in box 5", "there are 5, not 3",
         "; box 4=the other two boxes; box 5=the other two boxes", ""),
        ("A box with a ball, two cups and a spoon inside.",
         "box=A box; ball=a ball; cup 1=two cups; cup 2=two cups; spoon=a spoon",
         "spoon in box; cup 1 next_to box; cup 2 next_to box; ball next_to box", '"inside" of "ball"', "",
         "ball in box; cup 1 in box; cup 2 in box; spoon in box"),
        ("A lamp is to the left of the vase and a book to the right of it.", "lamp=A lamp; vase=the vase; book=a book",
         "lamp left_of vase; book right_of lamp", '"it" is not read as "vase"', "",
         "lamp left_of vase; book right_of vase"),
        ("A plate with an apple and a lamp next to it.", "plate=A plate; apple=an apple; lamp=a lamp",
         "apple next_to plate; lamp next_to plate", 'said of "apple" too', "", "apple on plate; lamp next_to plate"),
    ],
)  # fmt: skip
def test_what_is_said_of_each_of_several_is_had_by_each(prompt, objects, wrong, said, more, right):
    assert any(said in note for note in notes(plan(prompt, objects + more * ("box 4" in wrong), wrong)))
    if right:
        assert not notes(plan(prompt, objects + more, right))


@pytest.mark.parametrize(
    ("prompt", "objects", "said"),
    [
        ("Put the ball in left box and the spoon in right box.", "ball=the ball; box=left box; spoon=the spoon",
         '"left box" and "right box" are read as one'),
        ("Some apples are red, the rest are green.", "apple 1=Some apples=red=green; apple 2=Some apples=red=green",
         '"red and green" of "Some apples"'),
        ("Four cups: two red, two blue.", "cup 1=Four cups=red; cup 2=Four cups=red; cup 3=Four cups=red; "
         "cup 4=Four cups=blue", '"red" of "cup", of which there are 3'),
        ("Every cup but one is red.", "cup 1=Every cup=red", '"but one"'),
        ("A cup, a ball and a spoon are on a table. They are stacked.", "cup=A cup; ball=a ball; spoon=a spoon; "
         "table=a table", 'not as said: "stacked"'),
        ("Three cups: a red one, a blue one and a green one.", "cup 1=a red one=red; cup 2=a blue one=blue; "
         "cup 3=a green one=green; cup 4=Three cups", '"cups", of which there are 4'),
        ("There are two boxes on a table. A ball is in a box.", "box 1=two boxes; box 2=two boxes; box 3=a box; "
         "table=a table; ball=A ball", '"a box" is read as one more than "two boxes"'),
    ],
)  # fmt: skip
def test_what_is_counted_or_told_apart_otherwise_is_noted(prompt, objects, said):
    assert any(said in note for note in notes(plan(prompt, objects)))


def test_what_all_of_several_are_turned_is_turned():
    some, whole = ("cup 1", "cup 1; cup 2; cup 3")
    prompt = "Three cups on a table, all upside down."
    edges = "; ".join(f"cup {n} on table" for n in (1, 2, 3))
    told = notes(plan(prompt, f"{CUPS}; table=a table", edges, turned=some))
    assert any("1 of 3 are" in note for note in told)
    assert not notes(plan(prompt, f"{CUPS}; table=a table", edges, turned=whole))


@pytest.mark.parametrize(
    ("prompt", "objects", "edges", "task", "said"),
    [
        ("A cup and a bowl are on a table. Put them in the box.", "cup=A cup; bowl=a bowl; table=a table; box=the box",
         "cup on table; bowl on table", "place:cup:box", '"them" is not read as said of "bowl"'),
        ("A cup is on a table. A bowl is on a shelf. Put them in the box.",
         "cup=A cup; bowl=A bowl; table=a table; shelf=a shelf; box=the box", "cup on table; bowl on shelf",
         "place:bowl:box", '"them" is read as "bowl" alone'),
        ("Take the bowl to the table.", "bowl=the bowl; table=the table", "bowl on table", "pick:bowl",
         "it is there already"),
        ("Put the red cup in the box and the blue one on the shelf.",
         "red cup=the red cup=red; box=the box; blue cup=the blue one=blue; shelf=the shelf", "blue cup on shelf",
         "place:red cup:box", '"the blue one on the shelf" is read as where it is before the task'),
        ("Put the cup in the box, then the bowl.", "cup=the cup; box=the box; bowl=the bowl", "", "place:cup:box",
         '"the bowl" is in no task'),
        ("Empty the box.", "box=the box", "", "unload:box", "what is in it is not said"),
        ("Take a ball from each of the two boxes.",
         "ball 1=a ball; ball 2=a ball; box 1=the two boxes; box 2=the two boxes", "ball 1 in box 1; ball 2 in box 2",
         "pick:ball 1", "the task moves one thing"),
    ],
)  # fmt: skip
def test_what_is_asked_and_is_no_task_is_noted(prompt, objects, edges, task, said):
    assert any(said in note for note in notes(plan(prompt, objects, edges, task=task)))


def test_a_request_whose_goal_is_open_is_not_noted():
    told = plan("Put the cup on the table in the box.", "cup=the cup; table=the table; box=the box", "cup on table",
                task="place:cup:box")  # fmt: skip
    assert not notes(told)
    turned = plan("Pick up the upside down cup.", "cup=the upside down cup", task="pick:cup", turned="cup")
    assert not [note for note in notes(turned) if "before the task" in note]


def test_how_something_stands_after_the_task_is_not_how_it_stands_before():
    told = plan("Put the cup upside down in the box.", "cup=the cup; box=the box", task="place:cup:box", turned="cup")
    assert '"upside down" of "cup" is read as how it stands before the task' in notes(told)


def test_of_a_list_of_which_one_is_nowhere_it_is_said_what_is_not_read_of_it():
    prompt, edges = (
        "A cup stands next to a bowl and a vase on a table.",
        "cup next_to bowl; cup on table; bowl on table",
    )
    told = notes(plan(prompt, "cup=A cup; bowl=a bowl; vase=a vase; table=a table", edges))
    assert any('"a vase"' in note for note in told)
