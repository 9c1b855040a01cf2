"""Names of one kind: when "a short one", "the larger one" and "the clean plate" are further things, and when not."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan
from tests.plan.vocabulary import chain


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


def told(plan: ScenePlan, noun: str) -> list[tuple[str, ...]]:
    """What every object of `noun` is told from its like by."""
    return [(*obj.name.rstrip(" 0123456789").split()[:-1], *obj.adjectives) for obj in plan.objects if obj.noun == noun]


@pytest.mark.parametrize(
    ("prompt", "noun", "expected"),
    [
        ("A tall bottle and a short one are on a shelf.", "bottle", [("tall",), ("short",)]),
        ("Two long candles stand left of a short one.", "candle", [("long",), ("long",), ("short",)]),
        ("One big bowl and two little ones on a tray.", "bowl", [("big",), ("little",), ("little",)]),
        ("A wooden stool beside a metal one.", "stool", [("wooden",), ("metal",)]),
        ("One large pan is on the stove, two small ones in the sink.", "pan", [("large",), ("small",), ("small",)]),
        ("The smallest crate stands on the biggest one.", "crate", [("small",), ("big",)]),
        ("The larger plate is below the smaller one.", "plate", [("larger",), ("smaller",)]),
        ("Four jars are on the desk: three large ones and a small one.", "jar", [("large",)] * 3 + [("small",)]),
        ("Three crates are on the floor. The smallest crate is on the largest one.", "crate",
         [("small",), ("large",), ()]),
        ("Put the metal spoon in the cup and the wooden spoon in the jar.", "spoon", [("metal",), ("wooden",)]),
        ("The dirty mug is beside the clean mug.", "mug", [("dirty",), ("clean",)]),
        ("The clean plate is on a shelf and the dirty one in the sink.", "plate", [("clean",), ("dirty",)]),
        ("Two clean cups and a dirty one are on a tray. The dirty one is red.", "cup",
         [("clean",), ("clean",), ("red", "dirty")]),
        ("A tray holds a white cup, a tall one and a short one.", "cup", [("white",), ("tall",), ("short",)]),
        ("On a tray are a bowl and a smaller one.", "bowl", [(), ("smaller",)]),
        ("A desk with two lamps, a wooden one and a metal one.", "desk", [()]),
        ("There is a wooden spoon. The spoon is in a cup.", "spoon", [("wooden",)]),
        ("A long spoon is in a jar. The spoon is red.", "spoon", [("red", "long")]),
    ],
)  # fmt: skip
def test_members_of_a_kind(planner: GrammarPlanner, prompt: str, noun: str, expected: list[tuple[str, ...]]):
    plan = planner.plan(prompt)
    assert told(plan, noun) == expected
    assert not any(start in note for note in plan.notes for start in ("counted otherwise", "not understood"))


def test_what_is_on_it_is_on_what_the_sentence_is_about(planner: GrammarPlanner):
    plan = planner.plan("On the desk is a large box, and a small one stands on top of it.")
    assert [(rel.child, rel.parent) for rel in plan.relations] == [("large box", "desk"), ("small box", "large box")]


def test_two_names_of_one_sentence_are_two_things(planner: GrammarPlanner):
    plan = planner.plan("Put the socks in the hamper and the shirts in the laundry basket.")
    assert [obj.name for obj in plan.objects if obj.noun == "laundry basket"] == ["hamper", "laundry basket"]
    assert not any("counted otherwise" in note for note in plan.notes)


@pytest.mark.parametrize(
    "prompt",
    [
        "A sofa stands on a rug. A cushion is on the couch.",
        "A laundry basket is beside the bed and a towel is in the basket.",
        "A dresser is by the bed and a lamp is on the drawer.",
    ],
)
def test_a_name_that_refers_back_makes_nothing_new(planner: GrammarPlanner, prompt: str):
    assert len(planner.plan(prompt).objects) == 3


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        ("All the fruits (a fig, a pear and a plum) are in the bowl.", ["fig", "pear", "plum"]),
        ("Two tools (hammer, saw) lie on the bench.", ["hammer", "saw"]),
        ("Two jars stand on a shelf: jam and honey.", ["jam jar", "honey jar"]),
        ("Put the cups (red, green, white) on the tray.", ["red cup", "green cup", "white cup"]),
        ("Place the boxes of three different colors (red, orange, blue) on the table.",
         ["red box", "orange box", "blue box"]),
        ("Two cubes (red, white) and two matching colored cups (red, white).",
         ["red cube", "white cube", "red cup", "white cup"]),
        ("The mugs (one red, two black) are on the shelf.", ["red mug", "black mug 1", "black mug 2"]),
        ("Two vases, white and blue, stand on a table.", ["white vase", "blue vase"]),
        ("Three balls are orange, red and green.", ["orange ball", "red ball", "green ball"]),
        ("Two orange and two green balls lie on a mat.",
         ["orange ball 1", "orange ball 2", "green ball 1", "green ball 2"]),
        ("A blue, an orange and a white cup are on a tray.", ["blue cup", "orange cup", "white cup"]),
        ("Two oranges and a green cup are on a tray.", ["orange 1", "orange 2", "green cup"]),
        ("A wine glass and glass bowl are on the table.", ["wine glass", "glass bowl"]),
    ],
)  # fmt: skip
def test_what_is_listed_is_what_was_counted(planner: GrammarPlanner, prompt: str, expected: list[str]):
    plan = planner.plan(prompt)
    assert [obj.name for obj in plan.objects][: len(expected)] == expected
    assert len(plan.objects) <= len(expected) + 1
    assert not any("counted otherwise" in note or "not in the scene" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "noun", "count"),
    [
        ("Some grapes and two pears are in a bowl.", "grapes", 1),
        ("Some bread lies on a board.", "bread", 1),
        ("Three mugs on saucers stand on a tray.", "saucer", 3),
        ("A kettle and two cups on saucers are on the table.", "saucer", 2),
        ("Five plates are on placemats.", "placemat", 5),
        ("Two lamps on tables.", "table", 2),
        ("Two pears and twice as many figs are in a bowl.", "fig", 4),
        ("Six pens and half as many pencils are in a cup.", "pencil", 3),
        ("There are two mugs and three times as many spoons on a tray.", "spoon", 6),
        ("A pot stands on a stove with four burners.", "bunsen burner", 0),
        ("A spoon with its bowl in a glass.", "bowl", 0),
        ("The jar on the left is empty and the jar on the right is full.", "jar", 2),
        ("The basket on the left holds a cup, the one on the right is empty.", "basket", 2),
        ("The left mug is red, the right one white.", "mug", 2),
        ("Two trays, each with a bun and a knife next to it.", "knife", 2),
    ],
)
def test_so_many_are_made(planner: GrammarPlanner, prompt: str, noun: str, count: int):
    plan = planner.plan(prompt)
    assert sum(obj.noun == noun for obj in plan.objects) == count
    assert not any("counted otherwise" in note for note in plan.notes)


def test_half_of_what_is_odd_is_noted(planner: GrammarPlanner):
    assert 'not understood: "half"' in planner.plan("Three figs and half as many pears are in a bowl.").notes


def test_what_is_in_a_dish_is_not_beside_it(planner: GrammarPlanner):
    plan = planner.plan("A plate with a bun and a fork next to it.")
    assert {(rel.child, rel.kind) for rel in plan.relations} == {("bun", "on"), ("fork", "next_to")}


def test_what_is_said_of_everything_is_said_of_each(planner: GrammarPlanner):
    plan = planner.plan("Everything on the tray is green: a cup, two bowls and a pen.")
    assert {obj.colours for obj in plan.objects if obj.name != "tray"} == {("green",)}
    assert len(plan.relations) == 4
    assert not plan.notes


@pytest.mark.parametrize(
    ("prompt", "noun", "count"),
    [
        ("Put two of the four figs in the cup and the rest in the bowl.", "fig", 4),
        ("Three of the four mugs on the tray are red.", "mug", 4),
        ("Place one pear in the jar and the other in the cup.", "pear", 2),
        ("Three jars are on a shelf. Pick up a jar.", "jar", 3),
        ("Two bowls are on a table. A spoon is in a bowl.", "bowl", 2),
        ("The mugs are upside down. There are four mugs on the tray.", "mug", 4),
        ("On each side of the sofa stands a side table with a lamp.", "lamp", 2),
        ("A salt and a pepper shaker are on a tray.", "salt shaker", 2),
        ("A tray holds four cups (red, blue, white, green). Put the blue cup and the green cup in the box.", "cup", 4),
    ],
)
def test_members_of_what_was_named(planner: GrammarPlanner, prompt: str, noun: str, count: int):
    plan = planner.plan(prompt)
    assert sum(obj.noun == noun for obj in plan.objects) == count
    assert not any("counted otherwise" in note for note in plan.notes)


def test_the_rest_are_moved_where_the_rest_are_said_to_go(planner: GrammarPlanner):
    plan = planner.plan("Put two of the four figs in the cup and the rest in the bowl.")
    assert plan.task == chain("place:fig 1:cup", "place:fig 2:cup", "place:fig 3:bowl", "place:fig 4:bowl")


def test_what_has_its_colour_keeps_it_when_it_is_sorted(planner: GrammarPlanner):
    plan = planner.plan(
        "Two red and two blue cubes and two boxes are on a mat. Sort the cubes by color into the boxes."
    )
    assert [obj.colours for obj in plan.objects if obj.noun == "cube"] == [("red",)] * 2 + [("blue",)] * 2


def test_a_colour_like_that_of_others_is_noted(planner: GrammarPlanner):
    assert any("same color" in note for note in planner.plan("Each of two trays holds a cup of the same color.").notes)
