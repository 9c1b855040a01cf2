"""Every word of a sentence has an effect on the plan, or a note names it; else it is refused by that word."""

from dataclasses import replace

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.account import miscounted, words_left
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.grammar.words.modifiers import read_modifiers

PLANNER = GrammarPlanner()
MUGS = Phrase(kind="object", words="two red mugs", head="mugs", noun="mug", said="mug", count=2, plural=True,
              modifiers=read_modifiers(["red"]))  # fmt: skip


def _chunk(phrase: Phrase, *words: str) -> Chunk:
    return Chunk(kind="noun", text=" ".join(words), phrase=phrase, words=words)


def _items(count: int, phrase: Phrase = MUGS) -> list[Item]:
    group = Group(phrase=phrase, noun="mug", said="mug", modifiers=phrase.modifiers)
    group.items = [Item(group=group) for _ in range(count)]
    return group.items


def test_a_word_that_a_phrase_swallowed_is_found():
    assert words_left(_chunk(MUGS, "two", "red", "mugs")) == []
    assert words_left(_chunk(MUGS, "two", "sleepy", "red", "mugs")) == ["sleepy"]
    assert words_left(_chunk(replace(MUGS, modifiers=read_modifiers([])), "two", "red", "mugs")) == ["red"]


def test_a_number_that_is_not_the_number_of_objects_is_found():
    chunk = _chunk(MUGS, "two", "red", "mugs")
    assert miscounted(chunk, _items(2)) is None
    assert miscounted(chunk, _items(3)) == "two"


def test_a_number_for_each_of_several_is_as_many_times_it():
    items = _items(4)
    assert miscounted(_chunk(MUGS, "two", "red", "mugs"), items) == "two"
    items[0].group.multiplied = True
    assert miscounted(_chunk(MUGS, "two", "red", "mugs"), items) is None


@pytest.mark.parametrize(
    ("sentence", "word"),
    [
        ("A tower of alternating red and white cubes, six in all.", "six"),
        ("The second shelf of the bookcase holds a trophy.", "second"),
        ("Each of the four corners of the table has a candle.", "four"),
        ("A tray that carries two cups, one tilted.", "tilted"),
        ("The mug's handle points to the left of the kettle.", "points"),
        ("A mug with a picture of a cat on it.", "picture of a cat"),
        ("Six glasses on a tray, two of them broken.", "broken"),
        ("A pizza cut into slices, with a pizza cutter beside it.", "cut into slices"),
        ("A toy car whose wheels are red.", "whose wheels are red"),
        ("A yellow cup on the table and a cup of the same colour under it.", "of the same colour"),
        ("Move the vase to where the clock is.", "where the clock is"),
        ("Three eggs in a bowl and one beside it.", "further"),
        ("A speaker is connected to a laptop on the desk.", "to"),
        ("Lift the lid of the laptop.", "the lid of the laptop"),
        ("Two lemons were left on the chopping board, right next to the knife.", "is next to"),
    ],
)
def test_what_is_not_read_is_named(sentence: str, word: str):
    assert any(word in note for note in PLANNER.plan(sentence).notes)


@pytest.mark.parametrize(
    ("sentence", "why"),
    [
        ("Most of the blocks are red.", r'"most" \(word 1\): say how many in numbers'),
        ("Two pieces of fruit, but none of them are pears.", r'"none" \(word 6\): a prompt says what is there'),
        ("A plant stands either on the desk or beside it.", r'"either" \(word 4\): say the one thing'),
        ("A mug is behind it.", r'"it" \(word 5\): nothing before it is meant'),
        ("A side table is on an alarm clock.", "furniture rests on no such thing"),
    ],
)
def test_what_cannot_be_read_is_refused_by_its_word(sentence: str, why: str):
    with pytest.raises(PromptError, match=why):
        PLANNER.plan(sentence)


@pytest.mark.parametrize(
    ("sentence", "never"),
    [
        ("An armchair next to a small round table with a bowl on it.", "bowl is on the armchair"),
        ("A tray with a teapot, two cups and a plate of three cookies on a low table.", "table is on"),
        ("A red plate topped with broccoli, cheese and carrots.", "carrots stand on the ground"),
    ],
)
def test_no_second_reading_is_told_that_nobody_thinks_of(sentence: str, never: str):
    assert never not in PLANNER.plan(sentence).otherwise


def test_what_is_set_aside_holds_nothing_up_and_a_note_says_so():
    plan = PLANNER.plan("A broom leaning against the wall.")
    assert plan.set_aside == ("the wall",)
    assert plan.notes == ('not arranged: "leaning against" "the wall", which is set aside',)


@pytest.mark.parametrize(
    ("sentence", "named"),
    [
        ("Between the monitor and the edge of the desk lies a pen.", "edge"),
        ("The knife is in the block.", "inside"),
        ("The keyboard goes in front of the screen and the mouse goes to its right.", "keyboard"),
        ("Open the lamp and take out the doll.", "take out"),
        ("A basket is hanging under a shelf.", "hanging"),
    ],
)
def test_what_a_scene_does_not_hold_of_a_place_is_named(sentence, named):
    assert any(named in note for note in PLANNER.plan(sentence).notes)


def test_every_second_one_is_refused():
    with pytest.raises(PromptError, match="every second"):
        PLANNER.plan("A row of four jars in which every second jar holds a candle.")


@pytest.mark.parametrize(("part", "kind"), [("head", "upside_down"), ("side", "on_its_side")])
def test_one_of_them_is_turned_and_the_others_are_not(part, kind):
    plan = PLANNER.plan(f"Two cups on a tray, one of them on its {part}.")
    assert [(one.object, one.kind) for one in plan.turned()] == [("cup 1", kind)]


def test_what_is_on_a_head_stays_on_it():
    plan = PLANNER.plan("A plush elephant with three hats stacked on its head.")
    assert "hat 1 on plush elephant" in map(str, plan.relations)
    assert not plan.turned()


def test_what_is_inserted_where_it_may_be_said_of_several_things_is_refused():
    with pytest.raises(PromptError, match="next to it"):
        PLANNER.plan("On a stove is a frying pan with two eggs and, next to it, a pepper mill.")
