"""Other ways to write what is read give the same scene."""

import pytest

from pat3d.errors import PromptError
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
        ("Put the ruler back in the drawer.", "Put the ruler in the drawer."),
        ("Reach for the mug on the tray and pick it up.", "Pick up the mug on the tray."),
        ("Stacking a mug on a plate.", "Stack a mug on a plate."),
        ("Build a tower using three red cubes.", "Stack the three red cubes."),
        ("There seems to be a vase behind the clock.", "A vase is behind the clock."),
        ("In this photo we can see a mug on a tray.", "A mug on a tray."),
        ("A toaster stands not far from the kettle.", "A toaster stands near the kettle."),
        ("Four bowls stand in a 2 by 2 grid on a desk.", "A 2x2 grid of four bowls on a desk."),
        ("The forks go into the drawer.", "Put the forks into the drawer."),
        ("Object A: jar. Object B: mug. B is behind A.", "A mug is behind a jar."),
        ("A tray lies on the desk and carries a mug.", "A tray carries a mug and lies on the desk."),
        ("Put the fig in bin 1 and the plum in bin 2.", "Put the fig in the first bin and the plum in the second bin."),
        (
            "A lamp is on shelf A and a vase is on shelf B.",
            "A lamp is on the first shelf, a vase is on the second shelf.",
        ),
        ("Three trays carried three mugs.", "Three trays carry three mugs."),
        ("Put all the mugs but the red one in the sink.", "There is a red mug. Put all the other mugs in the sink."),
        ("Row 1: red mug, blue mug.", "A red mug and a blue mug are in a row."),
        (
            "The front row has two jars and the back row three mugs.",
            "A row of two jars is in front of a row of three mugs.",
        ),
        (
            "Open the pot by lifting the lid and placing it on the tray.",
            "Open the pot, lift the lid and place it on the tray.",
        ),
        ("Four trees surround a bench.", "Four trees around a bench."),
        (
            "A desk with various items that include a pen and a mug.",
            "A desk with various items including a pen and a mug.",
        ),
        ("Salt and pepper next to a plate.", "A salt shaker and a pepper shaker next to a plate."),
        ("Open the cabinet and pick up the bowl in there.", "Open the cabinet and pick up the bowl in it."),
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
        ("Push and close the oven.", "Push and close the oven"),
        ("Put the bolts in the jar and do not touch anything else.", "do not touch anything else"),
        ("A cut in half lemon lies on a plate.", "cut-in-half"),
        ("Three mugs stand on the tray at random locations.", "at random locations"),
        ("Two lanterns glimmered behind one vase.", "glimmered"),
        ("Four mugs stand in a curved line on a desk.", "curved"),
        ("Three wine glasses hang upside down from a wine rack.", "upside down"),
        ("Close the crate's lid.", "lid"),
        ("A toy dog guards a basket.", '"guards" is read as "next to"'),
        ("The cat licks the bowl.", '"licks" is read as "next to"'),
        ("Put the bowls on the tray for laying out a salad bar.", "for laying out a salad bar"),
        ("A tablet lies on a desk. The screen shows a spreadsheet.", "The screen shows a spreadsheet"),
        ("A crate, upside-down, serving as a stool.", "serving as a stool"),
        ("A tray holding, among other things, a mug and a spoon.", "among other things"),
        ("A fork lies on a napkin folded into a triangle.", "folded into a triangle"),
        ("A ladder taller than the shelf next to it.", "taller than"),
        ("A notebook with a name printed on it.", "with a name printed on it"),
        ("Two red bricks stand parallel to each other with a gap between them.", "with a gap between them"),
        ("Stack the plates from smallest to largest.", "from smallest to largest"),
        ("Sort the pens and the forks into two boxes, one kind per box.", "one kind per box"),
        ("A spoon lies next to the jar it belongs to.", "it belongs to"),
        ("Rotate the jug so that the spout points to the right.", "so that the spout points to the right"),
        ("Fetch the mug to garnish the soup.", "to garnish the soup"),
    ],
)
def test_what_is_left_out_is_noted(planner: GrammarPlanner, sentence: str, noted: str):
    plan = planner.plan(sentence)
    assert any(noted in note for note in plan.notes), plan.notes


@pytest.mark.parametrize(
    ("sentence", "noted", "task"),
    [
        ("Once the drawer is open, drop the pen in it.", "Once the drawer is open", "place:pen:drawer"),
        ("If there is a mug on the desk, put it in the sink.", "If there is a mug on the desk", "place:mug:sink"),
        ("Put the spoon on the plate without touching the mug.", "without touching the mug", "place:spoon:plate"),
    ],
)
def test_what_has_to_be_before_is_there_and_noted(planner: GrammarPlanner, sentence: str, noted: str, task: str):
    plan = planner.plan(sentence)
    assert any(noted in note for note in plan.notes), plan.notes
    assert plan.task == task


@pytest.mark.parametrize(
    ("sentence", "words"),
    [
        ("A sewing contraption stands on a desk.", '"sewing contraption"'),
        ("A trebuchet rests heavily on a table.", '"trebuchet"'),
        ("A mug stands on a stand.", '"stand" is not in the catalogue'),
        ("Move the door to the left.", '"door"'),
    ],
)
def test_a_refusal_names_the_words_at_fault(planner: GrammarPlanner, sentence: str, words: str):
    with pytest.raises(PromptError, match=words):
        planner.plan(sentence)


def test_what_is_written_at_the_end_of_a_sentence_is_set_aside(planner: GrammarPlanner):
    assert [obj.noun for obj in planner.plan('A mug reading "12/2020"').objects] == ["mug"]


def test_who_turns_is_no_object(planner: GrammarPlanner):
    assert [obj.noun for obj in planner.plan("Turn to face the desk.").objects] == ["desk"]
