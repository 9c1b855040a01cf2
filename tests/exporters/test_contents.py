"""An export says what is written of its scene and nothing else, whatever its checksums say."""

import re
import shutil
import sys
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from benchmarks.attacks import attacks
from pat3d.exporters import export
from pat3d.exporters.contents import compare
from pat3d.exporters.contents.compare import contents
from pat3d.exporters.contents.mujoco_models import model_differences
from pat3d.exporters.contents.values import same_numbers, same_words
from tests.exporters.things import hung_bar, mixed_scene

FORMATS = ("mjcf", "usd", "urdf", "sdf")
ATTACKS = [one for one in attacks() if one.forged]


@pytest.fixture(scope="module")
def scene():
    return mixed_scene()


@pytest.fixture(scope="module")
def written(scene, tmp_path_factory):
    folder = tmp_path_factory.mktemp("exports")
    export(scene, FORMATS, folder)
    return folder


@pytest.fixture
def folder(written, tmp_path):
    shutil.copytree(written, tmp_path / "scene")
    return tmp_path / "scene"


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("make", [mixed_scene, hung_bar])
def test_what_is_written_twice_is_the_same_to_the_bit(make, name, tmp_path):
    path = export(make(), (name,), tmp_path)[name]
    report = contents(make(), path)
    assert report.failures == ()
    assert report.identical


@pytest.mark.parametrize("name", FORMATS)
def test_files_that_are_compared_by_what_they_say_agree_with_themselves(written, name, monkeypatch):
    monkeypatch.setattr(compare.filecmp, "cmp", lambda *_, **__: False)
    assert list(compare._folders(written / name, written / name)) == []


@pytest.mark.parametrize("attack", ATTACKS, ids=lambda one: f"{one.kind}: {one.name}")
def test_every_tampering_is_convicted_by_what_the_export_says(scene, written, folder, attack):
    assert attack.deed(folder) is not False
    report = contents(scene, folder / attack.kind, anew=written / attack.kind)
    assert not report.passed
    assert not report.identical
    assert all(str(folder) in line for line in report.failures)


def test_the_tamperings_of_one_kind_are_told_in_the_words_of_the_file(scene, written, folder):
    path = folder / "mjcf" / "scene.xml"
    tree = ET.parse(path)
    option = tree.getroot().find("option")
    assert option is not None
    option.set("timestep", "0.02")
    option.set("gravity", "0 0 -0.5")
    ET.SubElement(ET.SubElement(tree.getroot(), "equality"), "weld", body1="ball", body2="pencil_co")
    tree.write(path)
    told = "\n".join(contents(scene, path, anew=written / "mjcf").failures)
    assert '<option> has timestep="0.02" instead of "0.002"' in told
    assert '<option> has gravity="0 0 -0.5", which PAT3D does not write' in told
    assert "<equality> is there, which PAT3D does not write" in told


@pytest.mark.parametrize("file", ["mjcf/scene.xml", "urdf/scene.urdf", "sdf/scene.sdf"])
def test_the_layout_of_the_text_is_no_difference(scene, written, folder, file):
    path = folder / file
    tree = ET.parse(path)
    ET.indent(tree, "\t")
    tree.write(path)
    report = contents(scene, path, anew=written / path.parent.name)
    assert report.failures == ()
    assert not report.identical


@pytest.mark.parametrize(
    ("file", "pattern"),
    [
        ("mjcf/scene.xml", r'<body name="red_mug_1" pos="(\S+) '),
        ("mjcf/meshes/red_mug_1/visual.obj", r"v (\S+) "),
        ("urdf/manifest.json", r'"position": \[\s*(0\.1),'),
        ("urdf/scene.dmd.yaml", r"translation: \[(0\.1),"),
        ("sdf/scene.sdf", r'<model name="red_mug_1">\s*<pose rotation_format="quat_xyzw">(\S+) '),
    ],
)
def test_rounding_of_another_computer_is_no_difference_and_a_millionth_is(scene, written, folder, file, pattern):
    path, text = folder / file, (written / file).read_text()
    found = re.search(pattern, text)
    assert found is not None
    for factor, same in ((1 + 1e-13, True), (1 + 1e-6, False)):
        changed = repr(float(found.group(1)) * factor)
        path.write_text(text[: found.start(1)] + changed + text[found.end(1) :])
        kind = file.split("/", 1)[0]
        assert contents(scene, folder / kind, anew=written / kind).passed is same


def test_other_principal_axes_of_the_same_inertia_are_no_difference(scene, written, folder):
    """Columns of the axes permuted with their moments: the tensor stays."""
    path = folder / "mjcf" / "scene.xml"
    tree = ET.parse(path)
    for inertial in tree.iter("inertial"):
        moments = [float(word) for word in inertial.attrib["diaginertia"].split()]
        axes = Rotation.from_quat(np.array(inertial.attrib["quat"].split(), float), scalar_first=True).as_matrix()
        turned = Rotation.from_matrix(axes[:, [1, 2, 0]]).as_quat(scalar_first=True)
        inertial.set("diaginertia", " ".join(repr(moments[k]) for k in (1, 2, 0)))
        inertial.set("quat", " ".join(map(repr, turned.tolist())))
    tree.write(path)
    assert contents(scene, path, anew=written / "mjcf").failures == ()
    inertial = next(tree.iter("inertial"))
    inertial.set("diaginertia", " ".join(reversed(inertial.attrib["diaginertia"].split())))
    tree.write(path)
    assert not contents(scene, path, anew=written / "mjcf").passed


def test_other_principal_axes_in_usd_are_no_difference(scene, written, folder):
    from pxr import Gf, Sdf

    path = folder / "usd" / "assets" / "ball" / "ball.usdc"
    layer = Sdf.Layer.OpenAsAnonymous(str(path))
    moments = layer.GetAttributeAtPath("/ball.physics:diagonalInertia")
    axes = layer.GetAttributeAtPath("/ball.physics:principalAxes")
    assert moments is not None
    x, y, z = moments.default
    quat = axes.default
    matrix = Rotation.from_quat([quat.GetReal(), *quat.GetImaginary()], scalar_first=True).as_matrix()
    w, a, b, c = Rotation.from_matrix(matrix[:, [1, 2, 0]]).as_quat(scalar_first=True).tolist()
    moments.default, axes.default = Gf.Vec3f(y, z, x), Gf.Quatf(w, a, b, c)
    layer.Export(str(path))
    assert contents(scene, folder / "usd", anew=written / "usd").failures == ()
    moments.default = Gf.Vec3f(y, z, 1.01 * x)
    layer.Export(str(path))
    assert not contents(scene, folder / "usd", anew=written / "usd").passed


def test_a_changed_layer_in_a_package_is_found(scene, tmp_path):
    export(scene, ("usd",), tmp_path, package=True)
    assert contents(scene, tmp_path / "usd").failures == ()
    other = export(hung_bar(), ("usd",), tmp_path / "other", package=True)["usd"].parent
    shutil.copyfile(other / "scene.usdz", tmp_path / "usd" / "scene.usdz")
    report = contents(scene, tmp_path / "usd")
    assert any("scene.usdz" in line for line in report.failures)


def test_what_mujoco_compiles_is_compared_where_only_the_layout_differs(written, folder):
    here, there = written / "mjcf" / "scene.xml", folder / "mjcf" / "scene.xml"
    assert list(model_differences(there, here)) == []
    there.write_text(there.read_text().replace('timestep="0.002"', 'timestep="0.004"'))
    assert any("opt.timestep" in line for line in model_differences(there, here))


def test_a_file_that_says_something_unknown_is_not_compiled(scene, written, folder, monkeypatch):
    called = []
    monkeypatch.setattr(compare, "model_differences", lambda *paths: called.append(paths) or iter(()))
    path = folder / "mjcf" / "scene.xml"
    path.write_text(
        path.read_text().replace("</worldbody>", '<replicate count="9999999"><geom/></replicate></worldbody>')
    )
    report = contents(scene, path, anew=written / "mjcf")
    assert report.foreign
    assert called == []


def test_words_and_numbers():
    assert same_words("1 2  3", "1 2 3.0")
    assert same_words("a 1e-3", "a 0.001")
    assert not same_words("1_0", "10")
    assert not same_words("nan", "1")
    assert not same_words("1 2", "1 2 3")
    assert same_numbers([1.0, 1e-14], [1.0, 0.0])
    assert not same_numbers([1.0, 1e-8], [1.0, 0.0])
    assert not same_numbers([float("nan")], [1.0])


def test_comparing_loads_no_usd_for_other_formats(tmp_path):
    import subprocess

    code = (
        "import pat3d.exporters.contents.compare, sys; sys.exit(any(name in sys.modules for name in ('pxr', 'mujoco')))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
