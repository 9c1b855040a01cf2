"""Canonical hard cases: no recorded frame intersects, and what stands, slides or falls is what mechanics says."""

import numpy as np
import pytest

from pat3d.sim.model import Model
from pat3d.sim.run import SettleOptions
from pat3d.sim.settling import Settled, settle
from tests.sim import canonical as cases
from tests.sim.canonical import pair, spike, upside_down, wedge
from tests.sim.oracles import IntersectionOracle, intersections

HALF_TURNS = {"parallel": 0.0, "a hair from parallel": 1e-6, "crossed": np.pi / 2}


def verified(model: Model, **options) -> Settled:
    """The model settled, after verification that no recorded frame intersects."""
    settled = settle(model, SettleOptions(**options), throw=False)
    assert intersections(model, settled) == {}
    return settled


def at_rest(model: Model, **options) -> Settled:
    settled = verified(model, **options)
    assert settled.at_rest.all(), settled.residual
    return settled


def moved(model: Model, settled: Settled) -> float:
    """Largest motion of any body's centre [m]."""
    return float(np.linalg.norm(settled.q[:, 0] - model.q0[:, 0], axis=1).max())


def turned(model: Model, settled: Settled) -> float:
    """Largest turn of any body [rad]."""
    cosine = (np.einsum("bji,bji->b", settled.q[:, 1:], model.q0[:, 1:]) - 1) / 2
    return float(np.arccos(np.clip(cosine, -1, 1)).max())


def test_the_oracle_finds_intersections():
    model = pair(wedge(), upside_down(wedge()), -0.02, np.pi / 2)
    assert IntersectionOracle(model).pairs_at(model.q0) == {(0, 1)}
    sunk = pair(spike(), upside_down(spike()), 0.01)
    sunk.q0[1, 0, 2] = -0.1
    assert IntersectionOracle(sunk).pairs_at(sunk.q0) == {(1, -1)}


@pytest.mark.parametrize("yaw", HALF_TURNS.values(), ids=HALF_TURNS)
def test_wedges_edge_on_edge_come_to_rest(yaw):
    at_rest(pair(wedge(), upside_down(wedge()), 1e-3, yaw))


@pytest.mark.parametrize("lower", [wedge(), spike()], ids=["wedge", "spike"])
def test_a_spike_comes_to_rest_on_its_tip_or_beside(lower):
    at_rest(pair(lower, upside_down(spike()), 1e-3))


@pytest.mark.parametrize("offset", [0.0, 0.011])
def test_a_spike_comes_to_rest_inside_a_pit_that_is_not_convex(offset):
    model = cases.spike_in_pit(offset)
    settled = at_rest(model)
    tip = IntersectionOracle(model).positions(settled.q)[model.vertex_body.numpy() == 1, 2].min()
    assert 0.0 < tip < 0.12


@pytest.mark.parametrize(("lean", "falls"), [(0.0, False), (0.04, False), (0.06, True)])
def test_a_box_falls_off_a_cliff_exactly_when_its_centre_is_beyond_the_edge(lean, falls):
    model = cases.cliff(lean)
    assert (moved(model, at_rest(model)) > 0.05) == falls


@pytest.mark.parametrize("yaw", [0.0, 0.3])
def test_the_triangles_of_a_flat_floor_do_not_show(yaw):
    model = cases.box_on_tiles(6, yaw)
    settled = at_rest(model)
    assert settled.q[1, 0, 2] - 0.08 == pytest.approx(1e-5, abs=1e-5)
    assert turned(model, settled) < 1e-3


def test_an_arch_of_7_stones_stands():
    model = cases.arch(7)
    settled = at_rest(model, friction=0.5)
    assert moved(model, settled) < 5e-3
    assert turned(model, settled) < np.deg2rad(1)


@pytest.mark.slow
def test_an_arch_of_25_stones_stands():
    """Each of the 25 joints opens by at most the barrier's reach while it settles, and so the ring by 25 times that."""
    model = cases.arch(25)
    settled = at_rest(model, friction=0.5)
    assert moved(model, settled) < 25 * SettleOptions().d_hat
    assert turned(model, settled) < np.deg2rad(2)


@pytest.mark.parametrize(("levels", "friction", "stands"), [(1, 0.5, True), (2, 0.5, True), (1, 0.1, False)])
def test_card_houses_stand_on_friction(levels, friction, stands):
    """A card leaning at 65 degrees against another needs mu > 1 / (2 tan 65 deg) = 0.23."""
    model = cases.card_house(levels)
    settled = at_rest(model, friction=friction)
    assert (turned(model, settled) < np.deg2rad(3)) == stands


@pytest.mark.parametrize("degrees", [15, 30, 45])
@pytest.mark.parametrize("share", [0.97, 1.03])
def test_blocks_slide_exactly_where_the_slope_exceeds_friction(degrees, share):
    angle = np.deg2rad(degrees)
    settled = verified(cases.slope(angle), friction=share * float(np.tan(angle)), max_frames=30, max_polish_steps=40)
    assert settled.at_rest.all() == (share > 1)
    slid = np.linalg.norm(settled.q[1, 0] - settled.trajectory[1, 1, 0])
    assert (slid < 2e-3) if share > 1 else (slid > 5e-3)


@pytest.mark.parametrize(("share", "falls"), [(0.95, False), pytest.param(1.1, True, marks=pytest.mark.slow)])
def test_an_overhanging_stack_falls_beyond_the_harmonic_bound(share, falls):
    model = cases.overhang(5, share)
    assert (moved(model, at_rest(model)) > 0.02) == falls


@pytest.mark.parametrize(("ratio", "tips"), [(1.0, False), (1.5, True)])
def test_a_lever_tips_to_its_heavier_end(ratio, tips):
    """The fulcrum, 2 cm wide, holds a balance that is off by less than 1 cm of 25."""
    model = cases.lever(ratio)
    settled = at_rest(model)
    assert (settled.q[3, 0, 2] - settled.q[2, 0, 2] < -0.01) == tips


@pytest.mark.parametrize("angle", HALF_TURNS.values(), ids=HALF_TURNS)
def test_cubes_edge_on_edge_come_to_rest(angle):
    at_rest(cases.edge_on_edge(angle, 1e-3))


@pytest.mark.parametrize("clearance", [1e-4, 1e-5])
def test_a_cube_falls_or_hangs_between_walls_without_touching_them(clearance):
    at_rest(cases.tunnel(clearance))


@pytest.mark.parametrize("ratio", [1e2, pytest.param(1e4, marks=pytest.mark.slow)])
def test_a_heavy_cube_rests_on_a_light_one(ratio):
    model = cases.heavy_on_light(ratio)
    assert moved(model, at_rest(model)) < 4e-3
