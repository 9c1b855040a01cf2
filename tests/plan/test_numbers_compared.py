"""Two kinds of which one is counted by the other, or of which the sentence only says again that there are more."""

from collections import Counter

import pytest

from pat3d.plan.audit.auditor import audited
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import PlannedObject, ScenePlan


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


@pytest.mark.parametrize(
    ("sentence", "counts"),
    [
        ("A stool and three dogs. There are fewer stools than dogs.", {"stool": 1, "dog": 3}),
        ("Two vases and five books, with fewer vases than books.", {"vase": 2, "book": 5}),
        ("A red cup and four blue cups; there are fewer red cups than blue cups.", {"cup": 5}),
        ("Two forks and three spoons. There are more spoons than forks.", {"fork": 2, "spoon": 3}),
        ("A tray holds two pears and a fig. The tray holds more pears than figs.", {"pear": 2, "fig": 1, "tray": 1}),
        ("Two spoons and one more fork than spoons.", {"spoon": 2, "fork": 3}),
        ("Six cups and two fewer plates than cups are on a table.", {"cup": 6, "plate": 4, "table": 1}),
        ("There are as many vases as bottles: two.", {"vase": 2, "bottle": 2}),
        ("Two vases are on a shelf. There are as many pots as vases.", {"vase": 2, "pot": 2, "shelf": 1}),
    ],
)  # fmt: skip
def test_what_is_counted_by_another_is_as_many(planner: GrammarPlanner, sentence: str, counts: dict[str, int]):
    plan = planner.plan(sentence)
    assert Counter(obj.noun for obj in plan.objects) == counts
    assert not any("than" in note or "counted otherwise" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "more", "fewer"),
    [
        ("Hats and mugs, more hats than mugs.", "hat", "mug"),
        ("Several cups and plates, with fewer cups than plates.", "plate", "cup"),
    ],
)
def test_there_are_more_of_the_kind_that_is_said_to_be_more(
    planner: GrammarPlanner, sentence: str, more: str, fewer: str
):
    counts = Counter(obj.noun for obj in planner.plan(sentence).objects)
    assert counts[more] > counts[fewer] > 0


@pytest.mark.parametrize(
    ("sentence", "named"),
    [
        ("Five pears and three figs, fewer pears than figs.", "fewer pears than figs"),
    ],
)
def test_numbers_that_contradict_a_comparison_are_named(planner: GrammarPlanner, sentence: str, named: str):
    assert any("counted otherwise" in note and named in note for note in planner.plan(sentence).notes)


@pytest.mark.parametrize(
    ("sentence", "cups", "noted"),
    [
        ("There are two more cups than plates.", 4, False),
        ("There are two more cups than plates.", 3, True),
        ("There are fewer cups than plates.", 2, True),
        ("More than three cups and two plates.", 3, True),
        ("More than three cups and two plates.", 4, False),
    ],
)
def test_the_audit_counts_what_is_compared(sentence: str, cups: int, noted: bool):
    names = [*((f"cup {n}", "cup") for n in range(cups)), *((f"plate {n}", "plate") for n in range(2))]
    objects = tuple(PlannedObject(name=name, noun=noun, phrase=noun) for name, noun in names)
    plan = audited(ScenePlan(prompt=sentence, objects=objects), {"cup": "cup", "plate": "plate"}.get)
    assert any("counted otherwise" in note for note in plan.notes) == noted


@pytest.mark.parametrize(
    ("sentence", "count", "named"),
    [
        ("More than two cups are on a table.", 3, "More than"),
        ("More than one cup is on a table.", 2, "More than"),
        ("Fewer than four cups are on a table.", 3, "Fewer than"),
        ("No more than four cups are on a table.", 4, "No more than"),
    ],
)
def test_a_bound_of_a_number_is_kept_and_named(planner: GrammarPlanner, sentence: str, count: int, named: str):
    plan = planner.plan(sentence)
    assert sum(obj.noun == "cup" for obj in plan.objects) == count
    assert f'not modelled: "{named}"' in plan.notes


def test_an_equal_number_is_as_many(planner: GrammarPlanner):
    plan = planner.plan("Four hats and an equal number of mugs.")
    assert Counter(obj.noun for obj in plan.objects) == {"hat": 4, "mug": 4}


def test_of_a_range_the_most_is_made_and_said(planner: GrammarPlanner):
    plan = planner.plan("A jar containing between two and three plums.")
    assert sum(obj.noun == "plum" for obj in plan.objects) == 3
    assert any("3 assumed" in note for note in plan.notes)
