"""`pat3d plan` says how a sentence is read; `--ask` asks where it has two readings."""

import builtins
import subprocess
import sys

import pytest

from pat3d.cli.main import main
from pat3d.cli.reading import AskingPlanner

TWO_READINGS = "a mug facing a laptop on a desk"


def test_plan_prints_the_telling_the_tree_the_notes_and_the_task(capsys):
    assert main(["plan", "put the soup in the basket and open the wardrobe"]) == 0
    told, _, rest = capsys.readouterr().out.partition("\n\n")
    assert told.startswith("A tomato soup, a basket and a wardrobe stand on the ground.") or "tomato soup" in told
    assert "ground\n  tomato soup\n  basket" in rest
    assert 'note: not modelled: "open the wardrobe": no task does that.' in rest
    assert "task: place:tomato soup:basket" in rest


def test_a_sentence_that_cannot_be_read_is_an_error_of_the_user(capsys):
    assert main(["plan", "una taza roja sobre la mesa"]) == 2
    assert "English" in capsys.readouterr().err


def test_plan_imports_nothing_that_makes_scenes():
    code = (
        "import sys; from pat3d.cli.main import main; main(['plan', 'a mug on a tray']); main(['plan', 'a mug']);"
        "print([name for name in ('scipy', 'warp', 'trimesh', 'mujoco', 'torch', 'rich') if name in sys.modules])"
    )
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)
    again = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert again.stdout.splitlines()[-1] == "[]"


@pytest.mark.parametrize(
    ("answers", "on_desk"),
    [([""], "laptop"), (["1"], "laptop"), (["2"], "mug"), (["9", "two", "-1", "\u0662", "2"], "mug")],
)
def test_asking_takes_the_reading_that_is_meant(monkeypatch, capsys, answers: list[str], on_desk: str):
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True, raising=False)
    given = iter(answers)
    monkeypatch.setattr(builtins, "input", lambda _: next(given))
    plan = AskingPlanner().plan(TWO_READINGS)
    assert [name for name in ("mug", "laptop") if plan.parent(name) == "desk"] == [on_desk]
    assert not list(given)
    assert capsys.readouterr().err.count("is none of them") == len(answers) - 1


def test_input_that_ends_takes_the_likelier_reading(monkeypatch):
    def end(_: str) -> str:
        raise EOFError

    monkeypatch.setattr(sys.stdin, "isatty", lambda: True, raising=False)
    monkeypatch.setattr(builtins, "input", end)
    assert AskingPlanner().plan(TWO_READINGS).parent("laptop") == "desk"


def test_nobody_is_asked_where_there_is_no_terminal(monkeypatch):
    monkeypatch.setattr(sys.stdin, "isatty", lambda: False, raising=False)
    monkeypatch.setattr(builtins, "input", lambda _: pytest.fail("asked"))
    assert AskingPlanner().plan(TWO_READINGS).otherwise
