"""Scenes that are not ours are judged by what is so by construction, and settle where they must."""

from __future__ import annotations

import json
from dataclasses import replace

import mujoco
import numpy as np
import pytest

from pat3d.check.foreign.load import load_foreign
from pat3d.check.foreign.settling import settle_foreign, write_settled
from pat3d.check.foreign.verify import verify_foreign
from pat3d.cli.main import main
from pat3d.errors import CheckError
from pat3d.exporters import export
from pat3d.exporters.common.objects import body_names
from tests.exporters.things import hung_bar, mixed_scene
from tests.scenes import tower

TABLE = """<geom name="floor" type="plane" size="2 2 0.1"/>
<body name="table" pos="0 0 0.2"><geom type="box" size="0.3 0.3 0.2"/></body>"""


def block(name: str, x: float, z: float, half: str = "0.03 0.03 0.03") -> str:
    return f'<body name="{name}" pos="{x} 0 {z}"><freejoint/><geom type="box" size="{half}" density="500"/></body>'


def written(folder, *bodies: str, more: str = "") -> str:
    path = folder / "scene.xml"
    path.write_text(f"<mujoco><worldbody>{TABLE}{''.join(bodies)}</worldbody>{more}</mujoco>")
    return str(path)


def test_blocks_that_rest_float_and_overlap_are_told_apart(tmp_path):
    path = written(
        tmp_path,
        block("rests", 0.0, 0.43),
        block("floats", 0.15, 0.48),
        block("sinks", -0.15, 0.42),
    )
    report = verify_foreign(load_foreign(path))
    found = {one.name: one for one in report.objects}
    assert found["rests"].unbalanced < 1e-6
    assert found["rests"].moved_mm < 1.0
    assert found["floats"].unbalanced == pytest.approx(1.0)
    # It falls by 50 mm, and for a moment a little further into MuJoCo's soft contacts.
    assert 49.5 < found["floats"].moved_mm < 60.0
    overlap = report.overlaps[0]
    assert len([line for line in report.failures if "overlap" in line]) == 1
    assert {overlap.first, overlap.second} == {"sinks", "the world"}
    assert overlap.depth_mm == pytest.approx(10.0, abs=0.1)
    assert found["sinks"].moved_mm > 5.0
    assert not report.passed
    assert found["rests"].mass == pytest.approx(500 * 0.06**3)


@pytest.mark.parametrize(("reach", "balanced"), [(0.025, True), (0.035, False)])
def test_a_block_over_the_edge_is_balanced_until_its_centre_passes_it(tmp_path, reach, balanced):
    """The table ends at x = 0.3; nothing is simulated for the answer."""
    path = written(tmp_path, block("block", 0.3 - 0.03 + reach, 0.43))
    (one,) = verify_foreign(load_foreign(path), seconds=0.01).objects
    assert (one.unbalanced < 0.01) == balanced


def test_a_block_on_a_slope_needs_friction(tmp_path):
    """30 degrees ask for 0.577."""
    for friction, balanced in ((0.6, True), (0.55, False)):
        (tmp_path / "slope.xml").write_text(
            f'''<mujoco><worldbody><body euler="0 30 0"><geom type="box" size="1 1 0.1" friction="{friction}"/>
            </body><body euler="0 30 0" pos="{0.13 * 0.5} 0 {0.13 * np.sqrt(0.75)}"><freejoint/>
            <geom type="box" size="0.05 0.05 0.03" friction="{friction}"/></body></worldbody></mujoco>'''
        )
        (one,) = verify_foreign(load_foreign(tmp_path / "slope.xml"), seconds=0.01).objects
        assert (one.unbalanced < 0.01) == balanced


def test_mechanisms_are_held_and_what_hangs_on_constraints_is_not_judged(tmp_path):
    joint = '<joint type="hinge" axis="0 1 0"/>'
    arm = f'<body name="arm" pos="0 0.2 1">{joint}<geom type="box" size="0.3 0.02 0.02"/></body>'
    weld = '<equality><weld body1="hung" body2="table"/></equality>'
    path = written(tmp_path, arm, block("hung", 0.0, 0.8), block("rests", 0.0, 0.43), more=weld)
    report = verify_foreign(load_foreign(path))
    assert report.held == 1
    assert {one.name: one.unbalanced < 0.01 for one in report.objects} == {"hung": True, "rests": True}
    assert report.passed, report.failures


def test_markers_of_goals_are_left_out_and_told(tmp_path):
    ghost = '<body name="goal" pos="0 0 1"><freejoint/><geom size="0.02" contype="0" conaffinity="0"/></body>'
    report = verify_foreign(load_foreign(written(tmp_path, ghost, block("rests", 0.0, 0.43))))
    assert [one.name for one in report.objects] == ["rests"]
    assert report.passed
    assert "goal" in report.notes[0]


def test_a_keyframe_is_another_scene(tmp_path):
    key = '<keyframe><key name="up" qpos="0 0 0.6 1 0 0 0"/></keyframe>'
    scene = load_foreign(written(tmp_path, block("block", 0.0, 0.43), more=key))
    assert verify_foreign(scene).passed
    assert verify_foreign(scene, keyframe="up").objects[0].unbalanced == pytest.approx(1.0)
    with pytest.raises(CheckError, match="Known: up"):
        verify_foreign(scene, keyframe="down")


def test_what_overlaps_and_floats_is_settled_nearby_and_stays(tmp_path):
    path = written(tmp_path, block("a", 0.0, 0.42), block("b", 0.0, 0.47), block("c", 0.15, 0.45))
    scene = load_foreign(path)
    assert not verify_foreign(scene).passed
    settled = settle_foreign(scene)
    assert settled.at_rest
    assert settled.moved_mm["a"] < 12.0
    assert settled.moved_mm["b"] < 22.0
    assert settled.moved_mm["c"] == pytest.approx(20.0, abs=2.0)
    again = verify_foreign(load_foreign(write_settled(load_foreign(path), settled, tmp_path / "settled.xml")))
    assert max(one.moved_mm for one in again.objects) < 1.0
    assert all(one.unbalanced < 0.01 for one in again.objects)
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "settled.xml"))
    assert np.allclose(model.key("settled").qpos, model.qpos0)


def test_our_own_scenes_pass_in_mjcf(tmp_path):
    paths = export(tower(3), ("mjcf",), tmp_path)
    report = verify_foreign(load_foreign(paths["mjcf"]))
    assert report.passed, report.failures
    assert len(report.objects) == 3


def test_the_command_tells_and_writes(tmp_path, capsys):
    path = written(tmp_path, block("floats", 0.0, 0.48))
    assert main(["verify", path, "--report", str(tmp_path / "r.json")]) == 1
    said = capsys.readouterr().out
    assert "floats" in said
    assert json.loads((tmp_path / "r.json").read_text())["objects"][0]["unbalanced"] == pytest.approx(1.0)
    out = tmp_path / "settled.xml"
    assert main(["verify", path, "--settle", str(out)]) == 0
    assert out.is_file()
    assert main(["verify", path, "--settle", str(tmp_path / "x.usd")]) == 2


@pytest.mark.parametrize(
    "text", ["", "<mujoco><worldbody><body", "<mujoco><asset><mesh file='x.obj'/></asset></mujoco>"]
)
def test_files_that_are_none_are_one_line(tmp_path, text):
    path = tmp_path / "broken.xml"
    path.write_text(text)
    with pytest.raises(CheckError) as error:
        load_foreign(path).compile()
    assert "\n" not in str(error.value)
    with pytest.raises(CheckError, match="no known scene format"):
        load_foreign(tmp_path / "scene.blend")


@pytest.mark.parametrize("kind", ["sdf", "usd"])
def test_our_own_scenes_weigh_and_stand_the_same_in_other_formats(tmp_path, kind):
    """Read from SDF and USD, a scene has the masses, inertias and poses that MuJoCo reads from its MJCF."""
    if kind == "usd":
        pytest.importorskip("pxr")
    scene = mixed_scene()
    paths = export(scene, ("mjcf", kind), tmp_path)
    there, here = (load_foreign(paths[name]).compile() for name in ("mjcf", kind))
    for obj in scene.objects:
        name = body_names(scene)[obj.name]
        one, other = there.body(name), here.body(f"World/{name}" if kind == "usd" else name)
        assert np.allclose(one.pos, other.pos, atol=1e-9)
        assert np.allclose(np.abs(one.quat @ other.quat), 1.0, atol=1e-9)
        if not obj.fixed:
            assert one.mass[0] == pytest.approx(other.mass[0], rel=1e-6)
            assert np.allclose(np.sort(one.inertia), np.sort(other.inertia), rtol=1e-5)


@pytest.mark.parametrize("kind", ["sdf", "usd"])
def test_a_tower_is_at_rest_in_other_formats_and_not_after_a_lift(tmp_path, kind):
    if kind == "usd":
        pytest.importorskip("pxr")
    paths = export(tower(2), (kind,), tmp_path)
    report = verify_foreign(load_foreign(paths[kind]))
    assert len(report.objects) == 2
    assert all(one.unbalanced < 0.01 for one in report.objects), report.failures
    assert not report.overlaps


@pytest.mark.parametrize("loose", [False, True])
def test_what_hangs_in_sdf_is_taken_as_fixed_with_what_it_hangs_from(tmp_path, loose):
    scene = hung_bar()
    if loose:
        scene = replace(scene, objects=tuple(replace(obj, fixed=False) for obj in scene.objects))
    read = load_foreign(export(scene, ("sdf",), tmp_path)["sdf"])
    model = read.compile()
    assert model.njnt == 0
    assert np.allclose(model.body("a_bar").pos, scene["a bar"].pose.position, atol=1e-9)
    assert any('"a_bar" has joints' in note for note in read.notes)


def test_sdf_primitives_includes_and_angles(tmp_path):
    model = tmp_path / "can"
    model.mkdir()
    (model / "model.sdf").write_text(
        """<sdf version="1.6"><model name="can"><link name="l"><inertial><mass>0.3</mass><inertia><ixx>1e-4</ixx>
        <iyy>2e-4</iyy><izz>2.5e-4</izz></inertia></inertial><collision name="c"><geometry><cylinder><radius>0.03
        </radius><length>0.1</length></cylinder></geometry></collision></link></model></sdf>"""
    )
    world = tmp_path / "w.sdf"
    world.write_text(
        """<sdf version="1.6"><world name="w"><model name="floor"><static>true</static><link name="l"><collision
        name="c"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link></model><include><uri>
        model://can</uri><name>lying</name><pose>0.2 0 0.03 1.5707963267948966 0 0</pose></include><include>
        <uri>model://can</uri><name>standing</name><pose>0 0 0.05 0 0 0</pose></include></world></sdf>"""
    )
    report = verify_foreign(load_foreign(world))
    assert {one.name: round(one.mass, 6) for one in report.objects} == {"lying": 0.3, "standing": 0.3}
    assert all(one.unbalanced < 0.01 for one in report.objects), report.failures
    assert {one.name: one.moved for one in report.objects}["standing"] is False
