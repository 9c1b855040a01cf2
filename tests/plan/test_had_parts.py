"""Parts that a thing is said to have are noted, whatever the catalogue has; alone they are no things."""

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


@pytest.mark.parametrize(
    ("sentence", "relations", "part"),
    [
        ("A belt with a polished buckle lies on a bench.", {"belt on bench"}, "polished buckle"),
        ("A bag with a canvas strap and a brass clasp is on a chair.", {"bag on chair"}, "clasp"),
        ("A vase with a narrow neck is on a table.", {"vase on table"}, "narrow neck"),
        ("A dog with a red collar is next to a sofa.", {"dog next_to sofa"}, "collar"),
        ("A hat with a white feather on a shelf.", {"hat on shelf"}, "feather"),
        ("A mug with a chipped handle on a shelf.", {"mug on shelf"}, "chipped handle"),
        ("A candle with less wax is on a plate.", {"candle on plate"}, "wax"),
        ("A doll with long hair sits on a bed.", {"doll on bed"}, "long hair"),
        ("A box with a red ribbon around it is on a table.", {"box on table"}, "ribbon"),
    ],
)
def test_a_part_that_a_thing_has_is_noted_and_the_thing_is_there(
    planner: GrammarPlanner, sentence: str, relations: set[str], part: str
):
    plan = planner.plan(sentence)
    assert {str(relation) for relation in plan.relations} == relations
    assert any(part in note for note in plan.notes)


@pytest.mark.parametrize(
    "sentence",
    ["A buckle is on a table.", "A jar of feathers.", "A bird sits on the roof of a shed."],
)
def test_a_part_by_itself_is_nothing_that_can_be_made(planner: GrammarPlanner, sentence: str):
    with pytest.raises(PromptError):
        planner.plan(sentence)


def test_the_colour_of_a_part_that_is_said_of_the_whole_is_noted(planner: GrammarPlanner):
    assert any("zipper" in note for note in planner.plan("The zipper of the bag is red.").notes)


@pytest.mark.parametrize(
    ("sentence", "things", "part"),
    [
        ("A trolley with wheels on it", {"trolley"}, "wheels"),
        ("A suitcase has four wheels and stands next to a bench.", {"suitcase", "bench"}, "four wheels"),
        ("A typewriter with white keys on it on a bench", {"typewriter", "bench"}, "keys"),
        ("A banjo with strings on it", {"banjo"}, "strings"),
        ("A tablet with a screen on it", {"tablet"}, "a screen"),
        ("A marker with a cap on it", {"marker"}, "a cap"),
    ],
)
def test_a_thing_that_is_a_part_of_its_owner_is_noted(
    planner: GrammarPlanner, sentence: str, things: set[str], part: str
):
    plan = planner.plan(sentence)
    assert {obj.name for obj in plan.objects} == things
    assert any(part in note for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "things"),
    [
        ("A suitcase with a wheel next to it", {"suitcase", "wheel"}),
        ("A shelf with a wheel on it", {"shelf", "wheel"}),
        ("A trolley holding two wheels", {"trolley", "wheel 1", "wheel 2"}),
        ("A bench with a tablet and a screen on it", {"bench", "tablet", "screen"}),
    ],
)
def test_the_same_elsewhere_is_a_thing(planner: GrammarPlanner, sentence: str, things: set[str]):
    assert {obj.name for obj in planner.plan(sentence).objects} == things


@pytest.mark.parametrize(
    ("sentence", "beside", "posed"),
    [
        ("A sofa with a floor lamp on its side", {"floor lamp next_to sofa"}, False),
        ("Two stools. One has a bin on its side, the other a hat on it.", {"bin next_to stool 1"}, False),
        ("A bench has a potted plant on its side.", {"potted plant next_to bench"}, False),
        ("A table with a mug on its side", set(), True),
        ("A crate with a bottle on its side", set(), True),
    ],
)
def test_what_a_chair_has_on_its_side_stands_beside_it(
    planner: GrammarPlanner, sentence: str, beside: set[str], posed: bool
):
    plan = planner.plan(sentence)
    assert {str(relation) for relation in plan.relations if not relation.supports} == beside
    assert bool(plan.postures) == posed
