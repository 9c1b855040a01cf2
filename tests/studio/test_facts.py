"""What a studio says of a scene after an edit has settled: figures of the new verification, and what moved."""

import re

import pytest

from pat3d.studio import facts
from pat3d.studio.session import Session
from tests.studio.bricks import bricks_in


@pytest.fixture(scope="module")
def settled(tmp_path_factory):
    session = Session.opened(bricks_in(tmp_path_factory.mktemp("scenes") / "bricks"))
    return session.edited("move", "brick: 2 cm left").settled().select("brick")


def test_every_object_has_its_drift_in_mujoco(settled):
    rows = facts.table(settled).splitlines()[2:]
    assert len(rows) == 3
    for row in rows:
        assert re.search(r"\| \d\.\d{3} mm \|$", row), row
    assert "drift in MuJoCo" in facts.about(settled)


def test_what_the_edit_moved_comes_first_and_by_how_much(settled):
    rows = [row.split(" | ") for row in facts.changed(settled).splitlines() if row.startswith("| b")]
    assert rows[0][0] == "| brick"
    assert float(rows[0][1]) == pytest.approx(20.0, abs=0.1)
    assert all(float(row[1]) < 0.1 for row in rows[1:])
    assert facts.changed(settled.undone()) == ""


def test_words_of_others_are_shown_as_they_are_and_lead_nowhere():
    shown = facts.plain("see https://example.org/a_b\n or <b>a@b.org</b>")
    # CommonMark: a backslash before a mark makes it a plain letter.
    assert re.sub(r"\\(.)", r"\1", shown) == "see https://example.org/a_b or <b>a@b.org</b>"
    assert not re.search(r"(?<!\\)[:@<_]", shown)
