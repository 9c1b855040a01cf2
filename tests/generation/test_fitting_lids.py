"""A lid is as wide as the rim that it is on: it neither falls into the vessel nor dwarfs it."""

from __future__ import annotations

import numpy as np
import pytest

from pat3d.generation.request import objects_of_plan
from pat3d.plan.grammar.planner import GrammarPlanner


@pytest.mark.parametrize("prompt", ["A lid is on a pot.", "A jar with a lid.", "A pan with its lid on."])
@pytest.mark.parametrize("seed", range(4))
def test_a_lid_reaches_over_the_opening_and_little_beyond(prompt: str, seed: int):
    made = {obj.name: obj.asset for obj in objects_of_plan(GrammarPlanner().plan(prompt), seed, lambda event: None)}
    lid = made.pop("lid")
    (vessel,) = made.values()
    inside = next(region for region in vessel.regions if region.kind == "in")
    radius = np.hypot(lid.visual.vertices[:, 0], lid.visual.vertices[:, 1]).max()
    points = vessel.visual.vertices - np.array(inside.floor)
    rim = points[np.abs(points[:, 2] - inside.height) < 5e-4]
    opening = np.hypot(rim[:, 0], rim[:, 1]).min()
    assert 0.001 < radius - opening < 0.36 * opening


def test_a_lid_whose_size_is_said_stays_so():
    plan = GrammarPlanner().plan("A large lid is on a jar.")
    made = {obj.name: obj.asset for obj in objects_of_plan(plan, 0, lambda event: None)}
    widths = {name: asset.size[0] for name, asset in made.items()}
    assert max(widths[name] for name in widths if "lid" in name) > 0.2
