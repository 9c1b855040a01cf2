"""What a plan decides where its sentence is silent, or says of each, is told: true plans are left alone."""

from dataclasses import replace

import pytest

from pat3d.plan.audit.auditor import audited
from pat3d.plan.scene_plan import Arrangement, PlannedObject, ScenePlan
from pat3d.scene.relations import Relation
from tests.plan.vocabulary import Table

TABLE = Table()


def find(name: str) -> str | None:
    known = TABLE.find(name)
    return None if known is None else known.noun


def plan(prompt: str, phrases: dict[str, str], *edges: str, arrangements: tuple[Arrangement, ...] = ()) -> ScenePlan:
    """A plan of objects by name and phrase, and edges written "mug 1 on table"."""
    made = [PlannedObject(name=name, noun=name.rstrip(" 0123456789"), phrase=said) for name, said in phrases.items()]
    relations = []
    for edge in edges:
        kind = next(word for word in edge.split() if word in ("on", "in", "next_to", "left_of", "right_of", "behind"))
        child, parent = edge.split(f" {kind} ")
        relations.append(Relation(child=child, kind=kind, parent=parent))  # type: ignore[arg-type]
    return ScenePlan(
        prompt=prompt, objects=tuple(made), relations=tuple(relations), arrangements=arrangements
    )  # fmt: skip


def notes(told: ScenePlan) -> tuple[str, ...]:
    return audited(told, find, ("table", "shelf", "bench")).notes


EGGS = {"cup 1": "Three cups", "cup 2": "Three cups", "cup 3": "Three cups", "box": "a box"}


def test_likes_of_which_some_are_somewhere_and_the_rest_nowhere_are_said():
    told = plan("Three cups, two of them red, in a box.", EGGS, "cup 1 in box", "cup 2 in box")
    assert any('"Three cups": 1 of 3: where they are is not said' in note for note in notes(told))
    whole = replace(told, relations=(*told.relations, Relation(child="cup 3", kind="in", parent="box")))
    assert not any("where" in note for note in notes(whole))


def test_a_stack_stands_where_its_lowest_stands():
    told = plan("Three stacked cups next to a box.", {**EGGS, **dict.fromkeys(("cup 1", "cup 2", "cup 3"), "cups")},
                "cup 2 on cup 1", "cup 3 on cup 2", "cup 1 next_to box")  # fmt: skip
    assert notes(told) == ()


def test_what_is_listed_with_something_that_is_somewhere_and_is_nowhere_itself_is_said():
    told = plan("A mug and a cup stand on a box.", {"mug": "A mug", "cup": "a cup", "box": "a box"}, "cup on box")
    assert notes(told) == ('"A mug": where is not said; on the ground',)
    apart = plan("A mug and a box with a cup.", {"mug": "A mug", "cup": "a cup", "box": "a box"}, "cup in box")
    assert notes(apart) == ()


def test_likes_that_stand_on_different_things_without_a_word_for_it_are_said():
    phrases = {"cup 1": "the cups", "cup 2": "the cups", "table": "The table", "shelf": "the shelf"}
    edges = ("cup 1 on table", "cup 2 on shelf")
    told = plan("The table and the shelf hold the cups.", phrases, *edges)
    assert any("shared out" in note for note in notes(told))
    assert not any("shared out" in note for note in notes(replace(told, prompt="One of the cups is on the table, the "
                                                                  "other on the shelf.")))  # fmt: skip


@pytest.mark.parametrize(
    ("prompt", "wanted"),
    [
        ("Two tables, each holding a cup.", 2),
        ("Each of the two tables holds a cup.", 2),
        ("A cup is on each of two tables.", 2),
        ("Two tables with a cup at either end.", 2),
        ("A cup at each corner of one of two tables.", 4),
    ],
)
def test_fewer_than_each_wants_are_said(prompt: str, wanted: int):
    phrases = {"table 1": "tables", "table 2": "tables", **{f"cup {n}": "a cup" for n in range(1, wanted)}}
    few = plan(prompt, phrases, *(f"cup {n} on table {1 + n % 2}" for n in range(1, wanted)))
    assert any(f'wants {wanted} of "cup"; there are {wanted - 1}' in note for note in notes(few))
    phrases = {**phrases, f"cup {wanted}": "a cup"}
    enough = plan(prompt, phrases, *(f"cup {n} on table {1 + n % 2}" for n in range(1, wanted + 1)))
    assert not any("wants" in note for note in notes(enough))


def test_what_is_without_something_does_not_have_it():
    phrases = {"cup 1": "The cup", "cup 2": "the cup", "box": "a box", "mug": "a mug"}
    prompt = "The cup with a mug in it is on a box, the cup without one is beside it."
    right = plan(prompt, phrases, "cup 1 on box", "mug in cup 1", "cup 2 next_to box")
    assert notes(replace(right, set_aside=("without one",))) == ()
    one = plan(prompt, {name: said for name, said in phrases.items() if name != "cup 2"}, "cup 1 on box",
               "mug in cup 1")  # fmt: skip
    assert any('"without one" of "cup"' in note for note in notes(one))


def test_what_is_said_of_a_part_is_said_when_the_plan_takes_the_whole():
    phrases = {"cup": "A cup", "box": "a box"}
    told = plan("A cup on the bottom of a box.", phrases, "cup on box")
    assert notes(told) == ('not modelled: "bottom" of "box"',)
    assert notes(plan("A cup at the bottom of a box.", phrases, "cup in box")) == ()
    edge = Arrangement(kind="at_edge", objects=("cup",), of=("table",), arranged=True)
    phrases = {"cup": "A cup", "table": "a table"}
    assert notes(plan("A cup at the edge of a table.", phrases, "cup on table", arrangements=(edge,))) == ()
    assert notes(plan("A cup at the edge of a table.", phrases, "cup on table")) == ('not modelled: "edge" of "table"',)


def test_its_side_is_of_what_is_named_before():
    phrases = {"mug": "A mug", "table": "a table", "cup": "a cup", "box": "a box"}
    on = ("mug on table", "cup on table", "box on table")
    prompt = "A mug is on a table with a cup to its right and a box to its left."
    right = plan(prompt, phrases, *on, "cup right_of mug", "box left_of mug")
    assert notes(right) == ()
    wrong = plan(prompt, phrases, *on, "cup right_of box")
    assert notes(wrong) == ('not as said: "to its right"',)


def test_what_is_against_something_leans_on_it():
    phrases = {"mug": "A mug", "box": "a box"}
    beside = plan("A mug stands against a box.", phrases, "mug next_to box")
    assert notes(beside) == ('not as said: "against a box"',)
    leaning = Arrangement(kind="leaning_against", objects=("mug",), of=("box",), arranged=True)
    assert notes(replace(beside, arrangements=(leaning,))) == ()


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        ("A lamp, two books stacked on each other.", True),
        ("A book stands by a lamp, on which two books lie", False),
        ("Two books lie on a lamp.", False),
        ("A cup and two books are on a lamp.", False),
        ("A lamp with two books on it.", False),
        ("From bottom to top: a lamp, two books.", False),
    ],
)
def test_what_hardly_lies_there_is_named_where_no_words_say_so(prompt: str, told: bool):
    phrases = {"lamp": "A lamp", "book 1": "two books", "book 2": "two books", "cup": "A cup"}
    made = plan(prompt, phrases, "book 1 on lamp", "book 2 on lamp")
    found = audited(made, find, ("table",), lambda child, kind, parent: 1.1 * (parent == "lamp")).notes
    assert ('assumed: "two books" on "A lamp"; few things are there' in found) == told


def test_what_a_thing_is_too_large_for_is_named_though_a_list_ends_there():
    made = plan("A tray with a pot and a spoon on a cup", {"tray": "A tray", "cup": "a cup"}, "tray on cup")
    for cost, told in ((1.1, False), (1.9, True)):
        found = audited(made, find, ("table",), lambda child, kind, parent, cost=cost: cost).notes
        assert ('assumed: "A tray" on "a cup"; few things are there' in found) == told
