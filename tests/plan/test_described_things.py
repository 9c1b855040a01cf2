"""How things are described: by adverbs, in two hues, as one of the foods; what a picture is of; what reaches what."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


def _edges(prompt: str) -> set[tuple[str, str, str]]:
    return {(rel.child, rel.kind, rel.parent) for rel in PLANNER.plan(prompt).relations}


@pytest.mark.parametrize(
    ("prompt", "below", "colours"),
    [
        ("A red apple sits on a white, delicately painted ceramic plate.", "plate", ["white"]),
        ("A silver spoon lies atop a blue, neatly folded napkin.", "napkin", ["blue"]),
        ("A cup is on a small, intricately carved tray.", "tray", []),
        ("A lemon lies on a brown, heavily scratched wooden bench.", "bench", ["brown"]),
    ],
)
def test_an_adverb_behind_a_comma_describes_the_same_thing(prompt: str, below: str, colours: list[str]):
    plan = PLANNER.plan(prompt)
    assert len(plan.objects) == 2
    found = next(obj for obj in plan.objects if obj.noun == below)
    assert list(found.colours) == colours
    assert [(rel.kind, rel.parent) for rel in plan.relations] == [("on", found.name)]
    assert not any(note.startswith("assumed") for note in plan.notes)


def test_what_is_done_behind_a_comma_describes_no_other_thing():
    plan = PLANNER.plan("Three mugs are red, neatly arranged on a table.")
    assert sorted(obj.noun for obj in plan.objects) == ["mug", "mug", "mug", "table"]


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("This picture looks like a messy office with open boxes on the floor.", ["storage box"] * 3),
        ("This photo looks like a kitchen with mugs on the counter.", ["counter", "mug", "mug", "mug"]),
        ("One of the pictures shows a mug on a shelf.", ["mug", "shelf"]),
        ("This photo is of a cup on a rug.", ["cup", "rug"]),
    ],
)
def test_a_picture_that_shows_the_scene_is_not_in_it(prompt: str, nouns: list[str]):
    resolved = {"box": "storage box"}
    assert sorted(resolved.get(obj.noun, obj.noun) for obj in PLANNER.plan(prompt).objects) == nouns


@pytest.mark.parametrize(
    ("prompt", "inside"),
    [
        ("A plate of food that has steak, corn and a lemon.", {"steak", "corn", "lemon"}),
        ("A bowl of vegetables that includes a carrot and an onion.", {"carrot", "onion"}),
        ("A basket of toys that has a ball and a doll is on a bench.", {"ball", "doll"}),
        ("Some food that has meat and cheese is on a plate.", {"meat", "cheese"}),
    ],
)
def test_what_food_has_is_the_food(prompt: str, inside: set[str]):
    plan = PLANNER.plan(prompt)
    held = {rel.child for rel in plan.relations if rel.parent in ("plate", "bowl", "basket")}
    assert held == inside
    assert inside <= {obj.name for obj in plan.objects}
    assert not {"bread", "apple", "block"} & {obj.noun for obj in plan.objects}


def test_what_reaches_something_is_next_to_it_and_a_note_says_so():
    plan = PLANNER.plan("White dog with orange bows on ears leaps to reach kitchen counter.")
    assert [(rel.child, rel.kind) for rel in plan.relations] == [("white dog", "next_to")]
    assert any("leaps to reach" in note for note in plan.notes)
    dog = next(obj for obj in plan.objects if obj.noun == "dog")
    assert list(dog.colours) == ["white"]


@pytest.mark.parametrize(
    "prompt", ["Two turquoise-blue mugs on a table.", "There are red-brown chairs around a table."]
)
def test_a_hue_of_two_words_is_the_hue_of_each(prompt: str):
    plan = PLANNER.plan(prompt)
    hues = {obj.colours for obj in plan.objects if obj.noun != "table"}
    assert len(hues) == 1
    assert len(hues.pop()) == 2


def test_colours_that_are_joined_are_shared_out():
    assert sorted(obj.colours for obj in PLANNER.plan("Two red and blue mugs.").objects) == [("blue",), ("red",)]


@pytest.mark.parametrize(
    "prompt", ["A small blue ball.", "A little white dog.", "A small yellow bird.", "A small, white dog."]
)
def test_a_size_ahead_of_a_colour_is_a_size(prompt: str):
    assert PLANNER.plan(prompt).objects[0].scale < 1


@pytest.mark.parametrize(
    ("prompt", "owner", "each"),
    [
        ("There are two bookshelves with 3 books on every shelf.", "bookshelf", 3),
        ("There are 2 brown cabinets with five plates on each shelf.", "cabinet", 5),
    ],
)
def test_each_of_several_has_what_is_on_each_shelf(prompt: str, owner: str, each: int):
    plan = PLANNER.plan(prompt)
    owners = [obj.name for obj in plan.objects if obj.noun == owner]
    assert [sum(rel.parent == name for rel in plan.relations) for name in owners] == [each, each]
    assert any('"shelf"' in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "around"),
    [
        ("Three washing machines stand next to a sofa. Around them are scattered a hammer, a box and a bucket.",
         {"hammer", "box", "bucket"}),
        ("Two desks stand next to a bed. Around them are various cups, a box and a bucket.",
         {"cup 1", "cup 2", "cup 3", "box", "bucket"}),
    ],
)  # fmt: skip
def test_the_first_of_a_list_is_not_them(prompt: str, around: set[str]):
    found = {rel for rel in PLANNER.plan(prompt).relations if rel.kind == "around"}
    assert {rel.child for rel in found} == around
    assert {rel.parent.split()[0] for rel in found} <= {"washing", "desk"}


def test_each_pair_is_of_two_and_no_note_says_otherwise():
    plan = PLANNER.plan("Two pairs of shoes are on a rug.")
    assert sum(obj.noun == "shoe" for obj in plan.objects) == 4
    assert not plan.notes


@pytest.mark.parametrize(
    ("prompt", "edges"),
    [
        ("Two tvs on a table.", {("tv 1", "on", "table"), ("tv 2", "on", "table")}),
        ("A clock and a lamp compete for attention on the shelf.", {("clock", "on", "shelf"), ("lamp", "on", "shelf")}),
        ("A cabinet sits flush to the wall next to a bed.", {("cabinet", "next_to", "bed")}),
    ],
)
def test_what_was_refused_is_read(prompt: str, edges: set[tuple[str, str, str]]):
    assert _edges(prompt) == edges
