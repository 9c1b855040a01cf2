"""Long work in a process: its result and its refusals come back, and when it is cancelled nothing of it goes on."""

import os
import time
from pathlib import Path

import pytest

from pat3d.errors import EditError, SimulationError
from pat3d.geometry.pose import Pose
from pat3d.progress import Event
from pat3d.studio.session import Session
from pat3d.studio.workbench import CancelledError, Watch, Workbench, needed
from pat3d.studio.worker import Worker
from tests.studio.bricks import bricks_in


def number(*, progress):
    progress(Event(stage="counting", step=0, steps=1))
    return os.getpid()


def moving(*, progress):
    height = 2.0
    progress(Event(stage="falling", step=0, places=lambda: {"brick": Pose(position=(0.0, 0.0, height))}))
    height = 1.0


def endless(folder, *, progress):
    """Writes its process id, and goes on without telling anybody."""
    (folder / "pid").write_text(str(os.getpid()))
    while True:
        time.sleep(0.05)


def deadly(*, progress):
    os._exit(3)


def refusing(*, progress):
    raise EditError("it topples.")


def faulty(*, progress):
    raise ZeroDivisionError("division by zero")


@pytest.fixture(scope="module")
def worker(tmp_path_factory):
    made = Worker(tmp_path_factory.mktemp("scratch"))
    yield made
    made.close()


def lives(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_where_objects_are_in_a_step_comes_with_its_event(worker):
    heard = []
    worker.run(moving, progress=heard.append)
    (event,) = heard
    assert event.places() == {"brick": Pose(position=(0.0, 0.0, 2.0))}


def test_a_job_is_done_in_another_process_which_stays(worker):
    heard = []
    first = worker.run(number, progress=heard.append)
    assert first != os.getpid()
    assert worker.run(number) == first
    assert [event.stage for event in heard] == ["counting"]


def test_refusals_and_faults_come_back_as_they_were(worker, capfd):
    with pytest.raises(EditError, match=r"it topples\."):
        worker.run(refusing)
    with pytest.raises(RuntimeError, match="ZeroDivisionError"):
        worker.run(faulty)
    assert worker.run(number)


def test_a_process_that_ends_by_itself_is_said_and_another_one_takes_its_place(worker):
    with pytest.raises(SimulationError, match="deadly"):
        worker.run(deadly)
    assert worker.run(number)


def test_cancelled_work_that_tells_nothing_ends_and_another_can_begin(worker, tmp_path):
    bench = Workbench(None)
    assert bench.start("Counting", lambda now, progress: (worker.run(endless, tmp_path, progress=progress), "done"))
    file = tmp_path / "pid"
    while not (file.is_file() and file.read_text()):
        assert bench.status.working, bench.status.said
        time.sleep(0.02)
    assert lives(int(file.read_text()))
    bench.cancel()
    assert bench.wait(60)
    assert "cancelled" in bench.status.said
    assert not lives(int(file.read_text()))
    assert bench.start("Counting", lambda now, progress: (now, str(worker.run(number, progress=progress))))
    assert bench.wait(60)
    assert bench.status.said.isdigit()


def test_a_scene_that_settles_elsewhere_keeps_its_assets_and_can_be_undone(worker, tmp_path):
    session = Session.opened(bricks_in(tmp_path / "bricks")).edited("move", "brick: 2 cm left")
    settled = session.settled(Watch(lambda event: None, lambda: False), run=worker.run)
    assert settled.at_rest
    assert settled.verification["passed"]
    for obj in settled.scene.objects:
        assert obj.asset is session.scene[obj.name].asset
    assert settled.before is session.before
    heavier = settled.edited("set", "block: mass=2", run=worker.run)
    assert heavier.scene["block"].asset is not settled.scene["block"].asset
    assert heavier.scene["brick"].asset is settled.scene["brick"].asset
    with pytest.raises(EditError, match="vase"):
        settled.edited("remove", "vase", run=worker.run)


def test_cancelled_settling_leaves_the_session_as_it_was(worker, tmp_path):
    session = Session.opened(bricks_in(Path(tmp_path) / "bricks")).edited("move", "brick: 2 cm left")
    bench = Workbench(session)

    def work(now, progress):
        bench.cancel()
        return needed(now).settled(progress, run=worker.run), "settled"

    bench.start("Settling", work)
    assert bench.wait(60)
    assert bench.session is session
    assert "cancelled" in bench.status.said


def test_a_watch_raises_where_it_is_asked_to():
    cancelled = False
    watch = Watch(lambda event: None, lambda: cancelled)
    watch(Event(stage="one"))
    cancelled = True
    with pytest.raises(CancelledError):
        watch.check()


def test_a_process_that_was_warmed_is_the_one_that_works(tmp_path):
    made = Worker(tmp_path)
    try:
        made.warm(number)
        first = made.run(number)
        assert made.run(number) == first
        made.warm(faulty)
        assert made.run(number) == first
    finally:
        made.close()
    assert not lives(first)
