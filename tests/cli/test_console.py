import io

from rich.console import Console

from pat3d.cli.console import _length, _said_back, _words, watch
from pat3d.generation.request import request_of
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.progress import Event


def test_a_log_hears_of_every_stage_once():
    stream = io.StringIO()
    with watch(Console(file=stream, width=100)) as progress:
        for step in range(200):
            progress(Event(stage="settling", step=step, motion=1e-3))
        progress(Event(stage="proving", detail="[equilibrium]", step=0, steps=4))
    lines = stream.getvalue().splitlines()
    assert len(lines) == 2
    assert lines[1].endswith("proving 1/4: [equilibrium]")


def test_a_terminal_sees_the_stage_and_the_time_and_keeps_nothing():
    stream = io.StringIO()
    with watch(Console(file=stream, width=100, force_terminal=True)) as progress:
        progress(Event(stage="settling", step=7, motion=2e-3))
        progress(Event(stage="proving", detail="[bold]"))
    text = stream.getvalue()
    assert "proving: [bold]" in text
    assert "0:00:0" in text


def test_events_read_as_sentences():
    assert _words(Event(stage="planning")) == "planning"
    assert _words(Event(stage="settling", step=3, motion=0.0123)) == "settling, step 3, moving 12.3 mm"
    assert [_length(value) for value in (2e-9, 3.2e-5, 0.5, 2.0)] == ["2 nm", "32 um", "500 mm", "2 m"]


def test_what_the_planner_left_out_is_printed():
    plan = GrammarPlanner().plan("A tilted mug on the floor")
    assert _said_back(request_of(plan, False).record) == (
        'not arranged: "tilted"; "A tilted mug" is placed the way the catalogue makes it',
        "set aside: the floor",
    )
    assert _said_back({}) == ()
