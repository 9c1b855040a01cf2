"""Other ways to write what is read give the same scene."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


@pytest.mark.parametrize(
    ("sentence", "same"),
    [
        ("Put all of the forks in the drawer.", "Put all the forks in the drawer."),
        ("Three pan cakes and a lap top.", "Three pancakes and a laptop."),
        ("A lamp on a desk with a stapler near by.", "A lamp on a desk with a stapler nearby."),
        ("A vase stands either side of a mirror.", "A vase stands on either side of a mirror."),
        ("On the bench you can see two helmets.", "On the bench there are two helmets."),
        ("Place the fork next the plate.", "Place the fork next to the plate."),
        ("Put the toys away in the crate.", "Put the toys in the crate."),
        ("Give the robot the wrench.", "Fetch the wrench."),
        ("A robotic arm has to put the mug on the tray.", "Put the mug on the tray."),
        ("That mug belongs on the tray.", "Put that mug on the tray."),
        ("Two chairs stand left and right of the table.", "Two chairs stand to the left and right of the table."),
        ("A clock should stand on the shelf.", "A clock stands on the shelf."),
    ],
)
def test_both_give_one_scene(planner: GrammarPlanner, sentence: str, same: str):
    plan, other = planner.plan(sentence), planner.plan(same)
    assert (set(plan.relations), plan.task) == (set(other.relations), other.task)
    assert sorted(obj.noun for obj in plan.objects) == sorted(obj.noun for obj in other.objects)


@pytest.mark.parametrize(
    ("sentence", "noted"),
    [
        ("Swap the positions of the jar and the mug.", "Swap the positions of the jar and the mug"),
        ("Have the jar and the mug trade places.", "Have the jar and the mug trade places"),
        ("Push and close the drawer.", "Push and close the drawer"),
        ("Put the bolts in the jar and do not touch anything else.", "do not touch anything else"),
        ("A cut in half lemon lies on a plate.", "cut-in-half"),
        ("Three mugs stand on the tray at random locations.", "at random locations"),
        ("Two lanterns glimmered behind one vase.", "glimmered"),
    ],
)
def test_what_is_left_out_is_noted(planner: GrammarPlanner, sentence: str, noted: str):
    plan = planner.plan(sentence)
    assert any(noted in note for note in plan.notes), plan.notes
    assert plan.task is None
