"""The light of the CPU renderer in closed form, on surfaces whose normals are known."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.envs.rendering.raytrace import SUN, RayTracer

SIZE = 11
BOX = """
<mujoco>
  <worldbody>
    <body quat="{quat}"><geom name="box" type="box" size="0.2 0.2 0.2" rgba="0.8 0.4 0.2 1"/></body>
    <camera name="eye" pos="0 0 2" fovy="5"/>
  </worldbody>
</mujoco>
"""


def traced(quat: str = "1 0 0 0") -> tuple[RayTracer, mujoco.MjData]:
    model = mujoco.MjModel.from_xml_string(BOX.format(quat=quat))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return RayTracer(model), data


def middle(tracer: RayTracer, data: mujoco.MjData):
    """Colour in the middle of the picture, where the view is straight down."""
    return tracer.draw(data, 0, SIZE, SIZE, depth=False, segmentation=False).image[SIZE // 2, SIZE // 2]


def lit(normal) -> np.ndarray:
    """The box's colour under sun, sky and the camera's lamp; the sky is as bright as the normal points up."""
    x, y, z = np.array(normal) / np.linalg.norm(normal)
    sun = max(float(SUN @ [x, y, z]) / float(np.linalg.norm(SUN)), 0.0)
    brightness = 0.36 + 0.28 * (0.5 + 0.5 * z) + 0.48 * sun + 0.12 * abs(z)
    return np.clip(255.0 * brightness * np.array([0.8, 0.4, 0.2]), 0.0, 255.0)


def test_a_top_is_lit_by_sun_sky_and_lamp():
    np.testing.assert_allclose(middle(*traced()), lit((0.0, 0.0, 1.0)), atol=0.51)


@pytest.mark.parametrize("quat", ["0 1 0 0", "0.7071067811865476 0 0.7071067811865476 0"])
def test_light_falls_in_the_world_s_frame(quat):
    """Whichever side of the box is up, it looks the same."""
    np.testing.assert_array_equal(middle(*traced(quat)), middle(*traced()))


@pytest.mark.parametrize(
    "normal", [(0.3, 0.2, 0.9), (-0.5, 0.1, 0.4), (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0)]
)
def test_a_surface_shows_its_outside_unless_that_is_turned_away(normal):
    """Normals of a mesh are its own: what looks away is seen from behind; at right angles it is as it is."""
    tracer, data = traced()
    tracer._bodies[0].normals[:] = np.array(normal) / np.linalg.norm(normal)
    seen = middle(tracer, data)
    np.testing.assert_allclose(seen, lit(normal), atol=0.51)
    if normal[2] > 0.0:
        tracer._bodies[0].normals[:] *= -1.0
        np.testing.assert_array_equal(middle(tracer, data), seen)
