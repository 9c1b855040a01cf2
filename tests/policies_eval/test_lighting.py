"""The light that perturbations draw: its colours are those of black bodies, and everything comes back."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

mujoco = pytest.importorskip("mujoco")

from pat3d.envs.surroundings.environment import environment, light_of  # noqa: E402
from pat3d.envs.surroundings.lights import OUTDOORS, Lights, light_up  # noqa: E402
from pat3d.policies_eval.run.lighting import (  # noqa: E402
    DAYLIGHT,
    HIGHEST,
    LOWEST,
    RISE,
    WARMEST,
    Lighting,
    chromaticity,
    colour_of,
    turned,
)
from pat3d.policies_eval.run.perturb import Perturbation, Perturber  # noqa: E402


def lit(rig=OUTDOORS):
    """A world with that light and a lamp that throws no parallel light."""
    spec = mujoco.MjSpec()
    body = spec.worldbody.add_body(pos=[0.0, 0.0, 1.0])
    body.add_freejoint()
    body.add_geom(size=[0.1, 0.0, 0.0])
    light_up(spec, rig)
    spec.worldbody.add_light(name="bulb", pos=[1.0, -1.0, 2.0], diffuse=[0.4, 0.4, 0.5], ambient=[0.3, 0.1, 0.1])
    model = spec.compile()
    return SimpleNamespace(simulation=SimpleNamespace(model=model), restart=lambda: None, close=lambda: None)


def told(model):
    """Everything about its light."""
    lamp = model.vis.headlight
    arrays = {name: getattr(model, name) for name in ("light_diffuse", "light_ambient", "light_dir", "light_pos")}
    return {name: one.copy() for name, one in {**arrays, "ambient": lamp.ambient, "lamp": lamp.diffuse}.items()}


@pytest.mark.parametrize(
    ("kelvin", "x", "y"),
    [
        (2500, 0.4770, 0.4137),
        (2856, 0.4476, 0.4075),
        (4000, 0.3805, 0.3768),
        (6500, 0.3135, 0.3237),
        (10000, 0.2807, 0.2884),
    ],
)
def test_black_bodies_have_the_chromaticities_of_tables(kelvin, x, y):
    """CIE 1931; 2856 K is illuminant A."""
    assert chromaticity(kelvin) == pytest.approx((x, y), abs=7e-4)


def test_colours_of_light_are_those_that_a_camera_for_daylight_sees():
    """Standard illuminant A, X = 1.0985 and Z = 0.3558 to Y = 1, as IEC 61966-2-1 turns it into red, green and blue."""
    matrix = np.linalg.inv(np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]))
    # A black body of 6,500 K has X = 0.9685 and Z = 1.1207.
    ratio = (matrix @ [1.0985, 1.0, 0.3558]) / (matrix @ [0.9685, 1.0, 1.1207])
    np.testing.assert_allclose(colour_of(2856.0) ** 2.2, ratio / ratio.max(), atol=0.01)


def test_warm_light_is_red_and_cold_light_is_blue_and_none_is_brighter():
    np.testing.assert_allclose(colour_of(DAYLIGHT), 1.0, atol=1e-12)
    red, green, blue = colour_of(DAYLIGHT / WARMEST)
    assert red == 1.0 > green > blue > 0.0
    red, green, blue = colour_of(DAYLIGHT * WARMEST)
    assert 0.0 < red < green < blue == 1.0


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("strength", [0.2, 0.9])
def test_lights_are_as_bright_and_as_warm_as_drawn_and_come_back(seed, strength):
    env = lit()
    model, before = env.simulation.model, told(env.simulation.model)
    perturber = Perturber(env)
    drawn = perturber.apply(Perturbation(light=strength), seed)["light"]
    factors = np.array(drawn["brightness"])[:, None]
    assert factors.shape == (model.nlight, 1)
    assert (np.abs(factors - 1.0) <= strength).all()
    assert abs(math.log(drawn["kelvin"] / DAYLIGHT)) <= strength * math.log(WARMEST)
    assert abs(drawn["turn"]) <= strength * math.pi
    assert abs(drawn["rise"]) <= strength * RISE
    after, tint = told(model), colour_of(drawn["kelvin"])
    # The model's colours are of single precision.
    for name in ("light_diffuse", "light_ambient"):
        np.testing.assert_allclose(after[name], factors * tint * before[name], rtol=1e-6)
    for name in ("ambient", "lamp"):
        np.testing.assert_allclose(after[name], tint * before[name], rtol=1e-6)
    perturber.undo()
    for name, value in told(model).items():
        np.testing.assert_array_equal(value, before[name])


def test_the_sun_alone_goes_round_and_shadows_with_it():
    """Directions as renderers get them; the sky stays above and the bulb where it hangs."""
    model = lit().simulation.model
    sun, sky, bulb = (model.light(name).id for name in ("sun", "sky", "bulb"))
    before = told(model)
    Lighting(brightness=(1.0,) * model.nlight, kelvin=DAYLIGHT, turn=math.pi / 2, rise=math.radians(-10.0)).shine(model)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    old, new = -before["light_dir"][sun], Lights(model, data).sun
    old = old / np.linalg.norm(old)
    assert new is not None
    # A quarter counter-clockwise.
    flat = old[:2] / np.linalg.norm(old[:2])
    np.testing.assert_allclose(new[:2] / np.linalg.norm(new[:2]), [-flat[1], flat[0]], atol=1e-6)
    assert math.asin(old[2]) - math.asin(new[2]) == pytest.approx(math.radians(10.0), abs=1e-6)
    np.testing.assert_allclose(model.light_pos[sun] / np.linalg.norm(model.light_pos[sun]), new, atol=1e-6)
    for other in (sky, bulb):
        for name in ("light_dir", "light_pos"):
            np.testing.assert_array_equal(getattr(model, name)[other], before[name][other])


@pytest.mark.parametrize("height", [5.0, 30.0, 60.0, 88.0])
@pytest.mark.parametrize("rise", [-40.0, -5.0, 0.0, 40.0])
def test_the_sun_stays_above_the_table(height, rise):
    """It sinks to LOWEST and rises to HIGHEST; one that is beyond them does not go further that way."""
    start = np.array([math.cos(math.radians(height)), 0.0, math.sin(math.radians(height))])
    found = math.asin(turned(2.0 * start, 1.0, math.radians(rise))[2])
    wanted = math.radians(height + rise)
    wanted = min(max(wanted, min(LOWEST, math.radians(height))), max(HIGHEST, math.radians(height)))
    assert found == pytest.approx(wanted, abs=1e-9)


def test_light_from_everywhere_has_the_colour_too():
    """Of an environment map, whose light rays take from harmonics: every channel as much less as the lamps are."""
    env = lit(light_of(environment("overcast")))
    model, normal = env.simulation.model, np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]], dtype=np.float32)

    def light():
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        found = Lights(model, data)
        assert found.harmonics is not None
        return found.harmonics, found.on(normal, np.zeros(2, dtype=np.float32), np.ones(2, dtype=np.bool_))

    model.light("bulb").diffuse[:] = 0.0
    before, plain = light()
    Lighting(brightness=(1.0,) * model.nlight, kelvin=3000.0, turn=0.0, rise=0.0).shine(model)
    after, warm = light()
    np.testing.assert_allclose(after, before * colour_of(3000.0), rtol=1e-5, atol=1e-7)
    np.testing.assert_allclose(warm, plain * colour_of(3000.0), rtol=1e-4)
