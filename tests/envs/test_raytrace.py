"""The light of the CPU renderer in closed form, on surfaces whose normals are known."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.envs.rendering.raytrace import TILE, RayTracer
from pat3d.envs.surroundings.lights import FLOOR, SKY, SUN, light_up

SIZE = 11


def lit_model(text: str) -> mujoco.MjModel:
    """A world in the environments' light."""
    spec = mujoco.MjSpec.from_string(text)
    light_up(spec)
    return spec.compile()


BOX = """
<mujoco>
  <worldbody>
    <body quat="{quat}"><geom name="box" type="box" size="0.2 0.2 0.2" rgba="0.8 0.4 0.2 1"/></body>
    <camera name="eye" pos="0 0 2" fovy="5"/>
  </worldbody>
</mujoco>
"""


def traced(quat: str = "1 0 0 0") -> tuple[RayTracer, mujoco.MjData]:
    model = lit_model(BOX.format(quat=quat))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return RayTracer(model), data


def middle(tracer: RayTracer, data: mujoco.MjData):
    """Colour in the middle of the picture, where the view is straight down."""
    return tracer.draw(data, 0, SIZE, SIZE, depth=False, segmentation=False).image[SIZE // 2, SIZE // 2]


def lit(normal) -> np.ndarray:
    """The box's colour under sun, sky and the camera's lamp; the sky shines straight down, and so does the camera."""
    x, y, z = np.array(normal) / np.linalg.norm(normal)
    sun = max(float(SUN @ [x, y, z]) / float(np.linalg.norm(SUN)), 0.0)
    brightness = 0.40 + 0.15 * max(z, 0.0) + 0.42 * sun + 0.10 * abs(z)
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


GLASS = """
<mujoco>
  <worldbody>
    <body><geom name="box" type="box" size="0.2 0.2 0.2" rgba="0.8 0.4 0.2 1"/></body>
    <body pos="0 0 0.5"><geom name="pane" type="box" size="0.2 0.2 0.1" rgba="0.2 0.6 0.9 {alpha}"/></body>
    <camera name="eye" pos="0 0 2" fovy="5"/>
  </worldbody>
</mujoco>
"""


@pytest.mark.parametrize("alpha", [0.25, 0.75, 1.0])
@pytest.mark.parametrize("fine", [False, True])
def test_what_is_behind_a_pane_shines_through_it_once_and_depth_is_that_of_the_pane(alpha, fine):
    """The pane's top faces the eye, its underside does not. Both tops are lit alike: nothing shades without shadows."""
    model = lit_model(GLASS.format(alpha=alpha))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    picture = RayTracer(model).draw(data, 0, SIZE, SIZE, depth=True, segmentation=True, fine=fine)
    top = lit((0.0, 0.0, 1.0)) / np.array([0.8, 0.4, 0.2])
    # Films have shadows: the pane's falls on the box beneath it.
    lower = top if not fine else 255.0 * np.full(3, 0.40 + 0.15 + 0.10)
    expected = alpha * top * np.array([0.2, 0.6, 0.9]) + (1.0 - alpha) * lower * np.array([0.8, 0.4, 0.2])
    shadowed = abs(picture.image[SIZE // 2, SIZE // 2] - expected)
    assert shadowed.max() < 1.1
    assert picture.depth is not None
    assert picture.geoms is not None
    assert picture.depth[SIZE // 2, SIZE // 2] == pytest.approx(1.4, abs=1e-4)
    assert picture.geoms[SIZE // 2, SIZE // 2] == 1


PAINTED = """
<mujoco>
  <asset>
    <texture name="red" type="2d" builtin="flat" rgb1="1 0.2 0.1" width="4" height="4"/>
    <texture name="blue" type="2d" builtin="flat" rgb1="0.1 0.4 1" width="4" height="4"/>
    <material name="red" texture="red"/>
    <material name="blue" texture="blue" rgba="0.5 1 0.5 1"/>
    <material name="bare" rgba="0.2 0.6 0.4 1"/>
  </asset>
  <worldbody>
    <body>
      <geom name="a" type="box" size="0.1 0.1 0.1" material="red"/>
      <geom name="b" type="box" size="0.1 0.1 0.1" pos="1 0 0" material="bare"/>
      <geom name="c" type="box" size="0.1 0.1 0.1" pos="2 0 0" material="blue"/>
      <geom name="d" type="box" size="0.1 0.1 0.1" pos="3 0 0" rgba="0.3 0.1 0.9 1"/>
    </body>
    {cameras}
  </worldbody>
</mujoco>
"""
COLOURS = [(1.0, 0.2, 0.1), (0.2, 0.6, 0.4), (0.05, 0.4, 0.5), (0.3, 0.1, 0.9)]
"""Of the four boxes: texture times material where there are both."""


def test_every_geom_of_a_body_has_its_own_texture_or_none():
    cameras = "".join(f'<camera pos="{x} 0 2" fovy="5"/>' for x in range(4))
    model = lit_model(PAINTED.format(cameras=cameras))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    tracer = RayTracer(model)
    brightness = lit((0.0, 0.0, 1.0)) / (255.0 * np.array([0.8, 0.4, 0.2]))
    for camera, colour in enumerate(COLOURS):
        drawn = tracer.draw(data, camera, SIZE, SIZE, depth=False, segmentation=True)
        assert drawn.geoms is not None
        assert (drawn.geoms == camera).all()
        expected = np.clip(255.0 * brightness * np.array(colour), 0.0, 255.0)
        # A texture has 255 steps of its own.
        np.testing.assert_allclose(drawn.image.reshape(-1, 3), np.tile(expected, (SIZE * SIZE, 1)), atol=1.3)


@pytest.mark.parametrize("tilt", [0.0, 25.0, 60.0, 80.0])
def test_a_floor_is_where_the_view_meets_it_in_tiles_that_fade_into_the_sky(tilt):
    """Seen from 2 m above a floor that is turned, from one straight down to one with its horizon in the picture."""
    model = lit_model(
        f"""<mujoco><worldbody><geom name="floor" type="plane" size="0 0 1" pos="0.3 -0.2 0.1" euler="0 0 30"/>
        <camera pos="1 0.5 2.1" euler="{tilt} 0 0" fovy="40"/></worldbody></mujoco>"""
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    drawn = RayTracer(model).draw(data, 0, 30, 40, depth=True, segmentation=True)
    assert drawn.depth is not None
    assert drawn.geoms is not None
    scale = 2.0 * np.tan(np.radians(20.0)) / 30
    y, x = np.mgrid[0:30, 0:40]
    views = np.stack([(x + 0.5 - 20) * scale, (15 - y - 0.5) * scale, -np.ones((30, 40))], axis=-1)
    views = views @ data.cam_xmat[0].reshape(3, 3).T
    below = views[..., 2] < -1e-3
    assert below.any()
    assert below.all() == (tilt < 70.0)
    np.testing.assert_array_equal(drawn.geoms, np.where(below, 0, -1))
    # Views go a metre ahead, so that what they are multiplied by is the depth.
    depth = 2.0 / -views[below][:, 2]
    far = model.vis.map.zfar * model.stat.extent
    np.testing.assert_allclose(drawn.depth[below], np.minimum(depth, far), rtol=1e-4)
    assert (drawn.depth[~below] == np.float32(far)).all()
    np.testing.assert_allclose(drawn.image[~below], np.tile(255.0 * SKY, (int((~below).sum()), 1)), atol=0.51)
    place = (views[below] * depth[:, None] + [1.0, 0.5, 2.1] - [0.3, -0.2, 0.1]) @ data.geom_xmat[0].reshape(3, 3)
    tiles = place[:, :2] / TILE
    # Away from the joints, which are as sharp as rounding allows.
    plain = (np.abs(tiles - np.round(tiles)) > 1e-3).all(axis=1)
    shade = np.where(np.floor(tiles).sum(axis=1)[:, None] % 2 > 0, *np.array(FLOOR))
    far_away = np.linalg.norm(views[below], axis=1)
    lamp = 0.10 * -views[below][:, 2] / far_away
    light = 0.40 + 0.15 + 0.42 * float(SUN[2] / np.linalg.norm(SUN)) + lamp[:, None]
    fade = np.clip((depth * far_away - 2.0) / 10.0, 0.0, 1.0)[:, None]
    expected = 255.0 * (shade * light * (1.0 - fade) + SKY * fade)
    assert len(set(np.round(shade[plain, 0], 3))) == 2
    np.testing.assert_allclose(drawn.image[below][plain], expected[plain], atol=0.6)


SHADED = """
<mujoco>
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1"/>
    <body pos="0 0 0.1"><geom name="box" type="box" size="0.4 0.4 0.1" rgba="0.8 0.4 0.2 1"/></body>
    <body pos="{x} {y} {z}"><geom name="ball" size="0.05" rgba="0.1 0.1 0.1 1"/></body>
    <camera name="eye" pos="0 0 3" fovy="30"/>
  </worldbody>
</mujoco>
"""


def in_the_sun(height: float, fine: bool):
    """A box on a floor, seen from above, and a ball on the line from the middle of its top to the sun."""
    ball = np.array([0.0, 0.0, 0.2]) + height * SUN / np.linalg.norm(SUN)
    model = lit_model(SHADED.format(x=ball[0], y=ball[1], z=ball[2]))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return RayTracer(model).draw(data, 0, 101, 101, depth=False, segmentation=True, fine=fine)


def test_what_something_hides_from_the_sun_has_the_light_of_sky_and_lamp_alone():
    """A ball that does not cover the middle of the picture throws its shadow there, in films alone."""
    sun = float(SUN[2] / np.linalg.norm(SUN))
    shade = lit((0.0, 0.0, 1.0)) - 255.0 * 0.42 * sun * np.array([0.8, 0.4, 0.2])
    film, plain = in_the_sun(0.6, True), in_the_sun(0.6, False)
    assert film.geoms is not None
    assert film.geoms[50, 50] == 1
    np.testing.assert_allclose(film.image[50, 50], shade, atol=0.51)
    np.testing.assert_allclose(plain.image[50, 50], lit((0.0, 0.0, 1.0)), atol=0.51)
    # The shadow of a ball of 5 cm is an ellipse, one radius wide across the sun's direction.
    dark = (film.image[..., 0] < shade[0] + 1) & (film.geoms == 1)
    pixel = 2.0 * 2.8 * np.tan(np.radians(15.0)) / 101
    assert dark.sum() * pixel**2 == pytest.approx(np.pi * 0.05**2 / sun, rel=0.2)


def test_a_box_throws_its_shadow_on_the_floor_away_from_the_sun():
    """The sun is at +x, -y: 20 cm of box reach 8.5 cm to -x and 11 cm to +y."""
    film, plain = in_the_sun(100.0, True), in_the_sun(100.0, False)
    darker = (film.image.astype(int).sum(axis=2) < plain.image.astype(int).sum(axis=2) - 60) & (film.geoms == 0)
    rows, columns = np.nonzero(darker)
    assert len(rows)
    pixel = 2.0 * 3.0 * np.tan(np.radians(15.0)) / 101
    assert (50 - columns.min()) * pixel == pytest.approx(0.4 + 0.2 * SUN[0] / SUN[2], abs=0.03)
    assert (50 - rows.min()) * pixel == pytest.approx(0.4 - 0.2 * SUN[1] / SUN[2], abs=0.03)
    # The box's own top covers the floor to 43 cm, seen from 3 m.
    assert (columns.max() - 50) * pixel < 0.44


def test_pixels_on_an_edge_are_between_what_is_on_both_sides_and_others_stay():
    """A tilted box covers a part of each pixel on its edges; what is inside is as it was."""
    text = BOX.format(quat="0.98 0 0 0.2").replace('fovy="5"', 'fovy="20"')
    model = lit_model(text)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    tracer = RayTracer(model)
    plain, film = (tracer.draw(data, 0, 61, 61, depth=False, segmentation=True, fine=fine) for fine in (False, True))
    assert plain.geoms is not None
    box, sky = plain.image[30, 30].astype(int), np.array(255.0 * SKY + 0.5, dtype=int)
    shares = (film.image[..., 0].astype(float) - sky[0]) / float(box[0] - sky[0])
    # Of four rays through a pixel some meet the box; top alone is seen, or a side, which is darker.
    between = (shares > 0.2) & (shares < 0.8)
    assert between.sum() > 40
    inside = np.zeros_like(between)
    inside[1:-1, 1:-1] = True
    for shift in ((0, 1), (0, -1), (1, 0), (-1, 0)):
        inside &= np.roll(plain.geoms, shift, axis=(0, 1)) == plain.geoms
    np.testing.assert_array_equal(film.image[inside], plain.image[inside])
    assert not between[inside].any()


@pytest.mark.parametrize("factor", [0.5, 0.0])
def test_a_light_of_the_model_that_is_weaker_is_weaker_in_the_picture(factor):
    """So that a perturbation of the lights is one of the pictures."""
    tracer, data = traced()
    before = middle(tracer, data).astype(float)
    model = tracer._model
    model.light_diffuse[model.light("sun").id] *= factor
    sun = 255.0 * 0.42 * float(SUN[2] / np.linalg.norm(SUN)) * np.array([0.8, 0.4, 0.2])
    np.testing.assert_allclose(before - middle(tracer, data), (1.0 - factor) * sun, atol=1.01)
