"""Resets that move the objects: what touches moves together, rests as it did, and meets nothing."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import fields
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.assets.shapes import box
from pat3d.cli.episodes import settings_of
from pat3d.envs.config import BatchConfig, TabletopConfig
from pat3d.envs.env import TabletopEnv
from pat3d.envs.physics.variation import GAP, LARGEST, TURN
from pat3d.envs.suites.request import Request
from pat3d.envs.suites.suite import Suite
from pat3d.errors import EnvironmentSetupError
from pat3d.policies_eval.run.settings import RolloutSettings
from tests.envs.own_arm import own_arm
from tests.scenes import GAP as SLIT
from tests.scenes import asset_of, placed, scene_of

SEEDS = range(6)
STRENGTH = 0.05
SIDE = 0.04
"""Of the cubes [m]."""


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    return str(path)


@pytest.fixture(scope="module")
def three():
    """A tower of two cubes, and a cube 60 mm beside it."""
    cube = asset_of(box(SIDE, SIDE, SIDE))
    return scene_of(
        placed("base", cube, (0.0, 0.0, SLIT)),
        placed("top", cube, (0.0, 0.0, SIDE + 2 * SLIT)),
        placed("neighbour", cube, (0.1, 0.0, SLIT)),
    )


def poses(env):
    return {name: env.simulation.state.position(name).copy() for name in env.objects}


def test_groups_move_as_wholes_within_the_strength_and_stay_still(arm, three):
    env, plain = (TabletopEnv(scene=three, robot=arm, task="pick:top", start_noise=0.0, vary=v) for v in (STRENGTH, 0))
    plain.reset(seed=0)
    start, places = poses(plain), []
    for seed in SEEDS:
        env.reset(seed=seed)
        found = poses(env)
        np.testing.assert_allclose(found["top"] - found["base"], start["top"] - start["base"], atol=1e-12)
        for name in ("base", "neighbour"):
            away = found[name] - start[name]
            # A cube on its own turns about its own middle.
            assert np.abs(away[:2]).max() <= STRENGTH
            assert away[2] == 0.0
        # Wherever they are turned, cubes a gap apart have their middles a side and a gap apart at least.
        assert np.linalg.norm((found["base"] - found["neighbour"])[:2]) > SIDE + GAP
        turn = env.simulation.state.rotation("base")
        assert np.arccos(np.clip(turn[0, 0], -1.0, 1.0)) <= TURN * STRENGTH + 1e-9
        for _ in range(20):
            env.step(np.zeros(7, dtype=np.float32))
        for name, at in poses(env).items():
            assert np.linalg.norm(at - found[name]) < 2e-4
        places.append(found["base"])
    assert np.ptp(places, axis=0)[:2].min() > STRENGTH / 2
    env.reset(seed=0)
    again = poses(env)
    env.reset(seed=0)
    assert all(np.array_equal(at, again[name]) for name, at in poses(env).items())
    env.close()
    plain.close()


def test_what_has_no_room_stays_and_a_strength_out_of_range_is_refused(arm):
    """Between walls that are closer than the gap to be kept, a tower stays where it was."""
    cube = asset_of(box(SIDE, SIDE, SIDE))
    away = SIDE + GAP / 2
    walls = ((away, 0.0), (-away, 0.0), (0.0, away), (0.0, -away))
    pen = scene_of(
        placed("cube", cube, (0.0, 0.0, SLIT)),
        placed("top", cube, (0.0, 0.0, SIDE + 2 * SLIT)),
        *(placed(f"wall {n}", cube, (x, y, 0.0), fixed=True) for n, (x, y) in enumerate(walls)),
    )
    env = TabletopEnv(scene=pen, robot=arm, task="pick:top", vary=GAP / 10)
    env.reset(seed=0)
    for name in ("cube", "top"):
        np.testing.assert_array_equal(poses(env)[name], pen[name].pose.position)
    env.close()
    with pytest.raises(EnvironmentSetupError, match=f"vary is 0 to {LARGEST:g} m"):
        TabletopEnv(robot=arm, vary=1.0)


def test_environments_of_a_suite_vary_as_it_says_unless_told_otherwise_and_worlds_on_a_gpu_refuse_it(monkeypatch):
    found = SimpleNamespace(request=Request(robot="panda", vary=STRENGTH))
    monkeypatch.setattr(Suite, "open", staticmethod(lambda path: found))
    assert TabletopConfig(suite="suite").vary == STRENGTH
    assert TabletopConfig(suite="suite", vary=0.0).vary == 0.0
    assert TabletopConfig().vary == 0.0
    with pytest.raises(EnvironmentSetupError, match="resets of this suite move its objects"):
        BatchConfig(suite="suite")
    options = Namespace(**{field.name: field.default for field in fields(RolloutSettings)}, suite="suite")
    assert settings_of(Namespace(**vars(options) | {"vary": None})).vary == STRENGTH
    assert settings_of(options).vary == 0.0
    assert settings_of(Namespace(**vars(options) | {"vary": None, "suite": ""})).vary == 0.0
