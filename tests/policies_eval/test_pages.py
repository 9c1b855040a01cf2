"""What is told of an evaluation, on records made by hand: which tables are shown, and what happened in an episode."""

from __future__ import annotations

import io
import re
from dataclasses import replace

import pytest
from rich.console import Console

from pat3d.policies_eval.analysis.report import write_report
from pat3d.policies_eval.analysis.summary import show_summary, summarise
from pat3d.policies_eval.run.episodes import Episode
from pat3d.policies_eval.run.records import Evaluation
from pat3d.policies_eval.run.rollout import NO_EVENTS, Result
from pat3d.scene.task_spec import AND_THEN


def episode(index, task="pick:cup", scene="one", **axes):
    return Episode(index=index, scene=scene, task=task, seed=index, axes=tuple(axes.items()))


def missed(made, **events):
    return Result(episode=made, outcome="missed", success=False, steps=3, events=replace(NO_EVENTS, **events))


def evaluation(folder, *results):
    manifest = {"policy": "mine", "episodes": len(results), "engine": {}, "settings": {}, "source": {}}
    return Evaluation(folder=folder, manifest=manifest, results=results)


def page(folder, *results):
    found = evaluation(folder, *results)
    return write_report(found, summarise(found), pictures=False).read_text(encoding="utf-8")


def test_the_page_has_a_table_of_whatever_there_are_two_kinds_of_and_of_nothing_else(tmp_path):
    """Two tasks and two objects, three clutters, one light; one scene and no perturbation."""
    clutter = ("low", "high", "none", "low")
    tasks = ("pick:cup", "pick:bowl", "push:cup", "pick:cup")
    shown = [
        missed(episode(k, task, clutter=level, light="day"))
        for k, (task, level) in enumerate(zip(tasks, clutter, strict=True))
    ]
    headings = re.findall(r"<h2>By (\w+)</h2>", page(tmp_path, *shown))
    assert sorted(headings) == ["clutter", "object", "task"]


def test_the_console_has_a_line_for_each_of_two_kinds_but_for_scenes(tmp_path):
    shown = [missed(episode(k, task, scene=f"s{k}", light="day")) for k, task in enumerate(("pick:cup", "push:cup"))]
    console = Console(file=io.StringIO(), width=200)
    show_summary(console, summarise(evaluation(tmp_path, *shown)))
    assert isinstance(console.file, io.StringIO)
    lines = [line.split(":")[0].strip() for line in console.file.getvalue().splitlines()]
    assert [line for line in lines if line.startswith(("task", "object", "scene", "light", "perturbation"))] == [
        "task pick",
        "task push",
    ]


def test_episodes_are_counted_by_the_object_that_is_moved_first(tmp_path):
    """A task of a kind that this version does not know counts for the first object it names."""
    tasks = ("place:can:tray", f"chain:place:cup:tray{AND_THEN}pick:can", "juggle:ball:can", "sort", "juggle")
    counted = summarise(evaluation(tmp_path, *(missed(episode(k, task)) for k, task in enumerate(tasks))))
    assert {name: rate.episodes for name, rate in counted.tables["object"].items()} == {"can": 1, "cup": 1, "ball": 1}


@pytest.mark.parametrize(
    ("closest", "grasped", "said"),
    [(0.0, False, "0.0 cm"), (0.0461, False, "4.6 cm"), (-1.0, False, None), (0.0, True, None), (0.05, True, None)],
)
def test_how_near_a_hand_came_is_said_where_it_is_known_and_the_hand_held_nothing(tmp_path, closest, grasped, said):
    """It is -1 where nothing was measured, and may be 0: the hand's site in the middle of the object."""
    told = page(tmp_path, missed(episode(0), closest=closest, grasped=grasped))
    assert re.findall(r"came within ([^<,]+)", told) == ([] if said is None else [said])
