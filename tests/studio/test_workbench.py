"""One session for all: changes come one at a time, long work is told of and cancelled, what fails changes nothing."""

import threading

import pytest

from pat3d.errors import EditError
from pat3d.progress import Event
from pat3d.studio.facts import orders
from pat3d.studio.session import Session
from pat3d.studio.workbench import Workbench, needed
from tests.studio.bricks import bricks_in


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    return Session.opened(bricks_in(tmp_path_factory.mktemp("scenes") / "bricks"))


def test_what_is_refused_says_why_and_changes_nothing(session):
    bench = Workbench(session)
    assert not bench.do(lambda now: needed(now).undone())
    assert bench.session is session
    assert bench.status.failed
    assert "nothing to undo" in bench.status.said


def test_without_a_scene_every_step_says_so():
    bench = Workbench(None)
    assert not bench.do(lambda now: needed(now).removed())
    assert "no scene yet" in bench.status.said


def test_a_fault_of_one_step_does_not_end_the_studio(session, capsys):
    bench = Workbench(session)
    assert not bench.do(lambda now: 1 / 0)
    assert "ZeroDivisionError" in bench.status.said
    assert "ZeroDivisionError" in capsys.readouterr().err
    assert bench.do(lambda now: needed(now).select("brick"))


def test_changes_from_many_threads_are_all_done(session):
    """A change that reads the session before another one has ended would lose that one's step."""
    bench = Workbench(session)

    def move():
        for _ in range(4):
            bench.do(lambda now: needed(now).edited("set", "brick: friction=0.5"))

    threads = [threading.Thread(target=move) for _ in range(4)]
    for one in threads:
        one.start()
    for one in threads:
        one.join()
    assert len(needed(bench.session).past) == 16


class Held:
    """Work that waits until it is let go, and then takes another step."""

    def __init__(self):
        self.begun, self.go = threading.Event(), threading.Event()

    def __call__(self, now, progress):
        progress(Event(stage="settling", step=1, steps=4))
        self.begun.set()
        self.go.wait(60)
        progress(Event(stage="settling", step=2, steps=4))
        return now.select("brick"), "done"


def test_while_work_goes_on_its_stage_is_told_and_nothing_else_begins(session):
    bench, work, seen = Workbench(session), Held(), []
    bench.changed = lambda: seen.append(bench.status)
    assert bench.start("Settling", work)
    assert work.begun.wait(60)
    assert bench.status.working == "Settling"
    assert bench.status.stage == "settling, step 2"
    assert bench.status.share == pytest.approx(0.5)
    assert not bench.start("Saving", work)
    assert not bench.do(lambda now: needed(now).removed())
    assert "Settling is going on" in bench.status.said
    work.go.set()
    assert bench.wait(60)
    assert needed(bench.session).selected == "brick"
    assert bench.status.said == "done"
    assert not bench.status.working
    assert seen[-1] == bench.status


def test_cancelled_work_changes_nothing_and_lets_others_begin(session):
    bench, work = Workbench(session), Held()
    bench.start("Settling", work)
    assert work.begun.wait(60)
    bench.cancel()
    work.go.set()
    assert bench.wait(60)
    assert bench.session is session
    assert "cancelled" in bench.status.said
    assert bench.do(lambda now: needed(now).select("block"))


def test_work_that_fails_says_why(session):
    def work(now, progress):
        raise EditError("it topples.")

    bench = Workbench(session)
    bench.start("Settling", work)
    assert bench.wait(60)
    assert bench.status.failed
    assert bench.status.said == "it topples."
    assert bench.session is session


def saying(name):
    return lambda now, progress: (needed(now).edited("set", f"brick: mass={name}"), f"made {name}")


def test_orders_are_done_one_after_the_other_and_told_of(session):
    bench, work = Workbench(session), Held()

    def refused(now, progress):
        raise EditError("no room.")

    assert bench.order("Making", "one", work)
    assert work.begun.wait(60)
    for title, order in (("two", saying(2)), ("three", refused), ("four", saying(4))):
        assert bench.order("Making", title, order)
    assert [one.state for one in bench.orders] == ["working", "waiting", "waiting", "waiting"]
    assert not bench.start("Settling", work)
    work.go.set()
    assert bench.wait(60)
    assert [one.state for one in bench.orders] == ["done", "done", "refused", "done"]
    assert [one.said for one in bench.orders] == ["done", "made 2", "no room.", "made 4"]
    assert len(needed(bench.session).past) == 2


def test_cancelling_ends_one_order_and_the_next_begins(session):
    bench, work = Workbench(session), Held()
    bench.order("Making", "one", work)
    bench.order("Making", "two", saying(2))
    assert work.begun.wait(60)
    bench.cancel()
    work.go.set()
    assert bench.wait(60)
    assert [one.state for one in bench.orders] == ["cancelled", "done"]


def test_what_waits_can_be_dropped_and_is_not_without_end(session, monkeypatch):
    monkeypatch.setattr("pat3d.studio.workbench.MAX_WAITING", 2)
    bench, work = Workbench(session), Held()
    bench.order("Making", "one", work)
    assert work.begun.wait(60)
    assert bench.order("Making", "two", saying(2))
    assert bench.order("Making", "three", saying(3))
    assert not bench.order("Making", "four", saying(4))
    bench.forget()
    work.go.set()
    assert bench.wait(60)
    assert [one.state for one in bench.orders] == ["done", "cancelled", "cancelled"]
    assert bench.session is not None
    assert needed(bench.session).past == ()


def test_orders_are_listed_the_latest_first():
    bench = Workbench(None)
    bench.order("Making", "a *red* mug", lambda now, progress: (now, "made"))
    assert bench.wait(60)
    bench.order("Making", "a book", lambda now, progress: needed(now))
    assert bench.wait(60)
    first, second = orders(bench.orders).splitlines()
    assert first.startswith("- a book: **refused**, there is no scene yet")
    assert second == "- a \\*red\\* mug: **done**, made"
