"""What a user may ask of every scene: the tilt that it stands, and the processor time that it takes."""

import json
import os

import pytest

from pat3d.cli.main import main
from pat3d.errors import CpuLimitError
from pat3d.progress import CpuBudget, Event
from pat3d.scene.io import load_scene

BOOKEND = """\
objects:
  - {name: slim, mesh: slim.obj, parts: box, pose: {position: [0, 0, 0.001]}}
"""


@pytest.fixture
def slim(tmp_path):
    """A box 1 cm wide and 40 cm high, which stands atan(1 / 40) = 1.43 degrees, and 1.36 on worn edges."""
    corners = [(x, y, z) for x in (-0.005, 0.005) for y in (-0.05, 0.05) for z in (0.0, 0.4)]
    faces = ["1 2 4", "1 4 3", "5 7 8", "5 8 6", "1 5 6", "1 6 2", "3 4 8", "3 8 7", "1 3 7", "1 7 5", "2 6 8", "2 8 4"]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + [f"f {face}" for face in faces]
    (tmp_path / "slim.obj").write_text("\n".join(lines))
    (tmp_path / "scene.yaml").write_text(BOOKEND)
    return tmp_path


@pytest.mark.parametrize(("asked", "code"), [("1.3", 0), ("1.5", 1)])
def test_the_least_tilt_decides_and_check_applies_the_same(slim, capfd, asked, code):
    build = ["build", str(slim / "scene.yaml"), "--out", str(slim / "out"), "--least-tilt", asked]
    assert main(build) == code
    assert load_scene(slim / "out").least_tilt == float(asked)
    certificate = json.loads((slim / "out" / "report.json").read_text())["verification"]["certificate"]
    assert certificate["least_tilt"] == float(asked)
    assert certificate["largest_tilt"] == pytest.approx(1.36, abs=0.02)
    capfd.readouterr()
    assert main(["check", str(slim / "out")]) == code
    line = (
        '"slim" balances on too little: more than 1.36 degrees of tilt upset it. This scene has to stand 1.50 degrees'
    )
    assert (line in capfd.readouterr().err) is bool(code)


@pytest.mark.parametrize("asked", ["-1", "8.1", "nan"])
def test_a_tilt_that_nobody_can_ask_for_is_one_line(slim, capfd, asked):
    assert main(["build", str(slim / "scene.yaml"), "--out", str(slim / "out"), f"--least-tilt={asked}"]) == 2
    assert "0 to 8 degrees" in capfd.readouterr().err


def test_a_scene_that_takes_more_of_the_processor_is_refused_and_nothing_is_written(slim, capfd):
    arguments = ["build", str(slim / "scene.yaml"), "--out", str(slim / "out"), "--cpu-limit"]
    assert main([*arguments, "1e-9"]) == 2
    assert "limit of 1e-09 s of processor time was reached while" in capfd.readouterr().err
    assert not (slim / "out").exists()
    assert main([*arguments, "0"]) == 2
    assert main([*arguments, "1000"]) == 0


def test_processor_time_counts_and_waiting_does_not(monkeypatch):
    spent = [0.0] * 5
    monkeypatch.setattr(os, "times", lambda: tuple(spent))
    heard = []
    tell = CpuBudget(3.0).watching(heard.append)
    spent[4] = 1000.0
    tell(Event(stage="settling"))
    # Of the process and of its children, for itself and in the system.
    spent[:4] = 0.5, 0.5, 0.5, 1.4
    tell(Event(stage="settling", step=7))
    spent[3] = 1.6
    with pytest.raises(CpuLimitError, match="while settling, step 8"):
        tell(Event(stage="settling", step=8))
    assert len(heard) == 2
