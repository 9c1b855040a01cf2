"""A scene folder that is quickly made and settled."""

from pathlib import Path

from pat3d.assets.shapes import box
from pat3d.scene.io import save_scene
from pat3d.scene.model import Relation, Scene
from tests.scenes import GAP, asset_of, placed


def bricks_in(folder: Path) -> Path:
    """A brick on a board, at rest, and a block beside it, in `folder`."""
    scene = Scene(
        objects=(
            placed("board", asset_of(box(0.3, 0.2, 0.02), noun="board"), (0, 0, GAP)),
            placed("brick", asset_of(box(0.1, 0.06, 0.04), noun="brick"), (0.05, 0, 0.02 + 2 * GAP)),
            placed("block", asset_of(box(0.05, 0.05, 0.05), noun="block"), (0.4, 0, GAP)),
        ),
        relations=(Relation(child="brick", kind="on", parent="board"),),
        prompt="a brick on a board",
    )
    save_scene(scene, folder)
    return folder
