"""Shorthand of lists: bare sides, brackets, "x4", names said again, ranks without an article."""

from __future__ import annotations

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def _edges(plan: ScenePlan) -> set[tuple[str, str, str]]:
    return {(rel.child, rel.kind, rel.parent) for rel in plan.relations}


def _noun_counts(plan: ScenePlan) -> dict[str, int]:
    nouns = [obj.noun for obj in plan.objects]
    return {noun: nouns.count(noun) for noun in nouns}


@pytest.mark.parametrize(
    ("prompt", "edges"),
    [
        (
            "workbench: hammer, drill, nails in mug",
            {("mug", "on", "workbench"), ("nail 1", "in", "mug"), ("drill", "on", "workbench")},
        ),
        ("shelf: clock, apple in bowl on tray", {("tray", "on", "shelf"), ("bowl", "on", "tray")}),
        ("desk, monitor center, speaker left, mug right", {("monitor", "on", "desk"), ("mug", "on", "desk"),
                                                           ("speaker", "left_of", "mug")}),
        ("bowl, spoon right, napkin left", {("spoon", "right_of", "bowl"), ("napkin", "left_of", "bowl")}),
        ("fork left, plate center, knife right", {("fork", "left_of", "plate"), ("plate", "left_of", "knife")}),
        ("coffee table, vase center, 2 cups left of it",
         {("vase", "on", "coffee table"), ("cup 1", "left_of", "vase"), ("cup 2", "left_of", "vase")}),
        ("table, chair left, chair right, vase middle", {("vase", "on", "table"), ("chair 1", "left_of", "table")}),
        ("crate (ball, 2 cubes)", {("ball", "in", "crate"), ("cube 2", "in", "crate")}),
        ("a basket [pear, plum] on a table",
         {("basket", "on", "table"), ("pear", "in", "basket"), ("plum", "in", "basket")}),
        ("tray (teapot, cup)", {("teapot", "on", "tray"), ("cup", "on", "tray")}),
        ("blue bucket w/ 2 sponges, broom leaning on bucket",
         {("broom", "next_to", "blue bucket"), ("sponge 1", "in", "blue bucket")}),
        ("bowl + spoon + cup, coaster under cup", {("cup", "on", "coaster")}),
    ],
)  # fmt: skip
def test_what_a_terse_list_leaves_out_is_understood(prompt: str, edges: set[tuple[str, str, str]]):
    plan = PLANNER.plan(prompt)
    assert edges <= _edges(plan)
    assert not [note for note in plan.notes if "assumed" not in note]


def test_a_carrier_without_brackets_has_no_contents():
    assert _edges(PLANNER.plan("crate, ball, 2 cubes")) == set()
    assert {obj.name for obj in PLANNER.plan("a table (wood) and a cup (glass)").objects} == {"wood table", "glass cup"}


@pytest.mark.parametrize(
    ("prompt", "counts"),
    [
        ("x4 bottles, crate", {"bottle": 4, "crate": 1}),
        ("bowl x2, spoon x3", {"bowl": 2, "spoon": 3}),
        ("pears (x5) on a table", {"pear": 5, "table": 1}),
        ("6 pcs of cubes", {"cube": 6}),
        ("3 bottles, middle one green", {"bottle": 3}),
        ("row of 4 jars, second one red", {"jar": 4}),
        ("blue crate with 3 pears, cup on crate", {"crate": 1, "pear": 3, "cup": 1}),
        ("two cubes, ball on cube", {"cube": 3, "ball": 1}),
    ],
)
def test_how_many_a_terse_list_counts(prompt: str, counts: dict[str, int]):
    assert _noun_counts(PLANNER.plan(prompt)) == counts


def test_the_one_of_several_is_told_by_its_place():
    plan = PLANNER.plan("stack of 3 boxes, bottom one red")
    assert [obj.colours for obj in plan.objects] == [("red",), (), ()]
    assert ("box 1", "on", "red box") in _edges(plan)


@pytest.mark.parametrize("name", ["bottle stand", "candle stand", "fork rest"])
def test_the_name_of_another_thing_is_none_of_its_first_word(name: str):
    with pytest.raises(PromptError, match=f'"{name}" is not in the catalogue'):
        PLANNER.plan(f"A {name} with a cup.")


@pytest.mark.parametrize(
    "prompt",
    ["A lamp and a candle stand on a desk.", "Two bottles rest on a tray.", "Let a bottle stand on a tray.",
     "On a desk stand two bottles."],
)  # fmt: skip
def test_to_stand_is_a_verb_too(prompt: str):
    assert any(rel.kind == "on" for rel in PLANNER.plan(prompt).relations)


@pytest.mark.parametrize(
    ("prompt", "noted"),
    [
        ("A screw and a washer on a plate.", "washer"), ("A file and a chisel.", "file"),
        ("A plane next to a saw.", "plane"), ("A washer and a screw under a mug.", "washer"),
        ("A baseball in a glove.", "glove"),
    ],
)  # fmt: skip
def test_a_thing_made_as_its_namesake_is_noted(prompt: str, noted: str):
    assert any(note.startswith(f'"{noted}" is made as') for note in PLANNER.plan(prompt).notes)


@pytest.mark.parametrize("prompt", ["A washer in a laundry room.", "A file on a desk.", "A plane on a rug."])
def test_in_its_own_company_it_is_what_the_catalogue_makes(prompt: str):
    assert not any("is made as" in note for note in PLANNER.plan(prompt).notes)


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("Desk: a jar (four pens inside), a clock", {"pen 1 in jar", "clock on desk", "jar on desk"}),
        ("On the desk: a jar (with four pens), a clock.", {"pen 1 in jar", "clock on desk", "jar on desk"}),
        ("Desk: a tray (a cup on it), a clock", {"cup on tray", "clock on desk", "tray on desk"}),
        ("A box (behind it a jug) is on a desk and holds an egg.", {"egg in box", "jug behind box", "jug on desk"}),
        ("A plate (next to it a fork) holds an egg.", {"egg on plate", "fork next_to plate"}),
    ],
)
def test_brackets_tell_of_what_stands_before_them(prompt: str, relations: set[str]):
    assert relations <= {str(relation) for relation in PLANNER.plan(prompt).relations}


def test_a_lid_in_brackets_is_no_contents():
    plan = PLANNER.plan("A clock and a jar (with a lid) are on a shelf.")
    assert "lid in jar" not in {str(relation) for relation in plan.relations}


def test_crates_of_a_material_are_the_ones_that_are_counted():
    plan = PLANNER.plan("A desk holds two plastic crates. The first holds an egg and the second a fork.")
    assert len(plan.objects) == 5
    assert {str(rel) for rel in plan.relations if rel.kind == "in"} == {
        "egg in plastic crate 1", "fork in plastic crate 2",
    }  # fmt: skip


@pytest.mark.parametrize("fruit", ["lime", "peach", "orange"])
def test_a_fruit_in_a_list_is_no_colour_of_what_follows(fruit: str):
    plan = PLANNER.plan(f"desk: 3 forks, {fruit}, purple cup")
    assert [(obj.noun, obj.colours) for obj in plan.objects[-2:]] == [(fruit, ()), ("cup", ("purple",))]


def test_colours_in_a_list_stay_colours():
    colours = [obj.colours for obj in PLANNER.plan("desk: red, orange, yellow cups").objects if obj.noun == "cup"]
    assert colours == [("red",), ("orange",), ("yellow",)]


@pytest.mark.parametrize(
    ("prompt", "made", "relations"),
    [
        ("blocks: three red, two blue, one green", {"red": 3, "blue": 2, "green": 1}, set()),
        ("balls: red 3x, blue 2x, one green, scattered on a mat", {"red": 3, "blue": 2, "green": 1}, {"on mat"}),
        ("pencils: 2x yellow, 3x blue on a tray", {"yellow": 2, "blue": 3}, {"on tray"}),
        ("jars: two white and one black, on a shelf", {"white": 2, "black": 1}, {"on shelf"}),
        ("wooden blocks: 4 yellow, 1 red", {"yellow": 4, "red": 1}, set()),
        ("pears: three green and two red in a bowl", {"green": 3, "red": 2}, {"in bowl"}),
    ],
)
def test_numbers_of_colours_behind_a_heading_are_of_it(prompt, made, relations):
    plan = GrammarPlanner().plan(prompt)
    coloured = [obj for obj in plan.objects if obj.colours]
    assert {colour: sum(obj.colours[0] == colour for obj in coloured) for colour in made} == made
    assert len(coloured) == sum(made.values())
    assert {f"{rel.kind} {rel.parent}" for rel in plan.relations} == relations
    assert sum(len(relations) for _ in coloured) == len(plan.relations)


@pytest.mark.parametrize("said", ["(landscape)", "(portrait format)", "(square)", "(vertical photo)"])
def test_how_a_photo_is_turned_is_no_object(said):
    plan = GrammarPlanner().plan(f"A bench {said} with a vase.")
    assert [obj.noun for obj in plan.objects] == ["bench", "vase"]


@pytest.mark.parametrize(
    ("prompt", "objects", "note"),
    [
        ("Neither spoon nor fork, just a knife across a plate", ["knife", "plate"], "nor fork"),
        ("A bench with neither lamps nor books, only a vase.", ["bench", "vase"], "nor books"),
        ("There is neither a jar nor a can on the shelf, only a vase.", ["shelf", "vase"], "nor a can"),
        ("Neither a pen nor a pencil, only a ruler next to a cup", ["ruler", "cup"], "nor a pencil"),
        ("No lamp and neither books nor pens, only a clock on the shelf.", ["clock", "shelf"], "nor pens"),
    ],
)
def test_of_neither_and_nor_only_what_is_there_instead_is_made(prompt, objects, note):
    plan = GrammarPlanner().plan(prompt)
    assert sorted(obj.noun for obj in plan.objects) == sorted(objects)
    assert f'not modelled: "{note}"' in plan.notes


@pytest.mark.parametrize(
    ("number", "pairs", "noun"), [("eight", "four", "cup"), ("six", "three", "bowl"), ("ten", "five", "plate")]
)
def test_things_stacked_in_pairs_are_stacks_of_two(number, pairs, noun):
    plan = GrammarPlanner().plan(f"{number} {noun}s stacked in {pairs} pairs on a table")
    on = [rel.parent for rel in plan.relations]
    assert sum(obj.noun == noun for obj in plan.objects) == len(on)
    assert 2 * on.count("table") == len(on)


@pytest.mark.parametrize("said", ["natural", "organic", "simple"])
def test_with_ingredients_nothing_is_made(said):
    plan = GrammarPlanner().plan(f"Two bars of soap with {said} ingredients on a shelf")
    assert [obj.noun for obj in plan.objects] == ["soap", "soap", "shelf"]
    assert f'not modelled: "with {said} ingredients"' in plan.notes
