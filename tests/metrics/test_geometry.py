"""D and R of the paper's Table 1, against closed forms and an exact count."""

import itertools
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import trimesh

from pat3d.assets.shapes import box, ellipsoid
from pat3d.check.metrics.displacement import D_HAT, displacement
from pat3d.check.metrics.interpenetration import EDGE, interpenetration, penetrating_pairs
from pat3d.check.metrics.remeshing import can_remesh, remeshed
from pat3d.check.metrics.subject import load_subject, scaled, subject_of
from pat3d.check.metrics.table import measure
from pat3d.errors import AssetError, SpecError
from pat3d.exporters.glb.writer import write_glb
from pat3d.geometry.pose import Pose
from tests.scenes import GAP, asset_of, placed, scene_of

CUBE = asset_of(box(0.1, 0.1, 0.1))


def exactly(a, b):
    """Pairs of triangles of which an edge of one passes through the other, in rational arithmetic."""

    def six_volumes(p, q, r, s):
        u, v, w = ([x - y for x, y in zip(point, p, strict=True)] for point in (q, r, s))
        return (
            u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0])
        )

    def pierces(p, q, t):
        if six_volumes(*t, p) * six_volumes(*t, q) >= 0:
            return False
        sides = [six_volumes(p, q, t[k], t[(k + 1) % 3]) for k in range(3)]
        return all(side > 0 for side in sides) or all(side < 0 for side in sides)

    def through(t, other):
        return any(pierces(t[k], t[(k + 1) % 3], other) for k in range(3))

    ta, tb = ([[list(map(Fraction, p)) for p in t] for t in v[f]] for v, f in (a, b))
    return sum(through(t, other) or through(other, t) for t, other in itertools.product(ta, tb))


def two_cubes(height, x=0.03, y=0.02):
    return subject_of(scene_of(placed("low", CUBE, (0, 0, GAP)), placed("high", CUBE, (x, y, height))))


@pytest.mark.parametrize("seed", range(4))
def test_pairs_of_triangles_are_those_of_an_exact_count(seed):
    rng = np.random.default_rng(seed)
    ball, cube = trimesh.creation.icosphere(1), trimesh.creation.box()
    cube.apply_transform(trimesh.transformations.random_rotation_matrix(rng.random(3)))
    cube.apply_translation(rng.uniform(0.3, 0.9, 3))
    a, b = ((np.array(mesh.vertices), np.array(mesh.faces, dtype=np.int32)) for mesh in (ball, cube))
    assert penetrating_pairs(a, b) == exactly(a, b) > 0


def test_overlapping_cubes_have_the_r_of_an_exact_count():
    """R = pairs times the mean edge, (4 sides + 2 diagonals) / 6 of a cube's halved faces, over the diagonal."""
    subject = two_cubes(0.08)
    low, high = ((body.vertices, body.visual.faces) for body in subject.bodies)
    found = interpenetration(subject)
    mean_edge = 0.1 * (4 + 2 * np.sqrt(2)) / 6
    assert found.pairs == exactly(low, high) > 0
    assert found.value == pytest.approx(found.pairs * mean_edge / np.sqrt(0.13**2 + 0.12**2 + (0.18 - GAP) ** 2))
    assert found.objects == (("low", "high", found.pairs),)


def test_r_is_0_where_nothing_overlaps_and_does_not_see_what_is_swallowed():
    assert interpenetration(two_cubes(0.1 + 2 * GAP)).value == 0.0
    inside = scene_of(placed("crate", CUBE), placed("pea", asset_of(ellipsoid(0.01)), (0, 0, 0.05)))
    assert interpenetration(subject_of(inside)).pairs == 0


@pytest.mark.parametrize("factor", [0.1, 7.0])
def test_r_does_not_depend_on_the_size_of_the_scene(factor):
    subject = two_cubes(0.08)
    small, large = interpenetration(subject), interpenetration(scaled(subject, factor))
    assert large.pairs == small.pairs
    assert large.value == pytest.approx(small.value, rel=1e-9)


def test_d_of_a_falling_block_is_the_height_it_falls_over_the_diagonal():
    """One block and a fixed one beside it, half of the vertices move: D = 1/2 h / l."""
    height = 0.05
    subject = subject_of(
        scene_of(placed("falls", CUBE, (0, 0, height)), placed("stays", CUBE, (0.3, 0, 1e-4), fixed=True))
    )
    found = displacement(subject)
    assert (found.engine, found.at_rest) == ("PAT3D", True)
    assert found.value == pytest.approx(0.5 * height / subject.diagonal, abs=2 * D_HAT)


@pytest.mark.parametrize("factor", [0.2, 5.0])
def test_d_does_not_depend_on_the_size_of_the_scene(factor):
    subject = subject_of(scene_of(placed("falls", CUBE, (0, 0, 0.05))))
    assert displacement(scaled(subject, factor)).value == pytest.approx(displacement(subject).value, rel=1e-3)


def test_d_of_a_scene_at_rest_is_0():
    diagonal = np.sqrt(0.1**2 + 0.1**2 + 0.2**2)
    gap = 0.6 * D_HAT * diagonal
    subject = subject_of(scene_of(placed("low", CUBE, (0, 0, gap)), placed("high", CUBE, (0, 0, 0.1 + 2 * gap))))
    found = displacement(subject)
    assert found.at_rest
    assert found.value < D_HAT


def test_what_rests_on_a_slope_does_not_creep_for_300_frames():
    """On 8 degrees, less than the 11.3 at which a friction of 0.2 gives way."""
    half = np.radians(8.0) / 2
    slope = Pose(position=(0, 0, 0.05), quat_wxyz=(np.cos(half), np.sin(half), 0, 0))
    above = Pose(position=tuple(slope.apply(np.array([[0, 0, 0.1 + 2e-6]]))[0]), quat_wxyz=slope.quat_wxyz)
    scene = scene_of(placed("slope", CUBE, pose=slope, fixed=True), placed("on", CUBE, pose=above))
    found = displacement(subject_of(scene))
    assert (found.engine, found.at_rest) == ("PAT3D", True)
    assert found.frames < 20
    assert found.value < 3 * D_HAT


def test_what_intersects_is_simulated_by_mujoco_which_says_so():
    found = displacement(two_cubes(0.09))
    assert found.engine == "MuJoCo"
    assert '"low" and "high"' in found.why or '"high" and "low"' in found.why
    assert found.value > 1e-3


def test_mujoco_measures_the_same_fall():
    """A block that falls beside one that is fixed and one a tenth of a millimetre in the ground: D = h / (3 l)."""
    subject = subject_of(
        scene_of(
            placed("falls", CUBE, (0, 0, 0.02)),
            placed("one", CUBE, (0.3, 0, 1e-4), fixed=True),
            placed("sunk", CUBE, (0.6, 0, -1e-4)),
        )
    )
    found = displacement(subject)
    assert found.engine == "MuJoCo"
    assert found.value == pytest.approx(0.02 / (3 * subject.diagonal), rel=0.05)


def test_a_glb_gives_the_same_as_the_scene_it_was_written_from(tmp_path):
    yaw = Pose.from_yaw(0.3, (0.0, 0.0, 0.05))
    scene = scene_of(placed("falls", CUBE, pose=yaw), placed("low", CUBE, (0.3, 0.05, 0.001)))
    ours, theirs = subject_of(scene), load_subject(write_glb(scene, tmp_path / "glb"))
    assert [body.name for body in theirs.bodies] == ["falls", "low"]
    lift = min(body.vertices[:, 2].min() for body in theirs.bodies) - 0.001
    for body, other in zip(ours.bodies, theirs.bodies, strict=True):
        there = body.vertices + (0.0, 0.0, lift)
        nearest = np.linalg.norm(there[:, None] - other.vertices, axis=2).min(axis=1)
        np.testing.assert_allclose(nearest, 0.0, atol=1e-6)
    assert [len(body.vertices) for body in theirs.bodies] == [8, 8]
    assert all(body.convex for body in theirs.bodies)
    # Its lowest vertex is put on the ground, so a millimetre of the fall is missing.
    fall = 0.5 * (0.05 - 0.001) / ours.diagonal
    assert displacement(theirs).value == pytest.approx(fall, rel=0.01)
    assert interpenetration(theirs).value == 0.0


def test_a_folder_of_meshes_is_a_scene(tmp_path):
    for name, z in (("low", 0.0), ("high", 0.09)):
        mesh = trimesh.creation.box((0.1, 0.1, 0.1))
        mesh.apply_translation((0.03 if z else 0.0, 0.02 if z else 0.0, z))
        mesh.export(tmp_path / f"{name}.stl")
    subject = load_subject(tmp_path)
    assert [body.name for body in subject.bodies] == ["high", "low"]
    assert interpenetration(subject).pairs > 0
    assert min(body.vertices[:, 2].min() for body in subject.bodies) == pytest.approx(1e-5 * subject.diagonal)


def test_what_is_no_scene_is_refused(tmp_path):
    with pytest.raises(SpecError, match="holds no meshes"):
        load_subject(tmp_path)
    (tmp_path / "x.glb").write_bytes(b"glTF nonsense")
    with pytest.raises(AssetError, match="cannot be read as GLB"):
        load_subject(tmp_path / "x.glb")
    with pytest.raises(SpecError, match="no GLB"):
        load_subject(tmp_path / "scene.blend")


def test_r_by_ftetwild_is_absent_or_right():
    found = measure(two_cubes(0.05))
    if not can_remesh():
        assert found.remeshed is None
        assert "pat3d[metrics]" in found.absent
        return
    assert found.remeshed is not None
    assert found.remeshed.value == pytest.approx(EDGE * found.remeshed.pairs)
    assert found.remeshed.pairs > found.delivered.pairs


def test_ftetwild_keeps_surfaces_and_their_edge_length_and_leaves_no_file(tmp_path, monkeypatch):
    pytest.importorskip("pytetwild")
    monkeypatch.chdir(tmp_path)
    subject = replace(two_cubes(0.2), bodies=two_cubes(0.2).bodies[:1])
    ((vertices, faces),) = remeshed(subject)
    solid = trimesh.Trimesh(vertices, faces)
    assert solid.is_watertight
    assert solid.volume == pytest.approx(1e-3, rel=5e-3)
    assert 0.5 < solid.edges_unique_length.mean() / (EDGE * subject.diagonal) < 1.5
    assert not list(tmp_path.iterdir())
