"""What a person reads at once is read: with the words that were left out in a note, and never with one thing less."""

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


@pytest.mark.parametrize(
    ("sentence", "same", "left_out"),
    [
        ("However, a jug is on the shelf.", "A jug is on the shelf.", ""),
        ("Note that the desk holds a globe.", "The desk holds a globe.", ""),
        (
            "Put the three pears in the crate in a certain order: green first, then yellow, and finally red.",
            "Put the three pears in the crate.",
            "in a certain order: green first, then yellow, and finally red",
        ),
        (
            "A tray holds two discs. The sequence should begin with green and end with red.",
            "A tray holds two discs.",
            "The sequence should begin with green and end with red",
        ),
    ],
)
def test_read_as_without_what_changes_nothing(planner: GrammarPlanner, sentence: str, same: str, left_out: str) -> None:
    plan, plain = planner.plan(sentence), planner.plan(same)

    assert [(obj.name, obj.noun) for obj in plan.objects] == [(obj.name, obj.noun) for obj in plain.objects]
    assert (plan.relations, plan.arrangements, plan.task) == (plain.relations, plain.arrangements, plain.task)
    assert set(plan.notes) - set(plain.notes) == ({f'not modelled: "{left_out}"'} if left_out else set())


@pytest.mark.parametrize(
    ("sentence", "names"),
    [
        ("The stapler is nearer to the lamp than the globe is.", {"stapler", "lamp", "globe"}),
        ("The bowl is as far from the jug as two hats are.", {"hat 1", "hat 2", "jug", "bowl"}),
    ],
)
def test_what_else_cannot_be_read_is_named_and_its_things_are_there(
    planner: GrammarPlanner, sentence: str, names: set[str]
) -> None:
    plan = planner.plan(sentence)

    assert {obj.name for obj in plan.objects} == names
    assert not plan.relations
    assert f'not understood: "{sentence[:-1]}"; what it names is there, and no more is made of it.' in plan.notes


@pytest.mark.parametrize(
    "sentence",
    [
        "The stapler is nearer to the gizmo than the globe is.",
        "The stapler is nearer to the lamp than another globe is.",
        "The bowl outshone every jug in the contest.",
        "A jug them a bowl.",
    ],
)
def test_what_counts_or_names_something_unknown_is_refused(planner: GrammarPlanner, sentence: str) -> None:
    with pytest.raises(PromptError):
        planner.plan(sentence)


@pytest.mark.parametrize(
    ("sentence", "same"),
    [
        ("Could you make me a shelf with two jugs on it?", "A shelf with two jugs on it."),
        ("I'd love to see four plums in a crate.", "Four plums in a crate."),
        ("We're picturing a bench with a hat on it.", "A bench with a hat on it."),
        ("Give me a scene where a globe is on a cabinet.", "A globe is on a cabinet."),
        ("There ought to be a jug on the shelf.", "There is a jug on the shelf."),
        ("A jug has to be on the left of the globe.", "A jug is on the left of the globe."),
        ("On my workbench I have a saw and a clamp.", "On my workbench there is a saw and a clamp."),
        ("A crate that's got two hats in it.", "A crate that has two hats in it."),
        ("x4 hats on bench", "4 hats on a bench"),
        ("hat x4 on bench", "4 hats on a bench"),
        ("4 hats in row, third from right red", "4 hats in a row, the second is red"),
        ("A stack of crates, three crates high.", "A stack of three crates."),
        ("Three hats, the second green.", "Three hats, the second is green."),
        ("Five hats in a row. The second hat from the right is red.", "Five hats in a row. The fourth hat is red."),
        ("A two by four grid of hats on a bench.", "A 2x4 grid of hats on a bench."),
        ("Two scarves are spread out on the bench.", "Two scarves are on the bench."),
        ("Search for the hat behind the crate and put it on the bench.",
         "Find the hat behind the crate and put it on the bench."),
        ("Build a tower of two crates and put a hat on top.", "A tower of two crates with a hat on top."),
        ("Build a tower out of four crates.", "Build a tower of four crates."),
        (
            "A hat and a jug lie to the left and to the right of a globe, respectively.",
            "A hat lies to the left of a globe and a jug lies to the right of the globe.",
        ),
        ("Crates A, B and C in a row; crate B holds a hat.", "Three crates in a row; the second crate holds a hat."),
        ("Two crates labelled A to B. Crate B holds a hat.", "Two crates. The second crate holds a hat."),
        ("Put the hat flat on the bench.", "Put the hat on the bench."),
        ("A hat exactly midway between two jugs.", "A hat between two jugs."),
        ("Somebody has built a tower out of three crates.", "A tower of three crates."),
        ("6 hats 2x3 on bench", "6 hats in a 2x3 grid on a bench"),
        ("All the hats are black except the pink one.", "There is a pink hat. All other hats are black."),
        ("A bench and a crate, with a mat between bench and crate.",
         "A bench and a crate, with a mat between the bench and the crate."),
    ],
)  # fmt: skip
def test_read_as_what_it_says_in_other_words(planner: GrammarPlanner, sentence: str, same: str) -> None:
    plan, plain = planner.plan(sentence), planner.plan(same)

    assert [(obj.name, obj.noun, obj.colours) for obj in plan.objects] == [
        (obj.name, obj.noun, obj.colours) for obj in plain.objects
    ]
    assert (plan.relations, plan.arrangements) == (plain.relations, plain.arrangements)


@pytest.mark.parametrize(
    ("sentence", "left_out"),
    [
        ("Examine a jug in the dark.", "in the dark"),
        ("Two hats in random places on a bench.", "in random places"),
        ("Put the hat in the crate if it is red.", "if it is red"),
        ("Arrange the three hats in order of decreasing size.", "in order of decreasing size"),
        ("A hat taller than either and two jugs.", "taller than either"),
        ("Three jugs and two hats, one damaged.", "one damaged"),
        ("Two hats with a gap of 9 cm between them.", "with a gap of 9 cm between them"),
        ("Stack the hats, starting with red, followed by green.", "starting with red, followed by green"),
        ("We are having lunch at home. Put the jug on the bench.", "We are having lunch at home"),
    ],
)
def test_how_and_when_are_left_out_with_a_note(planner: GrammarPlanner, sentence: str, left_out: str) -> None:
    plan = planner.plan(sentence)

    assert any(obj.noun in ("pitcher", "hat") or "hat" in obj.noun for obj in plan.objects)
    assert f'not modelled: "{left_out}"' in plan.notes


@pytest.mark.parametrize("sentence", ["Nine hats in a row. The second hat from the right is red."])
def test_a_place_that_is_not_known_is_refused(planner: GrammarPlanner, sentence: str) -> None:
    with pytest.raises(PromptError, match="second hat from the right"):
        planner.plan(sentence)
