"""The CPU renderer against closed forms and against MuJoCo's own."""

from __future__ import annotations

import os
import subprocess
import sys

import mujoco
import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.envs.rendering import pictures
from pat3d.envs.rendering.pictures import TOLERANCE
from pat3d.envs.rendering.raytrace import RayTracer
from pat3d.envs.surroundings.lights import light_up
from pat3d.errors import EnvironmentSetupError
from pat3d.view.gl import KINDS, gl_renderer
from tests.envs.own_arm import own_arm

BALL = """
<mujoco>
  <worldbody>
    <geom name="ball" size="0.2" rgba="1 0 0 1"/>
    <geom name="box" type="box" size="0.1 0.1 0.1" pos="0.5 0 0" rgba="0 0 1 1"/>
    <camera name="eye" pos="0 0 2" fovy="45"/>
  </worldbody>
</mujoco>
"""


def _drawn(text: str, size: int = 101):
    spec = mujoco.MjSpec.from_string(text)
    light_up(spec)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, RayTracer(model).draw(data, 0, size, size, depth=True, segmentation=True)


def test_depth_is_the_distance_from_the_camera_s_plane():
    """Two metres to the middle of the ball less its radius; 1.9 m to the box's top, wherever on it."""
    _, picture = _drawn(BALL)
    assert picture.depth[50, 50] == pytest.approx(1.8, abs=2e-3)
    top = picture.geoms == 1
    # Parts of the box's side are seen as well.
    assert np.percentile(picture.depth[top], 10) == pytest.approx(1.9, abs=1e-4)


def test_the_ball_covers_the_solid_angle_that_it_should():
    """A ball of radius r at distance d fills a circle of radius f r / sqrt(d^2 - r^2) pixels."""
    _, picture = _drawn(BALL, 201)
    focal = 100.5 / np.tan(np.radians(22.5))
    expected = np.pi * (focal * 0.2 / np.sqrt(4.0 - 0.04)) ** 2
    assert (picture.geoms == 0).sum() == pytest.approx(expected, rel=0.02)


def test_colours_stay_on_their_objects_and_right_is_right():
    _, picture = _drawn(BALL)
    ball, box = picture.image[picture.geoms == 0], picture.image[picture.geoms == 1]
    assert ball[:, 0].min() > 50
    assert ball[:, 2].max() == 0
    assert box[:, 2].min() > 50
    assert np.flatnonzero((picture.geoms == 1).any(axis=0)).min() > 50


@pytest.mark.parametrize("kind", KINDS)
def test_the_cpu_and_gl_draw_the_same_picture(tmp_path, kind):
    """Segmentation agrees but on edges, depth but in films to a step of a buffer of 16 bits, colours to TOLERANCE."""
    if gl_renderer(kind) is None:
        pytest.skip(f"no {kind} here")
    # What draws binds a process to EGL or to OSMesa.
    told = subprocess.run(
        [sys.executable, "-c", DRAW, kind, own_arm_file(tmp_path)],
        env={**os.environ, "PYOPENGL_PLATFORM": kind},
        capture_output=True,
        text=True,
        check=False,
    )
    assert told.returncode == 0, told.stderr
    for line in told.stdout.splitlines():
        fine, same, depth, colour = map(float, line.split())
        assert same > 0.99
        assert fine or depth < 1.0
        assert colour < TOLERANCE


DRAW = """
import sys
import numpy as np
from pat3d.envs.env import TabletopEnv
from pat3d.envs.rendering.opengl import OpenGL
from pat3d.envs.rendering.raytrace import RayTracer

env = TabletopEnv(robot=sys.argv[2], task="pick:red mug")
env.reset(seed=0)
model, data = env.simulation.model, env.simulation.data
renderers = OpenGL(model, sys.argv[1]), RayTracer(model)
mug = [geom for geom in range(model.ngeom) if "mug" in model.geom(geom).name and model.geom_matid[geom] >= 0]
for name, opacity in (("agentview", 1.0), ("wrist", 1.0), ("agentview", 0.25)):
    if opacity < 1.0:
        model.mat_rgba[model.geom_matid[mug], 3] = opacity
        renderers[0].close()
        renderers = OpenGL(model, sys.argv[1]), RayTracer(model)
    for fine in (False, True, False):
        theirs, ours = (
            one.draw(data, model.camera(name).id, 96, 128, depth=True, segmentation=True, fine=fine)
            for one in renderers
        )
        same = theirs.geoms == ours.geoms
        # A buffer that holds near / z [m] is off by near / z^2 for every metre.
        step = ours.depth**2 / (model.vis.map.znear * model.stat.extent) / 2**16
        print(int(fine), same.mean(), np.median((np.abs(theirs.depth - ours.depth) / step)[same]),
              np.abs(theirs.image.astype(float) - ours.image).mean())
renderers[0].close()
"""


def own_arm_file(folder) -> str:
    """A robot file of one's own."""
    (folder / "arm.xml").write_text(own_arm())
    return str(folder / "arm.xml")


@pytest.mark.parametrize(
    ("works", "variables", "used"),
    [
        (("egl", "osmesa"), {}, "egl"),
        (("osmesa",), {}, "osmesa"),
        ((), {}, "cpu"),
        (("egl",), {"PAT3D_RENDERER": "cpu"}, "cpu"),
        ((), {"MUJOCO_GL": "osmesa"}, "osmesa"),
        (("egl",), {"MUJOCO_GL": "glfw"}, "egl"),
        (("egl", "osmesa"), {"PYOPENGL_PLATFORM": "osmesa"}, "osmesa"),
    ],
)
def test_what_works_draws_unless_another_is_named(monkeypatch, works, variables, used):
    for name in ("PAT3D_RENDERER", "MUJOCO_GL", "PYOPENGL_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(pictures, "gl_renderer", lambda kind: kind if kind in works else None)
    assert pictures.backend.__wrapped__() == used


def test_a_renderer_that_is_none_is_refused_with_those_that_are(monkeypatch):
    monkeypatch.setenv("PAT3D_RENDERER", "gpu")
    with pytest.raises(EnvironmentSetupError, match="Valid: egl, osmesa, cpu"):
        pictures.backend.__wrapped__()
