"""Why a robot cannot take an object: each sentence in the scene of which it is true."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from pat3d.envs.grasping.refusals import _covered, why_not
from pat3d.geometry.hulls import convex_part
from pat3d.scene.asset import Region
from pat3d.scene.model import Relation, Scene, SceneObject
from tests.envs.test_grasp import GRIPPER, bar

SHAFT = 0.045
"""Between the cube's side and the walls of a shaft into which fingers fit, but no hand [m]."""


def walls(height: float, gap: float, *, lid: float | None = None, region: bool = False) -> SceneObject:
    """Four walls of 2 cm around a cube of 4 cm, so high, and `gap` from it; with a lid above from height `lid` on."""
    inner = 0.02 + gap
    outer = inner + 0.02

    def block(x, y, z):
        return convex_part(np.array([(a, b, c) for a in x for b in y for c in z]))

    parts = [
        block((inner, outer), (-outer, outer), (0.0, height)),
        block((-outer, -inner), (-outer, outer), (0.0, height)),
        block((-outer, outer), (inner, outer), (0.0, height)),
        block((-outer, outer), (-outer, -inner), (0.0, height)),
    ]
    if lid is not None:
        parts.append(block((-outer, outer), (-outer, outer), (lid, lid + 0.01)))
    made = bar("frame", (2 * outer, 2 * outer, height))
    inside = Region(
        kind="in", shape="rectangle", floor=(0.0, 0.0, 0.01), half_size=(inner, inner), height=height - 0.01
    )
    regions = (*made.asset.regions, *([inside] if region else []))
    return replace(made, asset=replace(made.asset, parts=tuple(parts), regions=regions))


def among(carrier: SceneObject, *others: SceneObject, cube=(0.04, 0.04, 0.05)) -> Scene:
    return Scene(
        objects=(bar("cube", cube), carrier, *others),
        relations=(Relation(child="cube", kind="in", parent=carrier.name),),
    )


def said(scene: Scene, name: str = "cube") -> str:
    return why_not(scene, name, GRIPPER)


def test_at_the_height_of_the_rim_the_fingers_lack_room_below_the_top_and_below_it_beside():
    """Of a cube flush with the walls around it nothing is below the rim."""
    assert said(among(walls(0.05, 0.002))) == '"frame" leaves no room for the fingers below its top'
    assert said(among(walls(0.047, 0.002))) == '"frame" leaves no room for the fingers below its top'
    assert said(among(walls(0.0501, 0.002))) == '"frame" leaves no room for the fingers beside it'
    # The rim is where the inside ends, not a handle above it.
    assert "below its top" in said(among(walls(0.05, 0.002, region=True)))


def test_in_a_shaft_for_fingers_only_the_top_is_too_far_below_the_rim():
    """The palm is 45 mm behind the tips: less a bite of 5 mm and a millimetre of play, 39 mm."""
    assert said(among(walls(0.15, SHAFT))) == (
        'its top is 100 mm below the rim of "frame", where the hand does not fit in; the fingers alone take what is at '
        "most 39 mm below"
    )


def test_what_is_under_a_part_of_its_carrier_is_not_got_at_from_above():
    covered = 'it is under a part of "frame" and cannot be got at from above'
    assert said(among(walls(0.05, 0.002, lid=0.05))) == covered
    assert said(among(walls(0.05, 0.002, lid=0.2))) == covered
    assert said(among(walls(0.05, 0.002, lid=0.0))) != covered


@pytest.mark.parametrize(("x", "y"), [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
def test_a_roof_covers_what_has_its_middle_below_it_and_no_more(x, y):
    """The roof goes 42 mm to each side; what it covers is where it is, not where its carrier's frame is."""
    frame, cube = walls(0.05, 0.002, lid=0.2), bar("cube", (0.04, 0.04, 0.05))
    for away, covered in ((0.0419, True), (0.0421, False)):
        assert _covered(replace(cube, pose=replace(cube.pose, position=(away * x, away * y, 0.0))), frame) == covered
        beside = replace(frame, pose=replace(frame.pose, position=(away * x, away * y, 0.0)))
        assert _covered(cube, beside) == covered


def test_a_neighbour_that_alone_is_in_the_way_is_named():
    """A roof over the cube that stands on other feet; with a second one below it, neither is enough."""
    plate = bar("table", (0.5, 0.5, 0.02))
    cube = bar("cube", (0.04, 0.04, 0.05))
    cube = replace(cube, pose=replace(cube.pose, position=(0.0, 0.0, 0.02)))
    relation = Relation(child="cube", kind="on", parent="table")

    def roof(name: str, low: float) -> SceneObject:
        made = bar(name, (0.3, 0.3, 0.01))
        return replace(made, pose=replace(made.pose, position=(0.0, 0.0, low)))

    one = Scene(
        objects=(plate, cube, roof("roof", 0.08), bar("far", (0.1, 0.1, 0.1), (1.0, 0.0))), relations=(relation,)
    )
    assert said(one) == '"roof" leaves no room for the fingers'
    two = replace(one, objects=(*one.objects, roof("second", 0.1)))
    assert said(two) == "what stands around it leaves no room for the fingers"


@pytest.mark.parametrize(
    ("size", "words"),
    [
        ((0.05, 0.05, 0.004), "it is 4 mm high, and the fingers hold at least 5 mm of it, 3 mm above what is below"),
        ((0.1, 0.12, 0.1), "it is 100 mm wide at its narrowest, the gripper opens 80 mm, and it has no rim or handle"),
        ((0.079, 0.12, 0.1), "opens 80 mm, which leaves too little play"),
    ],
)
def test_by_itself_it_is_too_low_too_thin_or_too_wide(size, words):
    assert words in said(Scene(objects=(bar("cube", size),)))


def test_what_is_narrow_enough_but_slants_turns_no_two_sides_to_the_fingers():
    """Each side of a pyramid of 70 degrees' opening leans by 45 degrees from what the pads would meet."""
    made = bar("cube", (0.06, 0.06, 0.03))
    tent = convex_part(np.array([(x, y, 0.0) for x in (-0.03, 0.03) for y in (-0.03, 0.03)] + [(0.0, 0.0, 0.03)]))
    scene = Scene(objects=(replace(made, asset=replace(made.asset, parts=(tent,))),))
    assert said(scene).endswith("and nowhere between do two of its sides face the fingers")
    assert math.degrees(math.atan2(0.03, 0.03)) == pytest.approx(45.0)


def test_what_is_thinner_than_the_closed_gripper_is_refused_for_that():
    scene = Scene(objects=(bar("cube", (0.006, 0.1, 0.05)),))
    words = "it is 6 mm thick, and the closed gripper leaves 20 mm"
    assert why_not(scene, "cube", replace(GRIPPER, closed=0.02)) == words
