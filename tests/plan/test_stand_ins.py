"""Ordinary things that no source has: what stands in for them, how large it is, and that a note says so."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest

from pat3d.assets.colours import find_colour
from pat3d.assets.materials import find_material
from pat3d.errors import PromptError
from pat3d.plan.english import is_plural, plural
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.grammar.words import lexicon, stand_ins
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.names import catalogue_names
from pat3d.plan.grammar.words.sizes import extents
from pat3d.plan.grammar.words.stand_ins import STAND_IN_SIZES, STAND_INS
from pat3d.plan.grammar.words.unmade import base_verb
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.plan.scene_plan import ScenePlan

NAMES = catalogue_names()
PLANNER = GrammarPlanner()
TABLE = Path(stand_ins.__file__).with_suffix(".txt").read_text(encoding="utf-8").splitlines()
NAMED_SO = {"ice cube", "grapefruit", "lettuce", "display", "spice rack"}
"""What the catalogue makes as another thing without a word."""
TWO_SENSES = {"straw", "skewer", "display", "chicken", "roast", "plug"}
"""A thing as well as a material, a verb or a place, or told by its company."""
OWN_IN_PLURAL = {"deer", "cracker", "tea bag", "facial tissue", "pipette tip", "earphone", "display", "green bean",
                 "raisin"}  # fmt: skip
"""What the catalogue has a noun for where there are several, mostly a packet; and what has no plural of its own."""
WORDS = (lexicon.VERBS, lexicon.PARTICIPLES, lexicon.ADVERBS, lexicon.COMMANDS, lexicon.SIZES, lexicon.SUBSTANCES,
         lexicon.PARTS, lexicon.POSITIONS, lexicon.DETERMINERS, lexicon.COLLECTIVES, lexicon.GENERICS)  # fmt: skip


def told(prompt: str) -> tuple[ScenePlan, list[str]]:
    """The plan of `prompt`, and its notes save those on new wording."""
    plan = PLANNER.plan(prompt)
    return plan, [note for note in plan.notes if not note.startswith("worded like nothing")]


def test_no_name_stands_twice_in_the_table() -> None:
    rows = [line.split(": ") for line in TABLE if line and not line.startswith("#")]
    assert all(len(row) == 2 for row in rows)
    names = Counter(name for row in rows for name in row[1].split(", "))
    assert [name for name, count in names.items() if count > 1] == []
    assert set(names) == set(STAND_INS)
    assert all(name == name.strip().lower() and name for name in names)


def test_every_stand_in_is_a_noun_of_the_catalogue() -> None:
    assert [noun for noun in STAND_INS.values() if (NAMES.find(noun) or NAMES.find("mug")).noun != noun] == []


def test_no_name_is_a_noun_of_its_own() -> None:
    assert {name for name in STAND_INS if NAMES.find(name) is not None} == NAMED_SO
    assert all(NAMES.find(name).noun == STAND_INS[name] for name in NAMED_SO)


def test_no_name_is_a_word_of_another_kind() -> None:
    shadowed = {
        name for name in STAND_INS
        if any(name in table for table in WORDS) or is_modifier(name) or base_verb(name) or find_colour(name)
        or find_material(name)
    }  # fmt: skip
    assert shadowed <= TWO_SENSES


def test_a_size_is_given_only_where_it_differs() -> None:
    """Within a tenth the catalogue's own size does."""
    alike = [
        name for name, metres in STAND_IN_SIZES.items()
        if not 0.004 <= metres <= 2 or 0.9 < metres / max(extents(STAND_INS[name])) < 1.1
    ]  # fmt: skip
    assert alike == []


@pytest.mark.parametrize("name", sorted(STAND_INS))
def test_it_is_read_with_a_note_alone_and_in_the_plural(name: str) -> None:
    whole = is_plural(name) or name.endswith(("overalls", "rhinoceros", "triceratops", "stegosaurus"))
    article = "" if whole else "an " if name[0] in "aeiou" else "a "
    plan, notes = told(f"Beside the wall is {article}{name}.")
    stand_in = STAND_INS[name]
    assert [obj.noun for obj in plan.objects] == [stand_in]
    size = STAND_IN_SIZES.get(name)
    assert (plan.objects[0].extent.metres if plan.objects[0].extent else None) == size
    said = f" of {size:g} m" if size else ""
    assert any(re.fullmatch(rf'"[^"]*{re.escape(name)}" is made as an? "{re.escape(stand_in)}"{said}\.', note)
               for note in notes)  # fmt: skip
    if not whole and name not in OWN_IN_PLURAL and "loaves" not in plural(name):
        match = Nouns(NAMES).match(plural(name).split())
        assert match is not None
        assert (match.noun, match.plural) == (stand_in, True)


@pytest.mark.parametrize(
    ("prompt", "nouns", "noted"),
    [
        ("Two capes lie on a bench.", ["bench", "coat", "coat"], '"Two capes" is made as a "coat".'),
        ("Three canes in an umbrella stand.", ["rod", "rod", "rod", "umbrella stand"],
         '"Three canes" is made as a "rod" of 0.9 m.'),
        ("Two CDs on a desk.", ["desk", "vinyl record", "vinyl record"],
         '"Two CDs" is made as a "vinyl record" of 0.12 m.'),
        ("A paper plane on a stool.", ["stool", "toy plane"], '"A paper plane" is made as a "toy plane".'),
        ("A plastic bag beside a bin.", ["bin", "paper bag"], '"A plastic bag" is made as a "paper bag".'),
        ("Swimming trunks and a towel on a bench.", ["bench", "jeans", "towel"],
         '"Swimming trunks" is made as a "jeans".'),
        ("A corn dog on a plate.", ["plate", "sausage"], '"A corn dog" is made as a "sausage" of 0.18 m.'),
        ("A rice cake beside a cup.", ["cookie", "cup"], '"A rice cake" is made as a "cookie".'),
        ("Two drumsticks lie on a drum.", ["drum", "rod", "rod"], '"Two drumsticks" is made as a "rod" of 0.4 m.'),
        ("Two drumsticks lie on a plate.", ["chicken leg", "chicken leg", "plate"], ""),
        ("A chicken and a cow on a rug.", ["cow", "duck", "rug"], '"A chicken" is made as a "duck".'),
        ("A chicken lies in a pan.", ["chicken leg", "pan"], '"A chicken" is made as a "chicken leg".'),
        ("Two trampolins beside a tree.", ["inflatable pool", "inflatable pool", "tree"],
         '"trampolins" is read as "trampolines".'),
    ],
)  # fmt: skip
def test_what_goes_by_the_name_of_another_thing_is_none(prompt: str, nouns: list[str], noted: str) -> None:
    plan, notes = told(prompt)
    assert sorted(obj.noun for obj in plan.objects) == nouns
    assert noted in notes if noted else notes == []


@pytest.mark.parametrize(
    ("prompt", "metres", "noted"),
    [
        ("A balloon beside a gift.", 0.25, '"A balloon" is made as a "ball" of 0.25 m.'),
        ("A huge balloon beside a gift.", 0.4, '"A huge balloon" is made as a "ball" of 0.4 m.'),
        ("A balloon 60 cm tall beside a gift.", 0.6, '"A balloon" is made as a "ball".'),
        ("A violin beside a gift.", None, '"A violin" is made as a "guitar".'),
    ],
)
def test_it_has_its_own_size_as_said_of_it(prompt: str, metres: float | None, noted: str) -> None:
    plan, notes = told(prompt)
    extent = plan.objects[0].extent
    assert (extent and extent.metres) == (metres and pytest.approx(metres))
    assert notes == [noted]


@pytest.mark.parametrize("word", ["stock", "breaker", "planet", "cartoon"])
def test_a_word_of_its_own_is_no_slip(word: str) -> None:
    """Each is a letter away from a noun: sock, scone, beaker, plant, carton."""
    with pytest.raises(PromptError, match=f'"{word}"'):
        PLANNER.plan(f"The {word} beside a mug.")


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("A gift with a red bow on a table.", ["gift", "table"]),
        ("Rake the leaves towards the bin.", ["bin"]),
        ("Chain the bicycle to the bench.", ["bicycle", "bench"]),
        ("Tape a banner to the cabinet.", ["cardboard sheet", "cabinet"]),
    ],
)
def test_a_verb_or_a_part_is_no_thing_beside_it(prompt: str, nouns: list[str]) -> None:
    plan, notes = told(prompt)
    assert sorted(obj.noun for obj in plan.objects) == sorted(nouns)
    assert notes


@pytest.mark.parametrize(
    ("prompt", "objects", "content"),
    [
        ("two bottles of KOH on a bench", ["bottle", "bottle", "bench"], "of KOH"),
        ("A flask of CuSO4 and a ruler are on a tray.", ["flask", "ruler", "tray"], "of CuSO4"),
        ("a jar of kimchee next to a spoon", ["jar", "spoon"], "of kimchee"),
        ("a cup of genmaicha is beside a kettle", ["cup", "kettle"], "of genmaicha"),
        ("a tray with a bowl of ceviche and a fork", ["tray", "bowl", "fork"], "of ceviche"),
        ("bottles of KOH and LiOH", ["bottle"] * 3, "of KOH and LiOH"),
    ],
)
def test_what_a_vessel_holds_that_no_table_has_is_noted(prompt, objects, content):
    plan = PLANNER.plan(prompt)
    assert [obj.noun for obj in plan.objects] == objects
    assert f'not modelled: "{content}"' in plan.notes


def test_things_that_a_vessel_holds_are_not_left_out():
    with pytest.raises(PromptError, match="wugs"):
        PLANNER.plan("a box of wugs on a table")


@pytest.mark.parametrize(
    ("said", "noun"),
    [("sconce", "lamp"), ("sprig", "rod"), ("divider", "plank"), ("pipette rack", "test tube rack"),
     ("capsule", "coin"), ("vitamin", "coin"), ("ps5", "game console"), ("chemical", "bottle")],
)  # fmt: skip
def test_what_is_found_in_bathrooms_drawers_and_laboratories_is_stood_in_for(said, noun):
    plan = PLANNER.plan(f"a {said} on a table")
    assert [obj.noun for obj in plan.objects] == [noun, "table"]
    assert any(f'"a {said}" is made as a' in note for note in plan.notes)


@pytest.mark.parametrize(
    ("said", "noun"),
    [("fidget spinner", "gear"), ("moisture meter", "kitchen thermometer"), ("manuscript", "stack of paper"),
     ("drill press", "microscope"), ("pill organizer", "ice cube tray"), ("gumball machine", "crystal ball"),
     ("blood pressure monitor", "clock"), ("crochet hook", "rod"), ("pcr tube", "test tube"),
     ("tire iron", "crowbar"), ("gold bar", "brick"), ("wall socket", "tile"), ("heat sink", "radiator"),
     ("ice chest", "storage box"), ("paper cutter", "cutting board"), ("bubble wrap", "paper towel"),
     ("folding screen", "cardboard sheet"), ("cherry tomato", "tomato")],
)  # fmt: skip
def test_a_thing_is_none_of_the_kind_that_its_last_word_names(said, noun):
    plan = PLANNER.plan(f"a mug and a {said} on a table")
    assert sorted(obj.noun for obj in plan.objects) == sorted(["mug", noun, "table"])
    assert any(f'"a {said}" is made as a' in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("A cast iron pan on a stove.", ["pan", "stove"]),
        ("A pepper mill and a salt shaker on a table.", ["pepper mill", "salt shaker", "table"]),
        ("Slice the cheese on the cutting board.", ["cheese", "cutting board"]),
        ("A vase, a lamp and a kettle stand on a counter.", ["counter", "kettle", "lamp", "vase"]),
        ("A sapphire ring and a red book on a desk.", ["book", "desk", "ring"]),
        ("A glass dish with a lemon half on a tray.", ["lemon", "plate", "tray"]),
    ],
)
def test_a_name_takes_no_word_from_another(prompt, nouns):
    assert sorted(obj.noun for obj in PLANNER.plan(prompt).objects) == nouns


@pytest.mark.parametrize(
    "said", ["half-burnt", "handmade", "hollow", "solid", "old-fashioned", "brand-new", "oven-proof"]
)
def test_an_adjective_set_off_behind_its_noun_is_noted(said):
    plan = PLANNER.plan(f"A book and a candle, {said}, are on a table.")
    assert sorted(obj.noun for obj in plan.objects) == ["book", "candle", "table"]
    assert f'not modelled: "{said}"' in plan.notes
