"""Scenes in which something is put beside something else."""

from __future__ import annotations

from pat3d.assets.shapes import box
from pat3d.scene.model import Relation, Scene
from tests.scenes import GAP, asset_of, placed, scene_of

CUBE = asset_of(box(0.04, 0.04, 0.05))
SLAB = asset_of(box(0.12, 0.1, 0.03))
BOARD = asset_of(box(0.34, 0.3, 0.02))


def on_a_table() -> Scene:
    """A mug in a corner of the table, a plate, a jar and a lid on the jar."""
    return scene_of(
        placed("mug", CUBE, (0.22, -0.2, GAP)),
        placed("plate", SLAB, (-0.1, 0.05, GAP)),
        placed("jar", CUBE, (-0.25, -0.2, GAP)),
        placed("lid", asset_of(box(0.03, 0.03, 0.02)), (-0.25, -0.2, 0.05 + 2 * GAP)),
        relations=(Relation(child="lid", kind="on", parent="jar"),),
    )


def on_a_board() -> Scene:
    """A mug beside a board on which a plate stands."""
    return scene_of(
        placed("mug", CUBE, (-0.24, 0.05, GAP)),
        placed("board", BOARD, (0.0, 0.0, GAP)),
        placed("plate", asset_of(box(0.06, 0.06, 0.03)), (-0.08, 0.05, 0.02 + 2 * GAP)),
        relations=(Relation(child="plate", kind="on", parent="board"),),
    )
