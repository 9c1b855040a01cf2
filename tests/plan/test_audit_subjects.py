"""A relation word is said of what stands beside it; where a plan has it of something else, a note says so."""

import pytest

from pat3d.plan.audit.auditor import audited
from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.subjects import said_of
from pat3d.plan.audit.text import read
from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.test_audit_places import find, notes, plan

NAMED = {"mug": "A mug", "book": "a book", "cup": "a cup", "box": "a box", "table": "a table", "hat": "a hat"}


def said(prompt: str, word: str) -> tuple[list[str], bool]:
    """The names that the first relation word `word` of `prompt` is said of, and whether of all."""
    it = Compared(plan(prompt, NAMED), read(prompt, find), ())
    claim = next(claim for claim in it.said.claims if claim.said.startswith(word))
    mentions, whole = said_of(it, claim)
    return [mention.text for mention in mentions], whole


@pytest.mark.parametrize(
    ("prompt", "word", "names", "whole"),
    [
        ("A mug on a table.", "on", ["mug"], False),
        ("A mug, a cup and a hat are on a table.", "on", ["mug", "cup", "hat"], True),
        ("A mug on a book is beside a box.", "beside", ["mug"], False),
        ("A mug on a book beside a box.", "beside", ["book", "mug"], False),
        ("Beside a box lie a mug and a cup.", "beside", ["mug", "cup"], False),
        ("A mug on its side and a cup on a table.", "on a table", ["mug", "cup"], False),
        ("A mug on a box, a cup on a table.", "on a table", ["cup"], False),
        ("A box with a hat, a mug and a cup are on a table.", "on", ["box", "mug", "cup"], True),
    ],
)
def test_what_a_relation_word_is_said_of_stands_beside_it(prompt, word, names, whole):
    assert said(prompt, word) == (names, whole)


def test_what_the_plan_relates_to_something_else_is_said():
    prompt = "A mug and a cup are on a table, and the cup is beside a box."
    phrases = {name: NAMED[name] for name in ("mug", "cup", "table", "box")}
    on = ("mug on table", "cup on table", "box on table")
    assert not any("read as said of" in note for note in notes(plan(prompt, phrases, *on, "cup next_to box")))
    assert '"beside a box" is not read as said of "cup"' in notes(plan(prompt, phrases, *on, "mug next_to box"))


def test_one_of_a_list_that_a_verb_tells_of_as_a_whole_is_said():
    prompt = "A mug and a hat lie on a box."
    phrases = {"mug": "A mug", "hat": "a hat", "box": "a box", "cup": "a cup"}
    half = plan(prompt + " A cup is beside the hat.", phrases, "mug on box", "cup next_to hat")
    assert any('"on a box" is not read as said of "hat"' in note for note in notes(half))


def test_what_is_behind_it_in_a_chain_is_the_nearer_or_is_said():
    prompt = "A mug is on a book. A cup lies on a table beside it."
    phrases = {"mug": "A mug", "book": "a book", "cup": "A cup", "table": "a table"}
    told = plan(prompt, phrases, "mug on book", "cup on table", "cup next_to book")
    assert '"beside it" is read as said of "cup"' in notes(told)


def test_too_and_row_excuse_no_other_relation():
    prompt = "A hat is on a box, too, and a mug and a cup are in a row."
    phrases = {"hat": "A hat", "box": "a box", "mug": "a mug", "cup": "a cup"}
    wrong = plan(prompt, phrases, "hat on box", "mug behind box")
    assert any(note.startswith('assumed: "a mug" behind "a box"') for note in notes(wrong))


def test_so_is_something_else():
    prompt = "A mug is on a box, and so is the hat."
    phrases = {"mug": "A mug", "box": "a box", "hat": "the hat"}
    assert notes(plan(prompt, phrases, "mug on box", "hat on box")) == ()


@pytest.mark.parametrize(
    ("sentence", "named"),
    [
        ("As well as a bowl of popcorn, there are two remotes and a blanket on the sofa.", "bowl on the ground"),
        ("The books are organized on a shelf beside the notice board.", '"shelf"'),
        ("Put two salt shakers inside of a suitcase.", 'inside "a suitcase"'),
    ],
)
def test_sentences_that_were_misread_without_a_word_are_read_or_noted(sentence, named):
    assert any(named in note for note in GrammarPlanner().plan(sentence).notes)


def test_a_relation_of_the_scene_before_a_task_needs_a_word_too():
    prompt = "Put the hat on the box and take it to the table."
    phrases = {"hat": "the hat", "box": "the box", "table": "the table"}
    told = plan(prompt, phrases, "hat on table")
    told = audited(type(told)(prompt=prompt, objects=told.objects, relations=told.relations, task="place:hat:box"),
                   find, ("table",))  # fmt: skip
    assert 'not as said: "take it to the table"' in told.notes
