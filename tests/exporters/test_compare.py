"""Parity convicts files in which one number was changed, and acquits those that were not."""

import json
import math
import re
import shutil
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from pat3d.assets.shapes import box
from pat3d.errors import ExportError
from pat3d.exporters import export, parity
from pat3d.exporters.common.readback import BodyReadback
from pat3d.exporters.compare import QUANTITIES
from pat3d.exporters.compare import _errors as errors_of
from pat3d.geometry.pose import Pose
from pat3d.scene.model import Scene
from tests.exporters.things import mixed_scene
from tests.scenes import asset_of, placed

FORMATS = ("mjcf", "urdf", "sdf")


@pytest.fixture(scope="module")
def scene():
    return mixed_scene()


@pytest.fixture(scope="module")
def written(scene, tmp_path_factory):
    return export(scene, FORMATS, tmp_path_factory.mktemp("exports"))


@pytest.mark.parametrize("name", FORMATS)
def test_what_was_written_is_the_scene(scene, written, name):
    report = parity(scene, written[name])
    assert report.passed, report.failures
    assert report.format == name
    worst = report.as_dict()["worst"]
    assert set(worst) == set(QUANTITIES)
    assert all(error is not None and error < 1e-6 for error in worst.values())


def _scaled(text: str, pattern: str, factor: float) -> str:
    """`text` with the number that the group of `pattern` first matches, scaled."""
    found = re.search(pattern, text, re.DOTALL)
    assert found is not None
    return text[: found.start(1)] + repr(float(found.group(1)) * factor) + text[found.end(1) :]


MUG = "objects/red_mug_1/red_mug_1.urdf"
PENCIL = "objects/pencil_co/pencil_co.urdf"
PLANTED = [
    ("mjcf", "scene.xml", r'<body name="red_mug_1".*?mass="(\S+)"', "weighs"),
    ("mjcf", "scene.xml", r'<body name="red_mug_1" pos="(\S+) ', "stands elsewhere"),
    ("mjcf", "scene.xml", r'<body name="pencil_co".*?diaginertia="(\S+) ', "inertia"),
    ("mjcf", "scene.xml", r'<body name="red_mug_2".*?<inertial pos="\S+ \S+ (\S+)"', "centre of mass"),
    ("mjcf", "scene.xml", r'name="red_mug_2_part_000" friction="(\S+) ', "friction"),
    ("mjcf", "meshes/red_mug_1/part_000.obj", r"v (\S+) ", "convex parts"),
    ("urdf", MUG, r'<mass value="(\S+)"', "weighs"),
    ("urdf", PENCIL, r'izz="(\S+)"', "inertia"),
    ("urdf", PENCIL, r'<origin xyz="\S+ \S+ \S+" rpy="\S+ (\S+) ', "inertia"),
    ("urdf", MUG, r'<origin xyz="\S+ \S+ (\S+)"', "centre of mass"),
    ("urdf", MUG, r'<lateral_friction value="(\S+)"', "friction"),
    ("urdf", MUG, r'<drake:mu_dynamic value="(\S+)"', "friction"),
    ("urdf", "objects/wooden_table/part_000.obj", r"v (\S+) ", "convex parts"),
    ("sdf", "scene.sdf", r'<model name="wooden_table".*?<collision.*?<size>(\S+) ', "convex parts"),
    ("urdf", "objects/ball/part_000.obj", r"v (\S+) ", "convex parts"),
    ("urdf", "manifest.json", r'"position": \[\s*(0\.1),', "stands elsewhere"),
    ("urdf", "scene.dmd.yaml", r"translation: \[(0\.1),", "stands elsewhere"),
    (
        "urdf",
        "scene.dmd.yaml",
        r"pencil_co:\s+translation: \S+ \S+ \S+\s+rotation: !AngleAxis {angle_deg: (\S+),",
        "stands elsewhere",
    ),
    ("sdf", "scene.sdf", r'<model name="red_mug_1".*?<mass>(\S+)</mass>', "weighs"),
    ("sdf", "scene.sdf", r'<model name="red_mug_1">\s*<pose rotation_format="quat_xyzw">(\S+) ', "stands elsewhere"),
    ("sdf", "scene.sdf", r'<model name="pencil_co".*?<iyy>(\S+)</iyy>', "inertia"),
    ("sdf", "scene.sdf", r'<model name="red_mug_2".*?<mu>(\S+)</mu>', "friction"),
    ("sdf", "models/red_mug_1/meshes/part_000.obj", r"v (\S+) ", "convex parts"),
]


@pytest.mark.parametrize(("name", "file", "pattern", "words"), PLANTED)
def test_one_number_off_by_a_hundred_thousandth_is_found(scene, written, tmp_path, name, file, pattern, words):
    shutil.copytree(written[name].parent, tmp_path / name)
    path = tmp_path / name / file
    # The ball's first corner lies 4 mm from its axis, and a hundred-thousandth of that is within the tolerance.
    path.write_text(_scaled(path.read_text(), pattern, 1 + (1e-4 if "ball" in file else 1e-5)))
    report = parity(scene, tmp_path / name / written[name].name)
    assert not report.passed
    assert any(words in line for line in report.failures), report.failures


@pytest.mark.parametrize(
    ("name", "file", "pattern", "place"),
    [
        ("mjcf", "scene.xml", r'name="wooden_table_part_000"[^>]* pos="([^"]*)"', "0 0 0.0201"),
        ("mjcf", "scene.xml", r'name="ball_part_000"[^>]*( )mesh=', ' pos="0 0 0.0001" '),
        ("urdf", MUG, r'<collision.*?<origin xyz="([^"]*)"', "0 0.0001 0"),
        ("urdf", MUG, r'<collision.*?<origin xyz="0 0 0" rpy="([^"]*)"', "0.01 0 0"),
        ("sdf", "scene.sdf", r'<model name="wooden_table".*?<collision.*?<pose[^>]*>([^<]*)<', "0 0 0.0201 0 0 0 1"),
    ],
)
def test_a_collider_that_was_moved_in_its_body_is_found(scene, written, tmp_path, name, file, pattern, place):
    shutil.copytree(written[name].parent, tmp_path / name)
    path = tmp_path / name / file
    text = path.read_text()
    found = re.search(pattern, text, re.DOTALL)
    assert found is not None
    path.write_text(text[: found.start(1)] + place + text[found.end(1) :])
    failures = parity(scene, tmp_path / name / written[name].name).failures
    assert any("the convex parts" in line for line in failures), failures


@pytest.mark.parametrize(
    ("name", "file", "before", "after", "words"),
    [
        ("mjcf", "scene.xml", '<freejoint name="ball" />', "", "MuJoCo 3"),
        ("urdf", "manifest.json", '"fixed": true', '"fixed": false', "is fixed in the scene but free"),
        ("sdf", "scene.sdf", 'model name="ball"', 'model name="bell"', "is missing"),
        ("sdf", "scene.sdf", 'model name="ball"', 'model name="bell"', '"bell"'),
        ("sdf", "scene.sdf", "<sdf ", "<sdf", "not well-formed"),
        ("mjcf", "scene.xml", "<worldbody>", "<worldbody><geom/>", "refuses"),
        ("urdf", MUG, "part_000.obj", "../../../../passwd.obj", "no file inside"),
        ("urdf", MUG, "part_000.obj", "nothing.obj", "cannot be read"),
        ("urdf", "manifest.json", '"version": 1', '"version": 2', "manifest of version"),
        ("urdf", "scene.dmd.yaml", "!AngleAxis", "!!python/object/apply:os.system", "not valid YAML"),
    ],
)
def test_faults_of_structure_are_told(scene, written, tmp_path, name, file, before, after, words):
    shutil.copytree(written[name].parent, tmp_path / name)
    path = tmp_path / name / file
    text = path.read_text()
    assert before in text
    path.write_text(text.replace(before, after, 1))
    failures = parity(scene, tmp_path / name / written[name].name).failures
    assert any(words in line for line in failures), failures


def test_a_path_without_an_export_is_an_error_that_lists_what_is_looked_for(scene, tmp_path):
    with pytest.raises(ExportError, match=r"scene\.xml.*manifest\.json"):
        parity(scene, tmp_path)


def test_the_report_is_json(scene, written):
    for path in written.values():
        json.dumps(parity(scene, path).as_dict(), allow_nan=False)


LONG = placed("plank", asset_of(box(0.1, 0.2, 0.4)), (1.0, 2.0, 3.0))
CORNERS = LONG.asset.parts[0].vertices


def _as_read(**changed) -> BodyReadback:
    properties = LONG.asset.mass_properties
    read = BodyReadback(
        name="plank",
        mass=properties.mass,
        centre=np.array(properties.centre_of_mass),
        inertia=np.array(properties.inertia),
        friction=LONG.asset.material.friction,
        hulls=(CORNERS,),
        pose=LONG.pose,
        fixed=False,
    )
    return replace(read, **changed)


def _wrong(silent: Iterable[str] = (), **changed: Any) -> dict[str, Any]:
    """The errors of a reading with these values in place of the plank's own."""
    found = errors_of(LONG, _as_read(**changed), frozenset(silent))
    return {name: getattr(found, name) for name in QUANTITIES}


@pytest.mark.parametrize(
    ("changed", "quantity", "expected"),
    [
        ({"mass": 1.03 * LONG.asset.mass_properties.mass}, "mass", 0.03),
        ({"friction": 0.9 * LONG.asset.material.friction}, "friction", 0.1),
        # Twice or half as large about its middle: 200 mm more, or 100 less, where the longest side has 400.
        ({"hulls": (2.0 * CORNERS - CORNERS.mean(axis=0),)}, "hulls", 0.5),
        ({"hulls": (0.5 * CORNERS + 0.5 * CORNERS.mean(axis=0),)}, "hulls", 0.25),
        # 4 mm along y, where the longest side has 400.
        ({"hulls": (CORNERS + (0.0, 0.004, 0.0),)}, "hulls", 0.01),
        ({"hulls": (CORNERS, CORNERS)}, "hulls", math.inf),
        ({"hulls": ()}, "hulls", math.inf),
        # 3 mm along x and 4 mm along y are 5 mm, and the longest side has 400.
        (
            {"centre": np.array(LONG.asset.mass_properties.centre_of_mass) + (0.003, 0.004, 0.0)},
            "centre",
            0.005 / 0.4,
        ),
        ({"pose": replace(LONG.pose, position=(1.0, 2.003, 2.996))}, "position", 0.005),
        ({"pose": Pose.from_yaw(0.3, LONG.pose.position)}, "rotation", 0.3),
        ({"pose": Pose.from_yaw(-2.8, LONG.pose.position)}, "rotation", 2.8),
    ],
)
def test_the_error_of_each_quantity_is_in_the_unit_it_is_said_to_be_in_and_of_no_other(changed, quantity, expected):
    found = _wrong(**changed)
    assert found.pop(quantity) == pytest.approx(expected, rel=1e-9)
    assert all(error == pytest.approx(0.0, abs=1e-12) for error in found.values())
    if quantity not in ("position", "rotation"):
        assert _wrong({quantity}, **changed)[quantity] is None


def test_single_precision_is_no_difference_of_a_thin_part():
    """Half a millimetre of 400: rounding of 1e-8 m would be 5e-5 of its volume."""
    thin = placed("sheet", asset_of(box(0.4, 0.3, 0.0005)), (0.0, 0.0, 0.0))
    rounded = thin.asset.parts[0].vertices.astype(np.float32).astype(np.float64)
    read = replace(_as_read(), name="sheet", hulls=(rounded,))
    assert errors_of(thin, read, frozenset()).hulls == pytest.approx(0.0, abs=1e-7)


def test_a_collider_that_spans_no_volume_is_neither_equal_nor_passed_over():
    """NaN must not be lost among the errors of the other parts."""
    flat = CORNERS * (1.0, 1.0, 0.0)
    assert math.isnan(_wrong(hulls=(flat,))["hulls"])
    assert math.isnan(_wrong(hulls=(np.full((4, 3), np.nan),))["hulls"])
    assert _wrong(hulls=(np.empty((0, 3)),))["hulls"] == math.inf


def test_the_error_of_inertia_is_the_larger_of_the_tensor_s_and_of_its_moments():
    """A turned tensor has the same moments; a wrong smallest moment hardly shows in the whole."""
    inertia = np.array(LONG.asset.mass_properties.inertia)
    moments = np.diag(inertia)
    turn = Rotation.from_euler("z", 90, degrees=True).as_matrix()
    # A quarter of a turn about z swaps the first two.
    swapped = math.sqrt(2.0) * abs(moments[0] - moments[1]) / np.linalg.norm(moments)
    assert _wrong(inertia=turn @ inertia @ turn.T)["inertia"] == pytest.approx(swapped)
    smallest = int(moments.argmin())
    thicker = inertia.copy()
    thicker[smallest, smallest] *= 1.01
    assert _wrong(inertia=thicker)["inertia"] == pytest.approx(0.01)
    assert math.isnan(_wrong(inertia=np.full((3, 3), np.nan))["inertia"])


def test_a_face_without_a_normal_convicts_the_export_in_every_format(tmp_path):
    """A face of 1e-11 mm^2 makes Drake refuse a whole scene; the readers at hand do not notice it."""
    whole = asset_of(box(0.1, 0.1, 0.1))
    points = np.vstack([whole.parts[0].vertices, [[0.0, -0.05 - 1e-9, 1e-9]]])
    hull = ConvexHull(points)
    faces = hull.simplices.astype(np.int32)
    normals = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    inward = np.einsum("fi,fi->f", normals, hull.equations[:, :3]) < 0
    faces[inward] = faces[inward][:, ::-1]
    bad = replace(whole.parts[0], vertices=points, faces=faces, box=None)
    scene = Scene(objects=(placed("drill", replace(whole, parts=(bad,)), (0, 0, 0.1)),))
    for path in export(scene, FORMATS, tmp_path).values():
        report = parity(scene, path)
        assert not report.passed
        assert any("convex part 0 has a face" in line for line in report.failures), report.failures
