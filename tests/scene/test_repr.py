"""What a scene says of itself in a terminal fits a screen."""

from dataclasses import replace

from pat3d.scene.model import SHOWN_OBJECTS
from tests.cli.test_optimize import overhanging_scene


def test_the_repr_of_a_scene_and_of_an_object_fits_a_screen_and_says_what_is_where():
    scene = overhanging_scene(prompt="a plank on a block")
    lines = repr(scene).splitlines()
    assert lines[0] == "Scene('a plank on a block', seed 4, 2 objects, 1 relations)"
    assert [line.split("'")[1] for line in lines[1:]] == ["block", "plank"]
    assert lines[2].endswith("on block")
    assert repr(scene["plank"]) in lines[2]


def test_a_large_scene_says_how_many_more_there_are():
    scene = overhanging_scene(prompt="word " * 100)
    plank = scene["plank"]
    many = tuple(replace(plank, name=f"plank {number}") for number in range(200))
    lines = repr(replace(scene, objects=many, relations=())).splitlines()
    assert len(lines) == SHOWN_OBJECTS + 2
    assert lines[-1] == f"  ... and {200 - SHOWN_OBJECTS} more"
    assert max(map(len, lines)) <= 120
