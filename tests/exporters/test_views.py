"""Formats to look at: GLB as trimesh reads it, HTML as a browser would."""

import base64
import io
import json
import re
import shutil
import zlib
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from PIL import Image

from pat3d.cli.main import main
from pat3d.errors import ExportError, SpecError
from pat3d.exporters.common.corners import corner_mesh
from pat3d.exporters.formats import VIEWS, chosen, export, exported
from pat3d.exporters.glb.writer import write_glb
from pat3d.exporters.html.writer import page, write_html
from pat3d.geometry.pose import Pose
from pat3d.scene.io import save_scene
from pat3d.scene.model import Scene
from tests.exporters.things import mixed_scene

Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1.0, 0], [0, -1.0, 0, 0], [0, 0, 0, 1.0]])


@pytest.fixture(scope="module")
def scene():
    return mixed_scene()


@pytest.fixture(scope="module")
def glb(scene, tmp_path_factory):
    return write_glb(scene, tmp_path_factory.mktemp("views") / "glb")


def document(text):
    return json.loads(re.search(r'<script type="application/json" id="scene">(.*?)</script>', text, re.DOTALL)[1])


def test_trimesh_reads_names_poses_and_meshes_back_from_the_glb(scene, glb):
    read = trimesh.load(glb)
    assert {obj.name for obj in scene.objects} == set(read.graph.nodes_geometry)
    assert len(read.geometry) == len({id(obj.asset) for obj in scene.objects})
    for obj in scene.objects:
        matrix, geometry = read.graph[obj.name]
        expected = np.eye(4)
        expected[:3, :3], expected[:3, 3] = obj.pose.rotation, obj.pose.position
        assert matrix == pytest.approx(Y_UP @ expected, abs=1e-7)
        mesh = read.geometry[geometry]
        assert mesh.bounds == pytest.approx(obj.asset.visual.bounds, abs=1e-6)
        assert mesh.area == pytest.approx(
            trimesh.Trimesh(obj.asset.visual.vertices, obj.asset.visual.faces).area, rel=1e-5
        )
        merged = trimesh.Trimesh(mesh.vertices, mesh.faces, process=True)
        merged.merge_vertices(merge_tex=True, merge_norm=True)
        assert merged.volume == pytest.approx(obj.asset.mass_properties.volume, rel=1e-4)


def test_the_glb_shows_every_point_in_its_colour(scene, glb):
    read = trimesh.load(glb)
    for obj in scene.objects:
        mesh = read.geometry[read.graph[obj.name][1]]
        picture = np.asarray(mesh.visual.material.baseColorTexture.convert("RGB"))
        assert np.array_equal(picture, obj.asset.visual.texture)
        # The corners come in another order; compare the colour at every triangle's middle.
        ours, theirs = _colours(obj.asset.visual.vertices, obj.asset.visual), _glb_colours(mesh, picture)
        assert ours.keys() == theirs.keys()
        assert all(ours[key] == theirs[key] for key in ours)


def _key(points):
    return tuple(np.round(points.mean(axis=0), 5) + 0.0)


def _at(picture, uv):
    height, width = picture.shape[:2]
    column, row = min(int(uv[0] * width), width - 1), min(int((1 - uv[1]) * height), height - 1)
    return tuple(picture[row, column])


def _colours(vertices, mesh):
    return {
        _key(vertices[face].astype(np.float32).astype(float)): _at(mesh.texture, uv.mean(axis=0))
        for face, uv in zip(mesh.faces, mesh.uv, strict=True)
    }


def _glb_colours(mesh, picture):
    return {_key(mesh.vertices[face]): _at(picture, mesh.visual.uv[face].mean(axis=0)) for face in mesh.faces}


def test_objects_that_share_an_asset_share_the_mesh_of_the_glb(scene, tmp_path):
    first = scene.objects[0]
    second = replace(first, name="another", pose=Pose(position=(1.0, 0.0, 0.0)))
    twice = replace(scene, objects=(*scene.objects, second))
    read = trimesh.load(write_glb(twice, tmp_path / "glb"))
    assert len(read.geometry) == len({id(obj.asset) for obj in scene.objects})
    assert read.graph["another"][1] == read.graph[first.name][1]
    assert read.graph["another"][0] == pytest.approx(Y_UP @ trimesh.transformations.translation_matrix((1, 0, 0)))


def test_the_page_holds_the_scene_to_a_hundredth_of_a_millimetre_of_its_meshes(scene):
    made = document(page(scene))
    assert [entry["name"] for entry in made["objects"]] == [obj.name for obj in scene.objects]
    for entry, obj in zip(made["objects"], scene.objects, strict=True):
        mesh, corners = made["meshes"][entry["mesh"]], corner_mesh(obj.asset.visual)
        raw, n = zlib.decompress(base64.b64decode(mesh["data"])), mesh["count"]
        assert len(raw) == 16 * n + 4 * mesh["corners"]
        steps = np.frombuffer(raw, "<u2", 4 * n).reshape(n, 4)[:, :3]
        positions = np.array(mesh["low"]) + np.array(mesh["span"]) * steps / 65535
        assert np.abs(positions - corners.positions).max() < 1e-5
        normals = np.frombuffer(raw, "i1", 4 * n, 8 * n).reshape(n, 4)[:, :3] / 127
        assert np.abs(normals - corners.normals).max() < 0.005
        faces = np.frombuffer(raw, "<u4", mesh["corners"], 16 * n).reshape(-1, 3)
        assert np.array_equal(faces, corners.faces)
        assert entry["pose"] == pytest.approx([*obj.pose.position, *obj.pose.quat_wxyz], abs=1e-7)
        picture = Image.open(io.BytesIO(base64.b64decode(mesh["texture"].partition(",")[2]))).convert("RGB")
        assert np.array_equal(np.asarray(picture), obj.asset.visual.texture)


def test_merged_corners_have_outward_normals_and_lose_no_triangle(scene):
    for obj in scene.objects:
        mesh, corners = obj.asset.visual, corner_mesh(obj.asset.visual)
        assert len(corners.faces) == len(mesh.faces)
        assert len(corners.positions) < mesh.faces.size
        assert np.linalg.norm(corners.normals, axis=1) == pytest.approx(1.0, abs=1e-5)
        assert corners.positions[corners.faces] == pytest.approx(mesh.vertices[mesh.faces], abs=1e-6)
        triangle = corners.positions[corners.faces].astype(float)
        flat = np.cross(triangle[:, 1] - triangle[:, 0], triangle[:, 2] - triangle[:, 0])
        assert np.all(np.einsum("fi,fci->fc", flat, corners.normals[corners.faces].astype(float)) > -1e-12)


def test_the_page_asks_nothing_of_the_network_and_no_name_gets_out_of_its_data(scene):
    wicked = '</script><script>alert(1)</script><img src="https://example.org/x">'
    changed = replace(scene, prompt=wicked, objects=(replace(scene.objects[0], phrase=wicked), *scene.objects[1:]))
    text = page(changed)
    assert text.count("<script") == 2
    assert text.count("</script>") == 2
    outside = re.sub(r'<script type="application/json".*?</script>', "", text, flags=re.DOTALL)
    outside = re.sub(r"<title>.*?</title>", "", outside)
    assert not re.search(r"https?:|//cdn|@import|\bfetch\(|XMLHttpRequest|\bimport\b", outside)
    assert "default-src 'none'" in outside
    assert document(text)["title"] == wicked
    assert dict(document(text)["objects"][0]["facts"])["asked for as"] == wicked


def test_facts_are_what_the_scene_says(scene):
    facts = {entry["name"]: dict(entry["facts"]) for entry in document(page(scene))["objects"]}
    for obj in scene.objects:
        assert facts[obj.name]["mass"] == f"{obj.asset.mass_properties.mass:.3g} kg"
        assert facts[obj.name]["kind"] == obj.asset.noun


def test_views_are_formats_of_their_own_that_a_folder_keeps(scene, tmp_path):
    assert chosen(["html,glb"]) == ("html", "glb")
    with pytest.raises(SpecError, match="html, glb"):
        chosen(["stl"])
    save_scene(scene, tmp_path / "desk")
    assert main(["export", str(tmp_path / "desk"), "--formats", "html,glb", "--out", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out" / "html" / "scene.html").stat().st_size < 5e6
    assert exported(tmp_path / "out")[0] == ("mjcf", "html", "glb")
    export(scene, VIEWS, tmp_path / "out")


def test_a_folder_of_somebody_else_is_not_replaced(scene, tmp_path):
    (tmp_path / "html").mkdir()
    (tmp_path / "html" / "mine.txt").write_text("mine")
    for write in (write_html, write_glb):
        with pytest.raises(ExportError, match="not empty"):
            write(scene, tmp_path / "html")
    assert (tmp_path / "html" / "mine.txt").read_text() == "mine"


def test_names_that_the_glb_needs_are_refused(scene, tmp_path):
    first = scene.objects[0]
    named = Scene(objects=(replace(first, name="world"),), relations=())
    with pytest.raises(ExportError, match="rename"):
        write_glb(named, tmp_path / "glb")


def _pixels(screenshot):
    """The canvas of a screenshot, without the list beside it."""
    return np.asarray(Image.open(io.BytesIO(screenshot)).convert("RGB")).astype(int)[:, :600]


@pytest.mark.slow
def test_a_browser_draws_the_page_from_disk_turns_it_and_selects(scene, tmp_path):
    """Chromium, headless, by file URL: nothing is asked of the network, and clicking an object lists its facts."""
    sync_api = pytest.importorskip("playwright.sync_api")
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    if chromium is None:
        pytest.skip("no Chromium here")
    path = write_html(scene, tmp_path / "html")
    arguments = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    with sync_api.sync_playwright() as play:
        browser = play.chromium.launch(executable_path=chromium, args=arguments)
        tab = browser.new_page(viewport={"width": 900, "height": 600})
        asked, errors = [], []
        tab.on("request", lambda request: asked.append(request.url))
        tab.on("pageerror", lambda error: errors.append(str(error)))
        tab.goto(path.as_uri())
        tab.wait_for_selector("html[data-drawn=yes]", timeout=60_000)
        before = tab.screenshot()
        tab.mouse.move(300, 300)
        tab.mouse.down()
        tab.mouse.move(420, 280, steps=4)
        tab.mouse.up()
        tab.wait_for_timeout(500)
        after = tab.screenshot()
        # Where the picture is neither paper nor shadow there is an object.
        shown = _pixels(after)
        coloured = np.argwhere((shown.max(axis=2) - shown.min(axis=2)) > 60)
        row, column = coloured[len(coloured) // 2]
        tab.mouse.click(float(column), float(row))
        tab.wait_for_selector("#facts dt")
        chosen_names = tab.eval_on_selector_all("#objects button[aria-pressed=true]", "e => e.map(x => x.textContent)")
        trouble = tab.is_visible("#trouble")
        browser.close()
    pictures = [_pixels(data) for data in (before, after)]
    # Something other than paper is drawn, and it turned.
    assert pictures[0].std() > 5.0
    assert np.abs(pictures[0] - pictures[1]).mean() > 1.0
    assert len(chosen_names) == 1
    assert [url for url in asked if not url.startswith(("file:", "data:", "blob:"))] == []
    assert errors == []
    assert not trouble
