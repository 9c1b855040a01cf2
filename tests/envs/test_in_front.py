"""What stands in front of what, by which a thing can be retrieved from behind others: bars at known distances."""

from __future__ import annotations

import contextlib
from dataclasses import replace

import pytest

from pat3d.envs.tasks.arrange import BEHIND, Retrieve
from pat3d.errors import TaskError
from pat3d.scene.model import Relation, Scene
from tests.envs.test_grasp import bar

HAIR = 1e-6
SIDE = 0.04


def retrievable(x: float, gap: float, *relations: Relation, more=()) -> bool:
    """Whether a cube can be retrieved from behind another one, so far beside it and with such a gap between them."""
    one, other = bar("one", (SIDE, SIDE, SIDE)), bar("other", (SIDE, SIDE, SIDE), (x, -SIDE - gap))
    scene, task = Scene(objects=(other, one, *more), relations=relations), Retrieve(target="one")
    with contextlib.suppress(TaskError):
        task.check(scene)
        return True
    with pytest.raises(TaskError, match=r'^nothing stands on or in front of "one"; use "pick:one"\.$'):
        task.check(scene)
    return False


@pytest.mark.parametrize(
    ("x", "gap", "expected"),
    [
        (0.0, 0.05, True),
        (0.0, BEHIND - HAIR, True),
        (0.0, BEHIND + HAIR, False),
        # They may overlap by a centimetre, but not stand beside one another or behind.
        (0.0, -0.01 + HAIR, True),
        (0.0, -0.01 - HAIR, False),
        (0.0, -2 * SIDE - 0.05, False),
        (SIDE - HAIR, 0.05, True),
        (SIDE + HAIR, 0.05, False),
        (-SIDE + HAIR, 0.05, True),
        (-SIDE - HAIR, 0.05, False),
    ],
)
def test_in_front_is_towards_the_viewer_in_line_and_within_fifteen_centimetres(x, gap, expected):
    assert retrievable(x, gap) == expected


def test_only_what_stands_on_the_same_thing_is_in_front():
    trays = [bar("tray", (0.3, 0.3, 0.01), (2.0, 0.0)), bar("plate", (0.3, 0.3, 0.01), (3.0, 0.0))]
    on = {
        (child, parent): Relation(child=child, kind="on", parent=parent)
        for child in ("one", "other")
        for parent in ("tray", "plate")
    }
    assert retrievable(0.0, 0.05, on["one", "tray"], on["other", "tray"], more=trays)
    assert not retrievable(0.0, 0.05, on["one", "tray"], on["other", "plate"], more=trays)
    assert not retrievable(0.0, 0.05, on["one", "tray"], more=trays)
    assert not retrievable(0.0, 0.05, on["other", "tray"], more=trays)


def test_what_carries_something_can_be_retrieved_and_what_is_fixed_or_missing_not():
    assert retrievable(1.0, 1.0, Relation(child="other", kind="on", parent="one"))
    alone = Scene(objects=(replace(bar("one", (SIDE, SIDE, SIDE)), fixed=True),))
    with pytest.raises(TaskError, match='"one" is fixed'):
        Retrieve(target="one").check(alone)
    with pytest.raises(TaskError, match='"two" is not in the scene'):
        Retrieve(target="two").check(alone)
