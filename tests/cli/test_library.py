"""`pat3d library` from adding a folder to removing its index."""

import pytest

from pat3d.cli.documents import LibraryFacts, LibraryObjectFacts
from pat3d.cli.main import main
from tests.assets.things_to_index import DOOR, URDF
from tests.documents import document_of


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("PAT3D_DATA", str(tmp_path / "data"))
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "kitchen_sponge.urdf").write_text(URDF)
    (tmp_path / "in" / "door.urdf").write_text(DOOR)
    return tmp_path / "in"


def test_a_folder_is_added_listed_shown_and_removed(folder, capsys):
    assert main(["library", "add", str(folder), "--name", "lab", "--workers", "1", "--no-pictures"]) == 0
    told = capsys.readouterr().out
    assert "lab: 1 objects ready" in told
    assert "refused: door.urdf: it has joints that move (hinge)" in told
    page = (folder.parent / "data" / "libraries" / "lab" / "index.html").read_text()
    assert "lab/kitchen_sponge" in page
    # "door" comes before "sponge", and what cannot be used after all that can.
    assert page.index("lab/kitchen_sponge") < page.index("joints that move")
    assert main(["library", "list"]) == 0
    assert f"lab: 1 objects, 1 refused, of {folder}" in capsys.readouterr().out
    assert main(["library", "show", "lab/sponge"]) == 0
    told = capsys.readouterr().out
    assert "0.25 kg, from URDF" in told
    assert "URDF says so" in told
    sponge = document_of(capsys, ["library", "show", "lab/sponge"], LibraryObjectFacts)
    assert sponge["mass_kg"] == pytest.approx(0.25)
    (lab,) = document_of(capsys, ["library", "list"], list[LibraryFacts])
    assert (lab["ready"], lab["refused"]) == (1, 1)
    assert next(one["reason"] for one in lab["objects"] if one["state"] == "refused").startswith("it has joints")
    assert main(["plan", "a lab sponge on a tray", "--libraries", "lab"]) == 0
    assert "lab sponge" in capsys.readouterr().out
    assert document_of(capsys, ["library", "remove", "lab"], LibraryFacts) == lab
    assert document_of(capsys, ["library", "list"], list[LibraryFacts]) == []
    assert sorted(path.name for path in folder.iterdir()) == ["door.urdf", "kitchen_sponge.urdf"]


def test_what_is_not_there_is_told(folder, capsys):
    assert main(["library", "show", "nothing"]) == 2
    assert main(["library", "add", str(folder / "nowhere"), "--name", "lab"]) == 2
    assert main(["library", "add", str(folder), "--name", "Lab"]) == 2
    told = capsys.readouterr().err
    assert "no library" in told
    assert "is no folder" in told
    assert "is no name for a library" in told
