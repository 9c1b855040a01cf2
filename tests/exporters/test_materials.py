"""Normal, roughness, metallic and opacity maps: from a GLB or an OBJ through the scene folder into every format."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
import trimesh
from PIL import Image
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

from pat3d.assets.mesh.importing import import_mesh
from pat3d.exporters import export, parity
from pat3d.geometry.pose import Pose
from pat3d.importers.scene import import_scene
from pat3d.scene.asset import Asset
from pat3d.scene.io import load_scene, save_scene
from pat3d.scene.model import Scene
from tests.scenes import placed, scene_of

SIDE = 16


def pictures() -> dict[str, np.ndarray]:
    """Pictures that no two texels of are alike, so that a flip, a swap of channels or a mean would show."""
    rng = np.random.default_rng(7)
    gray = {name: rng.permutation(SIDE * SIDE).reshape(SIDE, SIDE) for name in ("roughness", "metallic", "opacity")}
    found = {name: value.astype(np.uint8) for name, value in gray.items()}
    return found | {name: rng.integers(0, 256, (SIDE, SIDE, 3), dtype=np.uint8) for name in ("texture", "normal")}


def cube() -> trimesh.Trimesh:
    mesh = trimesh.creation.box((0.1, 0.1, 0.1))
    mesh.unmerge_vertices()
    mesh.apply_translation([0, 0, 0.05])
    return mesh


@pytest.fixture(scope="module")
def glb_asset(tmp_path_factory) -> Asset:
    made, mesh = pictures(), cube()
    blank = np.zeros((SIDE, SIDE), dtype=np.uint8)
    material = PBRMaterial(
        baseColorTexture=Image.fromarray(np.dstack([made["texture"], made["opacity"]])),
        normalTexture=Image.fromarray(made["normal"]),
        metallicRoughnessTexture=Image.fromarray(np.dstack([blank, made["roughness"], made["metallic"]])),
        alphaMode="BLEND",
    )
    uv = np.tile([[0.1, 0.1], [0.9, 0.1], [0.5, 0.9]], (len(mesh.faces), 1))
    mesh.visual = TextureVisuals(uv=uv, material=material)
    path = tmp_path_factory.mktemp("glb") / "cube.glb"
    mesh.export(path)
    return import_mesh(path, parts="hull", mass=0.5)


@pytest.fixture(scope="module")
def scene(glb_asset) -> Scene:
    return scene_of(placed("cube", glb_asset, pose=Pose(position=(0, 0, 1e-5))))


def test_the_maps_of_a_glb_are_its_own_channels(glb_asset):
    made = pictures()
    np.testing.assert_array_equal(glb_asset.visual.texture, made["texture"])
    assert set(glb_asset.visual.maps) == {"normal", "roughness", "metallic", "opacity"}
    for name, image in glb_asset.visual.maps.items():
        np.testing.assert_array_equal(image, made[name], name)


def test_the_maps_of_an_obj_and_its_numbers_are_read(tmp_path):
    made = pictures()
    for name, image in made.items():
        Image.fromarray(image).save(tmp_path / f"{name}.png")
    mesh = cube()
    lines = ["mtllib thing.mtl", "usemtl m", "vt 0.1 0.1", "vt 0.9 0.1", "vt 0.5 0.9"]
    lines += [f"v {x} {y} {z}" for x, y, z in mesh.vertices]
    lines += [f"f {a + 1}/1 {b + 1}/2 {c + 1}/3" for a, b, c in mesh.faces]
    (tmp_path / "thing.obj").write_text("\n".join(lines))
    (tmp_path / "thing.mtl").write_text(
        "newmtl m\nKd 1 1 1\nPr 0.3\nPm 0.9\nmap_Kd texture.png\nnorm normal.png\nmap_Pr roughness.png\n"
        "map_Pm metallic.png\nmap_d opacity.png\n"
    )
    asset = import_mesh(tmp_path / "thing.obj", parts="hull")
    assert (asset.provenance["surface"]["roughness"], asset.provenance["surface"]["metallic"]) == (0.3, 0.9)
    for name, image in asset.visual.maps.items():
        np.testing.assert_array_equal(image, made[name], name)
    assert len(asset.visual.maps) == 4


def test_pieces_of_several_materials_share_maps_that_are_neutral_where_a_piece_has_none(tmp_path):
    """A textured cube beside a plain one: the texture of both has a normal map, flat on the plain one."""
    made, mesh, plain = pictures(), cube(), cube()
    uv = np.tile([[0.1, 0.1], [0.9, 0.1], [0.5, 0.9]], (len(mesh.faces), 1))
    material = PBRMaterial(
        baseColorTexture=Image.fromarray(made["texture"]), normalTexture=Image.fromarray(made["normal"])
    )
    mesh.visual = TextureVisuals(uv=uv, material=material)
    plain.visual = TextureVisuals(uv=uv * 0, material=PBRMaterial(baseColorFactor=[255, 0, 0, 255]))
    plain.apply_translation([0.2, 0, 0])
    trimesh.Scene({"a": mesh, "b": plain}).export(tmp_path / "two.glb")
    visual = import_mesh(tmp_path / "two.glb", parts="box").visual
    height, width = visual.texture.shape[:2]
    assert visual.maps["normal"].shape == (height, width, 3)
    at = visual.uv.mean(axis=1)
    rows, columns = ((1 - at[:, 1]) * height).astype(int), (at[:, 0] * width).astype(int)
    on_plain = visual.vertices[visual.faces].mean(axis=1)[:, 0] > 0
    assert (visual.texture[rows, columns][on_plain] == [255, 0, 0]).all()
    assert (visual.maps["normal"][rows, columns][on_plain] == [128, 128, 255]).all()
    assert (visual.maps["normal"][rows, columns][~on_plain] != [128, 128, 255]).any()


def test_the_scene_folder_keeps_the_maps(scene, tmp_path):
    save_scene(scene, tmp_path)
    found = load_scene(tmp_path)["cube"].asset.visual.maps
    for name, image in scene["cube"].asset.visual.maps.items():
        np.testing.assert_array_equal(found[name], image, name)


def test_mujoco_has_a_layer_for_every_map(scene, tmp_path):
    model = mujoco.MjModel.from_xml_path(str(export(scene, ("mjcf",), tmp_path)["mjcf"]))
    (material,) = [k for k in range(model.nmat) if model.material(k).name == "cube"]
    for role, name in (("RGB", "texture"), ("NORMAL", "normal"), ("ROUGHNESS", "roughness"), ("METALLIC", "metallic")):
        texture = model.mat_texid[material][int(getattr(mujoco.mjtTextureRole, f"mjTEXROLE_{role}"))]
        assert texture >= 0, name
        start = model.tex_adr[texture]
        first = model.tex_data[start : start + 3]
        np.testing.assert_array_equal(first, np.broadcast_to(pictures()[name][0, 0], 3), name)


def test_glb_and_sdf_name_the_maps(scene, tmp_path):
    paths = export(scene, ("glb", "sdf"), tmp_path)
    loaded = trimesh.load_scene(paths["glb"])
    (geometry,) = loaded.geometry.values()
    material = geometry.visual.material
    both = np.asarray(material.metallicRoughnessTexture)
    np.testing.assert_array_equal(both[..., 1], pictures()["roughness"])
    np.testing.assert_array_equal(both[..., 2], pictures()["metallic"])
    np.testing.assert_array_equal(np.asarray(material.normalTexture), pictures()["normal"])
    np.testing.assert_array_equal(np.asarray(material.baseColorTexture)[..., 3], pictures()["opacity"])
    text = paths["sdf"].read_text()
    for tag in ("albedo_map", "normal_map", "roughness_map", "metalness_map"):
        (file,) = {line.split(">")[1].split("<")[0] for line in text.splitlines() if f"<{tag}>" in line}
        assert (paths["sdf"].parent / file).is_file()


@pytest.mark.parametrize("name", ["mjcf", "usd", "urdf", "sdf"])
def test_an_export_comes_back_with_its_maps_and_says_what_it_lacks(scene, tmp_path, name):
    if name == "usd":
        pytest.importorskip("pxr")
    path = export(scene, (name,), tmp_path)[name]
    found = import_scene(path.parent).scene["cube"].asset.visual.maps
    for key, image in scene["cube"].asset.visual.maps.items():
        np.testing.assert_array_equal(found[key], image, f"{name} {key}")
    said = " ".join(parity(scene, path).left_out)
    assert ("maps" in said) == (name in ("mjcf", "urdf", "sdf"))
