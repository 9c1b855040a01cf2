"""Counts and shares: what is made is as many as the sentence says, at each place as many, or a note names it."""

from dataclasses import replace

import pytest

from pat3d.plan.audit.auditor import audited
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.grammar.words.names import catalogue_names
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.plan.scene_plan import Arrangement, PlannedObject, ScenePlan
from pat3d.scene.relations import Relation


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


def carried(plan: ScenePlan, carrier: str) -> list[int]:
    """How many each object named `carrier` carries."""
    names = [obj.name for obj in plan.objects if obj.name.rstrip(" 0123456789") == carrier]
    return [sum(rel.parent == name and rel.kind in ("on", "in") for rel in plan.relations) for name in names]


@pytest.mark.parametrize(
    ("prompt", "noun", "carrier", "shares"),
    [
        ("There are eight pears, four in each of two baskets.", "pear", "basket", [4, 4]),
        ("Six pencils: three in each of the two mugs.", "pencil", "mug", [3, 3]),
        ("There are four plums, one in each of four cups.", "plum", "cup", [1, 1, 1, 1]),
        ("Six red pens, with two of them in each of the three mugs.", "pen", "mug", [2, 2, 2]),
        ("There are two boxes on a table. There are six balls, three in each box.", "ball", "box", [3, 3]),
        ("Two bowls hold six limes, with three in each bowl.", "lime", "bowl", [3, 3]),
    ],
)
def test_so_many_in_each_of_several(planner: GrammarPlanner, prompt: str, noun: str, carrier: str, shares: list[int]):
    plan = planner.plan(prompt)
    assert sum(obj.name.rstrip(" 0123456789").endswith(noun) for obj in plan.objects) == sum(shares)
    assert carried(plan, carrier) == shares
    assert not any("counted otherwise" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "note"),
    [
        ("Seven limes, two in each of three bowls.", '"limes", of which there are 21, with "two in each"'),
        ("Four spoons and two mugs: two spoons in each mug.", '"spoons", of which there are 8'),
        ("Six lemons, three in each of three boxes.", '"three in each"; there are 1'),
    ],
)
def test_shares_that_do_not_make_up_the_whole_are_noted(planner: GrammarPlanner, prompt: str, note: str):
    assert any(f"counted otherwise: {note}" in each for each in planner.plan(prompt).notes)


def arranged(plan: ScenePlan) -> list[tuple[str, int]]:
    """Kind and number of things of every arrangement."""
    return [(one.kind, len(one.objects)) for one in plan.arrangements]


@pytest.mark.parametrize(
    ("prompt", "steps", "arrangements"),
    [
        ("Five blocks: three red and two green, the green ones stacked.", 1, []),
        ("Six mugs: two red, stacked, and four white, side by side.", 1, [("side_by_side", 4)]),
        ("Six books, four of them stacked, the rest in a row.", 3, [("row", 2)]),
        ("Seven cans: three of them stacked, the other four side by side.", 2, [("side_by_side", 4)]),
        ("Five blocks: two red and three blue. The red ones are stacked, the others are in a row.", 1, [("row", 3)]),
    ],
)
def test_some_of_several_are_arranged(
    planner: GrammarPlanner, prompt: str, steps: int, arrangements: list[tuple[str, int]]
):
    plan = planner.plan(prompt)
    assert sum(rel.kind == "on" for rel in plan.relations) == steps
    assert arranged(plan) == arrangements
    assert plan.notes == ()


def test_those_told_by_colour_are_stacked_and_no_others(planner: GrammarPlanner):
    plan = planner.plan("Four plates: two blue and two white, the white ones stacked.")
    colour = {obj.name: obj.colours for obj in plan.objects}
    stacked = [rel for rel in plan.relations if rel.kind == "on"]
    assert [(colour[rel.child], colour[rel.parent]) for rel in stacked] == [(("white",), ("white",))]


BOOKS = tuple(PlannedObject(name=f"book {n}", noun="book", phrase="Five books") for n in range(1, 6))
TALL = tuple(Relation(child=f"book {n}", kind="on", parent=f"book {n - 1}") for n in range(2, 6))


def test_a_stack_of_more_than_are_said_to_be_stacked_is_noted():
    plan = ScenePlan(prompt="Five books, three of them stacked.", objects=BOOKS, relations=TALL)
    assert audited(plan, Nouns(catalogue_names()).resolve).notes == (
        'counted otherwise: "three of them stacked"; of which there are 5',
    )
    assert audited(replace(plan, relations=TALL[:2]), Nouns(catalogue_names()).resolve).notes == ()


def test_one_thing_alone_is_no_row():
    row = Arrangement(kind="row", objects=("book 1",))
    plan = ScenePlan(prompt="Five books in a row.", objects=BOOKS, relations=(), arrangements=(row,))
    assert 'not as said: "row" of "book 1" alone' in audited(plan, Nouns(catalogue_names()).resolve).notes


@pytest.mark.parametrize(
    ("prompt", "note"),
    [
        ("A mug and a plate, which is larger, are on a table.", 'not as said: "larger" of "plate"'),
        ("One cup holds pens and the other, which is taller, holds spoons.", '"taller" of "the other"'),
        ("One of the cups holds pens and the other one, which is larger, holds forks.", "the same one does"),
        ("Stack two boxes on top of the other two boxes in the cabinet.", '"two boxes in the cabinet"; there are 1'),
    ],
)
def test_what_is_said_of_the_other_one_is_noted_where_it_is_not_so(planner: GrammarPlanner, prompt: str, note: str):
    plan = planner.plan(prompt)
    assert any(note in each for each in plan.notes)
    assert not any("larger" in obj.name and obj.noun in ("pen", "fork") for obj in plan.objects)


@pytest.mark.parametrize(
    ("prompt", "expected", "note"),
    [
        ("On top of both crates is a cap.", {("cap 1", "crate 1"), ("cap 2", "crate 2")}, "one on each"),
        ("Two crates stand on a bench. A cap lies on top of both crates.", {("cap 1", "crate 1"), ("cap 2", "crate 2")},
         "one on each"),
        ("Two crates stand on a bench. A tray lies on top of both crates.", {("tray", "crate 1"), ("tray", "crate 2")},
         "one across the two"),
        ("Two crates stand on a bench, a tray on both crates.", {("tray 1", "crate 1"), ("tray 2", "crate 2")},
         "one on each"),
    ],
)  # fmt: skip
def test_what_lies_on_both_is_one_on_each_or_one_across_and_a_note_says_which(
    planner: GrammarPlanner, prompt: str, expected: set[tuple[str, str]], note: str
):
    plan = planner.plan(prompt)
    assert expected <= {(rel.child, rel.parent) for rel in plan.relations}
    assert [each for each in plan.notes if f"is read as {note}" in each]


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        ("In both pots is a plum.", {("plum 1", "pot 1"), ("plum 2", "pot 2")}),
        ("There are two pots. Put a plum in both pots.", {("plum 1", "pot 1"), ("plum 2", "pot 2")}),
        ("Place a pillow on both beds.", {("pillow 1", "bed 1"), ("pillow 2", "bed 2")}),
        ("On all three plates is a plum.", {("plum 1", "plate 1"), ("plum 2", "plate 2"), ("plum 3", "plate 3")}),
        ("Next to both beds is a lamp.", {("lamp", "bed 1"), ("lamp", "bed 2")}),
    ],
)
def test_both_have_one_each_and_one_thing_is_beside_both(
    planner: GrammarPlanner, prompt: str, expected: set[tuple[str, str]]
):
    plan = planner.plan(prompt)
    assert {(rel.child, rel.parent) for rel in plan.relations} == expected
    assert not [note for note in plan.notes if "is read as the scene" not in note]
