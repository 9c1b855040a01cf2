"""Scenes whose objects are hardly in the picture are refused, whether they are small or hidden."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

pytest.importorskip("gymnasium")

from pat3d.assets.shapes import box
from pat3d.cli.main import main
from pat3d.envs.rendering.pictures import Pictures
from pat3d.envs.suites.check import check_sight
from pat3d.envs.suites.folder import SuiteFolder
from pat3d.envs.suites.generate import generate
from pat3d.envs.suites.manifest import begin_manifest
from pat3d.envs.suites.request import Request
from pat3d.envs.suites.sight import AGENT, SIDE, UnseenError, require_seen
from pat3d.envs.tasks.registry import parse_task
from pat3d.envs.tasks.rehearsal import workplace
from pat3d.errors import SuiteError
from pat3d.exporters.mjcf.writer import write_mjcf
from pat3d.scene.io import save_scene
from tests.envs.own_arm import own_arm
from tests.scenes import GAP, asset_of, placed, scene_of

THINGS = scene_of(
    placed("cube", asset_of(box(0.04, 0.04, 0.04)), (0.0, 0.0, GAP)),
    placed("post", asset_of(box(0.012, 0.012, 0.03)), (0.12, 0.0, GAP)),
)


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    return str(path)


def work(folder, arm, *more):
    """A cube of 40 mm with a post of 12 mm behind it, and what else there is."""
    scene = replace(THINGS, objects=(*THINGS.objects, *more))
    folder.mkdir()
    return lambda task: workplace(scene, write_mjcf(scene, folder / "mjcf"), parse_task(task), arm)


def test_the_share_that_is_asked_for_decides_and_the_object_is_named(tmp_path, arm):
    plain = work(tmp_path / "plain", arm)
    require_seen(plain("pick:cube"), 0.5)
    require_seen(plain("pick:post"), 0.05)
    with pytest.raises(UnseenError, match=r'"post" covers 0\.\d\d % of the picture at the start, not 0\.5 %'):
        require_seen(plain("pick:post"), 0.5)


def test_what_hides_behind_something_is_hardly_seen(tmp_path, arm):
    """The cameras look from beyond the work at the robot; a high wall between them and the cube covers it."""
    free = work(tmp_path / "free", arm)("pick:cube")
    camera = free.simulation.data.cam_xpos[free.simulation.model.camera("agentview").id]
    towards = camera[:2] / ((camera[:2] ** 2).sum() ** 0.5)
    wall = placed("wall", asset_of(box(0.16, 0.16, 0.3)), (*(0.16 * towards), 0.0), fixed=True)
    hidden = work(tmp_path / "hidden", arm, wall)
    with pytest.raises(UnseenError, match=r'"cube" covers 0\.'):
        require_seen(hidden("pick:cube"), 0.5)


def test_shares_are_what_the_rays_count(tmp_path, arm):
    """Every object of the task, in percent of the pixels that are its own."""
    one = work(tmp_path / "both", arm)("stack:cube:post")
    seen = require_seen(one, 0.1)
    labels = Pictures(one.simulation, "cpu").take(AGENT, SIDE, SIDE, segmentation=True).segmentation
    counted = {name: 100.0 * float((labels == number).sum()) / SIDE**2 for name, number in (("cube", 2), ("post", 3))}
    assert seen == pytest.approx(counted, abs=1e-3)


def test_a_check_looks_again_at_what_a_suite_says_is_in_view(tmp_path, arm):
    """As the request has it: not at all for 0, and at both objects otherwise."""
    work(tmp_path / "suite", arm)("pick:cube")
    where = tmp_path / "suite"
    save_scene(THINGS, where)

    def lines(task, percent):
        request = Request(tasks=("pick",), robot=arm, visible=percent)
        entry: Any = SimpleNamespace(place=7, task=task)
        return check_sight(where, request, entry)

    assert lines("pick:cube", 0.5) == lines("pick:post", 0.0) == []
    (line,) = lines("pick:post", 0.5)
    assert line.startswith('scene 7: "post" covers 0.')


def test_suites_ask_for_half_a_percent_and_those_made_before_for_nothing():
    usual = Request().as_dict()
    assert usual["visible"] == 0.5
    before = {name: value for name, value in usual.items() if name != "visible"}
    assert Request.from_dict(before, "before").visible == 0.0
    assert Request.from_dict(before, "before").as_dict() == before


def test_a_suite_that_nobody_looked_at_is_not_gone_on_with_as_one_that_is_seen(tmp_path):
    """Nor the other way round: what differs is named with what the folder has."""
    for held, asked, said in ((0.0, 0.5, "no visible"), (0.5, 0.0, "visible 0.5")):
        folder = SuiteFolder(tmp_path / said.replace(" ", "-"))
        folder.path.mkdir()
        begin_manifest(folder, Request(visible=held))
        with pytest.raises(SuiteError, match=f"holds a suite with {said}"):
            generate(str(folder.path), Request(visible=asked), workers=1)


def test_clutter_that_is_no_list_of_numbers_is_answered_with_one(tmp_path, capsys):
    assert main(["suite", "generate", str(tmp_path / "s"), "--clutter", "many"]) == 2
    assert "--clutter is numbers such as 3,5" in " ".join(capsys.readouterr().err.split())
