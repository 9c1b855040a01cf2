"""How do things stand on the surfaces of generated scenes: how far spread, how near to the axes?

python -m benchmarks.arrangement --prompts benchmarks/tabletops.txt benchmarks/prompts.txt --seeds 0 1 2

Layouts alone are made, nothing settles. What is measured are things of at most 0.6 m that stand upright on something,
side by side with others or not. The directions of rows, other arrangements and place settings are not counted.
"""

from __future__ import annotations

import argparse
import math
import statistics
from collections import defaultdict
from pathlib import Path

import numpy as np

from benchmarks.generate import HERE, read_prompts
from pat3d.errors import Pat3dError
from pat3d.generation.request import request_of
from pat3d.geometry.pose import Pose
from pat3d.layout.layout import arrange
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.progress import silent
from pat3d.scene.asset import Asset
from pat3d.scene.model import GROUND, parent_of

LARGEST = 0.6
"""Of what is measured [m]."""
REACH = 0.42
"""Half of the surface that counts, at most [m]."""
TABLEWARE = frozenset({"plate", "fork", "knife", "spoon", "glass", "wine glass", "cup", "mug", "napkin"})
"""Nouns of place settings, which have their directions."""
AXIS = 10.0
"""[degrees]"""


class Measured:
    """What was found, over all scenes."""

    def __init__(self) -> None:
        self.yaws: list[float] = []
        """Angle to the nearest axis [degrees]."""
        self.spreads: list[float] = []
        """Root mean square distance from their middle, against that of things spread evenly over what counts."""
        self.hulls: list[float] = []
        """Area of the hull of the middles of three or more, against what counts."""
        self.failed: list[str] = []

    def add(
        self,
        assets: dict[str, Asset],
        poses: dict[str, Pose],
        parents: dict[str, str],
        inside: set[str],
        exact: set[str],
    ) -> None:
        """One layout; what is `inside` something is left out, of what stands `exact` the direction."""
        shared: dict[str, list[np.ndarray]] = defaultdict(list)
        for name, asset in assets.items():
            size, rotation = asset.size, poses[name].rotation
            if float(size.max()) > LARGEST or name in inside or rotation[2, 2] < 0.99:
                continue
            yaw = math.degrees(math.atan2(rotation[1, 0], rotation[0, 0])) % 90.0
            if name not in exact:
                self.yaws.append(min(yaw, 90.0 - yaw))
            shared[parents[name]].append(np.array(poses[name].position[:2]))
        for surface, points in shared.items():
            half = np.full(2, REACH)
            if surface != GROUND:
                region = next(one for one in assets[surface].regions if one.kind == "on")
                half = np.minimum(np.array(region.half_size), REACH)
            if len(points) < 2 or float(half.max()) < 0.2:
                continue
            cloud = np.stack(points)
            off = cloud - cloud.mean(axis=0)
            self.spreads.append(float(np.sqrt((off**2).sum(axis=1).mean())) / math.sqrt(float((half**2).sum()) / 3))
            if len(points) > 2:
                x, y = (cloud[_hull(cloud)] if len(points) > 3 else cloud).T
                area = 0.5 * abs(float(np.dot(x, np.roll(y, 1)) - np.dot(y, np.roll(x, 1))))
                self.hulls.append(area / float(4 * np.prod(half)))

    def lines(self) -> list[str]:
        """The figures, a line each."""
        near = sum(yaw < AXIS for yaw in self.yaws)
        return [
            f"within {AXIS:.0f} degrees of an axis: {near} of {len(self.yaws)} ({near / len(self.yaws):.0%})",
            f"rms distance from the middle, against an even spread (1): median {statistics.median(self.spreads):.2f} "
            f"of {len(self.spreads)} surfaces",
            f"hull of the middles, against the surface: median {statistics.median(self.hulls):.1%} "
            f"of {len(self.hulls)} surfaces",
            f"layouts refused: {len(self.failed)}",
            *self.failed,
        ]


def _laid(assets: dict[str, Asset], parents: dict[str, str]) -> set[str]:
    """What lies where plates and cutlery lie."""
    found = set()
    for surface in set(parents.values()):
        own = {name for name, parent in parents.items() if parent == surface}
        nouns = {assets[name].noun for name in own}
        if "plate" in nouns and nouns & {"fork", "knife", "spoon"}:
            found |= {name for name in own if assets[name].noun in TABLEWARE}
    return found


def _hull(points: np.ndarray) -> np.ndarray:
    from scipy.spatial import ConvexHull

    try:
        return ConvexHull(points).vertices
    except (ValueError, RuntimeError):
        return np.arange(len(points))


def main() -> None:
    """Print the figures of every prompt file."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prompts", type=Path, nargs="+", default=[HERE / "tabletops.txt", HERE / "prompts.txt"])
    parser.add_argument("--seeds", type=int, nargs="+", default=[0, 1, 2])
    options = parser.parse_args()
    planner = GrammarPlanner()
    for path in options.prompts:
        measured = Measured()
        for prompt in read_prompts(path):
            for seed in options.seeds:
                try:
                    request = request_of(planner.plan(prompt), False)
                    objects = request.make_objects(seed, silent)
                    assets = {one.name: one.asset for one in objects}
                    postures = {one.name: one.posture for one in objects if one.posture is not None}
                    layout = arrange(
                        assets, request.relations, seed=seed, arrangements=request.arrangements, postures=postures
                    )
                except Pat3dError as error:
                    measured.failed.append(f"  {prompt} (seed {seed}): {error}")
                    continue
                parents = {name: parent_of(name, request.relations) for name in assets}
                inside = {rel.child for rel in request.relations if rel.kind in ("in", "hangs_from")}
                exact = {name for one in request.arrangements for name in one.objects} | _laid(assets, parents)
                measured.add(assets, dict(layout.poses), parents, inside, exact)
        print(path.name, *measured.lines(), sep="\n  ")


if __name__ == "__main__":
    main()
