"""What folders of known collections say of their objects: Objaverse, PartNet-Mobility, HSSD, ManiSkill, ShapeNet."""

import gzip
import json
from pathlib import Path

import pytest
import trimesh

from pat3d.assets.library.body import Body
from pat3d.assets.library.discover import discover, files_below
from pat3d.assets.library.guess import SURE, Typical, guess_unit
from pat3d.assets.library.index import add_library, open_library
from pat3d.assets.library.indexing import called
from pat3d.assets.library.metadata import Metadata, metadata_of
from pat3d.assets.library.names import synonyms_of, title_words, words_of
from pat3d.assets.mesh.load import load_mesh
from pat3d.errors import AssetError

BOWL, PIN = "0a1b2c3d4e5f60718293a4b5c6d7e8f9", "ffeeddccbbaa99887766554433221100"


def _put(path: Path, data: str | bytes | dict = b"") -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    text = json.dumps(data) if isinstance(data, dict) else data
    path.write_bytes(text.encode() if isinstance(text, str) else text)


def _named(root: Path) -> dict[str, list[str]]:
    """Words of the name of every object below `root`, by its path."""
    found = discover(root, "lab")
    said = metadata_of([one.path for one in found], files_below(root), root)
    return {str(one.path.relative_to(root)): called(one, said[one.path]) for one in found}


def _said(root: Path) -> list[Metadata]:
    paths = [one.path for one in discover(root, "lab")]
    return list(metadata_of(paths, files_below(root), root).values())


def test_objaverse_names_its_objects_in_tables(tmp_path):
    glbs = tmp_path / "glbs" / "000-023"
    _put(glbs / f"{BOWL}.glb")
    _put(glbs / f"{PIN}.glb")
    table = {
        BOWL: {"name": "Fruit Bowl (Low Poly)", "license": "by", "tags": [{"name": "table"}]},
        PIN: {"name": "Nudelholz"},
        "somebody else": {"name": "x"},
    }
    _put(tmp_path / "metadata" / "000-023.json.gz", gzip.compress(json.dumps(table).encode()))
    _put(tmp_path / "lvis-annotations.json.gz", gzip.compress(json.dumps({"rolling_pin": [PIN]}).encode()))
    assert list(_named(tmp_path).values()) == [["fruit", "bowl"], ["rolling", "pin"]]
    bowl, pin = _said(tmp_path)
    assert bowl.licence == "by"
    # What a picture is tagged with is no name: a table in a sentence is to be a table.
    assert bowl.names == ("Fruit Bowl (Low Poly)",)
    assert pin.names == ("rolling_pin", "Nudelholz")


def test_folders_called_by_numbers_hold_an_object_each(tmp_path):
    """PartNet-Mobility and ShapeNet: the same file names in every folder."""
    for number, kind in (("102358", "KitchenPot"), ("102359", "Mug")):
        _put(tmp_path / "partnet" / number / "mobility.urdf", "<robot/>")
        _put(tmp_path / "partnet" / number / "meta.json", {"anno_id": number, "model_cat": kind})
    for name in (BOWL, PIN):
        _put(tmp_path / "02876657" / name / "models" / "model_normalized.obj")
    named = _named(tmp_path)
    assert named["partnet/102358/mobility.urdf"] == ["kitchen", "pot"]
    assert named["partnet/102359/mobility.urdf"] == ["mug"]
    assert len(named) == 4


def test_habitat_and_maniskill_say_mass_axis_and_density(tmp_path):
    _put(tmp_path / "objects" / "0" / f"{BOWL}.glb")
    _put(tmp_path / "objects" / "0" / f"{BOWL}.object_config.json", {"up": [0, 1, 0], "mass": 0.4})
    _put(tmp_path / "semantics" / "objects.csv", f"id,name,main_category\n{BOWL},Small salad bowl,bowl\n")
    _put(tmp_path / "ycb" / "models" / "002_master_chef_can" / "textured.obj")
    _put(tmp_path / "ycb" / "info_pick_v0.json", {"002_master_chef_can": {"density": 500, "scales": [1.0]}})
    bowl, can = _said(tmp_path)
    assert bowl == Metadata(names=("Small salad bowl", "bowl"), mass=0.4, up="y")
    assert can == Metadata(density=500.0)


def test_shapenet_says_unit_and_axis_in_a_table(tmp_path):
    _put(tmp_path / "models" / f"{PIN}.obj")
    row = f'wss.{PIN},Cup,"0\\,0\\,1",0.0254'
    _put(tmp_path / "metadata.csv", f"fullId,category,up,unit\n{row}\n")
    assert _said(tmp_path) == [Metadata(names=("Cup",), up="z", metres=0.0254)]


@pytest.mark.parametrize(
    "text",
    [b"", b"\x1f\x8b\x08 damaged", b"[" * 100_000, b"[1, 2]", b'{"a": 1}', gzip.compress(b"{" * 9, mtime=0)[:-9]],
)
def test_damaged_tables_say_nothing(tmp_path, text):
    _put(tmp_path / "cup.obj")
    _put(tmp_path / "metadata" / "objects.json.gz", text)
    _put(tmp_path / "metadata" / "objects.json", text)
    _put(tmp_path / "cup.json", text)
    assert _said(tmp_path) == [Metadata()]


def test_metadata_of_a_folder_of_many_name_none_of_them(tmp_path):
    _put(tmp_path / "meta.json", {"name": "My data set", "up": "y"})
    _put(tmp_path / "cup.obj")
    _put(tmp_path / "plate.obj")
    assert _said(tmp_path) == [Metadata(), Metadata()]


def test_what_metadata_say_anew_is_read_anew(tmp_path, monkeypatch):
    monkeypatch.setenv("PAT3D_DATA", str(tmp_path / "data"))
    folder = tmp_path / "objects" / "4711"
    folder.mkdir(parents=True)
    trimesh.creation.box((0.06, 0.09, 0.18)).export(folder / "model.stl")
    _put(folder / "meta.json", {"name": "Brick", "density": 2000})
    add_library(tmp_path / "objects", "lab", workers=1)
    [entry] = open_library("lab").entries
    assert entry.key == "brick"
    assert entry.facts["mass"] == pytest.approx(2000 * 0.06 * 0.09 * 0.18, rel=1e-6)  # 32-bit file
    _put(folder / "meta.json", {"name": "Brick", "mass": 1.5})
    add_library(tmp_path / "objects", "lab", workers=1)
    [entry] = open_library("lab").entries
    assert entry.facts["mass"] == 1.5


def test_accents_and_remarks_are_no_words():
    assert words_of("Tässchen_groß") == ["tasschen", "gross"]
    assert title_words("Fruit Bowl (Low Poly)") == ["fruit", "bowl"]
    assert title_words("Low Poly") == ["low", "poly"]
    assert synonyms_of(["object"], ("Salad Bowl",), frozenset({"bowl"}))[2] == "bowl"


def test_a_declared_size_that_is_unlike_its_kind_is_a_doubt(tmp_path):
    """The format says metres, yet a bowl of two metres is more likely a picture's than a dish."""
    trimesh.creation.box((2.0, 2.0, 0.8)).export(tmp_path / "bowl.glb")
    body = Body(mesh=load_mesh(tmp_path / "bowl.glb"), metres=1.0, declared="the glTF standard")
    small = Typical(noun="bowl", size=(0.16, 0.16, 0.06))
    assert guess_unit(body, small).confidence < SURE
    assert guess_unit(body, None).confidence == 1.0
    assert guess_unit(body, Typical(noun="table", size=(1.4, 0.8, 0.74))).confidence == 1.0


def test_names_in_latin_1_and_stl_files_that_end_early(tmp_path):
    made = trimesh.creation.box((0.1, 0.1, 0.1))
    lines = ["mtllib Körper.mtl", "usemtl Körper", *(f"v {x} {y} {z}" for x, y, z in made.vertices)]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in made.faces]
    (tmp_path / "box.obj").write_bytes("\n".join(lines).encode("latin-1"))
    (tmp_path / "Körper.mtl").write_bytes("newmtl Körper\nKd 1 0 0\n".encode("latin-1"))
    assert load_mesh(tmp_path / "box.obj").texture.reshape(-1, 3)[0].tolist() == [255, 0, 0]
    made.export(tmp_path / "whole.stl")
    (tmp_path / "cut.stl").write_bytes((tmp_path / "whole.stl").read_bytes()[:300])
    with pytest.raises(AssetError, match=r"12 triangles, which take 684 bytes, and it has 300"):
        load_mesh(tmp_path / "cut.stl")
