"""Scenes from specifications: one that works, and everything that a person may get wrong."""

import json
import os

import jsonschema
import numpy as np
import pytest
import trimesh

import pat3d
from pat3d.check.wear import WEAR
from pat3d.cli.main import main
from pat3d.generation.optimize_stage import given_poses
from pat3d.generation.spec_schema import BUILD_SCHEMA
from pat3d.scene.yaml_source import read_yaml

GOOD = """\
seed: 3
friction: 0.25
objects:
  - name: shelf
    noun: bookshelf
    fixed: true
  - name: can
    mesh: meshes/can.obj
    units: cm
    up: y
    parts: hull
    mass: 0.4
    friction: 0.6
  - name: mug
    noun: mug
    colour: green
    size: 0.1
    density: 1500
  - name: parcel
    noun: box
    scale: 0.5
    pose: {position: [0.9, 0, 0.01], yaw_degrees: 30}
relations:
  - {child: can, kind: on, parent: shelf}
  - {child: mug, kind: on, parent: shelf}
  - {child: mug, kind: right_of, parent: can}
"""


@pytest.fixture
def workplace(tmp_path):
    """A folder with a can, 6 cm wide and 10 cm high, lying in a file whose y is up."""
    (tmp_path / "meshes").mkdir()
    can = trimesh.creation.cylinder(radius=3.0, height=10.0, sections=24)
    can.apply_transform(trimesh.transformations.rotation_matrix(-np.pi / 2, [1, 0, 0]))
    can.export(tmp_path / "meshes" / "can.obj")
    return tmp_path


def test_a_specification_becomes_a_verified_scene(workplace):
    (workplace / "scene.yaml").write_text(GOOD)
    assert main(["build", str(workplace / "scene.yaml"), "--out", str(workplace / "out")]) == 0
    scene = pat3d.load_scene(workplace / "out")
    assert (scene.seed, scene.settling_friction, scene.prompt) == (3, 0.25, "")
    # An optimisation leaves alone where the user put something.
    assert given_poses(scene) == {"parcel"}
    can, mug, shelf, parcel = (scene[name] for name in ("can", "mug", "shelf", "parcel"))
    np.testing.assert_allclose(can.asset.size, [0.06, 0.06, 0.1], rtol=2e-2)
    assert can.asset.mass_properties.mass == pytest.approx(0.4)
    assert can.asset.material.friction == 0.6
    assert max(mug.asset.size) == pytest.approx(0.1)
    properties = mug.asset.mass_properties
    assert properties.mass == pytest.approx(1500 * properties.volume)
    assert shelf.fixed
    assert shelf.pose == shelf.initial_pose
    assert shelf.pose.position[2] == pytest.approx(0.0, abs=1e-4)
    # It drops a centimetre and keeps its turn.
    np.testing.assert_allclose(parcel.pose.position, [0.9, 0, 0], atol=1e-3)
    assert 2 * np.degrees(np.arccos(parcel.pose.quat_wxyz[0])) == pytest.approx(30, abs=0.1)
    report = json.loads((workplace / "out" / "report.json").read_text())
    assert report["passed"]
    assert report["verification"]["relations"]["held"] == 3
    assert str(workplace) not in (workplace / "out" / "scene.json").read_text()


def test_the_published_schema_is_valid_and_accepts_the_example(workplace, capsys):
    assert main(["build", "--schema"]) == 0
    schema = json.loads(capsys.readouterr().out)
    jsonschema.Draft202012Validator.check_schema(schema)
    assert schema == BUILD_SCHEMA
    (workplace / "scene.yaml").write_text(GOOD)
    jsonschema.validate(read_yaml(workplace / "scene.yaml").document, schema)


def one(**changes):
    """A specification of one can with `changes`."""
    return json.dumps({"objects": [{"name": "can", "mesh": "meshes/can.obj", "units": "cm", **changes}]}, indent=1)


def two(relations, **changes):
    objects = [{"name": "a", "noun": "box"}, {"name": "b", "noun": "box", **changes}]
    return json.dumps({"objects": objects, "relations": relations})


def tie(child, kind, parent):
    return {"child": child, "kind": kind, "parent": parent}


BAD = {
    "a wrong key": ("objects:\n  - name: mug\n    noun: mug\n    colr: red\n", (":4:5:", "objects[0].colr", "colour")),
    "a wrong key at the top": ("object: []\n", (":1:1:", "object", "Nearest: objects")),
    "no objects": ("objects: []\n", (":1:1: objects:",)),
    "not a mapping": ("- a\n- b\n", ("object",)),
    "a missing name": ("objects:\n  - noun: mug\n", (":2:5:", '"name" is missing')),
    "a noun and a mesh": (one(noun="mug"), ("either a noun", "objects[0]")),
    "neither noun nor mesh": ("objects:\n  - name: a\n", ("either a noun",)),
    "an unknown noun": ("objects:\n  - {name: a, noun: mugg}\n", (":2:15:", "mug")),
    "a missing file": (one(mesh="meshes/cam.obj"), ("objects[0].mesh", "meshes/cam.obj")),
    "a folder as a mesh": (one(mesh="meshes"), ("objects[0].mesh",)),
    "a repeated name": ("objects:\n  - {name: a, noun: mug}\n  - {name: a, noun: mug}\n", ("objects[1].name",)),
    "the ground's name": ("objects:\n  - {name: ground, noun: mug}\n", ("objects[0].name",)),
    "mass and density": (one(mass=1, density=2), ("objects[0].density", "not both")),
    "a negative mass": (one(mass=-1), ("objects[0].mass",)),
    "a mesh's key for a noun": ("objects:\n  - {name: a, noun: mug, units: cm}\n", ("objects[0].units", "meshes")),
    "an unknown unit": (one(units="km"), ("objects[0].units", "Valid: m, cm, mm, in")),
    "a side of zero": (one(size=[0, None, None]), ("objects[0]",)),
    "an unknown material": (one(material="unobtainium"), ("objects[0].mesh", "unobtainium")),
    "an unknown colour": ("objects:\n  - {name: a, noun: mug, colour: octarine}\n", ("objects[0]", "octarine")),
    "two rotations": (
        one(pose={"position": [0, 0, 0], "yaw_degrees": 1, "quat_wxyz": [1, 0, 0, 0]}),
        ("objects[0].pose.quat_wxyz", "not both"),
    ),
    "a quaternion of norm 2": (one(pose={"position": [0, 0, 0], "quat_wxyz": [2, 0, 0, 0]}), ("objects[0].pose",)),
    "a pose without position": (one(pose={"yaw_degrees": 1}), ("objects[0].pose", "position")),
    "an unknown relation": (two([tie("b", "under", "a")]), ("relations[0].kind", "next_to")),
    "an unknown parent": (two([tie("b", "on", "c")]), ("relations[0].parent", '"c"')),
    "a cycle": (two([tie("b", "on", "a"), tie("a", "on", "b")]), ("relations[1]", "cycle", "a -> b -> a")),
    "two supports": (two([tie("b", "on", "a"), tie("b", "in", "a")]), ("relations[1]", "two supports")),
    "beside what carries it": (
        two([tie("b", "on", "a"), tie("a", "left_of", "b")]),
        ("relations[1]", "a left_of b", '"a" carries "b"'),
    ),
    "two on each other's left": (
        two([tie("b", "left_of", "a"), tie("b", "right_of", "a")]),
        ("relations[1]", "b right_of a", "other side"),
    ),
    "a mass that sinks": (one(mass=1e9), ("objects[0].mass", "1e+09 kg", "1e-05 to 100000 kg")),
    "a density of nothing": (one(density=1e-9), ("objects[0].density", "kg")),
    "itself as a support": (two([tie("a", "on", "a")]), ("relations[0]", "itself")),
    "poses that intersect": (
        two([], pose={"position": [0, 0, 0]}).replace('"a", ', '"a", "pose": {"position": [0, 0, 0]}, '),
        ('"a"', '"b"', "intersect"),
    ),
    "an object larger than its container": (
        "objects:\n  - {name: bin, noun: mug}\n  - {name: melon, noun: watermelon}\n"
        "relations:\n  - {child: melon, kind: in, parent: bin}\n",
        ('"melon"', '"bin"', "fit"),
    ),
    "no YAML": ("objects: [", ("not valid YAML",)),
}


@pytest.mark.parametrize("case", BAD)
def test_a_mistake_is_one_line_that_names_the_place_and_nothing_is_written(workplace, capfd, case):
    text, words = BAD[case]
    refused(workplace, capfd, text, words)


def refused(workplace, capfd, text, words):
    (workplace / "scene.yaml").write_text(text)
    before = sorted(os.listdir(workplace))
    code = main(["build", str(workplace / "scene.yaml"), "--out", str(workplace / "out")])
    lines = [line for line in capfd.readouterr().err.splitlines() if line.startswith("pat3d:")]
    assert code == 2
    assert len(lines) == 1
    assert all(word in lines[0] for word in words), lines[0]
    assert sorted(os.listdir(workplace)) == before


@pytest.mark.parametrize(("extra", "attempts"), [("", 1), ("  - {name: cup, noun: cup}\n", 3)])
def test_a_scene_that_cannot_hold_is_delivered_with_its_faults_and_exit_code_1(workplace, capfd, extra, attempts):
    """The upper box starts with its centre off the lower one; another layout is tried where one is possible."""
    (workplace / "scene.yaml").write_text(
        "objects:\n"
        "  - {name: low, noun: cube, size: 0.1, pose: {position: [0, 0, 0.001]}}\n"
        "  - {name: high, noun: cube, size: 0.1, pose: {position: [0.08, 0, 0.103]}}\n"
        f"{extra}relations:\n  - {{child: high, kind: on, parent: low}}\n"
    )
    assert main(["build", str(workplace / "scene.yaml"), "--out", str(workplace / "out")]) == 1
    assert "pat3d: broken: high on low" in capfd.readouterr().err
    report = json.loads((workplace / "out" / "report.json").read_text())
    assert not report["passed"]
    assert any("high on low" in line for line in report["failures"])
    assert len(report["attempts"]) == len({attempt["layout_seed"] for attempt in report["attempts"]}) == attempts
    assert (workplace / "out" / "preview.png").is_file()


def test_a_side_that_was_asked_for_and_is_not_there_fails_build_and_check(workplace, capfd):
    """Where the user put them, the cup is on the right."""
    (workplace / "scene.yaml").write_text(
        "objects:\n"
        "  - {name: cup, noun: cup, pose: {position: [0.5, 0, 0.001]}}\n"
        "  - {name: box, noun: box, pose: {position: [0, 0, 0.001]}}\n"
        "relations:\n  - {child: cup, kind: left_of, parent: box}\n"
    )
    assert main(["build", str(workplace / "scene.yaml"), "--out", str(workplace / "out")]) == 1
    assert "pat3d: not met: cup left_of box (centre -500 mm to that side" in capfd.readouterr().err
    assert not json.loads((workplace / "out" / "report.json").read_text())["passed"]
    assert main(["check", str(workplace / "out")]) == 1
    assert "pat3d: not met: cup left_of box" in capfd.readouterr().err


@pytest.mark.slow
def test_playing_cards_lie_on_one_another(workplace):
    trimesh.creation.box((0.0635, 0.0889, 0.0003)).export(workplace / "meshes" / "card.obj")
    cards = "".join(f"  - {{name: card {k}, mesh: meshes/card.obj, parts: hull, material: paper}}\n" for k in range(3))
    on = "".join(f"  - {{child: card {k}, kind: on, parent: card {k - 1}}}\n" for k in (1, 2))
    (workplace / "scene.yaml").write_text(f"objects:\n{cards}relations:\n{on}")
    assert main(["build", str(workplace / "scene.yaml"), "--out", str(workplace / "out")]) == 0
    heights = [pat3d.load_scene(workplace / "out")[f"card {k}"].pose.position[2] for k in range(3)]
    assert np.all(np.diff(heights) > 2.9e-4)


def test_what_balances_on_a_tip_is_not_verified_and_the_message_says_how_little_it_stands(workplace, capfd):
    """The part's tip has a radius of 0.1 mm, the middle of the orange is 35 mm over it: it tips at 0.17 degrees.

    The claim allows for engines, which sink in at edges, so that a quarter of so small a tip is left; and the tip that
    is seen is a point, of which what is within a tenth of a millimetre may carry.
    """
    (workplace / "scene.yaml").write_text(
        "objects:\n"
        "  - {name: cone, noun: cone, fixed: true, pose: {position: [0, 0, 0.00001]}}\n"
        "  - {name: orange, noun: orange, pose: {position: [0, 0, 0.0685]}}\n"
        "relations:\n  - {child: orange, kind: on, parent: cone}\n"
    )
    assert main(["build", str(workplace / "scene.yaml"), "--out", str(workplace / "out")]) == 1
    streams = capfd.readouterr()
    certificate = json.loads((workplace / "out" / "report.json").read_text())["verification"]["certificate"]
    assert not certificate["passed"]
    assert certificate["worst"] < 1e-6
    tip = np.degrees(np.arctan(0.1005**2 / (0.1005 + 1e3 * WEAR) / 34.52))
    claimed = certificate["largest_tilt"]
    assert 0.3 * tip <= claimed <= tip
    assert f"stands a tilt of {claimed:.2g} degrees, then orange goes" in " ".join(streams.out.split())
    assert f'"orange" balances on too little: more than {claimed:.2f} degrees of tilt upset it.' in streams.err
    assert certificate["first_to_go"] == ["orange"]


def _nan(path):
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 nan 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 1 3 4\n")


def _zero_area(path):
    path.write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")


def _ten_million(path):
    """A binary STL whose header says ten million triangles, the right size and full of holes on disk."""
    with path.open("wb") as file:
        file.write(b"\0" * 80 + np.uint32(10_000_000).tobytes())
        file.truncate(84 + 50 * 10_000_000)


@pytest.mark.parametrize(
    ("make", "name", "words"),
    [
        (_nan, "nan.obj", ("not finite",)),
        (_zero_area, "flat.obj", ("flat.obj",)),
        (_ten_million, "huge.stl", ("10,000,000 triangles",)),
        (lambda path: path.write_text("hello"), "text.obj", ("text.obj",)),
        (lambda path: path.write_bytes(b""), "empty.ply", ("empty",)),
        (lambda path: path.write_text("x"), "scene.blend", ("scene.blend", "obj")),
    ],
)
def test_a_bad_mesh_is_one_line_that_names_the_object_and_the_file(workplace, capfd, make, name, words):
    make(workplace / "meshes" / name)
    text = f"objects:\n  - name: thing\n    mesh: meshes/{name}\n"
    refused(workplace, capfd, text, (":3:5:", "objects[0].mesh", '"thing"', *words))


def test_a_missing_specification_is_one_line(tmp_path, capfd):
    assert main(["build", str(tmp_path / "none.yaml"), "--out", str(tmp_path / "out")]) == 2
    assert "none.yaml" in capfd.readouterr().err
    assert main(["build"]) == 2
    assert list(tmp_path.iterdir()) == []


def test_one_mesh_of_several_objects_is_imported_and_stored_once_in_every_format(workplace, capfd):
    can = "  - {{name: {}, mesh: meshes/can.obj, units: cm, scale: {}, up: y, parts: hull, "
    can += "pose: {{position: [{}, 0, 0.001]}}}}"
    cans = [can.format(*one) for one in (("can 0", 1, 0), ("can 1", 1, 0.1), ("can 2", 1, 0.2), ("half", 0.5, 0.3))]
    (workplace / "scene.yaml").write_text("\n".join(["seed: 3", "objects:", *cans, ""]))
    out = workplace / "out"
    formats = "mjcf,usd,urdf,sdf"
    assert main(["build", str(workplace / "scene.yaml"), "--out", str(out), "--formats", formats]) == 0
    scene = pat3d.load_scene(out)
    assert scene["can 0"].asset is scene["can 2"].asset
    assert scene["half"].asset is not scene["can 0"].asset
    assert len(list((out / "assets").iterdir())) == 2
    for name in ("mjcf/meshes", "usd/assets", "urdf/objects", "sdf/models"):
        assert len([path for path in (out / name).iterdir() if path.is_dir()]) == 2, name
    capfd.readouterr()
    assert main(["check", str(out)]) == 0
