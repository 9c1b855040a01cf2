"""`pat3d bench table1`: its variants of one prompt, its means, its second run."""

from __future__ import annotations

import json
import math

import pytest

from pat3d.cli.main import main
from pat3d.cli.reading import chat
from pat3d.generation import table1 as module
from pat3d.generation.settings import Settings
from pat3d.generation.table1 import COLUMNS, PUBLISHED, VARIANTS, Entry, means, table1
from tests.generation.pictured import painted_and_labelled


def entry(variant: str, **values: float | None) -> Entry:
    return Entry(prompt="a", variant=variant, values={**dict.fromkeys(COLUMNS), **values})


def test_means_leave_out_what_is_absent():
    first, second, *_, last = VARIANTS
    rows = means([entry(first, D=1.0), entry(first, D=2.0, R=3.0), entry(last, D=math.inf)])
    assert (rows[first]["D"], rows[first]["R"], rows[first]["clip"]) == (1.5, 3.0, None)
    assert rows[last]["D"] == math.inf
    assert rows[second] == dict.fromkeys(COLUMNS)


def test_what_is_written_is_read_back():
    one = Entry(prompt="a", variant="b", values={"D": math.inf, "R": None, "clip": 1.0}, absent=("x",), failed="y")
    assert module._read(json.loads(json.dumps(module._written(one)))) == one


@pytest.mark.slow
def test_the_layout_moves_the_scene_does_not_and_a_second_run_measures_nothing(tmp_path, capsys, monkeypatch):
    (tmp_path / "prompts.txt").write_text("a red mug on a book\na zorblax\n")
    out = str(tmp_path / "out")
    command = ["bench", "table1", str(tmp_path / "prompts.txt"), "--out", out, "--json"]
    assert main(command) == 1, "one prompt is refused"
    found = json.loads(capsys.readouterr().out)
    by_variant = {one["variant"]: one for one in found["entries"] if one["prompt"] == "a red mug on a book"}
    assert list(by_variant) == list(VARIANTS[1:]), "a sentence has no raw layout"
    # The mug starts 0.3 mm or more above the book and comes to rest on it.
    assert by_variant["initialisation"]["values"]["D"] > 1e-3
    assert by_variant["full method"]["values"]["D"] < 1e-4
    assert by_variant["no scene tree"]["values"]["D"] < 1e-4
    assert all("zorblax" in one["failed"] for one in found["entries"] if one["prompt"] == "a zorblax")
    assert found["published"].keys() == PUBLISHED.keys()
    monkeypatch.setattr(module, "measure", lambda *_, **__: pytest.fail("measured again"))
    assert main(command) == 1
    assert json.loads(capsys.readouterr().out) == found


def test_painting_names_every_model_that_is_missing_before_anything_is_made(tmp_path, capsys, monkeypatch):
    for name in ("PAT3D_DEPTH_MODEL", "PAT3D_SEGMENTATION_MODEL", "PAT3D_IMAGE_MODEL", "PAT3D_MODEL", "PAT3D_CONFIG"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    chat.cache_clear()
    (tmp_path / "prompts.txt").write_text("a red mug on a book\n")
    assert main(["bench", "table1", "prompts.txt", "--out", "out", "--paint"]) == 2
    told = capsys.readouterr().err
    for name in ("PAT3D_IMAGE_MODEL", "PAT3D_SEGMENTATION_MODEL", "PAT3D_DEPTH_MODEL", "PAT3D_MODEL"):
        assert name in told
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_a_painted_prompt_is_measured_as_it_was_fitted_too(tmp_path, monkeypatch):
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    monkeypatch.setenv("PAT3D_CACHE", str(tmp_path / "cache"))
    with painted_and_labelled() as (lookers, server):
        (found,) = table1(["a mug and a box"], tmp_path / "out", settings=Settings(formats=("mjcf",)), lookers=lookers)
        assert len(server.requests) == 3
        again = table1(["a mug and a box"], tmp_path / "out", settings=Settings(formats=("mjcf",)), lookers=lookers)
        assert list(again) == [found]
    assert [one.variant for one in found] == list(VARIANTS)
    assert not any(one.failed for one in found)
    values = {one.variant: one.values["D"] for one in found}
    assert values["full method"] < 1e-4
    assert 0.0 <= values["raw layout"] < 0.1
