"""What a prompt says and no plan has is said back: in a note or in the error."""

import pytest

from pat3d.errors import PromptError
from pat3d.generation.request import objects_of_plan
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import Extent, PlannedObject
from pat3d.progress import silent
from tests.plan.vocabulary import Table


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner(vocabulary=Table())


def only(planner: GrammarPlanner, prompt: str) -> PlannedObject:
    (obj,) = planner.plan(prompt).objects
    return obj


@pytest.mark.parametrize(
    ("prompt", "metres", "axis"),
    [
        ("A 20 cm tall vase.", 0.2, "height"),
        ("a vase 20 cm tall", 0.2, "height"),
        ("a 20-cm-tall vase", 0.2, "height"),
        ("a vase with a height of 25 cm", 0.25, "height"),
        ("The vase is 20 cm high.", 0.2, "height"),
        ("a 3½ cm block", 0.035, None),
        ("a 1/2 inch block", 0.0127, None),
        ("a 5cm block", 0.05, None),
        ("a 50 mm block", 0.05, None),
        ("a ten centimetre block", 0.1, None),
        ("a 30 cm wide plate", 0.3, "width"),
        ("a 1.2 m long table", 1.2, "length"),
        ("a 3 foot long table", 0.9144, "length"),
        ("a 12-inch ruler", 0.3048, None),
        ("a plate 25 cm in diameter", 0.25, "length"),
        ("a 20 cm tall, blue vase", 0.2, "height"),
        ("a table that is 1.5 m long", 1.5, "length"),
    ],
)
def test_a_length_sets_the_size_of_one_object(planner: GrammarPlanner, prompt: str, metres: float, axis: str | None):
    extent = only(planner, prompt).extent
    assert extent is not None
    assert (extent.metres, extent.axis) == (pytest.approx(metres), axis)


def test_lengths_count_nothing_and_numbers_beside_them_do(planner: GrammarPlanner):
    plan = planner.plan("two 5cm blocks on a 1.2 m long table")
    assert [obj.name for obj in plan.objects] == ["block 1", "block 2", "table"]
    assert plan.notes == ()


def test_what_stands_to_each_other_is_of_one_group(planner: GrammarPlanner):
    for words in ("leaning against", "in front of", "facing", "inside"):
        assert len(planner.plan(f"Two books {words} each other").objects) == 2


def test_a_cube_of_three_equal_lengths_needs_no_note(planner: GrammarPlanner):
    assert planner.plan("A 6x6x6 cm block").notes == ()


def test_a_box_of_three_lengths_has_the_longest_and_says_so(planner: GrammarPlanner):
    plan = planner.plan("A 10x10x5 cm box")
    assert plan.objects[0].extent == Extent(metres=0.1)
    assert plan.notes == ('"10x10x5 cm": the longest side is 0.1 m, the others follow.',)


@pytest.mark.parametrize(
    ("prompt", "size", "factor"),
    [
        ("a 20 cm tall vase", (0.1, 0.1, 0.4), 0.5),
        ("a 20 cm wide vase", (0.1, 0.2, 0.4), 2.0),
        ("a 20 cm deep box", (0.1, 0.4, 0.8), 0.5),
        ("a 20 cm long box", (0.1, 0.4, 0.8), 0.5),
        ("a 2 cm thick book", (0.2, 0.3, 0.04), 0.5),
        ("a 20 cm box", (0.1, 0.4, 0.8), 0.25),
    ],
)
def test_an_extent_scales_the_side_that_it_names(
    planner: GrammarPlanner, prompt: str, size: tuple[float, float, float], factor: float
):
    extent = only(planner, prompt).extent
    assert extent is not None
    assert extent.factor(size) == pytest.approx(factor)


def test_an_asset_has_the_size_that_the_prompt_gives():
    plan = GrammarPlanner().plan("two 5cm cubes, a huge 30 cm plate and a 20 cm tall vase")
    sizes = {made.name: made.asset.size for made in objects_of_plan(plan, 0, silent)}
    assert [sizes[f"cube {number}"].max() for number in (1, 2)] == pytest.approx([0.05, 0.05])
    assert sizes["huge plate"].max() == pytest.approx(0.3)
    assert sizes["vase"][2] == pytest.approx(0.2)


@pytest.mark.parametrize("prompt", ["a 1 mm ball", "a 9000 m tall vase"])
def test_a_size_that_nothing_has_is_refused(planner: GrammarPlanner, prompt: str):
    with pytest.raises(PromptError, match="2 mm to 20 m"):
        planner.plan(prompt)


@pytest.mark.parametrize(
    ("prompt", "note"),
    [
        # Amounts and distances
        ("a 500 ml bottle", '"500 ml" is left out: of "a 500 ml bottle" only a size in metres or inches can be set.'),
        ("A mug 10 cm to the left of a plate", '"10 cm" is left out: distances between objects are not planned.'),
        ("Two mugs 20 cm apart", '"20 cm" is left out: distances between objects are not planned.'),
        ("a 20 cm tall, 10 cm wide vase",
         '"10 cm wide" is left out: "a 20 cm tall, 10 cm wide vase" has a size already and keeps its proportions.'),
        # Postures
        ("Three forks standing upright",
         'not arranged: "upright"; "Three forks" is placed the way the catalogue makes it'),
        ("A mug rotated by 45 degrees",
         'not arranged: "rotated by 45 degrees"; "A mug" is placed the way the catalogue makes it'),
        ("A mug with its handle facing right",
         'not arranged: "facing right"; "A mug" is placed the way the catalogue makes it'),
        # Relations that another stands in for
        ("Two books leaning against each other", 'not arranged: "Two books" leaning against each other'),
        ("A lamp above a table", 'not arranged: "A lamp" above "a table"; it is placed on it'),
        ("A lamp on two books", 'not arranged: "A lamp" on "two books" together; it is placed on the first'),
        ("A spoon in the top drawer of a desk",
         '"the top drawer of a desk": "desk" has no parts of its own and is meant.'),
        ("A ruler bridging a box and a chair.",
         'not arranged: "A ruler" across "a box" and "a chair" together; it is placed on the first'),
        # Places without anything to relate to
        ("A table with a mug on the left", '"a mug" (left): there is nothing beside it that it could be left of.'),
        ("A lamp on the desk's left side", '"A lamp" (left): there is nothing beside it that it could be left of.'),
        # Words
        ("A box that is twice as large as the mug next to it", 'not modelled: "A box" twice as large as "the mug"'),
        ("A mug or a bowl on a plate", '"or" is read as "and": everything named is placed.'),
        ("A knife block", '"knife" of "A knife block" is left out: it is made as a "block".'),
        ("A pile of toys", '"A pile of toys": its objects lie side by side, since as a stack they would not stay.'),
    ],
)  # fmt: skip
def test_what_a_plan_does_not_have_is_noted(planner: GrammarPlanner, prompt: str, note: str):
    assert note in planner.plan(prompt).notes


@pytest.mark.parametrize(
    "prompt",
    [
        "Three bottles standing upright",
        "A mug on the left, a bowl on the right",
        "A ball on one of two boxes",
        "A block and a ball to the right",
        "A dog beside a 40 cm tall box",
        "two cushions on two chairs",
    ],
)
def test_what_a_plan_has_is_not_noted(planner: GrammarPlanner, prompt: str):
    assert planner.plan(prompt).notes == ()


@pytest.mark.parametrize(
    ("prompt", "why"),
    [
        (
            "A tower of boxes in a pyramid.",
            r'"pyramid" \(word 7\) is an arrangement that cannot be planned',
        ),
        ("A pyramid of seven cups.", r'"pyramid" \(word 2\) .* 3, 6, 10 or 15'),
        ("A pyramid of six balls.", r'"pyramid" \(word 2\)'),
        ("Two pyramids of six cups.", r'"pyramids" \(word 2\)'),
        ("A bridge made of three blocks.", r'"bridge" \(word 2\)'),
        ("Four blocks forming an arch.", r'"arch" \(word 5\)'),
        ("A ball in two baskets", '"A ball" cannot be in 2 things at once'),
        ("The mug is not on the plate.", r'"not" \(word 4\)'),
        ("Neither a mug nor a bowl.", r'"neither" \(word 1\)'),
        ("A lamp on a lamp stand.", r'"lamp stand" is not in the catalogue'),
        ("Six cups in two rows of four.", '"Six cups" are 6 objects and cannot stand as 8'),
    ],
)
def test_what_no_scene_can_be_is_refused(planner: GrammarPlanner, prompt: str, why: str):
    with pytest.raises(PromptError, match=why):
        planner.plan(prompt)


@pytest.mark.parametrize(
    "prompt",
    [
        "An open box on a desk",
        "You can see a mug on a table.",
        "A lamp and a radio stand on a desk",
        "A mug in a square box",
        "Please put two mugs on the shelf.",
        "A statue of a dog",
    ],
)
def test_what_only_looks_like_an_instruction_or_a_shape_is_planned(planner: GrammarPlanner, prompt: str):
    assert planner.plan(prompt).objects


@pytest.mark.parametrize(
    ("prompt", "held", "holder"),
    [
        ("A mug on a desk with two pens in it.", "pen 1", "mug"),
        ("A bowl on a table with two apples in it.", "apple 2", "bowl"),
        ("A desk with a lamp on it.", "lamp", "desk"),
    ],
)
def test_it_is_what_can_hold(planner: GrammarPlanner, prompt: str, held: str, holder: str):
    assert planner.plan(prompt).parent(held) == holder
