"""Words for lengths, angles and sizes, and for objects."""

import math

import pytest

from pat3d.errors import EditError
from pat3d.generation.editing.selecting import chosen
from pat3d.generation.editing.words import angle_of, factor_of, halves, offset_of
from pat3d.plan.grammar.planner import GrammarPlanner


@pytest.mark.parametrize(
    ("text", "offset"),
    [
        ("10 cm to the right", (0.1, 0.0)),
        ("5 cm left and 20 mm back", (-0.05, 0.02)),
        ("0.1 m forward", (0.0, -0.1)),
        ("3cm to the left, 1 cm towards the front", (-0.03, -0.01)),
        ("1 inch right", (0.0254, 0.0)),
        ("onto the books", None),
        ("10 cm", None),
        ("10 cm to the right of the vase", None),
    ],
)
def test_lengths_and_directions_are_an_offset(text, offset):
    found = offset_of(text)
    assert found == offset if offset is None else found == pytest.approx(offset)


@pytest.mark.parametrize(
    ("text", "degrees"), [("90", 90), ("45 degrees clockwise", -45), ("30° counterclockwise", 30), ("-20 deg", -20)]
)
def test_angles_are_counter_clockwise(text, degrees):
    assert angle_of(text) == pytest.approx(math.radians(degrees))


@pytest.mark.parametrize(
    ("text", "factor"),
    [
        ("1.5", 1.5), ("20 % larger", 1.2), ("20% smaller", 0.8), ("2 times larger", 2.0),
        ("2 times smaller", 0.5), ("12 cm", 0.6), ("to 30 cm", 1.5), ("80 %", 0.8), ("by a factor of 1.1", 1.1),
    ],
)  # fmt: skip
def test_sizes_are_a_factor_of_what_is_20_cm_long(text, factor):
    assert factor_of(text, 0.2) == pytest.approx(factor)


@pytest.mark.parametrize("text", ["vase", "vase:", ": 3 cm", ""])
def test_a_text_without_two_halves_is_refused(text):
    with pytest.raises(EditError, match="colon"):
        halves(text, "move", "vase: 10 cm to the right")


@pytest.mark.parametrize(
    ("words", "names"),
    [
        ("book 2", ["book 2"]),
        ("Book 2", ["book 2"]),
        ("the bottom book", ["book 1"]),
        ("top book", ["book 3"]),
        ("the top book of the stack", ["book 3"]),
        ("second book from the top", ["book 2"]),
        ("third book", ["book 3"]),
        ("the books", ["book 1", "book 2", "book 3"]),
        ("all books", ["book 1", "book 2", "book 3"]),
        ("the stack of books", ["book 1", "book 2", "book 3"]),
        ("both apples", ["apple 1", "apple 2"]),
        ("the apples in the bowl", ["apple 1", "apple 2"]),
        ("the book on the desk", ["book 1"]),
        ("the heaviest book", None),
        ("the vase", ["vase"]),
        ("vases", ["vase"]),
        ("table", None),
    ],
)
def test_words_mean_objects(desk, words, names):
    scene = desk.scene
    if words == "the heaviest book":
        names = [
            max((obj for obj in scene.objects if "book" in obj.name), key=lambda o: o.asset.mass_properties.mass).name
        ]
    if names is None:
        with pytest.raises(EditError):
            chosen(scene, words, GrammarPlanner())
        return
    assert list(chosen(scene, words, GrammarPlanner(), several=True)) == names


@pytest.mark.parametrize("words", ["book", "apple", "the books", ""])
def test_words_that_do_not_tell_which_are_refused(desk, words):
    with pytest.raises(EditError):
        chosen(desk.scene, words, GrammarPlanner())
