"""A recorded episode done again for a page: every state of it, and the figures that are charted."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

for package in ("gymnasium", "mujoco_menagerie", "pyarrow"):
    pytest.importorskip(package)

from pat3d.cli.main import main  # noqa: E402
from pat3d.errors import EvaluationError  # noqa: E402
from pat3d.policies_eval.run.records import read_evaluation  # noqa: E402
from pat3d.studio.episode import FIGURES, recorded  # noqa: E402
from pat3d.studio.episodes import listed  # noqa: E402

STEPS = 12


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = tmp_path_factory.mktemp("eval") / "scripted"
    arguments = ["--policy", "scripted", "--episodes", "2", "--max-steps", str(STEPS), "--no-pictures"]
    assert main(["evaluate", *arguments, "--out", str(out)]) == 0
    return out


@pytest.mark.slow
def test_every_step_is_there_and_the_states_are_the_recorded_ones(folder):
    events = []
    found = recorded(folder, 1, progress=events.append)
    assert found.same
    assert len(found) == STEPS + 1 == len(events)
    assert found.positions.shape == (STEPS + 1, len(found.bodies), 3)
    np.testing.assert_allclose(np.linalg.norm(found.quats, axis=2), 1.0, atol=1e-6)
    # The arm moves, the table stays.
    assert np.ptp(found.positions, axis=0).max() > 0.05
    assert (np.ptp(found.positions, axis=0) < 1e-6).all(axis=1).any()
    for body in found.bodies:
        assert body.corners.shape[1:] == (3, 3)
        assert len(body.colours) == len(body.corners)


def test_figures_are_those_of_the_state(folder):
    """The scripted hand comes nearer to the mug, which stands where it is."""
    found = recorded(folder, 0)
    assert set(found.figures) == set(FIGURES)
    hand = found.figures["hand"]
    assert hand[-1] < hand[0] - 1.0
    assert np.ptp(found.figures["height"]) < 0.1
    assert ((found.figures["progress"] >= 0.0) & (found.figures["progress"] <= 1.0)).all()


def test_an_episode_that_is_not_there_is_refused(folder):
    with pytest.raises(EvaluationError, match="no episode 7"):
        recorded(folder, 7)


def test_episodes_that_only_one_did_are_left_out_and_outcomes_choose(folder):
    one = read_evaluation(folder)
    outcome = one.results[0].outcome
    shorter: Any = SimpleNamespace(results=one.results[:1])
    assert list(listed([one])) == [0, 1]
    assert list(listed([one, shorter])) == [0]
    assert listed([one, shorter])[0].endswith(" / ".join([outcome.replace("_", " ")] * 2))
    assert listed([one], "success" if outcome != "success" else "missed") == {}
