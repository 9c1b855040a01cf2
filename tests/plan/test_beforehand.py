"""What an instruction tells of how things stand before it is done."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import chain

PLANNER = GrammarPlanner()
NEEDLESS = ("assumed", "worded like nothing", "is made as", ": no task does that.",
            "are shared out", "is read as picking it up")  # fmt: skip


def told(prompt: str) -> tuple[set[str], str | None, list[str]]:
    plan = PLANNER.plan(prompt)
    notes = [note for note in plan.notes if not any(word in note for word in NEEDLESS)]
    return {str(relation) for relation in plan.relations}, plan.task, notes


@pytest.mark.parametrize(
    ("prompt", "there", "task"),
    [
        ("Put the jar with the marble on the plate.", {"marble in jar"}, "place:jar:plate"),
        ("Slide the tray with the mug towards the globe.", {"mug on tray"}, None),
        ("Push the dish with the muffin to the globe.", {"muffin on dish"}, "beside:dish:next_to:globe"),
        ("Place the basket with one pear in the crate.", {"pear in basket"}, "place:basket:crate"),
        ("Move the red tray with the candle on it to the bench.", {"candle on red tray"}, "place:red tray:bench"),
        ("Push the saucer with the muffin forward.", {"muffin on saucer"}, None),
        ("Move the jug with the rose to the shelf and the jug with the lime to the bench.",
         {"rose in jug 1", "lime in jug 2"}, chain("place:jug 1:shelf", "place:jug 2:bench")),
        ("Move the chair with the pillow to the desk.", {"pillow on chair"}, None),
        # What is closed or pushed with something is not told by that.
        ("Put the pot with the lid on the stove.", {"lid on pot"}, "place:pot:stove"),
        ("Push the crate with the broom to the bench.", set[str](), None),
    ],
)  # fmt: skip
def test_what_is_moved_carries_what_it_is_told_by(prompt: str, there: set[str], task: str | None):
    assert told(prompt)[:2] == (there, task)


@pytest.mark.parametrize(
    ("prompt", "there"),
    [
        ("Swap the mug on the bench with the one on the stool.", {"mug 1 on bench", "mug 2 on stool"}),
        ("Swap the red mug on the bench with the blue one on the stool.", {"red mug on bench", "blue mug on stool"}),
        ("Exchange the pear in the bowl for the lime on the plate.", {"pear in bowl", "lime on plate"}),
        ("Switch the candle on the desk and the globe on the stool.", {"candle on desk", "globe on stool"}),
        ("Please trade the pen in the cup for the ruler in the jar.", {"pen in cup", "ruler in jar"}),
        ("Wipe the desk around the globe.", {"globe on desk"}),
        ("Clean the table around the vase and the candle.", {"vase on table", "candle on table"}),
        ("Top up the mug from the jug.", set[str]()),
        ("Top off the glass from the bottle.", set[str]()),
        ("Pour the marbles in the bowl.", set[str]()),
        ("Pour the marbles into the jar, then the buttons over them.", set[str]()),
        ("Crack the egg in the wok.", set[str]()),
        ("Pour the cereal in the bowl, then the honey over it.", set[str]()),
        ("Wipe the plate, then rinse the mug in the sink.", set[str]()),
        ("Arrange the mugs, plates and jars next to each other on the tray.", set[str]()),
    ],
)
def test_where_things_are_before(prompt: str, there: set[str]):
    found, task, _ = told(prompt)
    assert (found, task) == (there, None)


def test_what_is_carried_to_a_planter_is_put_next_to_it():
    assert told("Carry the watering can to the planter.") == (set[str](), "beside:watering can:next_to:planter", [])


@pytest.mark.parametrize(
    ("prompt", "there", "notes"),
    [
        ("Flip the muffin in the wok with the spatula.", {"muffin in wok"}, ['not modelled: "with the spatula"']),
        ("Turn the sausage in the pan with the tongs.", {"sausage in pan"}, ['not modelled: "with the tongs"']),
        ("Open the box beside the lamp with the crowbar.", {"box next_to lamp"},
         ['not modelled: "with the crowbar"']),
        ("Open the jar on the bench with the knife.", {"jar on bench"}, ['not modelled: "with the knife"']),
        ("Open the jar using a spoon.", set[str](), ['not modelled: "using a spoon"']),
        ("Open the box with the ring.", {"ring in box"}, list[str]()),
        ("Rotate the tray with the mug.", {"mug on tray"}, list[str]()),
    ],
)  # fmt: skip
def test_what_a_deed_is_done_with_lies_apart(prompt: str, there: set[str], notes: list[str]):
    assert told(prompt) == (there, None, notes)


@pytest.mark.parametrize(
    ("prompt", "there", "task"),
    [
        ("Collect the two marbles from behind the globe.", {"marble 1 behind globe", "marble 2 behind globe"}, None),
        ("Collect the mug from the bench.", {"mug on bench"}, "pick:mug"),
        ("Hand over the ladle lying beside the jug.", {"ladle next_to jug"}, "pick:ladle"),
        ("Hand over the ladle.", set[str](), "pick:ladle"),
        ("Pass the ruler lying next to the globe.", {"ruler next_to globe"}, "pick:ruler"),
        ("There is a mug on the bench and one on the stool. Take the one from the stool.",
         {"mug 1 on bench", "mug 2 on stool"}, "pick:mug 2"),
        ("There's a pen on the bed and another on the floor. Pick up the one on the floor.", {"pen 1 on bed"},
         "pick:pen 2"),
        ("A book lies on the bed and one lies on the floor. Move the one from the floor to the desk.",
         {"book 1 on bed"}, "place:book 2:desk"),
        ("From the bowl, take a pear.", {"pear in bowl"}, "pick:pear"),
        ("From the crate, pick up the red mug.", {"red mug in crate"}, "pick:red mug"),
        ("Put the rose into the planter.", set[str](), "place:rose:planter"),
        ("There is a cart. A jug and a rope are on it. Unload all of it.", {"jug on cart", "rope on cart"},
         "unload:cart"),
        ("There is a crate. A jug and a mug are in it. Empty it.", {"jug in crate", "mug in crate"}, "unload:crate"),
    ],
)  # fmt: skip
def test_which_is_meant_by_where_it_is(prompt: str, there: set[str], task: str | None):
    assert told(prompt) == (there, task, [])


@pytest.mark.parametrize(
    ("prompt", "task", "note"),
    [
        ("I want the green jug, not the white one.", "pick:green jug", 'not modelled: "not the white one"'),
        ("I'd like the small box, not the large one.", "pick:small box", 'not modelled: "not the large one"'),
        ("Take the bulb out of the lamp.", "pick:bulb", 'not arranged: "bulb" inside "lamp"; it is placed on it'),
        ("Take the coin out of the clock.", "pick:coin", 'not arranged: "coin" inside "clock"; it is placed on it'),
    ],
)
def test_a_note_names_what_is_not_there(prompt: str, task: str, note: str):
    _, found, notes = told(prompt)
    assert (found, notes) == (task, [note])
