"""The page itself: what the panel shows of a session, what its controls do, and that it is served."""

import http.client
import time
from urllib.parse import urlsplit

import pytest

from pat3d.errors import EnvironmentSetupError
from pat3d.scene.io import load_scene
from tests.studio.bricks import bricks_in

pytest.importorskip("viser")

from pat3d.studio.server import opened
from pat3d.studio.workbench import needed


@pytest.fixture(scope="module")
def studio(tmp_path_factory):
    root = tmp_path_factory.mktemp("scenes")
    with opened(bricks_in(root / "bricks"), port=0) as made:
        yield made


def control(studio, label):
    """The control called `label`, as viser has it."""
    gui = studio.page.gui
    found = [one for one in gui._gui_input_handle_from_uuid.values() if getattr(one, "label", None) == label]
    assert len(found) == 1
    return found[0]


def test_the_page_is_served_at_its_address(studio):
    where = urlsplit(studio.address)
    client = http.client.HTTPConnection(where.hostname or "", where.port, timeout=30)
    client.request("GET", "/")
    answer = client.getresponse()
    assert answer.status == 200
    assert b"<html" in answer.read().lower()
    client.close()


def test_a_port_that_is_taken_is_refused(studio):
    port = urlsplit(studio.address).port
    with pytest.raises(EnvironmentSetupError, match="--port 0"), opened(root=studio.store.root.folder, port=port or 0):
        pass


def test_what_is_selected_and_deleted_is_shown(studio):
    assert control(studio, "Settle").disabled
    assert control(studio, "Delete").disabled
    studio.bench.do(lambda now: needed(now).select("block"))
    assert control(studio, "Selected").value == "block"
    assert not control(studio, "Delete").disabled
    studio.bench.do(lambda now: needed(now).removed())
    assert "block" not in control(studio, "Selected").options
    assert not control(studio, "Settle").disabled
    studio.bench.do(lambda now: needed(now).undone())
    assert "block" in control(studio, "Selected").options
    assert control(studio, "Settle").disabled


def test_the_tree_of_the_page_has_the_names_of_the_objects(studio):
    def objects():
        return {path for path in studio.page.scene._handle_from_node_name if path.startswith("/objects/")}

    assert objects() == {"/objects/board", "/objects/brick", "/objects/block (2)"}


@pytest.mark.parametrize("label", ["Convex hulls", "Contact forces", "Initial layout"])
def test_what_is_shown_beside_the_objects_can_be_changed(studio, label):
    before = set(studio.page.scene._handle_from_node_name)
    box = control(studio, label)
    box.value = not box.value
    # viser tells of a change from another thread.
    for _ in range(600):
        if set(studio.page.scene._handle_from_node_name) != before:
            break
        time.sleep(0.05)
    else:
        pytest.fail(f"{label} changes nothing.")
    box.value = not box.value


def test_an_edit_is_settled_saved_and_reloaded(studio):
    studio.bench.do(lambda now: needed(now).edited("move", "brick: 2 cm left"))
    assert "1 edit to be settled" in studio.page.verdict
    assert studio.bench.start("Settling", lambda now, progress: (needed(now).settled(progress), "settled"))
    assert studio.bench.wait(300)
    assert "Verified" in studio.page.verdict
    path = studio.store.saved(needed(studio.bench.session), "bricks")
    assert load_scene(path)["brick"].pose.position[0] == pytest.approx(0.03, abs=1e-3)
