"""How tasks of several steps are written down and taken apart."""

import pytest

from pat3d.scene.task_spec import AND_THEN, STEPS, chain_of, steps_of

PUT, STACK, ASIDE, PICK = "place:red mug:tray", "stack:cup:saucer", "beside:fork:left_of:plate", "pick:pear"


@pytest.mark.parametrize(
    "steps",
    [
        [PUT, STACK],
        [PUT, ASIDE],
        [ASIDE, "beside:knife:right_of:plate"],
        [STACK, PICK],
        [PUT, STACK, ASIDE, "place:lemon:bowl", PICK],
        ["place:mug:tray", "place:tray:shelf"],
    ],
)
def test_a_chain_is_taken_apart_as_it_was_made(steps: list[str]):
    chain = chain_of(steps)
    assert chain is not None
    assert chain == f"chain:{':then:'.join(steps)}"
    assert [":".join(step) for step in steps_of(chain)] == steps


@pytest.mark.parametrize(
    ("task", "steps"),
    [
        ("sort", [["sort"]]),
        (PICK, [["pick", "pear"]]),
        (PUT, [["place", "red mug", "tray"]]),
        (ASIDE, [["beside", "fork", "left_of", "plate"]]),
        ("chain:place:pear:tray:then:stack:cup:saucer", [["place", "pear", "tray"], ["stack", "cup", "saucer"]]),
    ],
)
def test_every_task_has_its_steps(task: str, steps: list[list[str]]):
    assert steps_of(task) == steps


@pytest.mark.parametrize("count", [0, 1, 2, 5, 6])
def test_a_chain_has_so_many_steps(count: int):
    fewest, most = STEPS
    assert (fewest, most) == (2, 5)
    chain = chain_of([f"place:cup {number}:tray" for number in range(count)])
    assert (chain is not None) == (fewest <= count <= most)


@pytest.mark.parametrize(
    "steps",
    [
        pytest.param([PICK, PUT], id="pick is not last"),
        pytest.param([PUT, PICK, STACK], id="pick in the middle"),
        pytest.param(["pick:fork", "pick:plate"], id="two picks"),
        pytest.param(["place:pear:red plate", "place:pear:blue plate"], id="one thing moved twice"),
        pytest.param(["place:pear:plate", "pick:pear"], id="one thing moved and picked"),
        pytest.param(["beside:pear:left_of:plate", "place:pear:tray"], id="one thing moved aside and on"),
        pytest.param(["unload:crate", PUT], id="unload"),
        pytest.param([PUT, "sort"], id="sort"),
        pytest.param([PUT, "push:pear:left"], id="push"),
    ],
)
def test_other_steps_make_no_chain(steps: list[str]):
    assert chain_of(steps) is None


def test_what_is_moved_may_carry_what_was_moved_before():
    assert AND_THEN in (chain_of(["place:plum:basket", "beside:basket:next_to:vase"]) or "")
