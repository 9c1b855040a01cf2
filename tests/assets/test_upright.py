"""Which axis of a bare mesh points up: by rest, proportions, hollows and origin; what is unsure is flagged."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from pat3d.assets.library.body import Body, Inertial, of_mesh
from pat3d.assets.library.guess import SURE, Typical
from pat3d.assets.library.indexing import _centre
from pat3d.assets.library.metadata import _axis
from pat3d.assets.library.resting import resting_poses, standing
from pat3d.assets.library.upright import guess_up
from pat3d.assets.mesh.importing import TO_Z_UP
from pat3d.assets.mesh.load import LoadedMesh
from tests.assets.things_to_index import bowl

CARTON = Typical(noun="carton", size=(0.16, 0.06, 0.21))


def body_of(mesh: trimesh.Trimesh, up: str) -> Body:
    """The mesh, which has z up, as a file that has `up` up and says nothing of it."""
    vertices = np.asarray(mesh.vertices) @ np.array(TO_Z_UP[up], dtype=float)
    faces = np.asarray(mesh.faces, dtype=np.int64)
    blank = LoadedMesh(
        vertices=vertices, faces=faces, uv=np.zeros((len(faces), 3, 2)), texture=np.zeros((1, 1, 3), dtype=np.uint8)
    )
    assert of_mesh(blank).vertices is vertices
    return Body(mesh=blank)


def carton(yaw: float = 0.0) -> trimesh.Trimesh:
    """As tall as its kind, standing on its base 1 cm above the origin, turned by `yaw` about the upright."""
    box = trimesh.creation.box((0.17, 0.065, 0.2))
    box.apply_translation((0.01, 0.02, 0.11))
    return box.apply_transform(trimesh.transformations.rotation_matrix(yaw, [0, 0, 1]))


@pytest.mark.parametrize("up", ["z", "y"])
@pytest.mark.parametrize("yaw", [0.0, 0.6])
def test_proportions_of_its_kind_tell_however_it_is_turned(up, yaw):
    guess = guess_up(body_of(carton(yaw), up), CARTON)
    assert guess.value == up
    assert guess.confidence >= SURE
    assert "carton" in guess.reason


@pytest.mark.parametrize("up", ["z", "y", "x"])
def test_a_hollow_is_open_to_above(up):
    guess = guess_up(body_of(bowl(), up), None)
    assert guess.value == up
    assert "hollow" in guess.reason


@pytest.mark.parametrize("up", ["z", "y"])
def test_what_would_topple_is_not_upright(up):
    """A pyramid stands on its base alone: on its slanted sides it would have no axis upright."""
    corners = [[x, y, 0.0] for x in (0.1, -0.1) for y in (0.1, -0.1)] + [[0.0, 0.0, 0.3]]
    pyramid = trimesh.convex.convex_hull(np.array(corners))
    assert guess_up(body_of(pyramid, up), None).value == up


def test_a_cube_may_stand_on_any_side_and_is_flagged():
    guess = guess_up(body_of(trimesh.creation.box((0.1, 0.1, 0.1)), "z"), None)
    assert guess.value == "z"
    assert guess.confidence < SURE


@pytest.mark.parametrize(
    ("said", "axis"),
    [("y", "y"), ("Z_UP", "z"), ("+Y", "y"), ("-x", "-x"), ([0, 1, 0], "y"), ([0, 0, -1.0], "-z")]
    + [(one, None) for one in ("upwards", "", None, [0.7, 0.7, 0], [1, 1, 1], [0, 1], 3)],
)
def test_axes_that_metadata_name(said, axis):
    assert _axis(said) == axis


def _wedge(half: float) -> np.ndarray:
    """A bar 0.2 m high over a base of half width `half` [m], wide above."""
    base = [(x, y, 0.0) for x in (-half, half) for y in (-0.05, 0.05)]
    return np.array(base + [(x, y, z) for x in (-0.06, 0.06) for y in (-0.05, 0.05) for z in (0.1, 0.2)])


def test_what_stands_on_too_little_is_laid_where_it_stands_steadily():
    """Its centre of mass is 0.13 m above a base that is 2 mm wide: 0.4 degrees upset it, 2 degrees of 10 mm do not."""
    turn, told = standing(np.eye(3), resting_poses(_wedge(0.001)))
    assert "steadily" in told
    assert abs(turn[2, 2]) < 0.01  # on its side
    turn, told = standing(np.eye(3), resting_poses(_wedge(0.005)))
    assert (turn == np.eye(3)).all()
    assert told == ""


def test_the_margin_of_a_box_is_its_closed_form():
    upright = next(rest for rest in resting_poses(trimesh.creation.box((0.1, 0.06, 0.3)).vertices) if rest.tilt < 1.0)
    assert upright.margin == pytest.approx(np.degrees(np.arctan2(0.03, 0.15)), rel=1e-9)


def test_what_an_object_rests_on_depends_on_where_its_own_mass_is():
    """A plate with a heavy block under one end: the hull's centre of mass is over the block's edge, its own is not."""
    block, plate = trimesh.creation.box((0.04, 0.04, 0.08)), trimesh.creation.box((0.14, 0.04, 0.004))
    plate.apply_translation((0.05, 0.0, 0.042))
    mesh = trimesh.util.concatenate([block, plate])
    body = body_of(mesh, "z")
    volumes = np.array([block.volume, plate.volume])
    centre = _centre(body, 1.0)
    assert centre == pytest.approx(volumes @ [[0.0, 0.0, 0.0], [0.05, 0.0, 0.042]] / volumes.sum(), abs=1e-12)
    points = np.asarray(mesh.vertices)
    assert min(rest.tilt for rest in resting_poses(points)) > 10.0
    upright = min(resting_poses(points, centre=centre), key=lambda rest: rest.tilt)
    assert upright.tilt < 1e-6
    assert upright.margin == pytest.approx(np.degrees(np.arctan2(0.02 - centre[0], centre[2] + 0.04)), rel=1e-6)
    said = replace(body, inertial=Inertial(mass=1.0, centre=np.array([0.01, 0.0, 0.0])))
    assert _centre(said, 1.0) == pytest.approx([0.01, 0.0, 0.0])
    assert _centre(replace(body, inertial=Inertial(mass=1.0, centre=np.full(3, 9.0))), 1.0) == pytest.approx(centre)


def test_an_open_sheet_has_no_centre_of_mass():
    sheet = trimesh.Trimesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0.01)], [(0, 1, 2), (1, 3, 2)], process=False)
    assert _centre(body_of(sheet, "z"), 1.0) is None
