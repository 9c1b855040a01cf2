"""Scenes that others write: their shapes, weights, places, and what is refused by name."""

from __future__ import annotations

import numpy as np
import pytest

from pat3d.cli.main import main
from pat3d.errors import AssetError
from pat3d.importers.scene import import_object, import_scene
from pat3d.scene.io import load_scene
from pat3d.scene.obj_files import hull_obj

FLOOR = '<geom name="floor" type="plane" size="2 2 0.1"/>'

ELL = np.array([[0, 0], [0.1, 0], [0.1, 0.03], [0.03, 0.03], [0.03, 0.1], [0, 0.1]])
"""Outline of an L [m], which fills two thirds of its hull."""


def mjcf(folder, bodies: str, more: str = "", floor: str = FLOOR):
    path = folder / "scene.xml"
    path.write_text(f"<mujoco>{more}<worldbody>{floor}{bodies}</worldbody></mujoco>")
    return path


def ell_mesh(folder) -> None:
    """ell.obj, an L 0.04 m high."""
    points = np.concatenate([np.column_stack([ELL, np.full(6, z)]) for z in (0.0, 0.04)])
    caps = [(0, 2, 1), (0, 3, 2), (0, 4, 3), (0, 5, 4)]
    sides = [(k, (k + 1) % 6, 6 + (k + 1) % 6) for k in range(6)] + [(k, 6 + (k + 1) % 6, 6 + k) for k in range(6)]
    faces = np.array([*caps, *(tuple(6 + k for k in reversed(face)) for face in caps), *sides])
    (folder / "ell.obj").write_text(hull_obj(points, faces))


def test_primitives_keep_their_sizes_masses_and_places(tmp_path):
    """Closed forms: a box of 0.2 kg is a box, a cylinder's inertia is m r^2 / 2 about its axis."""
    path = mjcf(
        tmp_path,
        """<body name="block" pos="0 0 0.05" euler="0 0 30"><freejoint/>
             <geom type="box" size="0.03 0.04 0.05" mass="0.2" friction="0.7"/></body>
           <body name="can" pos="0.3 0 0.06"><freejoint/><geom type="cylinder" size="0.033 0.06" mass="0.35"/></body>
           <body name="shelf" pos="-0.5 0 0.1"><geom type="box" size="0.1 0.1 0.1"/></body>""",
    )
    scene = import_scene(path).scene
    block, can, shelf = scene["block"], scene["can"], scene["shelf"]
    assert (block.fixed, can.fixed, shelf.fixed) == (False, False, True)
    (part,) = block.parts
    assert part.box is not None
    assert part.box[1] == pytest.approx((0.03, 0.04, 0.05))
    # The frame is at the base, as that of every asset; the block is where it was.
    assert block.pose.position == pytest.approx((0, 0, 0))
    assert block.pose.apply(np.array([[0.03, 0.04, 0.1]]))[0] == pytest.approx(
        (0.03 * np.sqrt(0.75) - 0.02, 0.015 + 0.04 * np.sqrt(0.75), 0.1)
    )
    assert block.asset.material.friction == 0.7
    assert block.asset.mass_properties.inertia[2][2] == pytest.approx(0.2 * (0.06**2 + 0.08**2) / 12)
    assert can.asset.mass_properties.inertia[2][2] == pytest.approx(0.35 * 0.033**2 / 2)
    # Few flat sides stand for the round one: around it, by at most a hundredth of its size.
    assert (can.asset.size - [0.066, 0.066, 0.12]).max() < 1.2e-3
    assert (can.asset.size - [0.066, 0.066, 0.12]).min() > -1e-9


def test_a_ground_elsewhere_becomes_z_0(tmp_path):
    path = mjcf(
        tmp_path,
        '<body name="box" pos="0 0 1.05"><freejoint/><geom type="box" size="0.05 0.05 0.05"/></body>',
        floor='<geom name="floor" type="box" size="2 2 0.5" pos="0 0 0.5"/>',
    )
    read = import_scene(path)
    assert read.lifted == -1.0
    assert [obj.name for obj in read.scene.objects] == ["box"]
    assert read.scene["box"].pose.position[2] == pytest.approx(0.0)


def test_what_is_not_convex_is_cut_and_what_is_stays(tmp_path):
    ell_mesh(tmp_path)
    path = mjcf(
        tmp_path,
        '<body name="corner"><freejoint/><geom type="mesh" mesh="ell"/><geom type="box" size="0.01 0.01 0.02" '
        'pos="0.015 0.015 0.06"/></body>',
        '<asset><mesh name="ell" file="ell.obj"/></asset>',
    )
    read = import_scene(path, cache_dir=tmp_path / "cache")
    assert (read.kept, read.cut) == (1, 1)
    corner = read.scene["corner"]
    assert len(corner.parts) >= 3
    # The notch of the L stays open: its middle is in no part.
    notch = corner.pose.apply(np.zeros((1, 3)))[0]  # the frame's origin in the world
    point = np.array([0.07, 0.07, 0.02]) - notch
    for part in corner.parts:
        normals = np.cross(
            part.vertices[part.faces[:, 1]] - part.vertices[part.faces[:, 0]],
            part.vertices[part.faces[:, 2]] - part.vertices[part.faces[:, 0]],
        )
        assert (np.einsum("fi,fi->f", normals, point - part.vertices[part.faces[:, 0]]) > 0).any()


def test_a_robot_is_refused_by_its_joints_and_may_stand_still_or_be_left_out(tmp_path):
    elbow = '<joint name="elbow" type="hinge"/>'
    arm = f'<body name="arm" pos="0 0.5 0.2">{elbow}<geom type="box" size="0.1 0.1 0.1"/></body>'
    path = mjcf(tmp_path, f'{arm}<body name="cube"><freejoint/><geom type="box" size="0.02 0.02 0.02"/></body>')
    with pytest.raises(AssetError, match=r'"arm" by elbow.*--joints fix'):
        import_scene(path)
    assert import_scene(path, joints="fix").scene["arm"].fixed
    left = import_scene(path, joints="leave-out")
    assert (left.left_out, [obj.name for obj in left.scene.objects]) == (("arm",), ["cube"])


def test_a_body_without_a_name_has_that_of_the_mesh_that_no_other_has(tmp_path):
    corners = "0 0 0  0.1 0 0  0 0.1 0  0 0 0.1"
    meshes = "".join(f'<mesh name="{name}" vertex="{corners}"/>' for name in ("mug", "brick", "tray"))
    body = '<body pos="{} 0 0.1"><freejoint/><geom type="mesh" mesh="{}"/></body>'
    bodies = "".join(body.format(x, mesh) for x, mesh in enumerate(("mug", "brick", "brick", "tray")))
    named = '<body name="tray" pos="9 0 0.1"><freejoint/><geom type="box" size="0.02 0.02 0.02"/></body>'
    path = tmp_path / "scene.xml"
    path.write_text(f"<mujoco><asset>{meshes}</asset><worldbody>{bodies}{named}</worldbody></mujoco>")
    assert [obj.name for obj in import_scene(path).scene.objects] == ["mug", "body 2", "body 3", "body 4", "tray"]


def test_sdf_frames_links_joints_and_includes(tmp_path):
    (tmp_path / "brick").mkdir()
    box = "<geometry><box><size>0.2 0.1 0.06</size></box></geometry>"
    mu = "<surface><friction><ode><mu>0.3</mu></ode></friction></surface>"
    (tmp_path / "brick" / "model.sdf").write_text(
        f"""<sdf version="1.9"><model name="brick"><link name="l"><pose>0 0 0.03 0 0 0</pose>
        <inertial><mass>2</mass></inertial><visual name="v">{box}</visual>
        <collision name="c">{box}{mu}</collision></link></model></sdf>"""
    )
    world = tmp_path / "world.sdf"
    plane = "<geometry><plane><normal>0 0 1</normal></plane></geometry>"

    def written(more: str):
        world.write_text(
            f"""<sdf version="1.9"><world name="w"><model name="floor"><static>true</static><link name="l">
            <collision name="c">{plane}</collision></link></model>
            <include><uri>model://brick</uri><name>red brick</name><pose>1 0 0 0 0 1.5707963267948966</pose></include>
            {more}</world></sdf>"""
        )
        return world

    (brick,) = import_scene(written("")).scene.objects
    assert (brick.name, brick.fixed, brick.asset.material.friction) == ("red brick", False, 0.3)
    assert brick.asset.mass_properties.mass == 2.0
    corner = brick.pose.apply(np.array([[0.1, 0.05, 0.06]]))[0]
    assert corner == pytest.approx((0.95, 0.1, 0.06))
    links = "".join(f'<link name="{name}"><collision name="c">{box}</collision></link>' for name in "ab")
    joint = '<joint name="{0}" type="{0}"><parent>a</parent><child>b</child></joint>'
    two = f'<model name="two">{links}{{}}</model>'
    glued = import_scene(written(two.format(joint.format("fixed")))).scene
    assert len(glued["two"].parts) == 2
    with pytest.raises(AssetError, match='"two/a" by revolute'):
        import_scene(written(two.format(joint.format("revolute"))))
    post = '<model name="post"><link name="a"><collision name="c">{}</collision></link>{}</model>'
    to_world = '<joint name="{0}" type="{0}"><parent>world</parent><child>a</child></joint>'
    assert import_scene(written(post.format(box, to_world.format("fixed")))).scene["post"].fixed
    with pytest.raises(AssetError, match='"post" by ball'):
        import_scene(written(post.format(box, to_world.format("ball"))))


def test_urdf_links_that_float_are_objects_and_doors_are_refused(tmp_path):
    shape = '<collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>'

    def written(kind: str):
        path = tmp_path / "scene.urdf"
        path.write_text(
            f"""<robot name="scene"><link name="world"/><link name="table">{shape}</link><link name="box">{shape}</link>
            <joint name="a" type="fixed"><parent link="world"/><child link="table"/><origin xyz="0 0 0.05"/></joint>
            <joint name="b" type="{kind}"><parent link="world"/><child link="box"/><origin xyz="0 0 0.15"/></joint>
            </robot>"""
        )
        return path

    scene = import_scene(written("floating")).scene
    assert (scene["table"].fixed, scene["box"].fixed) == (True, False)
    assert scene["box"].pose.position == pytest.approx((0, 0, 0.1))
    with pytest.raises(AssetError, match='"box" by b'):
        import_scene(written("revolute"))


def test_usd_units_and_axes_are_the_stage_s(tmp_path):
    """A box of 10 by 20 by 40 cm, 20 cm up, on a stage in centimetres with y up, in grams."""
    pytest.importorskip("pxr")
    path = tmp_path / "scene.usda"
    path.write_text(
        """#usda 1.0
(
  metersPerUnit = 0.01
  upAxis = "Y"
  kilogramsPerUnit = 0.001
  defaultPrim = "World"
)
def Xform "World" {
  def Xform "box" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]) {
    float physics:mass = 500
    point3f physics:centerOfMass = (0, 0, 0)
    float3 physics:diagonalInertia = (83333.333, 70833.333, 20833.333)
    double3 xformOp:translate = (5, 20, 30)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def Cube "shape" (prepend apiSchemas = ["PhysicsCollisionAPI"]) {
      double size = 1
      float3 xformOp:scale = (10, 20, 40)
      uniform token[] xformOpOrder = ["xformOp:scale"]
    }
  }
}
"""
    )
    (box,) = import_scene(path).scene.objects
    assert box.asset.mass_properties.mass == pytest.approx(0.5)
    # m (a^2 + b^2) / 12 of the sides across each axis; the stage's z is our -y.
    moments = 0.5 / 12 * np.array([0.2**2 + 0.4**2, 0.1**2 + 0.2**2, 0.1**2 + 0.4**2])
    np.testing.assert_allclose(box.asset.mass_properties.inertia, np.diag(moments), rtol=1e-6, atol=1e-12)
    corners = box.pose.apply(np.concatenate([part.vertices for part in box.parts]))
    # x stays, the stage's y is up, its z points towards the viewer, who stands at -y.
    assert corners.min(axis=0) == pytest.approx((0.0, -0.5, 0.1))
    assert corners.max(axis=0) == pytest.approx((0.1, -0.1, 0.3))


def test_files_outside_the_folder_are_not_read(tmp_path):
    inner = tmp_path / "a" / "b" / "c"
    inner.mkdir(parents=True)
    ell_mesh(tmp_path)
    path = inner / "thing.urdf"
    path.write_text(
        '<robot name="x"><link name="l"><visual><geometry><mesh filename="../../../ell.obj"/></geometry></visual>'
        '<collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link></robot>'
    )
    with pytest.raises(AssetError, match="outside"):
        import_scene(path)
    assert len(import_scene(path, root=tmp_path).scene.objects) == 1


def test_one_object_is_asked_for_by_name_where_there_are_several(tmp_path):
    body = '<body name="{}" pos="{} 0 0"><freejoint/><geom type="box" size="0.02 0.02 0.02"/></body>'
    with pytest.raises(AssetError, match="2 objects"):
        import_object(mjcf(tmp_path, body.format("a", 0) + body.format("b", 1)))
    assert import_object(mjcf(tmp_path, body.format("red mug", 0))).material.name == "ceramic"


def test_the_command_writes_a_folder_and_refuses_one_of_ours(tmp_path, capsys):
    path = mjcf(
        tmp_path, '<body name="cube" pos="0 0 0.02"><freejoint/><geom type="box" size="0.02 0.02 0.02"/></body>'
    )
    assert main(["import", str(path), "--out", str(tmp_path / "made")]) == 0
    assert "1 collision shapes as they are" in capsys.readouterr().out
    scene = load_scene(tmp_path / "made")
    assert [obj.name for obj in scene.objects] == ["cube"]
    assert main(["import", str(tmp_path / "made"), "--out", str(tmp_path / "again")]) == 2
    assert "PAT3D scene folder already" in capsys.readouterr().err


@pytest.mark.slow
def test_what_floats_and_overlaps_settles_and_is_verified(tmp_path, capsys):
    """The block that floats falls by its 50 mm; the one that overlaps the table by 10 mm is lifted out of it."""
    body = '<body name="{}" pos="{} 0 {}"><freejoint/><geom type="box" size="0.03 0.03 0.03" density="500"/></body>'
    table = '<body name="table" pos="0 0 0.2"><geom type="box" size="0.3 0.3 0.2"/></body>'
    path = mjcf(tmp_path, table + body.format("floats", 0.1, 0.48) + body.format("sinks", -0.1, 0.42))
    assert main(["import", str(path), "--settle", "--out", str(tmp_path / "made")]) == 0
    scene = load_scene(tmp_path / "made")
    for name in ("floats", "sinks"):
        assert scene[name].pose.position[2] == pytest.approx(0.4, abs=2e-5)
        assert scene.parent(name) == "table"


@pytest.mark.slow
def test_an_open_shell_is_cut_as_a_whole_and_closed_lumps_one_by_one(tmp_path):
    """A collision mesh of two boxes is two parts; a box without its lid, whose sides share no corner, stays open."""
    boxes = [np.array([[x, y, z] for x in (a, a + 0.04) for y in (0, 0.04) for z in (0, 0.04)]) for a in (0.0, 0.1)]
    faces = np.array(
        [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
         [1, 5, 7], [1, 7, 3]]
    )  # fmt: skip
    (tmp_path / "two.obj").write_text(hull_obj(np.concatenate(boxes), np.concatenate([faces, faces + 8])))
    (tmp_path / "scene.urdf").write_text(
        '<robot name="pair"><link name="l"><collision><geometry><mesh filename="two.obj"/></geometry></collision>'
        "</link></robot>"
    )
    read = import_scene(tmp_path / "scene.urdf")
    assert (read.kept, read.cut) == (2, 0)
    assert all(part.box is not None for part in read.scene["pair"].parts)
    apart = boxes[0][faces[:10]].reshape(-1, 3)
    (tmp_path / "two.obj").write_text(hull_obj(apart, np.arange(30, dtype=np.int32).reshape(10, 3)))
    tub = import_scene(tmp_path / "scene.urdf", cache_dir=tmp_path / "cache")
    assert tub.cut == 1
    inside = np.array([0.02, 0.02, 0.03]) - tub.scene["pair"].pose.position
    assert not any(
        (np.all(inside > part.bounds[0]) and np.all(inside < part.bounds[1])) for part in tub.scene["pair"].parts
    )
