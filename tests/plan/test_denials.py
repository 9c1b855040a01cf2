"""What is said not to be there is named in a note, and what else the sentence says is read."""

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


@pytest.mark.parametrize(
    ("sentence", "relations", "denied"),
    [
        ("The yellow mug, not the black one, is on the tray.", {"yellow mug on tray"}, "not the black one"),
        ("It is the small crate, not the big one, that holds a hammer.", {"hammer in small crate"}, "not the big one"),
        ("The marble is in neither the jar nor the bucket but under the chair.", set(), "in neither the jar nor"),
        ("The fork is not on the napkin but next to it.", {"fork next_to napkin"}, "not on the napkin"),
        ("A kettle rather than a teapot stands on the stove.", {"kettle on stove"}, "rather than a teapot"),
        ("A spoon lies next to but not touching a knife.", {"spoon next_to knife"}, "but not touching"),
        ("A whisk, but not its bowl, is in the drawer.", {"whisk in drawer", "drawer in cabinet"}, "but not its bowl"),
    ],
)
def test_what_is_denied_beside_what_is_there_is_noted(
    planner: GrammarPlanner, sentence: str, relations: set[str], denied: str
):
    plan = planner.plan(sentence)
    assert {str(relation) for relation in plan.relations} == relations
    assert any(denied in note for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "count"),
    [
        ("Neither of the two baskets is full: one holds an apple, the other a pear.", 2),
        ("Neither basket has a lid, but the crate between them holds a ball.", 2),
        ("Nothing lies on the left half of the basket.", 1),
    ],
)
def test_what_a_denial_is_said_of_is_there(planner: GrammarPlanner, sentence: str, count: int):
    assert sum(obj.noun == "basket" for obj in planner.plan(sentence).objects) == count


@pytest.mark.parametrize("sentence", ["The mug is not on the tray.", "A mug does not stand on the tray."])
def test_a_sentence_that_only_denies_is_refused(planner: GrammarPlanner, sentence: str):
    with pytest.raises(PromptError, match="not what is not"):
        planner.plan(sentence)
