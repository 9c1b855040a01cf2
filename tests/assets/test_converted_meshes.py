"""COLLADA, 3MF and FBX files as meshes: shape against closed forms, unit and up axis as the file says them."""

import zipfile
from pathlib import Path

import numpy as np
import pytest

from pat3d.assets.mesh.importing import import_mesh
from pat3d.assets.mesh.load import load_mesh
from pat3d.errors import AssetError
from pat3d.importers.scene import import_object

CORNERS = [(x, y, z) for x in (0, 2) for y in (0, 4) for z in (0, 6)]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = [(q[0], q[k], q[k + 1]) for q in QUADS for k in (1, 2)]


def dae(path: Path, *, unit: float = 0.01, up: str = "Z_UP", head: str = "") -> Path:
    """A red box of 2 x 4 x 6 units."""
    points = " ".join(str(value) for corner in CORNERS for value in corner)
    faces = " ".join(str(corner) for face in TRIANGLES for corner in face)
    path.write_text(
        f'<?xml version="1.0"?>{head}<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
        f'<asset><unit name="u" meter="{unit}"/><up_axis>{up}</up_axis></asset>'
        '<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert><diffuse>'
        "<color>0.8 0 0 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>"
        '<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>'
        '<library_geometries><geometry id="g"><mesh><source id="p">'
        f'<float_array id="a" count="24">{points}</float_array><technique_common>'
        '<accessor source="#a" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>'
        '<param name="Z" type="float"/></accessor></technique_common></source>'
        '<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>'
        '<triangles count="12" material="s"><input semantic="VERTEX" source="#v" offset="0"/>'
        f"<p>{faces}</p></triangles></mesh></geometry></library_geometries>"
        '<library_visual_scenes><visual_scene id="w"><node id="n"><instance_geometry url="#g"><bind_material>'
        '<technique_common><instance_material symbol="s" target="#m"/></technique_common></bind_material>'
        '</instance_geometry></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#w"/>'
        "</scene></COLLADA>",
        encoding="utf-8",
    )
    return path


def three_mf(path: Path, *, unit: str = "inch") -> Path:
    """The same box."""
    points = "".join('<vertex x="{}" y="{}" z="{}"/>'.format(*corner) for corner in CORNERS)
    faces = "".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*face) for face in TRIANGLES)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(
            "3D/3dmodel.model",
            f'<model unit="{unit}" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>'
            f'<object id="1" type="model"><mesh><vertices>{points}</vertices><triangles>{faces}</triangles></mesh>'
            '</object></resources><build><item objectid="1"/></build></model>',
        )
    return path


def fbx(path: Path, *, up: int = 1) -> Path:
    """An L of five unit squares' outline, 3 x 3 less 2 x 2, one unit thick, its caps polygons of six corners."""
    outline = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
    points = [(x, y, z) for z in (0, 1) for x, y in outline]
    faces = [[5, 4, 3, 2, 1, 0], [6, 7, 8, 9, 10, 11]]
    faces += [[k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k] for k in range(6)]
    indices = [one for face in faces for one in (*face[:-1], ~face[-1])]
    flat = [value for point in points for value in point]
    front = {1: (2, 1), 2: (1, -1)}[up]
    axes = (("UpAxis", up), ("UpAxisSign", 1), ("FrontAxis", front[0]), ("FrontAxisSign", front[1]))
    axes = (*axes, ("CoordAxis", 0), ("CoordAxisSign", 1))
    settings = "".join(f'P: "{name}", "int", "Integer", "",{value}\n' for name, value in axes)
    path.write_text(
        "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXVersion: 7400\n}\n"
        f'GlobalSettings: {{\nVersion: 1000\nProperties70: {{\n{settings}P: "UnitScaleFactor", "double", "Number", '
        '"",10\n}\n}\nObjects: {\n'
        f'Geometry: 1, "Geometry::L", "Mesh" {{\nVertices: *{len(flat)} {{\na: {",".join(map(str, flat))}\n}}\n'
        f"PolygonVertexIndex: *{len(indices)} {{\na: {','.join(map(str, indices))}\n}}\nGeometryVersion: 124\n}}\n"
        'Model: 2, "Model::L", "Mesh" {\nVersion: 232\n}\n'
        'Material: 3, "Material::red", "" {\nVersion: 102\nShadingModel: "lambert"\nProperties70: {\n'
        'P: "DiffuseColor", "Color", "", "A",0.8,0,0\n}\n}\n}\n'
        'Connections: {\nC: "OO",1,2\nC: "OO",2,0\nC: "OO",3,2\n}\n',
        encoding="utf-8",
    )
    return path


def volume(vertices: np.ndarray, faces: np.ndarray) -> float:
    """By the divergence theorem: negative inside out, wrong where a face overlaps another."""
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    return float(np.einsum("fk,fk->", a, np.cross(b, c))) / 6.0


@pytest.mark.parametrize(("up", "size"), [("Z_UP", (0.02, 0.04, 0.06)), ("Y_UP", (0.02, 0.06, 0.04))])
def test_collada_has_the_unit_and_the_up_axis_that_it_says(tmp_path, up, size):
    pytest.importorskip("collada")
    asset = import_mesh(dae(tmp_path / "box.dae", up=up), parts="box")
    assert np.ptp(asset.visual.vertices, axis=0) == pytest.approx(size)
    assert (asset.visual.texture.reshape(-1, 3) == (204, 0, 0)).all(axis=1).any()


def test_a_description_takes_the_unit_of_collada_and_leaves_its_axes(tmp_path):
    """As RViz and Gazebo read them: a robot description has one frame, whatever axis a mesh says to be up."""
    pytest.importorskip("collada")
    dae(tmp_path / "box.dae", up="Y_UP")
    shape = '<geometry><mesh filename="box.dae"/></geometry>'
    (tmp_path / "box.urdf").write_text(
        f'<robot name="box"><link name="box"><visual>{shape}</visual><collision>{shape}</collision>'
        '<inertial><mass value="0.2"/></inertial></link></robot>'
    )
    asset = import_object(tmp_path / "box.urdf")
    assert np.ptp(asset.visual.vertices, axis=0) == pytest.approx((0.02, 0.04, 0.06))
    assert any("says that y points up" in note for note in asset.provenance["notes"])


def test_3mf_has_the_unit_that_it_says(tmp_path):
    pytest.importorskip("lxml")
    mesh = load_mesh(three_mf(tmp_path / "box.3mf"))
    assert (mesh.metres, mesh.up) == (0.0254, "z")
    assert volume(mesh.vertices, mesh.faces) == pytest.approx(48.0)


@pytest.mark.parametrize(("up", "axis"), [(1, "y"), (2, "z")])
def test_fbx_polygons_that_are_not_convex_keep_their_volume(tmp_path, up, axis):
    """Five squares, one thick; a fan over the caps would cover the notch and overlap itself."""
    pytest.importorskip("ufbx")
    mesh = load_mesh(fbx(tmp_path / "l.fbx", up=up))
    assert (mesh.metres, mesh.up) == (0.1, axis)
    assert volume(mesh.vertices, mesh.faces) == pytest.approx(5.0)
    a, b, c = np.moveaxis(mesh.vertices[mesh.faces], 1, 0)
    # Two caps, and a wall along the outline of 12.
    assert np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2 == pytest.approx(2 * 5.0 + 12.0)
    assert (mesh.texture.reshape(-1, 3) == (204, 0, 0)).all(axis=1).any()


@pytest.mark.slow
def test_what_is_wrong_with_a_file_is_an_error_that_names_it(tmp_path):
    for package in ("collada", "lxml", "ufbx"):
        pytest.importorskip(package)
    entity = '<!DOCTYPE c [<!ENTITY a "aaaa">]>'
    with pytest.raises(AssetError, match=r"entity\.dae.*declares a document type"):
        load_mesh(dae(tmp_path / "entity.dae", head=entity))
    with pytest.raises(AssetError, match='up_axis is "W_UP"'):
        load_mesh(dae(tmp_path / "axis.dae", up="W_UP"))
    with pytest.raises(AssetError, match='its unit is "ell"'):
        load_mesh(three_mf(tmp_path / "ell.3mf", unit="ell"))
    bomb = tmp_path / "bomb.3mf"
    with zipfile.ZipFile(bomb, "w", zipfile.ZIP_DEFLATED) as archive, archive.open("3D/3dmodel.model", "w") as file:
        for _ in range(210):
            file.write(b" " * 1_000_000)
    with pytest.raises(AssetError, match="unpacks to more than 200 MB"):
        load_mesh(bomb)
    for name in ("noise.fbx", "noise.dae", "noise.3mf"):
        (tmp_path / name).write_bytes(b"Kaydara FBX Binary  \x00\x1a\x00" + bytes(range(256)) * 4)
        with pytest.raises(AssetError, match=f"{name}.*cannot be read as"):
            load_mesh(tmp_path / name)


@pytest.mark.slow
def test_objects_that_hold_twice_the_next_one_are_refused(tmp_path):
    """Forty levels of two each would be a trillion boxes."""
    pytest.importorskip("lxml")
    path = tmp_path / "twice.3mf"
    levels = "".join(
        f'<object id="{k}"><components><component objectid="{k - 1}"/><component objectid="{k - 1}"/></components>'
        "</object>"
        for k in range(2, 42)
    )
    three_mf(path)
    with zipfile.ZipFile(path) as archive:
        text = archive.read("3D/3dmodel.model").decode()
    text = text.replace("</resources>", f"{levels}</resources>").replace('item objectid="1"', 'item objectid="41"')
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("3D/3dmodel.model", text)
    with pytest.raises(AssetError, match="places more than 10,000 objects"):
        load_mesh(path)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("3D/3dmodel.model", text.replace('component objectid="1"', 'component objectid="41"', 1))
    with pytest.raises(AssetError, match="holds itself"):
        load_mesh(path)
