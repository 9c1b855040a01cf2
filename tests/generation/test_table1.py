"""`pat3d bench table1`: its variants of one prompt, its means, its second run."""

from __future__ import annotations

import json
import math

import pytest

from pat3d.cli.main import main
from pat3d.generation import table1 as module
from pat3d.generation.table1 import COLUMNS, PUBLISHED, VARIANTS, Entry, means


def entry(variant: str, **values: float | None) -> Entry:
    return Entry(prompt="a", variant=variant, values={**dict.fromkeys(COLUMNS), **values})


def test_means_leave_out_what_is_absent():
    rows = means([entry(VARIANTS[0], D=1.0), entry(VARIANTS[0], D=2.0, R=3.0), entry(VARIANTS[3], D=math.inf)])
    assert (rows[VARIANTS[0]]["D"], rows[VARIANTS[0]]["R"], rows[VARIANTS[0]]["clip"]) == (1.5, 3.0, None)
    assert rows[VARIANTS[3]]["D"] == math.inf
    assert rows[VARIANTS[1]] == dict.fromkeys(COLUMNS)


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
    assert list(by_variant) == list(VARIANTS)
    # The mug starts 0.3 mm or more above the book and comes to rest on it.
    assert by_variant["initialisation"]["values"]["D"] > 1e-3
    assert by_variant["full method"]["values"]["D"] < 1e-4
    assert by_variant["no scene tree"]["values"]["D"] < 1e-4
    assert all("zorblax" in one["failed"] for one in found["entries"] if one["prompt"] == "a zorblax")
    assert found["published"].keys() == PUBLISHED.keys()
    monkeypatch.setattr(module, "measure", lambda *_, **__: pytest.fail("measured again"))
    assert main(command) == 1
    assert json.loads(capsys.readouterr().out) == found
