"""Everyday nouns: what is made of them, what stands in, what is only named, and what a refusal says to write."""

from __future__ import annotations

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def told(plan: ScenePlan) -> tuple[str, str]:
    """Nouns of `plan`, and what carries what, in the order of the alphabet."""
    held = sorted(f"{rel.child} {rel.kind} {rel.parent}" for rel in plan.relations)
    return ", ".join(sorted(obj.noun for obj in plan.objects)), ", ".join(held)


def notes(plan: ScenePlan) -> list[str]:
    """What is noted, save that wording is new."""
    return [note for note in plan.notes if not note.startswith("worded like nothing")]


@pytest.mark.parametrize(
    ("prompt", "nouns", "held"),
    [
        ("A telephone stands on a desk.", "desk, telephone", "telephone on desk"),
        ("A toilet stands beside a bathtub.", "bathtub, toilet", "toilet next_to bathtub"),
        ("A rubber duck in a bathtub.", "bathtub, rubber duck", "rubber duck in bathtub"),
        ("A parrot in a bird cage.", "bird, birdcage", "parrot on bird cage"),
        ("A goldfish in a fish tank.", "aquarium, fish", "goldfish in fish tank"),
        ("A doll in a doll house.", "doll, dollhouse", "doll on doll house"),
        ("A red umbrella in an umbrella stand.", "umbrella, umbrella stand", "red umbrella in umbrella stand"),
        ("A trumpet lies on a piano.", "piano, trumpet", "trumpet on piano"),
        ("A record beside a record player on a shelf.", "record player, shelf, vinyl record",
         "record next_to record player, record on shelf, record player on shelf"),
        ("A clock on the mantelpiece.", "clock, fireplace", "clock on mantelpiece"),
        ("A fireplace with a vase on its mantel.", "fireplace, vase", "vase on fireplace"),
        ("Three blocks in a toy wagon.", "block, block, block, toy wagon",
         "block 1 in toy wagon, block 2 in toy wagon, block 3 in toy wagon"),
        ("A pestle lies next to a mortar.", "mortar, pestle", "pestle next_to mortar"),
        ("An olive and a scone on a plate.", "olive, plate, scone", "olive on plate, scone on plate"),
        ("An olive bowl on a shelf.", "bowl, shelf", "olive bowl on shelf"),
        ("A dog lead hangs on a hook.", "hook, leash", "dog lead hangs_from hook"),
        ("A stone vase and a pebble on a table.", "rock, table, vase", "pebble on table, stone vase on table"),
        ("A pair of nail clippers in a tray.", "nail clipper, tray", "pair of nail clippers on tray"),
        ("A bird feeder stands on a bench.", "bench, birdhouse", "bird feeder on bench"),
        ("A cup in a cup holder.", "cup, cup holder", "cup in cup holder"),
    ],
)  # fmt: skip
def test_what_people_have_is_made(prompt: str, nouns: str, held: str) -> None:
    plan = PLANNER.plan(prompt)
    assert told(plan) == (nouns, held)
    assert notes(plan) == []
    assert plan.task is None


@pytest.mark.parametrize(
    ("prompt", "nouns", "held"),
    [
        ("There is a table on which a plant stands.", "plant, table", "plant on table"),
        ("The plant stands left of the sofa.", "plant, sofa", "plant left_of sofa"),
        ("An umbrella stands behind a chair.", "chair, umbrella", "umbrella behind chair"),
        ("Two plant stands next to a bench.", "bench, plant stand, plant stand",
         "plant stand 1 next_to bench, plant stand 2 next_to bench"),
        ("A plant stand stands behind a sofa.", "plant stand, sofa", "plant stand behind sofa"),
        ("Three cake stands on a table.", "cake stand, cake stand, cake stand, table",
         "cake stand 1 on table, cake stand 2 on table, cake stand 3 on table"),
    ],
)  # fmt: skip
def test_a_plant_stands_and_plant_stands_are_told_apart(prompt: str, nouns: str, held: str) -> None:
    plan = PLANNER.plan(prompt)
    assert told(plan) == (nouns, held)
    assert notes(plan) == []


@pytest.mark.parametrize("word", ["cloche", "glass dome", "bell jar"])
def test_a_dome_stands_over_what_is_under_it_as_it_is_made(word: str) -> None:
    """It is open below, unlike a bowl, which is turned over."""
    plan = PLANNER.plan(f"A cupcake under a {word} on a table.")
    assert told(plan) == ("cloche, cupcake, table", ", ".join(sorted(("cupcake on table", f"{word} on table"))))
    assert [(each.kind, each.objects, each.of) for each in plan.arrangements] == [("under", ("cupcake",), (word,))]
    assert plan.postures == ()
    turned = PLANNER.plan("A coin under a bowl on a table.")
    assert [(each.object, each.kind) for each in turned.postures] == [("bowl", "upside_down")]


@pytest.mark.parametrize(
    ("prompt", "nouns", "noted"),
    [
        ("A violin on a chair.", "chair, guitar", '"A violin" is made as a "guitar".'),
        ("A tricycle beside a bench.", "bench, bicycle", '"A tricycle" is made as a "bicycle".'),
        ("A doily lies under a vase.", "placemat, vase", '"A doily" is made as a "placemat".'),
        ("Two eggs in a vessel.", "bowl, egg, egg", '"a vessel" is made as a "bowl".'),
        ("A roll of foil on a counter.", "counter, paper towel", '"A roll of foil" is made as a "paper towel".'),
        ("A straw in a glass.", "glass, rod", '"A straw" is made as a "rod" of 0.2 m.'),
        ("A table runner on a table.", "table, towel", '"A table runner" is made as a "towel".'),
    ],
)
def test_what_is_like_it_stands_in(prompt: str, nouns: str, noted: str) -> None:
    plan = PLANNER.plan(prompt)
    assert told(plan)[0] == nouns
    assert noted in plan.notes


@pytest.mark.parametrize(
    ("prompt", "nouns", "noted"),
    [
        ("A bowl of lentils on a table.", "bowl, table",
         '"lentils" of "A bowl of lentils" is left out: it is no rigid body.'),
        ("A glass of whisky on a bar counter.", "counter, glass",
         '"whisky" of "A glass of whisky" is left out: it is no rigid body.'),
        ("A pot filled with broth.", "pot", 'not modelled: "broth"'),
        ("Lentils and a ladle are in a pot.", "ladle, pot", 'not modelled: "Lentils"'),
        ("A plate covered with foil.", "plate", 'not modelled: "foil"'),
        ("Some crumbs lie on a plate.", "plate", 'not modelled: "Some crumbs"'),
        ("A puddle is next to a bucket.", "bucket", 'not modelled: "A puddle"'),
        ("A crate full of junk.", "crate", 'not modelled: "junk"'),
        ("Fresh herbs and a knife lie on a cutting board.", "cutting board, knife", 'not modelled: "Fresh herbs"'),
        ("A storage box with leftovers.", "storage box", 'not modelled: "leftovers"'),
    ],
)  # fmt: skip
def test_what_is_no_body_is_named_and_the_rest_is_made(prompt: str, nouns: str, noted: str) -> None:
    plan = PLANNER.plan(prompt)
    assert told(plan)[0] == nouns
    assert noted in plan.notes


@pytest.mark.parametrize(
    ("prompt", "hint"),
    [
        ("A stand in the corner.", '"cake stand"'),
        ("A machine on a desk.", '"coffee machine"'),
        ("A holder on a desk.", '"cup holder"'),
        ("A pad on a desk.", '"mouse pad"'),
        ("Two rolls on a plate.", '"dinner roll"'),
        ("A case on a bed.", '"pencil case"'),
    ],
)
def test_a_kind_alone_is_refused_with_kinds_that_can_be_made(prompt: str, hint: str) -> None:
    with pytest.raises(PromptError, match="Say which kind: ") as refused:
        PLANNER.plan(prompt)
    assert hint in str(refused.value)
