"""What stands on what, from poses alone."""

import numpy as np
import pytest

from pat3d.assets.catalogue import make
from pat3d.assets.shapes import box, join
from pat3d.errors import LayoutError
from pat3d.geometry.pose import Pose
from pat3d.layout.bodies import place
from pat3d.layout.clearance import pair_distances
from pat3d.layout.predicates import check_relations
from pat3d.scene.model import Relation
from pat3d.vision.placing import placed_apart
from pat3d.vision.supports import supports
from tests.scenes import asset_of

CUBE = asset_of(box(0.1, 0.1, 0.1))
SLAB = asset_of(box(0.6, 0.6, 0.05))
TABLE = asset_of(
    join(box(0.8, 0.8, 0.04).moved(0.0, 0.0, 0.66), *(
        box(0.05, 0.05, 0.66).moved(x, y, -0.0) for x in (-0.35, 0.35) for y in (-0.35, 0.35)
    ))
)  # fmt: skip
TOP = float(TABLE.visual.bounds[1, 2])
FOOT = float(TABLE.visual.bounds[0, 2])
SIDE = 0.1


def bodies_of(**placed):
    return {name: place(name, asset, Pose(position=at)) for name, (asset, at) in placed.items()}


def told(bodies, **options):
    return sorted(map(str, supports(bodies, **options)))


@pytest.mark.parametrize("error", [-0.008, 0.0, 0.008])
def test_a_stack_on_a_table_is_a_chain(error):
    """Fits are off by millimetres: things float, or sink into what carries them."""
    bodies = bodies_of(
        table=(TABLE, (0.0, 0.0, -FOOT)),
        low=(CUBE, (0.1, 0.1, TOP - FOOT + error)),
        high=(CUBE, (0.12, 0.1, TOP - FOOT + SIDE)),
        beside=(CUBE, (-0.2, 0.0, TOP - FOOT - error)),
    )
    assert told(bodies) == ["beside on table", "high on low", "low on table"]


def test_what_is_under_a_table_stands_on_the_ground():
    bodies = bodies_of(table=(TABLE, (0.0, 0.0, -FOOT)), under=(CUBE, (0.0, 0.0, 0.0)))
    assert told(bodies) == []


def test_a_thing_in_a_bowl_is_in_it_and_one_on_a_plate_on_it():
    bowl, plate, apple = make("bowl"), make("plate"), make("apple")
    bodies = bodies_of(
        bowl=(bowl, (0.0, 0.0, 0.0)),
        plate=(plate, (0.5, 0.0, 0.0)),
        apple=(apple, (0.01, 0.0, 0.02)),
        pear=(apple, (0.5, 0.02, 0.012)),
    )
    assert told(bodies) == ["apple in bowl", "pear on plate"]


def test_noise_of_the_camera_widens_what_counts_as_touching():
    bodies = bodies_of(slab=(SLAB, (0.0, 0.0, 0.0)), cube=(CUBE, (0.0, 0.0, 0.05 + 0.06)))
    assert told(bodies) == []
    assert told(bodies, slack=0.05) == ["cube on slab"]


def test_fits_that_intersect_are_moved_apart_and_stay_on_what_carries_them():
    relations = (
        Relation(child="one", kind="on", parent="slab"),
        Relation(child="two", kind="on", parent="slab"),
        Relation(child="three", kind="on", parent="one"),
    )
    bodies = bodies_of(
        slab=(SLAB, (0.0, 0.0, -0.01)),
        one=(CUBE, (0.28, 0.0, 0.04)),
        two=(CUBE, (0.20, 0.0, 0.05)),
        three=(CUBE, (0.29, 0.01, 0.14)),
    )
    poses, notes = placed_apart(bodies, relations)
    assets = {name: body.body.asset for name, body in bodies.items()}
    assert all(pair.distance > 0.0 for pair in pair_distances(assets, poses))
    held = check_relations(relations, assets, poses, touch=0.002)
    assert [each.detail for each in held if not each.holds] == []
    moved = {name: np.linalg.norm((np.array(poses[name].position) - bodies[name].position)[:2]) for name in bodies}
    assert moved["slab"] == moved["one"] == 0.0
    assert 0.015 < moved["two"] < 0.05
    assert len(notes) == 1
    assert '"two" was moved' in notes[0]


def test_no_room_is_an_error_that_names_the_object():
    bodies = bodies_of(base=(CUBE, (0.0, 0.0, 0.0)), one=(CUBE, (0.0, 0.0, 0.1)), two=(CUBE, (0.0, 0.0, 0.1)))
    relations = tuple(Relation(child=name, kind="on", parent="base") for name in ("one", "two"))
    with pytest.raises(LayoutError, match='"two" finds no room on "base"'):
        placed_apart(bodies, relations)
