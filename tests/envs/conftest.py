"""The environment of the shipped scene, made once; robosuite's absence skips what needs it."""

from __future__ import annotations

import importlib.util
import os

import pytest

from pat3d.envs.registration import register_with_gymnasium

# The CPU draws the same everywhere; the agreement with GL has a test of its own.
os.environ.setdefault("PAT3D_RENDERER", "cpu")
# What these tests say of joints and lifts they say of this arm, which needs no download; test_robots has the others.
os.environ["PAT3D_ROBOT"] = "Panda"


@pytest.fixture(scope="session", autouse=True)
def registered():
    """The environment is known to Gymnasium, whatever imported what first."""
    if importlib.util.find_spec("gymnasium"):
        register_with_gymnasium()


@pytest.fixture(scope="session")
def env():
    """A TabletopEnv with a Panda on the shipped scene; its task may change from test to test."""
    pytest.importorskip("robosuite")
    pytest.importorskip("gymnasium")
    from pat3d.envs.env import TabletopEnv

    made = TabletopEnv()
    yield made
    made.close()


@pytest.fixture(scope="session")
def breakfast():
    """The shipped scene: a red mug, a green apple, a banana and a blue bowl on a wooden tray."""
    from pat3d.envs.physics.loading import default_scene
    from pat3d.scene.io import load_scene

    return load_scene(default_scene())
