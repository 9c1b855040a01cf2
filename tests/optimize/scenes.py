"""Small scenes that fall apart."""

from __future__ import annotations

from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset
from pat3d.scene.model import Relation
from tests.layout.things import block


def on(child: str, parent: str, kind: str = "on") -> Relation:
    return Relation(child=child, kind=kind, parent=parent)  # type: ignore[arg-type]


def overhanging() -> tuple[dict[str, Asset], tuple[Relation, ...], dict[str, Pose]]:
    """A plank on a block, its middle 15 mm beyond the edge."""
    assets = {"block": block(0.08, 0.08, 0.06), "plank": block(0.1, 0.06, 0.02)}
    poses = {"block": Pose(position=(0, 0, 0.002)), "plank": Pose(position=(0.055, 0, 0.065))}
    return assets, (on("plank", "block"),), poses
