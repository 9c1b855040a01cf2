import contextlib
import io
import json
import tomllib
import zlib
from pathlib import Path

import pytest
from PIL import Image

from pat3d.cli import doctor, extras, parts
from pat3d.cli.doctor import _number
from pat3d.cli.documents import PartFacts
from pat3d.cli.main import main
from tests.documents import document_of

ROOT = Path(__file__).parents[2]


@pytest.fixture
def small_catalogue(monkeypatch, tmp_path):
    """The first three nouns only, and a cache of its own."""
    from pat3d.assets import catalogue
    from pat3d.cli import catalogue as browse

    three = catalogue.entries()[:3]
    monkeypatch.setattr(browse.nouns, "entries", lambda: three)
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


def test_the_sizes_of_every_noun_ship_with_the_package_and_nothing_is_measured(monkeypatch, capsys):
    from pat3d.cli import catalogue as browse

    def measured(noun, seed):
        raise AssertionError(f"{noun} was measured")

    monkeypatch.setattr(browse, "_size_of", measured)
    assert main(["catalogue"]) == 0
    assert f"{len(browse.nouns.entries())} nouns" in capsys.readouterr().out


@pytest.mark.parametrize("share", [pytest.param(1, marks=pytest.mark.slow), 40])
def test_the_sizes_that_ship_are_those_of_the_recipes(share):
    """One noun in 40, chosen by its name; all of them in the slow test. `measure_shipped` writes them anew."""
    from pat3d.cli import catalogue as browse

    shipped = json.loads(browse.shipped_sizes().read_text())
    found = browse.nouns.entries()
    assert set(shipped) == {entry.noun for entry in found}
    for entry in found:
        if zlib.crc32(entry.noun.encode()) % share == 0:
            assert browse._size_of(entry.noun, 0) == pytest.approx(shipped[entry.noun], abs=1e-4)


def test_a_damaged_size_cache_is_measured_again(small_catalogue, tmp_path, capsys):
    assert main(["catalogue", "--seed", "1"]) == 0
    first = capsys.readouterr().out
    (cache,) = (tmp_path / "cache").glob("catalogue-*.json")
    cache.write_text(json.dumps({small_catalogue[0].noun: "big"}))
    assert main(["catalogue", "--seed", "1"]) == 0
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


@pytest.fixture(scope="module")
def examined(tmp_path_factory):
    """What doctor says of this computer, by what it is about."""
    stream, code = io.StringIO(), 1
    with contextlib.redirect_stdout(stream):
        code = main(["doctor"])
    assert code == 0, stream.getvalue()
    rows = [line.split(maxsplit=2) for line in stream.getvalue().splitlines() if not line.startswith(" ")]
    return {row[1]: row for row in rows}


def test_doctor_reads_what_pyproject_asks_for_and_repeats_nothing(examined):
    with (ROOT / "pyproject.toml").open("rb") as file:
        project = tomllib.load(file)["project"]
    lines = project["dependencies"] + [
        line for extra, lines in project["optional-dependencies"].items() if extra != "dev" for line in lines
    ]
    names = {extras.read(line).name for line in lines} - {"pat3d"}
    assert names <= set(examined)
    # What this test wants to notice is a second list: no package is named in doctor's own source.
    source = Path(doctor.__file__).read_text()
    assert [name for name in names if f'"{name}"' in source] == []
    assert set(extras.ENABLES) == set(project["optional-dependencies"]) - {"dev"}


def test_doctor_does_a_real_step_of_every_part_that_is_installed(examined):
    for part in parts.PARTS:
        state, _, said = examined[part.name.split()[0]]
        if part.missing or part.gpu:
            assert (state, said.startswith("not tried for want of")) == ("no", True)
        else:
            assert (state, "not tried" in said) == ("ok", False), said


def test_a_part_that_does_not_work_is_a_fault_and_the_others_are_still_tried(monkeypatch, capsys):
    def broken(folder):
        raise AttributeError("'MjData' object has no attribute 'qM'")

    tried = (parts.Part(name="first", step=broken), parts.Part(name="second", step=lambda folder: "worked"))
    monkeypatch.setattr(parts, "PARTS", tried)
    assert main(["doctor"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert any(line.startswith("FAULT") and "'MjData' object has no attribute 'qM'" in line for line in lines)
    assert any(line.split() == ["ok", "second", "worked"] for line in lines)
    told = document_of(capsys, ["doctor"], list[PartFacts], code=1)
    assert {"state": "ok", "part": "second", "found": "worked"} in told


def test_doctor_names_a_package_that_is_too_old_or_missing(monkeypatch, capsys):
    wanted = (
        extras.Requirement(name="numpy", least="999.0", extra=""),
        extras.Requirement(name="absent-package", least="1.0", extra=""),
        extras.Requirement(name="absent-extra", least="1.0", extra="usd"),
    )
    monkeypatch.setattr(doctor, "requirements", lambda: wanted)
    monkeypatch.setattr(parts, "PARTS", ())
    assert main(["doctor"]) == 1
    rows = {line.split()[1]: line for line in capsys.readouterr().out.splitlines()}
    assert rows["numpy"].startswith("FAULT")
    assert "999.0" in rows["numpy"]
    assert rows["absent-package"].startswith("FAULT")
    assert rows["absent-extra"].startswith("no")
    assert "pat3d[usd]" in rows["absent-extra"]


def test_doctor_says_which_model_is_set_up_and_what_is_missing(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    for name in ("PAT3D_MODEL", "PAT3D_MODEL_URL", "PAT3D_MODEL_KEY", "PAT3D_CONFIG", "OPENAI_API_KEY"):
        monkeypatch.delenv(name, raising=False)
    rows = []
    monkeypatch.setattr(doctor.Table, "add", lambda table, *row: rows.append(row))
    doctor._model(doctor.Table())
    monkeypatch.setenv("PAT3D_MODEL", "small")
    doctor._model(doctor.Table())
    monkeypatch.setenv("PAT3D_MODEL_KEY", "sk-secret")
    doctor._model(doctor.Table())
    assert [row[0] for row in rows] == ["no", "ok", "ok"]
    assert "PAT3D_MODEL" in rows[0][2]
    assert rows[1][2] == "small on api.openai.com, with no key (PAT3D_MODEL_KEY or OPENAI_API_KEY)"
    assert "sk-secret" not in rows[2][2]


@pytest.mark.parametrize(
    ("line", "name", "least", "extra"),
    [
        ("numpy>=2.0", "numpy", "2.0", ""),
        ('imageio-ffmpeg>=0.5; extra == "eval"', "imageio-ffmpeg", "0.5", "eval"),
        ('pat3d[robots]; extra == "eval"', "pat3d", "", "eval"),
        ("mujoco<5,>=3.9; extra == 'gpu'", "mujoco", "3.9", "gpu"),
    ],
)
def test_requirements_are_read_from_the_lines_of_the_metadata(line, name, least, extra):
    assert extras.read(line) == extras.Requirement(name=name, least=least, extra=extra)


@pytest.mark.parametrize(("text", "number"), [("3.9.0", (3, 9, 0)), ("2.13.0+cpu", (2, 13, 0)), ("4.0rc1", (4, 0))])
def test_versions_compare_as_numbers(text, number):
    assert _number(text) == number


def test_check_of_a_folder_without_a_scene_is_one_line(tmp_path, capsys):
    assert main(["check", str(tmp_path)]) == 2
    assert "scene.json" in capsys.readouterr().err
