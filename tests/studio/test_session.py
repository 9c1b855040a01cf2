"""Sessions are values: every step gives another one, and undo gives back the very state before."""

import numpy as np
import pytest

from pat3d.errors import EditError
from pat3d.geometry.pose import Pose
from pat3d.studio.session import MAX_WORDS, Session
from tests.studio.bricks import bricks_in


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    return Session.opened(bricks_in(tmp_path_factory.mktemp("scenes") / "bricks"))


def names(session):
    return [obj.name for obj in session.scene.objects]


def test_removing_is_a_step_that_undo_takes_back_and_redo_does_again(session):
    removed = session.select("block").removed()
    assert names(removed) == ["board", "brick"]
    assert removed.selected is None
    assert not removed.at_rest
    back = removed.undone()
    assert back.current is session.current
    assert back.redone().current is removed.current
    assert names(session) == ["board", "brick", "block"]


def test_a_new_step_forgets_what_was_undone(session):
    other = session.select("block").removed().undone().edited("move", "brick: 2 cm left")
    with pytest.raises(EditError, match="nothing to redo"):
        other.redone()


def test_there_is_nothing_to_undo_at_the_beginning(session):
    with pytest.raises(EditError, match="nothing to undo"):
        session.undone()


def test_what_is_not_there_cannot_be_selected(session):
    with pytest.raises(EditError, match=r'no "vase".*brick'):
        session.select("vase")


@pytest.mark.parametrize("step", [Session.removed, lambda one: one.dragged(Pose())])
def test_steps_on_the_selected_object_need_one(session, step):
    with pytest.raises(EditError, match="select an object"):
        step(session)


@pytest.mark.parametrize(("words", "why"), [("   ", "say what to add"), ("a" * (MAX_WORDS + 1), "characters")])
def test_words_have_to_be_there_and_have_a_limit(session, words, why):
    with pytest.raises(EditError, match=why):
        session.edited("add", words)


def test_a_drag_moves_and_turns_as_far_as_the_gizmo_did(session):
    """Lifted by the gizmo or not, the brick is put down on the board, 1 mm over it, and its edits are kept in words."""
    start = session.scene["brick"].pose
    there = Pose.from_yaw(0.3, (start.position[0] - 0.0312, start.position[1] + 0.0127, 0.5))
    found = session.select("brick").dragged(there)
    pose = found.scene["brick"].pose
    assert pose.position[:2] == pytest.approx(there.position[:2], abs=1e-6)
    assert pose.position[2] == pytest.approx(0.021, abs=5e-4)
    assert pose.quat_wxyz == pytest.approx(there.quat_wxyz, abs=1e-4)
    assert [edit.verb for edit in found.current.edits] == ["move", "turn"]
    assert found.undone().current is session.current


def test_a_drag_by_less_than_anyone_sees_is_a_click(session):
    chosen = session.select("brick")
    x, y, z = session.scene["brick"].pose.position
    assert chosen.dragged(Pose(position=(x + 1e-5, y, z))) is chosen


def test_a_drag_into_something_is_refused_with_the_reason(session):
    x, y, _ = session.scene["board"].pose.position
    with pytest.raises(EditError, match="board"):
        session.select("block").dragged(Pose(position=(x + 0.12, y, 0.0)))


def test_settling_verifies_and_can_be_undone(session):
    edited = session.edited("move", "brick: 2 cm left")
    assert edited.verification == {}
    places = []
    settled = edited.settled(lambda event: places.append(event.places()) if event.places else None)
    # Whoever watches sees the brick come down from where it was put to where it stays.
    heights = [poses["brick"].position[2] for poses in places]
    assert edited.scene["brick"].pose.position[2] > heights[0] > heights[-1]
    for name in ("board", "brick", "block"):
        assert np.allclose(places[-1][name].position, settled.scene[name].pose.position, atol=1e-5)
    assert settled.at_rest
    assert settled.verification["passed"]
    assert settled.verification["certificate"]["worst"] < 1e-3
    assert settled.scene["brick"].pose.position[0] == pytest.approx(0.03, abs=1e-3)
    assert settled.undone().current is edited.current
    with pytest.raises(EditError, match="nothing was edited"):
        session.settled()


def test_what_progress_raises_leaves_the_session(session):
    class StopError(Exception):
        pass

    def stop(event):
        raise StopError

    edited = session.edited("move", "brick: 2 cm left")
    with pytest.raises(StopError):
        edited.settled(stop)
    assert not edited.at_rest
