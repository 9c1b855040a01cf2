"""One runner on the shipped scene for all tests; robosuite's or pyarrow's absence skips what needs it."""

from __future__ import annotations

import os

import pytest

os.environ.setdefault("PAT3D_RENDERER", "cpu")


@pytest.fixture(scope="session")
def runner():
    """Runs episodes of at most 100 steps on the shipped scene."""
    pytest.importorskip("robosuite")
    pytest.importorskip("gymnasium")
    from pat3d.policies_eval.run.rollout import Runner
    from pat3d.policies_eval.run.settings import RolloutSettings

    made = Runner(RolloutSettings(max_steps=100, act_seconds=3600.0))
    yield made
    made.close()


@pytest.fixture(scope="session")
def episode():
    """Picking the red mug."""
    from pat3d.policies_eval.run.episodes import Episode

    return Episode(index=0, scene="", task="pick:red mug", seed=11)
