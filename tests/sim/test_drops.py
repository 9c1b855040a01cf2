"""Random drops of every kind: never an intersection, and rest in the end."""

import os

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from pat3d.sim.run import SettleOptions
from pat3d.sim.settling import settle
from tests.sim.drops import KINDS, random_scenes
from tests.sim.oracles import intersections

SCENES = int(os.environ.get("PAT3D_DROPS", "10000"))
"""Scenes of the slow suite, in equal shares of the kinds."""

BATCH = 20
"""Worlds that fall at once."""


def check(kind: str, seeds: list[int]) -> tuple[list[str], list[str]]:
    """Scenes that intersect, and scenes that do not come to rest."""
    model = random_scenes(kind, seeds)
    settled = settle(model, SettleOptions(max_frames=150), throw=False)
    found = intersections(model, settled)
    wrong = sorted(
        {
            f"{kind} {seeds[model.world_of[pair[0]]]}: bodies {pair} at frame {frame}"
            for frame, pairs in found.items()
            for pair in pairs
        }
    )
    restless = [
        f"{kind} {seed}: {status}, residual {residual:.2g}"
        for seed, status, residual, rests in zip(seeds, settled.status, settled.residual, settled.at_rest, strict=True)
        if not rests
    ]
    return wrong, restless


@pytest.mark.parametrize("kind", KINDS)
def test_a_random_drop_rests_without_intersection(kind):
    assert check(kind, [4]) == ([], [])


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_many_random_drops_never_intersect_and_nearly_all_rest(kind):
    seen, moving = [], []

    @settings(
        max_examples=max(1, SCENES // (BATCH * len(KINDS))),
        deadline=None,
        database=None,
        phases=[Phase.generate],
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example],
    )
    @given(st.lists(st.integers(0, 2**32 - 1), min_size=BATCH, max_size=BATCH, unique=True))
    def drop(seeds: list[int]) -> None:
        wrong, restless = check(kind, seeds)
        seen.extend(seeds)
        moving.extend(restless)
        assert wrong == []

    drop()
    assert len(moving) <= len(seen) // 50, moving
