"""What each guest at a table has, and what stands beside "it" in a list of what is on a table."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


def _counts(prompt: str) -> dict[str, int]:
    nouns = [obj.noun for obj in PLANNER.plan(prompt).objects]
    return {noun: nouns.count(noun) for noun in dict.fromkeys(nouns)}


def _edges(prompt: str) -> set[tuple[str, str, str]]:
    return {(rel.child, rel.kind, rel.parent) for rel in PLANNER.plan(prompt).relations}


@pytest.mark.parametrize(
    ("prompt", "counts"),
    [
        ("A table for two with a candle in the middle", {"candle": 1}),
        ("A table with food for two: a burger and a pizza", {"burger": 1, "pizza": 1}),
    ],
)  # fmt: skip
def test_each_guest_has_one(prompt: str, counts: dict[str, int]):
    made = _counts(prompt)
    assert {noun: made.get(noun, 0) for noun in counts} == counts
    assert sum(made.values()) == sum(counts.values()) + 1


@pytest.mark.parametrize(
    "prompt",
    [
        "A table with two plates, each with a fork to its left and a knife to its right.",
        "Two plates on a table, each with a fork on its left and a knife on its right.",
        "A table with two plates, each with a fork to its left, a knife to its right, and two glasses.",
    ],
)
def test_every_plate_has_a_fork_and_a_knife(prompt: str):
    edges = _edges(prompt)
    plates = {f"plate {number}" for number in (1, 2)}
    assert {parent for child, kind, parent in edges if kind == "left_of" and child.startswith("fork")} == plates
    assert {parent for child, kind, parent in edges if kind == "right_of" and child.startswith("knife")} == plates
    assert {child.rstrip(" 12") for child, kind, parent in edges if (kind, parent) == ("on", "table")} >= {
        "plate", "fork", "knife",
    }  # fmt: skip
    assert not any(parent.startswith("plate") for _, kind, parent in edges if kind == "on")


def test_what_follows_each_is_not_had_by_each():
    for prompt in (
        "A table with two plates, each with a fork to its left, and two glasses",
        "A shelf with two boxes, each with a ball on its left, and a lamp",
    ):
        carrier = prompt.split()[1]
        edges = _edges(prompt)
        assert {p for c, kind, p in edges if kind in ("on", "in") and c.startswith(("glass", "lamp"))} == {carrier}


@pytest.mark.parametrize(
    ("prompt", "edges"),
    [
        ("The desk has a monitor in the middle, a keyboard in front of it and a mouse on the right.",
         {("keyboard", "in_front_of", "monitor"), ("monitor", "left_of", "computer mouse"),
          ("keyboard", "on", "desk"), ("computer mouse", "on", "desk")}),
        ("The tray has a teapot in the middle, a cup behind it and a spoon on the left.",
         {("cup", "behind", "teapot"), ("cup", "on", "tray"), ("teapot", "right_of", "spoon")}),
        ("The tray has a teapot in the middle, a cup to the left of it and a spoon to the right of it.",
         {("cup", "left_of", "teapot"), ("spoon", "right_of", "teapot"), ("spoon", "on", "tray")}),
        ("The shelf holds a vase, a candle beside it and a clock.",
         {("candle", "next_to", "vase"), ("candle", "on", "shelf"), ("clock", "on", "shelf")}),
        ("A table with a plate, a napkin beside it and a glass on the left.",
         {("napkin", "next_to", "plate"), ("glass", "left_of", "plate"), ("glass", "on", "table")}),
        ("A desk with a laptop, a mug beside it, and a chair in front of it",
         {("mug", "next_to", "laptop"), ("chair", "in_front_of", "desk")}),
        ("A sofa with a cushion and a lamp next to it", {("lamp", "next_to", "sofa"), ("cushion", "on", "sofa")}),
        ("A workbench with a toolbox, a jar leaning against it, and three pens in a row in front of the toolbox.",
         {("pen 1", "in_front_of", "toolbox"), ("pen 3", "on", "workbench")}),
    ],
)  # fmt: skip
def test_what_stands_beside_it_in_a_list(prompt: str, edges: set[tuple[str, str, str]]):
    made = _edges(prompt)
    assert edges <= made
    landmarks = {parent for _, kind, parent in edges if kind == "in_front_of"}
    assert {parent for _, kind, parent in made if kind == "in_front_of"} == landmarks


@pytest.mark.parametrize(
    ("prompt", "edges"),
    [
        ("A teddy bear sits on the bed between two pillows, wearing a hat.", {("hat", "on", "teddy bear")}),
        ("A microscope on a bench with a rack of six test tubes to its right and a beaker to its left.",
         {("test tube 1", "in", "test tube rack"), ("test tube rack", "right_of", "microscope"),
          ("beaker", "left_of", "microscope")}),
    ],
)  # fmt: skip
def test_who_wears_something_and_what_a_rack_of_tubes_stands_beside(prompt: str, edges: set[tuple[str, str, str]]):
    assert edges <= _edges(prompt)


def test_it_may_be_the_tray_or_the_cup():
    notes = PLANNER.plan("A tray with a cup and a spoon beside it").notes
    assert any('it may be "a cup"' in note for note in notes)
    assert not PLANNER.plan("A tray with a spoon beside it").notes


def test_a_side_at_the_end_of_a_sentence_is_read():
    assert ("cup", "left_of", "box") in _edges("A box with a cup on its left and a lamp with a pen on its right")


@pytest.mark.parametrize(
    ("prompt", "edge"),
    [
        ("On the table is a plate. On it are two eggs.", ("egg 1", "on", "plate")),
        ("On a desk is a tray. On it is a mug.", ("mug", "on", "tray")),
        ("In the crate is a bowl. In it is an egg.", ("egg", "in", "bowl")),
        ("On a desk is a laptop. On it is a mug.", ("mug", "on", "desk")),
        ("On the table is a bowl. On it is also a cup.", ("cup", "on", "table")),
        ("Behind the sofa: a lamp. In front of it: a rug.", ("rug", "in_front_of", "sofa")),
    ],
)
def test_it_is_what_holds_things_before_what_that_stands_on(prompt: str, edge: tuple[str, str, str]):
    assert edge in _edges(prompt)
