"""Mesh files to assets: formats and limits, frames and units, repair, mass, looks, parts."""

import json
import struct

import manifold3d
import numpy as np
import pytest
import trimesh
from PIL import Image

from pat3d.assets.mesh import importing
from pat3d.assets.mesh import load as mesh_load
from pat3d.assets.mesh.cover import outside, surface_points
from pat3d.assets.mesh.decompose import Decomposition
from pat3d.assets.mesh.importing import import_mesh
from pat3d.assets.mesh.repair import repair
from pat3d.assets.mesh.topology import signed_volume
from pat3d.assets.shapes import prism
from pat3d.errors import AssetError


@pytest.fixture
def write(tmp_path):
    """Write a trimesh to a file and return its path."""

    def save(mesh, name):
        path = tmp_path / name
        path.write_bytes(data if isinstance(data := mesh.export(file_type=path.suffix[1:]), bytes) else data.encode())
        return path

    return save


def _box(x=0.3, y=0.2, z=0.1):
    """A box with a corner at the origin."""
    mesh = trimesh.creation.box((x, y, z))
    mesh.apply_translation((x / 2, y / 2, z / 2))
    return mesh


def _picture(image):
    return trimesh.visual.material.PBRMaterial(baseColorTexture=image)


def _edges_closed(faces):
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return bool((np.unique(edges, axis=0, return_counts=True)[1] == 2).all())


@pytest.mark.parametrize("suffix", ["obj", "stl", "ply", "off", "glb"])
def test_every_format_gives_the_same_box_standing_on_its_base(write, suffix):
    asset = import_mesh(write(_box(), f"crate.{suffix}"), parts="hull", up="z", density=500)
    assert asset.noun == "crate"
    assert asset.bounds == pytest.approx(np.array([[-0.15, -0.1, 0.0], [0.15, 0.1, 0.1]]), abs=1e-7)
    assert asset.visual.bounds == pytest.approx(asset.bounds, abs=1e-7)
    assert len(asset.parts) == 1
    properties = asset.mass_properties
    assert properties.mass == pytest.approx(500 * 0.006, rel=1e-6)
    assert properties.centre_of_mass == pytest.approx((0, 0, 0.05), abs=1e-7)
    assert np.diag(properties.inertia) == pytest.approx(3 * np.array([0.05, 0.1, 0.13]) / 12, rel=1e-5)
    assert asset.provenance["volume_source"] == "closed surface"
    assert asset.provenance["watertight"]
    json.dumps(dict(asset.provenance))


def test_gltf_is_y_up_and_its_front_faces_the_viewer(write):
    mesh = trimesh.util.concatenate([_box(0.3, 0.5, 0.1), trimesh.creation.box((0.02, 0.02, 0.02))])
    mesh.vertices[8:] += (0.15, 0.4, 0.11)  # A nose on the +z side, glTF's front.
    asset = import_mesh(write(mesh, "radio.glb"), parts="box")
    assert asset.size[2] == pytest.approx(0.5)
    nose = asset.visual.vertices[np.argmin(asset.visual.vertices[:, 1])]
    assert nose[2] == pytest.approx(0.4, abs=0.011)


@pytest.mark.parametrize(("up", "height"), [("z", 0.1), ("-z", 0.1), ("y", 0.2), ("-y", 0.2), ("x", 0.3), ("-x", 0.3)])
def test_up_axis_turns_the_mesh_without_mirroring_it(write, up, height):
    asset = import_mesh(write(_box(), "box.stl"), up=up, parts="box")
    assert asset.size[2] == pytest.approx(height)
    assert signed_volume(asset.visual.vertices, asset.visual.faces) == pytest.approx(0.006)
    assert asset.provenance["repairs"] == []


def test_units_scale_and_target_sizes(write):
    path = write(_box(30, 20, 10), "box.stl")
    assert import_mesh(path, units="cm", parts="box").size == pytest.approx([0.3, 0.2, 0.1])
    assert import_mesh(path, units="in", scale=2, parts="box").size == pytest.approx([1.524, 1.016, 0.508])
    assert import_mesh(path, size=0.6, parts="box").size == pytest.approx([0.6, 0.4, 0.2])
    assert import_mesh(path, size=(None, None, 0.05), parts="box").size == pytest.approx([0.15, 0.1, 0.05])
    assert import_mesh(path, size=(0.1, 0.1, 0.1), parts="box").size == pytest.approx([0.1, 0.1, 0.1])
    with pytest.raises(AssetError, match=r'implausible in metres. units="cm" would make it 0.3 m'):
        import_mesh(path)
    with pytest.raises(AssetError, match="implausible"):
        import_mesh(write(_box(3e-4, 2e-4, 1e-4), "dust.stl"))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"units": "feet"}, "Valid: m, cm, mm, in"),
        ({"up": "w"}, "Valid: z, -z"),
        ({"size": 0.0}, "positive"),
        ({"size": (None, None, None)}, "one length or three"),
        ({"size": 1.0, "units": "m"}, "not both"),
        ({"mass": 1.0, "density": 1.0}, "not both"),
        ({"mass": float("nan")}, "positive"),
        ({"material": "adamantium"}, "Known:"),
        ({"parts": "vhacd"}, "Valid: coacd, hull, box"),
        ({"friction": -1.0}, "negative"),
    ],
)
def test_bad_arguments_say_what_is_valid(write, options, message):
    with pytest.raises(AssetError, match=message):
        import_mesh(write(_box(), "box.stl"), **options)


def test_mass_friction_and_material_reach_the_asset(write):
    path = write(_box(), "box.stl")
    asset = import_mesh(path, mass=1.2, friction=0.7, material="wood", parts="box")
    assert asset.mass_properties.mass == pytest.approx(1.2)
    assert asset.material.density == pytest.approx(200)
    assert asset.material.friction == 0.7
    assert import_mesh(path, material="wood", parts="box").mass_properties.mass == pytest.approx(650 * 0.006)


# Repair


def test_inside_out_and_mixed_windings_weigh_what_the_box_weighs():
    box = _box()
    mixed = box.faces.copy()
    mixed[::2] = mixed[::2, ::-1]
    for faces in (box.faces[:, ::-1], mixed):
        fixed = repair(box.vertices, faces)
        assert signed_volume(fixed.solid.vertices, fixed.solid.faces) == pytest.approx(0.006)
        assert signed_volume(fixed.vertices, fixed.faces) == pytest.approx(0.006)
        assert any("inside-out" in text for text in fixed.repairs)


def test_corners_follow_their_faces_through_repair():
    """Texture coordinates stay with their vertices when faces are turned, dropped and welded."""
    box = _box()
    soup = box.triangles.reshape(-1, 3)
    faces = np.arange(36).reshape(-1, 3)[:, ::-1]
    fixed = repair(soup, np.concatenate([faces, faces[:3], [[0, 0, 1]]]))
    flat = np.concatenate([faces, faces[:3], [[0, 0, 1]]]).reshape(-1)
    assert np.array_equal(soup[flat[fixed.corners]], fixed.vertices[fixed.faces])
    assert fixed.repairs == ("dropped 1 degenerate faces", "dropped 3 duplicate faces", "turned 1 inside-out pieces")


def test_open_box_becomes_walls_of_the_given_thickness():
    box = _box(1.0, 1.0, 1.0)
    fixed = repair(box.vertices, box.faces[box.triangles_center[:, 2] < 0.99], thickness=0.01)
    assert signed_volume(fixed.solid.vertices, fixed.solid.faces) == pytest.approx(1 - 0.98**2 * 0.99, rel=1e-9)
    assert fixed.volume_source == "thickened shell"
    assert np.array_equal(np.ptp(fixed.vertices, axis=0), [1, 1, 1])
    assert _edges_closed(fixed.faces)


def test_missing_base_and_small_holes_are_capped():
    box = _box()
    fixed = repair(box.vertices, box.faces[box.triangles_center[:, 2] > 0.001])
    assert signed_volume(fixed.solid.vertices, fixed.solid.faces) == pytest.approx(0.006)
    assert fixed.repairs == ("closed the open base",)
    ball = trimesh.creation.icosphere(3, radius=0.1)
    fixed = repair(ball.vertices, np.delete(ball.faces, [7, 300], axis=0))
    assert fixed.volume_source == "hole filled"
    assert not fixed.watertight
    assert signed_volume(fixed.solid.vertices, fixed.solid.faces) == pytest.approx(ball.volume, rel=2e-3)


def test_overlapping_solids_weigh_their_union_and_voids_count_out():
    left, right = _box(), _box()
    right.apply_translation((0.2, 0, 0))
    both = trimesh.util.concatenate([left, right])
    fixed = repair(both.vertices, both.faces)
    assert signed_volume(fixed.solid.vertices, fixed.solid.faces) == pytest.approx(0.5 * 0.2 * 0.1)
    assert len(fixed.pieces) == 2
    outer, inner = trimesh.creation.icosphere(3, 0.1), trimesh.creation.icosphere(3, 0.05)
    inner.invert()
    hollow = trimesh.util.concatenate([outer, inner])
    for faces in (hollow.faces, hollow.faces[:, ::-1]):
        fixed = repair(hollow.vertices, faces)
        assert signed_volume(fixed.solid.vertices, fixed.solid.faces) == pytest.approx(outer.volume + inner.volume)


def test_edge_shared_by_four_faces_is_paired_not_broken():
    """Two cubes that touch along an edge and are joined elsewhere: not manifold, but a solid."""
    a, b = _box(1, 1, 1), _box(1, 1, 1)
    b.apply_translation((1, 1, 0))
    both = trimesh.util.concatenate([a, b])
    both.merge_vertices()
    fixed = repair(both.vertices, both.faces)
    assert signed_volume(fixed.solid.vertices, fixed.solid.faces) == pytest.approx(2)
    assert fixed.volume_source == "closed surface"


def test_inner_wall_between_two_solids_is_closed_on_both_sides():
    """Three faces meet along each edge of a partition: every chamber is closed, the union weighs all."""
    lower, upper = _box(1, 1, 1), _box(1, 1, 1)
    upper.update_faces(upper.triangles_center[:, 2] > 0.01)
    upper.apply_translation((0, 0, 1))
    both = trimesh.util.concatenate([lower, upper])
    both.merge_vertices()
    fixed = repair(both.vertices, both.faces)
    assert signed_volume(fixed.solid.vertices, fixed.solid.faces) == pytest.approx(2)
    assert fixed.volume_source == "hole filled"


@pytest.mark.slow
def test_a_soup_of_triangles_is_wrapped_and_says_so():
    ball = trimesh.creation.icosphere(2, radius=0.1)
    rng = np.random.default_rng(0)
    soup = (ball.triangles * (1 + rng.normal(scale=5e-3, size=(len(ball.faces), 1, 1)))).reshape(-1, 3)
    fixed = repair(soup, np.arange(len(soup)).reshape(-1, 3))
    assert fixed.volume_source == "voxel wrap"
    assert _edges_closed(fixed.solid.faces)
    # The wrap stands 0.6 voxels, 2 mm, outside a ball of radius 100 mm.
    assert signed_volume(fixed.solid.vertices, fixed.solid.faces) == pytest.approx(ball.volume * 1.02**3, rel=0.03)


@pytest.mark.slow
def test_mass_properties_of_a_torus_agree_with_its_closed_form(write):
    mesh = trimesh.creation.torus(0.1, 0.03, major_sections=128, minor_sections=64)
    asset = import_mesh(write(mesh, "ring.ply"), parts="hull", density=1000)
    volume = 2 * np.pi**2 * 0.1 * 0.03**2
    properties = asset.mass_properties
    assert properties.volume == pytest.approx(volume, rel=3e-3)
    assert properties.inertia[2][2] == pytest.approx(1000 * volume * (0.1**2 + 0.75 * 0.03**2), rel=5e-3)
    assert properties.inertia == pytest.approx(mesh.moment_inertia * 1000, rel=1e-4, abs=1e-9)
    assert properties.centre_of_mass == pytest.approx((0, 0, 0.03), abs=1e-6)


# Looks


def test_texture_and_coordinates_survive_a_glb_round_trip(write):
    image = Image.fromarray(np.arange(8 * 8 * 3, dtype=np.uint8).reshape(8, 8, 3))
    mesh = _box()
    mesh.unmerge_vertices()
    uv = np.random.default_rng(0).uniform(size=(len(mesh.vertices), 2))
    mesh.visual = trimesh.visual.TextureVisuals(uv=uv, material=_picture(image))
    asset = import_mesh(write(mesh, "box.glb"), up="z", parts="box")
    assert np.array_equal(asset.visual.texture, np.asarray(image))
    # Every corner keeps the coordinate of its place.
    expected = {tuple(np.round(p - [0.15, 0.1, 0], 5)): set() for p in mesh.vertices}
    for point, coordinate in zip(mesh.vertices, uv, strict=True):
        expected[tuple(np.round(point - [0.15, 0.1, 0], 5))].add(tuple(np.round(coordinate, 4)))
    for point, coordinate in zip(
        asset.visual.vertices[asset.visual.faces].reshape(-1, 3), asset.visual.uv.reshape(-1, 2), strict=True
    ):
        assert tuple(np.round(coordinate, 4)) in expected[tuple(np.round(point, 5) + 0.0)]


def _colour_at(visual, face):
    """The texel in the middle of a face."""
    u, v = visual.uv[face].mean(axis=0)
    height, width = visual.texture.shape[:2]
    return tuple(int(c) for c in visual.texture[int((1 - v) * height), int(u * width)])


def test_scene_graph_is_merged_with_the_colours_of_its_pieces(tmp_path):
    scene = trimesh.Scene()
    for x, colour in ((0.0, [255, 0, 0, 255]), (1.0, [0, 0, 255, 255])):
        mesh = _box(0.5, 0.5, 0.5)
        mesh.visual = trimesh.visual.TextureVisuals(
            material=trimesh.visual.material.PBRMaterial(baseColorFactor=colour)
        )
        scene.add_geometry(mesh, transform=trimesh.transformations.translation_matrix([x, 0, 0]))
    path = tmp_path / "pair.glb"
    path.write_bytes(scene.export(file_type="glb"))
    asset = import_mesh(path, up="z", parts="box")
    assert asset.size == pytest.approx([1.5, 0.5, 0.5])
    assert asset.mass_properties.volume == pytest.approx(0.25)
    centres = asset.visual.vertices[asset.visual.faces].mean(axis=1)
    colours = {(_colour_at(asset.visual, k), bool(centre[0] < 0)) for k, centre in enumerate(centres)}
    assert colours == {((255, 0, 0), True), ((0, 0, 255), False)}


def test_face_and_vertex_colours_become_a_palette(write):
    mesh = _box()
    mesh.visual.face_colors = np.array([[255, 0, 0, 255], [0, 255, 0, 255]] * 6)
    asset = import_mesh(write(mesh, "box.ply"), parts="box")
    assert sorted({_colour_at(asset.visual, k) for k in range(12)}) == [(0, 255, 0), (255, 0, 0)]
    mesh.visual = trimesh.visual.ColorVisuals(mesh, vertex_colors=np.tile([0, 0, 255, 255], (8, 1)))
    asset = import_mesh(write(mesh, "blue.ply"), parts="box")
    assert {_colour_at(asset.visual, k) for k in range(12)} == {(0, 0, 255)}


def test_textures_of_several_materials_share_an_atlas(tmp_path):
    lines = ["mtllib two.mtl"]
    box = _box()
    for k, name in enumerate(("left", "right")):
        lines += [f"v {x + k} {y} {z}" for x, y, z in box.vertices] + ["vt 0.5 0.5"] + [f"usemtl {name}"]
        lines += ["f " + " ".join(f"{8 * k + i + 1}/{k + 1}" for i in face) for face in box.faces]
        Image.new("RGB", (16, 8 + 8 * k), (200 * k, 100, 50)).save(tmp_path / f"{name}.png")
    (tmp_path / "two.obj").write_text("\n".join(lines))
    (tmp_path / "two.mtl").write_text("newmtl left\nmap_Kd left.png\nnewmtl right\nmap_Kd right.png\n")
    asset = import_mesh(tmp_path / "two.obj", parts="box")
    assert {_colour_at(asset.visual, k) for k in range(len(asset.visual.faces))} == {(0, 100, 50), (200, 100, 50)}


# What nobody vouches for


def test_unknown_format_missing_and_broken_files_are_one_line(tmp_path, write):
    (tmp_path / "a.blend").write_bytes(b"x")
    for name, message in (
        ("a.blend", "Valid: obj, stl, ply, off, glb, gltf, dae, 3mf, fbx"),
        ("b.stl", "no mesh file"),
    ):
        with pytest.raises(AssetError, match=message):
            import_mesh(tmp_path / name)
    whole = write(_box(), "box.glb").read_bytes()
    for name, data in (
        ("empty.obj", b""),
        ("text.obj", b"hello"),
        ("cut.glb", whole[: len(whole) // 2]),
        ("zero.glb", bytes(100)),
        ("noise.ply", bytes(range(256)) * 4),
        ("noise.stl", b"solid nothing"),
        ("bad.gltf", b"{"),
        ("x.off", b"OFF\n1"),
        ("list.gltf", b"[1]"),
    ):
        (tmp_path / name).write_bytes(data)
        with pytest.raises(AssetError) as caught:
            import_mesh(tmp_path / name)
        assert "\n" not in str(caught.value)
        assert name in str(caught.value)


def test_nan_vertices_zero_area_and_wrong_indices_are_named(tmp_path):
    cases = {
        "nan.obj": ("v 0 0 0\nv 1 0 0\nv 0 nan 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n", "not finite"),
        "line.obj": ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "zero area"),
        "point.obj": ("v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", "no extent"),
        "index.off": ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "index.off"),
    }
    for name, (text, message) in cases.items():
        (tmp_path / name).write_text(text)
        with pytest.raises(AssetError, match=message):
            import_mesh(tmp_path / name)


@pytest.mark.parametrize(
    ("name", "head", "size"),
    [
        ("huge.stl", bytes(80) + struct.pack("<I", 10_000_000), 84 + 50 * 10_000_000),
        ("huge.ply", b"ply\nformat ascii 1.0\nelement vertex 3\nelement face 10000000\nend_header\n", 1000),
        ("huge.off", b"OFF # big\n5000000 10000000 0\n", 1000),
        (
            "huge.gltf",
            json.dumps(
                {"accessors": [{"count": 30_000_000}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]}
            ).encode(),
            None,
        ),
    ],
)
def test_ten_million_triangles_are_refused_by_the_header(tmp_path, monkeypatch, name, head, size):
    monkeypatch.setattr(trimesh, "load_scene", lambda *a, **k: pytest.fail("the file was read"))
    path = tmp_path / name
    path.write_bytes(head)
    if size:
        with open(path, "r+b") as file:
            file.truncate(size)  # A sparse file: the disk holds its head alone.
    with pytest.raises(AssetError, match="10,000,000 triangles; at most 2,000,000"):
        import_mesh(path)


def test_large_files_and_many_obj_faces_are_refused(tmp_path, monkeypatch):
    path = tmp_path / "big.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 2 3\n" * 100)
    monkeypatch.setattr(mesh_load, "MAX_FACES", 99)
    with pytest.raises(AssetError, match="100 triangles; at most 99"):
        import_mesh(path)
    monkeypatch.setattr(mesh_load, "MAX_BYTES", 500)
    with pytest.raises(AssetError, match="MB are read"):
        import_mesh(path)


@pytest.mark.parametrize("uri", ["../secret.bin", "/etc/passwd", "http://127.0.0.1:9/secret.bin", "file:///etc/passwd"])
def test_gltf_reads_nothing_outside_its_folder(tmp_path, write, uri):
    folder = tmp_path / "in"
    folder.mkdir()
    (tmp_path / "secret.bin").write_bytes(bytes(1000))
    files = trimesh.exchange.gltf.export_gltf(trimesh.Scene(_box()))
    tree = json.loads(files["model.gltf"])
    tree["buffers"][0]["uri"] = uri
    (folder / "model.gltf").write_text(json.dumps(tree))
    with pytest.raises(AssetError, match="outside the mesh's folder"):
        import_mesh(folder / "model.gltf")


def test_obj_texture_outside_the_folder_is_left_out_unless_allowed(tmp_path):
    folder = tmp_path / "meshes"
    folder.mkdir()
    Image.new("RGB", (4, 4), (9, 8, 7)).save(tmp_path / "skin.png")
    box = _box()
    lines = ["mtllib box.mtl", "usemtl skin", "vt 0.5 0.5"] + [f"v {x} {y} {z}" for x, y, z in box.vertices]
    lines += ["f " + " ".join(f"{i + 1}/1" for i in face) for face in box.faces]
    (folder / "box.obj").write_text("\n".join(lines))
    (folder / "box.mtl").write_text("newmtl skin\nmap_Kd ../skin.png\n")
    kept_out = import_mesh(folder / "box.obj", parts="box")
    assert "outside" in kept_out.provenance["notes"][0]
    allowed = import_mesh(folder / "box.obj", parts="box", texture_root=tmp_path)
    assert _colour_at(allowed.visual, 0) == (9, 8, 7)


# Parts


def test_bracket_of_two_arms_is_decomposed_and_stands_on_its_base(write, tmp_path):
    solid = manifold3d.Manifold.cube((0.1, 0.02, 0.02)) + manifold3d.Manifold.cube((0.02, 0.02, 0.08))
    surface = solid.to_mesh64()
    mesh = trimesh.Trimesh(np.asarray(surface.vert_properties)[:, :3], np.asarray(surface.tri_verts).astype(int))
    asset = import_mesh(write(mesh, "bracket.ply"), cache_dir=tmp_path / "cache")
    assert 2 <= len(asset.parts) <= 4
    assert asset.bounds == pytest.approx(np.array([[-0.05, -0.01, 0.0], [0.05, 0.01, 0.08]]), abs=1e-5)
    assert asset.bounds[0, 2] == 0.0
    assert asset.mass_properties.volume == pytest.approx(6.4e-5, rel=1e-5)
    assert asset.provenance["parts"]["options"]["seed"] == 0


@pytest.mark.slow
def test_scanned_cup_of_many_faces_keeps_its_room_and_contains_its_noisy_surface(write, tmp_path):
    """29,000 faces that a scanner's noise moves by 0.05 mm: CoACD gets fewer, the parts contain all of them."""
    outer = manifold3d.Manifold.cylinder(0.09, 0.035, 0.04, 64)
    cup = outer - manifold3d.Manifold.cylinder(0.09, 0.031, 0.036, 64).translate((0, 0, 0.005))
    surface = cup.refine_to_length(0.003).to_mesh64()
    mesh = trimesh.Trimesh(np.asarray(surface.vert_properties)[:, :3], np.asarray(surface.tri_verts).astype(int))
    noise = np.random.default_rng(0).normal(scale=5e-5, size=(len(mesh.vertices), 1))
    mesh.vertices = mesh.vertices + noise * mesh.vertex_normals
    assert len(mesh.faces) > 10_000
    asset = import_mesh(write(mesh, "cup.ply"), material="ceramic", cache_dir=tmp_path / "cache")
    sampled = trimesh.sample.sample_surface(
        trimesh.Trimesh(asset.visual.vertices, asset.visual.faces, process=False), 100_000, seed=0
    )[0]
    assert outside(sampled, list(asset.parts))[0].max() < 1e-4
    assert asset.provenance["parts"]["cavity_loss"] < 0.02


@pytest.mark.slow
def test_cup_is_decomposed_with_its_cavity_open_and_the_visual_mesh_inside(write, tmp_path):
    """A cup of 16 sides, closed surface: weight of the wall, not of the hulls; room inside."""
    outer = manifold3d.Manifold.cylinder(0.09, 0.035, 0.04, 16)
    cup = (outer - manifold3d.Manifold.cylinder(0.09, 0.031, 0.036, 16).translate((0, 0, 0.005))).to_mesh64()
    mesh = trimesh.Trimesh(np.asarray(cup.vert_properties)[:, :3], np.asarray(cup.tri_verts).astype(int))
    path = write(mesh, "cup.stl")
    asset = import_mesh(path, material="ceramic", cache_dir=tmp_path / "cache")
    assert asset.mass_properties.volume == pytest.approx(mesh.volume, rel=1e-4)
    assert all(len(part.vertices) <= 64 and len(part.faces) <= 64 for part in asset.parts)
    points = surface_points(asset.visual.vertices, asset.visual.faces)
    assert outside(points, list(asset.parts))[0].max() < 1e-4
    assert asset.bounds[0, 2] == 0.0
    assert asset.provenance["parts"]["cavity_loss"] < 0.02
    room = asset.region("in")
    assert room is not None
    assert room.half_size[0] > 0.028
    assert room.height > 0.07
    # What this process remembers would not be read from the disk.
    importing._imported.clear()
    again = import_mesh(path, material="ceramic", cache_dir=tmp_path / "cache")
    assert again.provenance["parts"]["cached"]
    assert all(np.array_equal(a.vertices, b.vertices) for a, b in zip(asset.parts, again.parts, strict=True))


def test_closed_boxes_in_one_file_stay_boxes(write, tmp_path):
    """Convex pieces are parts as they are, without CoACD."""
    tray = trimesh.util.concatenate([_box(0.4, 0.3, 0.01), _box(0.4, 0.01, 0.05), _box(0.01, 0.3, 0.05)])
    asset = import_mesh(write(tray, "corner.off"), cache_dir=tmp_path)
    assert len(asset.parts) == 3
    assert all(part.box is not None for part in asset.parts)


def test_one_file_is_imported_once_until_it_changes(tmp_path, monkeypatch):
    """A hundred objects of one mesh cost one import; their assets are not one object, so each keeps its own files."""
    from pat3d.assets.mesh import importing

    path = tmp_path / "block.obj"
    trimesh.creation.box((0.1, 0.1, 0.1)).export(path)
    calls = []
    load = importing.load_mesh
    monkeypatch.setattr(importing, "load_mesh", lambda *given, **more: calls.append(given) or load(*given, **more))
    first, second = (importing.import_mesh(path, cache_dir=tmp_path / "cache") for _ in range(2))
    assert first is second
    assert len(calls) == 1
    importing.import_mesh(path, cache_dir=tmp_path / "cache", mass=1.0)
    assert len(calls) == 2
    trimesh.creation.box((0.1, 0.1, 0.2)).export(path)
    assert importing.import_mesh(path, cache_dir=tmp_path / "cache").size[2] == pytest.approx(0.2)


def test_all_pieces_of_a_mesh_share_one_budget_of_time(tmp_path, monkeypatch):
    """A soup has dozens of pieces; a limit for each would add up to many minutes."""
    from pat3d import progress
    from pat3d.assets.mesh import parts

    spent = [0.0]
    given = []

    def slow(vertices, faces, *, cpu_limit, **options):
        given.append(cpu_limit)
        spent[0] += 40.0
        return Decomposition(parts=[vertices], options={}, cached=False, seconds=40.0)

    monkeypatch.setattr(parts, "decompose", slow)
    monkeypatch.setattr(progress, "_processor_time", lambda: spent[0])
    outline = [(0, 0), (0.1, 0), (0.1, 0.03), (0.03, 0.03), (0.03, 0.1), (0, 0.1)]
    ells = [prism(outline, 0.05).moved(x=0.2 * number).solid.to_mesh64() for number in range(4)]
    ells = [trimesh.Trimesh(np.asarray(ell.vert_properties)[:, :3], np.asarray(ell.tri_verts)) for ell in ells]
    path = tmp_path / "ells.stl"
    trimesh.util.concatenate(ells).export(path)
    import_mesh(path, cache_dir=tmp_path / "cache", decomposition_limit=100.0)
    assert given[:3] == [100.0, 60.0, 20.0]
    assert all(rest == parts.LEAST_SECONDS for rest in given[3:])


def test_the_surface_that_a_glb_says_is_kept_and_what_is_not_is_told(write):
    from PIL import Image

    from pat3d.assets.materials import surface_of

    mesh = trimesh.creation.box((0.1, 0.1, 0.1))
    # Green is roughness, blue metallic.
    both = Image.new("RGB", (8, 8), (0, 51, 204))
    mesh.visual = trimesh.visual.TextureVisuals(
        uv=mesh.vertices[:, :2],
        material=trimesh.visual.material.PBRMaterial(
            metallicRoughnessTexture=both,
            normalTexture=Image.new("RGB", (8, 8), (128, 128, 255)),
            occlusionTexture=Image.new("RGB", (8, 8), (255, 255, 255)),
        ),
    )
    asset = import_mesh(write(mesh, "box.glb"), parts="box", material="wood")
    surface = surface_of(asset)
    assert surface.roughness == pytest.approx(0.2, abs=0.01)
    assert surface.metallic == pytest.approx(0.8, abs=0.01)
    assert surface.opacity == 1.0
    assert set(asset.visual.maps) == {"normal", "roughness", "metallic"}
    assert any("occlusion map" in note for note in asset.provenance["notes"])
    plain = import_mesh(write(_box(), "box.stl"), parts="box", material="wood")
    assert surface_of(plain).roughness == 0.6
    assert surface_of(import_mesh(write(_box(), "box.stl"), parts="box", material="steel")).metallic == 1.0
