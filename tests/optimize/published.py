"""Scenes that the paper's pipeline is reported to fail on, planned and made with the project's own parts."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from pat3d.assets.catalogue.lookup import make
from pat3d.check.settle import SettleReport, settle_in_mujoco
from pat3d.exporters.mjcf.writer import write_mjcf
from pat3d.geometry.pose import Pose
from pat3d.layout.bodies import place
from pat3d.layout.drop import fall
from pat3d.layout.layout import arrange
from pat3d.optimize.placement import Placement
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.scene.asset import Asset
from pat3d.scene.model import Relation, Scene, SceneObject

HATS = "a plush toy dog with five hats of different colours stacked on its head"
SOFA = (
    "on a brown leather sofa sit two large teddy bears, a gray elephant, a white rabbit, a yellow giraffe and two "
    "throw pillows; two round burgundy floor cushions are in front of the sofa"
)


def objects(prompt: str, seed: int = 0) -> tuple[dict[str, Asset], tuple[Relation, ...]]:
    plan = GrammarPlanner().plan(prompt)
    assets = {
        obj.name: make(
            obj.noun,
            colours=obj.colours,
            material=obj.material,
            scale=obj.scale,
            adjectives=obj.adjectives,
            seed=100 * seed + k,
        )
        for k, obj in enumerate(plan.objects)
    }
    return assets, plan.relations


def askew(assets: dict[str, Asset], share: float = 0.4, gap: float = 0.003) -> dict[str, Pose]:
    """Everything on top of what comes before it, each `share` of its width further to the side, lowered until near."""
    placed, height, aside = [], 0.0, 0.0
    for name, asset in assets.items():
        low, high = asset.bounds
        middle = (low + high) / 2
        body = place(name, asset, Pose(position=(aside - middle[0], -middle[1], height - low[2] + gap)))
        drop = fall(body, placed, floor=0.0, gap=gap)
        body = body.shifted(np.array([0.0, 0.0, -drop]))
        placed.append(body)
        height = max(height, float(body.high[2]))
        aside += share * float(asset.size[0])
    return {body.body.name: body.pose for body in placed}


def sofa_with_a_bear_over_the_edge() -> tuple[dict[str, Asset], tuple[Relation, ...], dict[str, Pose]]:
    """The crowded sofa, laid out with one of the two large bears half a metre too far to the front."""
    assets, relations = objects(SOFA)
    placement = Placement(assets, relations, arrange(assets, relations, seed=0).poses)
    variables = np.zeros((len(assets), 3))
    variables[list(assets).index("large teddy bear 2"), 1] = -0.5
    return assets, relations, placement.project(variables)


def in_mujoco(
    assets: Mapping[str, Asset],
    relations: tuple[Relation, ...],
    poses: Mapping[str, Pose],
    folder: Path,
    seconds: float = 5.0,
) -> SettleReport:
    """How MuJoCo moves the objects from `poses`."""
    objects = tuple(
        SceneObject(name=name, asset=asset, pose=poses[name], initial_pose=poses[name])
        for name, asset in assets.items()
    )
    return settle_in_mujoco(write_mjcf(Scene(objects=objects, relations=relations), folder), seconds)
