"""What is hidden in part, made whole by a painter and a finder that know the truth: the hidden size comes back."""

import numpy as np
import pytest

from pat3d.assets.shapes import box
from pat3d.geometry.pose import Pose
from pat3d.vision.caster import Caster
from pat3d.vision.completing import AROUND, completed
from pat3d.vision.detection import Found
from pat3d.vision.fitting import fit
from pat3d.vision.observation import Observation
from tests.scenes import asset_of
from tests.vision.seen import camera_at, see

CAMERA = camera_at((0.0, -0.9, 0.35), (0.0, 0.0, 0.08))
BOARD = asset_of(box(0.4, 0.04, 0.1), noun="board")
SCREEN = asset_of(box(0.2, 0.02, 0.2), noun="screen")
BEHIND = {"board": (BOARD, Pose.from_yaw(0.0, (0.0, 0.1, 0.0)))}
HIDING = {"screen": (SCREEN, Pose.from_yaw(0.0, (0.12, 0.0, 0.0)))}
ALONE = see(BEHIND, CAMERA)
DRAWN = see({**BEHIND, **HIDING}, CAMERA)
GREY = np.full((*DRAWN.depth.shape, 3), 120, dtype=np.uint8)
SEEN = Observation(camera=DRAWN.camera, depth=DRAWN.depth, instances=DRAWN.instances, names=DRAWN.names, picture=GREY)


class Truth:
    """Paints nothing, and finds the board as it is behind the screen, in the part of the picture that it is given."""

    name = "truth"

    def __init__(self):
        self.hidden = []

    def completed(self, picture, hidden, name):
        self.hidden.append((name, hidden))
        return picture

    def find(self, picture, phrase):
        rows, columns = np.nonzero(SEEN.mask("board"))
        margin = 4 + int(AROUND * max(np.ptp(rows), np.ptp(columns)))
        top, left = max(rows.min() - margin, 0), max(columns.min() - margin, 0)
        crop = ALONE.instances[top:, left:][: picture.shape[0], : picture.shape[1]] == 1
        return [Found(phrase=phrase, score=0.9, mask=np.ones_like(crop)), Found(phrase=phrase, score=0.5, mask=crop)]


@pytest.fixture(scope="module")
def whole():
    truth = Truth()
    found, notes = completed(SEEN, truth, truth)
    assert notes == []
    # The screen hides the board, nothing hides the screen.
    assert [name for name, _ in truth.hidden] == ["board"]
    screen = np.count_nonzero(DRAWN.instances == 2)
    assert 0.5 * screen < truth.hidden[0][1].sum() <= screen
    return found


def test_the_whole_mask_is_the_one_without_what_hides_it(whole):
    assert set(whole.whole) == {"board"}
    assert np.count_nonzero(whole.whole["board"] != (ALONE.instances == 1)) < 0.02 * np.count_nonzero(ALONE.instances)


def test_the_whole_mask_decides_between_sizes_that_the_visible_part_leaves_open(whole):
    """A third of the board is behind the screen: of a longer one of the same height, nothing more would be seen."""
    from pat3d.vision.window import Window

    long = Caster(asset_of(box(0.48, 0.04, 0.1)).visual)
    true = Caster(BOARD.visual)

    def costs(seen):
        window = Window(seen, CAMERA, "board", 1500)
        from pat3d.vision.caster import Placement

        return [
            window.cost(caster.ranges(window.origin, window.rays,
                                      Placement(scale=1.0, rotation=np.eye(3), position=np.array([x, 0.1, 0.0]))))
            for caster, x in ((true, 0.0), (long, -0.04), (long, 0.04))
        ]  # fmt: skip

    blind, knowing = costs(SEEN), costs(whole)
    assert blind[2] - blind[0] < 0.3 * (knowing[2] - knowing[0])
    assert knowing[0] == min(knowing)
    assert knowing[2] - knowing[0] > 0.05


@pytest.mark.slow
def test_the_fit_of_a_hidden_thing_is_no_worse_for_knowing_its_whole_mask(whole):
    found = fit(whole, CAMERA, "board", Caster(asset_of(box(0.5, 0.05, 0.125)).visual))
    assert found.placed.scale == pytest.approx(0.8, rel=0.02)


def test_what_is_not_found_again_stays_as_it_is_and_is_noted():
    class Blind(Truth):
        def find(self, picture, phrase):
            return []

    found, notes = completed(SEEN, Blind(), Blind())
    assert found.whole == {}
    assert notes == ['"board" is hidden in part, and is not found in what was painted of it.']
