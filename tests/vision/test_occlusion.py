"""The least occluded object: what is said of it, unless the drawn fits contradict; and whether its size is believed."""

from dataclasses import replace

import numpy as np
import pytest

from pat3d.assets.shapes import box
from pat3d.geometry.pose import Pose
from pat3d.vision.caster import Placement
from pat3d.vision.fitting import Fit
from pat3d.vision.occlusion import doubt_of_size, least_occluded, visible_share
from pat3d.vision.recover import Recovered
from tests.scenes import asset_of
from tests.vision.seen import camera_at, see

BRICK = asset_of(box(0.1, 0.1, 0.1))
CAMERA = camera_at((0.0, -1.2, 0.5))
THINGS = {
    "free": (BRICK, Pose(position=(-0.25, 0.0, 0.0))),
    "behind": (BRICK, Pose(position=(0.17, 0.12, 0.0))),
    "screen": (asset_of(box(0.2, 0.02, 0.3)), Pose(position=(0.25, -0.05, 0.0))),
}
SEEN = see(THINGS, CAMERA)
FOUND = Recovered(
    camera=CAMERA,
    assets={name: asset for name, (asset, _) in THINGS.items()},
    fits={
        name: Fit(
            placed=Placement(scale=1.0, rotation=pose.rotation, position=np.array(pose.position)),
            tilted=False,
            cost=0.0,
            overlap=1.0,
        )
        for name, (_, pose) in THINGS.items()
    },
    relations=(),
)
SIZES = {"free": 0.1, "behind": 0.1}


def test_what_hides_an_object_and_what_the_border_cuts_off_count():
    assert visible_share(FOUND, SEEN, "free") == pytest.approx(1.0, abs=0.01)
    assert visible_share(FOUND, SEEN, "behind") < 0.7
    aside = camera_at((0.0, -1.2, 0.5), (0.22, 0.0, 0.05), angle=35.0)
    cut = see(THINGS, aside)
    assert np.nonzero(cut.mask("free"))[1].min() == 0
    assert 0.2 < visible_share(replace(FOUND, camera=aside), cut, "free") < 0.8


def test_what_is_said_counts_unless_it_is_hidden():
    assert least_occluded(FOUND, SEEN, SIZES, None) == ("free", "measured")
    assert least_occluded(FOUND, SEEN, SIZES, "free") == ("free", "said")
    assert least_occluded(FOUND, SEEN, SIZES, "behind") == ("free", "measured")
    # Without a size, it tells nothing.
    assert least_occluded(FOUND, SEEN, SIZES, "screen") == ("free", "measured")


def test_all_lengths_follow_from_the_size_of_the_object_that_is_said():
    both = {"free": 0.2, "screen": 0.9}
    assert FOUND.resized(both, SEEN, said="free").fits["screen"].placed.scale == pytest.approx(2.0)
    larger = FOUND.resized(both, SEEN, said="screen")
    assert larger.fits["free"].placed.scale == pytest.approx(3.0)
    assert "(said)" in larger.notes[-1]


def test_a_size_that_the_depth_contradicts_is_noted():
    assert doubt_of_size(FOUND, "free", 0.12) is None
    assert "0.1 m long, the labels say 0.3 m" in (doubt_of_size(FOUND, "free", 0.3) or "")
