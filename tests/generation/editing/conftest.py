"""A small desk that comes to rest once for all tests of edits."""

import pytest

import pat3d
from pat3d.generation.attempts import Attempts
from pat3d.generation.checkpoints import Workspace
from pat3d.generation.request import request_of
from pat3d.generation.settle_stage import settle_scene
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.progress import Clock, silent
from pat3d.scene.io import save_scene

PROMPT = "a stack of three books, a vase and a bowl with two apples on a desk"


@pytest.fixture(scope="session")
def desk_folder(tmp_path_factory):
    """A scene folder, without what takes long and edits do not read: exports, report, preview."""
    folder = tmp_path_factory.mktemp("scenes") / "desk"
    attempts = Attempts(
        request_of(GrammarPlanner().plan(PROMPT), False),
        seed=2,
        friction=0.2,
        device="cpu",
        workspace=Workspace(folder, keep=False),
        clock=Clock(),
        progress=silent,
        scratch=folder.parent,
    )
    layout = attempts.layout()
    settled = settle_scene(layout)
    assert settled.at_rest
    save_scene(settled.of(layout), folder)
    settled.write(tuple(obj.name for obj in layout.objects), folder)
    return folder


@pytest.fixture(scope="session")
def desk(desk_folder):
    return pat3d.load(desk_folder)
