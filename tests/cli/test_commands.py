import json

import pytest
from PIL import Image

from pat3d.cli.doctor import NEEDED, _number
from pat3d.cli.main import main


@pytest.fixture
def small_catalogue(monkeypatch, tmp_path):
    """The first three nouns only, and a cache of its own."""
    from pat3d.assets import catalogue
    from pat3d.cli import catalogue as browse

    three = catalogue.entries()[:3]
    monkeypatch.setattr(browse.catalogue, "entries", lambda: three)
    monkeypatch.setenv("PAT3D_CACHE", str(tmp_path / "cache"))
    return three


def test_catalogue_lists_every_noun_with_its_size(small_catalogue, capsys):
    assert main(["catalogue"]) == 0
    first = capsys.readouterr().out
    assert "3 nouns" in first
    for entry in small_catalogue:
        line = next(line for line in first.splitlines() if line.strip().startswith(f"{entry.noun} "))
        assert line.count(" x ") == 2
    assert main(["catalogue"]) == 0
    assert capsys.readouterr().out == first


def test_a_damaged_size_cache_is_measured_again(small_catalogue, tmp_path, capsys):
    assert main(["catalogue"]) == 0
    first = capsys.readouterr().out
    (cache,) = (tmp_path / "cache").glob("catalogue-*.json")
    cache.write_text(json.dumps({small_catalogue[0].noun: "big"}))
    assert main(["catalogue"]) == 0
    assert capsys.readouterr().out == first


def test_catalogue_draws_a_sheet(small_catalogue, tmp_path):
    assert main(["catalogue", "--sheet", str(tmp_path / "all.png")]) == 0
    with Image.open(tmp_path / "all.png") as picture:
        assert picture.width > 3 * 200


def test_catalogue_shows_one_object_by_its_synonym(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["catalogue", "Coffee  Mug"]) == 0
    text = capsys.readouterr().out
    for word in ("mug", "tableware", "ceramic", "kg", "convex parts", "mug.png"):
        assert word in text
    assert (tmp_path / "mug.png").is_file()


def test_catalogue_names_the_nearest_nouns(capsys):
    assert main(["catalogue", "muug"]) == 2
    assert '"mug"' in capsys.readouterr().err
    assert main(["catalogue", "--out", "x.png"]) == 2


def test_doctor_finds_this_computer_well(capsys):
    assert main(["doctor"]) == 0
    text = capsys.readouterr().out
    for word in (*NEEDED, "Python", "cores", "kernels", "EGL", "torch", "usd-core", "gymnasium", "robosuite"):
        assert word in text
    assert "FAULT" not in text


def test_doctor_names_a_package_that_is_too_old(monkeypatch, capsys):
    monkeypatch.setitem(NEEDED, "numpy", "999.0")
    assert main(["doctor"]) == 1
    line = next(line for line in capsys.readouterr().out.splitlines() if " numpy " in line)
    assert line.startswith("FAULT")
    assert "999.0" in line


@pytest.mark.parametrize(("text", "number"), [("3.9.0", (3, 9, 0)), ("2.13.0+cpu", (2, 13, 0)), ("4.0rc1", (4, 0))])
def test_versions_compare_as_numbers(text, number):
    assert _number(text) == number


def test_check_of_a_folder_without_a_scene_is_one_line(tmp_path, capsys):
    assert main(["check", str(tmp_path)]) == 2
    assert "scene.json" in capsys.readouterr().err
