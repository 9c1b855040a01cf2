"""Sentences about drawers: in a cabinet, in rows, opened and shut."""

from __future__ import annotations

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.scene.task_spec import chain_of

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("sentence", "nouns", "task"),
    [
        ("Open the top drawer of the cabinet.", "drawer", "open:top drawer"),
        ("Open the cabinet drawer.", "drawer", "open:drawer"),
        ("Pull the cabinet's top drawer open.", "drawer", "open:top drawer"),
        ("Slide the middle drawer of the dresser shut.", "open drawer", "close:middle drawer"),
        ("Push the bottom drawer in.", "open drawer", "close:bottom drawer"),
        ("Slide out the bottom drawer of the dresser.", "drawer", "open:bottom drawer"),
        ("Open the second drawer from the top.", "drawer", "open:middle drawer"),
        ("Open the third drawer from the bottom.", "drawer", "open:top drawer"),
        ("Put the apple in the top drawer of the cabinet.", "open drawer", "place:apple:top drawer"),
        ("Take the fork out of the top drawer of the cabinet.", "open drawer", "pick:fork"),
        (
            "Open the top drawer of the cabinet, put the cube in it and close it.",
            "drawer",
            "chain:open:top drawer:then:place:cube:top drawer:then:close:top drawer",
        ),
        ("Two socks are in the open drawer of a dresser.", "open drawer", None),
        ("Put the cup to the left of the drawer.", "drawer", "beside:cup:left_of:cabinet"),
        ("Open the top drawer and close the bottom drawer of the cabinet.", "drawer, open drawer",
         "chain:open:top drawer:then:close:bottom drawer"),
    ],
)  # fmt: skip
def test_a_drawer_is_in_a_cabinet_and_is_as_the_task_needs_it(sentence, nouns, task):
    plan = PLANNER.plan(sentence)
    drawers = [obj for obj in plan.objects if obj.noun in ("drawer", "open drawer")]
    (cabinet,) = (obj for obj in plan.objects if obj.noun == "drawer cabinet")
    assert ", ".join(obj.noun for obj in drawers) == nouns
    assert all(plan.parent(obj.name) == cabinet.name for obj in drawers)
    assert plan.task == task


def test_cabinet_and_drawer_have_their_own_colours():
    plan = PLANNER.plan("Open the red drawer of the white cabinet.")
    assert {obj.noun: obj.colours for obj in plan.objects} == {"drawer cabinet": ("white",), "drawer": ("red",)}
    assert not [note for note in plan.notes if "white" in note]


def test_what_is_on_and_beside_a_cabinet_stays_there():
    plan = PLANNER.plan(
        "A lamp is on the cabinet and a chair is next to the cabinet. Open the top drawer of the cabinet."
    )
    assert {str(rel) for rel in plan.relations} == {
        "top drawer in cabinet", "lamp on cabinet", "chair next_to cabinet"
    }  # fmt: skip


@pytest.mark.parametrize(
    ("sentence", "noted"),
    [("Open the left drawer.", '"left" of "the left drawer"'), ("Open the desk drawer.", "no task does that"),
     ("Open the drawer.", "a cabinet is made")],
)  # fmt: skip
def test_what_is_made_otherwise_is_noted(sentence, noted):
    assert any(noted in note for note in PLANNER.plan(sentence).notes)


def test_more_drawers_than_rows_are_refused():
    with pytest.raises(PromptError, match="a cabinet has 3 rows"):
        PLANNER.plan("Open the top drawer, the middle drawer, the bottom drawer and the lowest drawer.")


def test_a_chain_may_open_and_close_one_drawer_but_not_open_it_twice():
    assert chain_of(["open:d", "place:a:d", "close:d"]) == "chain:open:d:then:place:a:d:then:close:d"
    assert chain_of(["open:d", "open:d"]) is None
