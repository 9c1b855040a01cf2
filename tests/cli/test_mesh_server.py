"""`pat3d generate --assets mesh:URL`, from the sentence to what MuJoCo loads, against a server on the loopback."""

import json

import numpy as np
import pytest
import trimesh

from pat3d.cli.main import main
from pat3d.scene.io import load_scene
from tests.assets.mesh_server import serving
from tests.loopback import Reply


def glb() -> bytes:
    """A box that is twice as tall along y as it is wide, in units that mean nothing."""
    data = trimesh.creation.box((1.0, 2.0, 1.0)).export(file_type="glb")
    assert isinstance(data, bytes)
    return data


@pytest.fixture(autouse=True)
def apart(tmp_path, monkeypatch):
    """Folders and environment of the test's own."""
    monkeypatch.setenv("PAT3D_DATA", str(tmp_path / "data"))
    monkeypatch.setenv("PAT3D_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    monkeypatch.setenv("PAT3D_MESH_KEY", "swordfish-93")
    for name in ("PAT3D_MESH_TIMEOUT", "PAT3D_MESH_PICTURES"):
        monkeypatch.delenv(name, raising=False)


def test_a_sentence_with_what_nothing_has_becomes_a_verified_scene(tmp_path, capsys):
    import mujoco

    out = tmp_path / "scene"
    with serving("generate", glb()) as server:
        words = ["a 30 cm tall gramophone on a wooden box", "--assets", f"mesh:{server.url}"]
        assert main(["plan", *words]) == 0
        assert server.asked == []
        assert main(["generate", *words, "--out", str(out), "--seed", "3"]) == 0
        assert server.count("POST /generate") == 1
        assert "gramophone" in server.asked[0]["text"]
    assert server.keys[-1] == "Bearer swordfish-93"
    scene = load_scene(out)
    made = next(obj for obj in scene.objects if "gramophone" in obj.name)
    np.testing.assert_allclose(made.asset.size, [0.15, 0.15, 0.3], rtol=1e-3)
    assert made.asset.provenance["source"] == "mesh"
    assert made.asset.provenance["parts"]["method"] == "coacd"
    report = json.loads((out / "report.json").read_text())
    assert report["passed"]
    model = mujoco.MjModel.from_xml_path(str(out / "mjcf" / "scene.xml"))
    names = [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_BODY, body) or "" for body in range(model.nbody)]
    assert any("gramophone" in name for name in names)
    kept = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert not any(b"swordfish-93" in path.read_bytes() for path in kept)


def test_a_mesh_that_is_none_is_told_and_nothing_is_written(tmp_path, capsys):
    out = tmp_path / "scene"
    with serving("generate", b"glTF\x02\0\0\0 nothing") as server:
        assert main(["generate", "a gramophone", "--assets", f"mesh:{server.url}", "--out", str(out)]) == 2
    assert "gramophone" in capsys.readouterr().err
    assert not out.exists()


def test_a_server_that_refuses_is_told_without_the_key(tmp_path, capsys):
    out = tmp_path / "scene"
    with serving("generate", glb()) as server:
        server.faults = {"POST /generate": [Reply(status=403, body=b"bad key swordfish-93")]}
        assert main(["generate", "a gramophone", "--assets", f"mesh:{server.url}", "--out", str(out)]) == 2
    said = capsys.readouterr().err
    assert "403" in said
    assert "swordfish-93" not in said
    assert not out.exists()


def test_what_is_no_server_is_told_before_anything_is_read(tmp_path, capsys):
    for said in ("http://127.0.0.1:1", "mesh:", "mesh:ftp://host", "mesh:http://user:secret@host"):
        assert main(["generate", "a gramophone", "--assets", said, "--out", str(tmp_path / "scene")]) == 2
        assert "secret" not in capsys.readouterr().err
