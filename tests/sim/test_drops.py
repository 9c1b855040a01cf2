"""Random drops of every kind: never an intersection, and rest in the end."""

import os

import pytest

from pat3d.sim.settling import SettleOptions, settle
from tests.sim.drops import KINDS, random_scene
from tests.sim.oracles import intersections

SCENES = int(os.environ.get("PAT3D_DROPS", "10000"))
"""Scenes of the slow suite, in equal shares of the kinds."""

BATCH = 100


def check(kind: str, seed: int) -> list[str]:
    """What went wrong with a scene."""
    model = random_scene(kind, seed)
    settled = settle(model, SettleOptions(max_frames=150))
    wrong = [f"{kind} {seed}: frame {i} intersects {pairs}" for i, pairs in intersections(model, settled).items()]
    if not settled.at_rest.all():
        wrong.append(f"{kind} {seed}: not at rest, residual {settled.residual.max():.2g}")
    return wrong


@pytest.mark.parametrize("kind", KINDS)
def test_a_random_drop_rests_without_intersection(kind):
    assert check(kind, seed=4) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("batch", range(max(1, SCENES // (BATCH * len(KINDS)))))
def test_many_random_drops_never_intersect_and_nearly_all_rest(kind, batch):
    wrong = [
        message for seed in range(1000 + batch * BATCH, 1000 + (batch + 1) * BATCH) for message in check(kind, seed)
    ]
    assert [message for message in wrong if "intersects" in message] == []
    assert len(wrong) <= BATCH // 50, wrong
