"""The CPU renderer against closed forms and against MuJoCo's own."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.envs.rendering.raytrace import RayTracer

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
    model = mujoco.MjModel.from_xml_string(text)
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


def test_the_cpu_and_gl_see_the_same_things(env):
    """Segmentation agrees in all but a few edge pixels, depth to a step of a buffer of 16 bits."""
    from pat3d.view.gl import probe_egl

    if not probe_egl():
        pytest.skip("no EGL here")
    from pat3d.envs.rendering.opengl import OpenGL

    env.reset(seed=0)
    model, data = env.simulation.model, env.simulation.data
    gl, cpu = OpenGL(model), RayTracer(model)
    near = model.vis.map.znear * model.stat.extent
    for name in ("agentview", "wrist"):
        camera = model.camera(name).id
        theirs = gl.draw(data, camera, 96, 128, depth=True, segmentation=True)
        ours = cpu.draw(data, camera, 96, 128, depth=True, segmentation=True)
        same = theirs.geoms == ours.geoms
        assert same.mean() > 0.99
        # A buffer that holds near / z [m] is off by near / z^2 for every metre.
        step = ours.depth**2 / near / 2**16
        assert np.median((np.abs(theirs.depth - ours.depth) / step)[same]) < 1.0
        # Textures land on the same places: colours differ by the light, not by the hue.
        bright = same & (theirs.image.max(axis=2) > 60) & (theirs.image.max(axis=2) < 250)
        hues = [one[bright] / one[bright].sum(axis=1, keepdims=True) for one in (theirs.image * 1.0, ours.image * 1.0)]
        assert np.median(np.abs(hues[0] - hues[1])) < 0.03
    gl.close()
