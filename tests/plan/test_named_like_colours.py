"""Things called like colours behind a place that opens the sentence, and furniture that hangs from nothing."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "nouns", "coloured"),
    [
        ("Behind the plate are ketchup and mustard.", ["plate", "ketchup", "mustard"], ()),
        ("Next to the jar are mustard and ketchup.", ["jar", "mustard", "ketchup"], ()),
        ("On the tray are chocolate and honey.", ["tray", "chocolate bar", "honey"], ()),
        ("On the desk are orange and lime.", ["desk", "orange", "lime"], ()),
        ("In the crate are lime and orange blocks.", ["crate", "block", "block", "block"], ("lime", "orange")),
        ("On the shelf the vase is mustard.", ["shelf", "vase"], ("mustard",)),
        ("The bowl is mustard and the plate is orange.", ["bowl", "plate"], ("mustard", "orange")),
    ],
)
def test_what_stands_there_is_no_colour_of_the_place(prompt: str, nouns: list[str], coloured: tuple[str, ...]):
    plan = PLANNER.plan(prompt)
    assert [obj.noun for obj in plan.objects] == nouns
    assert tuple(dict.fromkeys(colour for obj in plan.objects for colour in obj.colours)) == coloured


@pytest.mark.parametrize(
    ("prompt", "hanging"),
    [
        ("A bed with a doll on it and a blanket hanging over the rail.", {"blanket"}),
        ("A chair with a bag under it and a towel hanging over the rail.", {"towel"}),
        ("A towel over a rail next to a bathtub.", {"towel"}),
    ],
)
def test_no_furniture_hangs_from_a_rail(prompt: str, hanging: set[str]):
    relations = PLANNER.plan(prompt).relations
    assert {rel.child for rel in relations if rel.kind == "hangs_from"} == hanging
