"""The studio in a real browser: a sentence becomes a scene, which is edited, settled, undone and exported by mouse."""

from __future__ import annotations

import re
import time

import numpy as np
import pytest

from tests.studio.browser import chromium, page, pixel

pytest.importorskip("viser")
pytest.importorskip("playwright")
if chromium() is None:
    pytest.skip("there is no Chromium", allow_module_level=True)

from pat3d.scene.io import load_scene
from pat3d.studio.names import HEIGHT, Eye
from pat3d.studio.server import opened
from pat3d.studio.workbench import needed

pytestmark = pytest.mark.slow

RECORDER = """
window.shaders = [];
const { shaderSource } = WebGL2RenderingContext.prototype;
WebGL2RenderingContext.prototype.shaderSource = function (shader, text) {
    window.shaders.push(text);
    return shaderSource.call(this, shader, text);
};
"""
SENTENCE = "a red mug on a cutting board"
LONG = "a stack of ten books, a vase, a red mug, a bowl with six apples and a laptop on a desk"


@pytest.fixture(scope="module")
def studio(tmp_path_factory):
    with opened(root=tmp_path_factory.mktemp("scenes"), port=0) as made:
        yield made


@pytest.fixture(scope="module")
def browser(studio):
    with page() as made:
        made.add_init_script(RECORDER)
        made.goto(studio.address)
        made.get_by_role("button", name="Make").wait_for()
        yield made


@pytest.fixture
def shot(browser, tmp_path, request):
    """A picture of the page after the test, where one wants to look."""
    yield
    browser.screenshot(path=str(tmp_path / f"{request.node.name}.png"))


def until(holds, seconds=120.0):
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, "it did not happen."
        time.sleep(0.1)


def field(browser, label):
    """The text field beside a label."""
    return browser.get_by_text(label, exact=True).locator("xpath=../../..").locator("input, textarea").first


def server(studio):
    return studio.page.server


def test_a_sentence_becomes_a_scene(studio, browser, shot, monkeypatch):
    seen, view = [], studio.page._view
    begin, show = view.begin, view.pose
    monkeypatch.setattr(view, "begin", lambda scene: (seen.append(scene["red mug"].pose), begin(scene)))
    monkeypatch.setattr(view, "pose", lambda poses: (seen.append(poses["red mug"]), show(poses)))
    field(browser, "Sentence").fill(SENTENCE)
    browser.get_by_role("button", name="Make").click()
    browser.get_by_text("made and verified").first.wait_for()
    # It was shown on its way, from its layout down to its rest.
    assert len(seen) > 2
    assert seen[0].position[2] > seen[-1].position[2]
    browser.get_by_text("it does not move").wait_for()
    assert {"red mug", "cutting board"} <= {obj.name for obj in needed(studio.bench.session).scene.objects}


def test_where_the_processor_draws_edges_are_not_smoothed(browser):
    wishes = browser.evaluate(
        "document.querySelector('canvas[data-engine]').getContext('webgl2').getContextAttributes()"
    )
    assert wishes["antialias"] is False
    assert wishes["preserveDrawingBuffer"] is True


def test_where_the_processor_draws_surfaces_are_matt_until_shadows_and_reflections_are_asked_for(browser):
    def lit():
        """For every lit surface that was compiled: whether it shines."""
        shaders = [text for text in browser.evaluate("window.shaders") if "RE_Direct_Physical" in text]
        return [re.search(r"#define RE_Direct\s+(\w+)", text).group(1) == "RE_Direct_Physical" for text in shaders]

    assert lit()
    assert not any(lit())
    box = browser.get_by_text("Shadows, reflections", exact=True)
    box.click()
    until(lambda: any(lit()))
    box.click()


def test_names_do_not_overlap_and_follow_the_eye(studio, browser):
    (client,) = server(studio).get_clients().values()

    def places():
        found = {path: one for path, one in client.scene._handle_from_node_name.items() if path.startswith("/names/")}
        return {path: one.position.copy() for path, one in found.items() if one.visible}

    until(lambda: set(places()) == {"/names/red mug", "/names/cutting board"})
    before = places()
    # From far away the names come together.
    client.camera.position = 25.0 * np.asarray(client.camera.position)
    until(lambda: np.linalg.norm(places()["/names/red mug"] - before["/names/red mug"]) > 0.01)
    mug, board = (Eye.of(client.camera).seen(places()[path][None])[0] for path in before)
    assert abs(mug[1] - board[1]) >= HEIGHT - 0.1
    server(studio).initial_camera.position = client.camera.position = client.camera.position / 25.0


def test_a_click_selects_what_is_under_it(studio, browser, shot):
    scene = needed(studio.bench.session).scene
    # The camera is told of in its own time.
    time.sleep(2.0)
    mug = scene["red mug"]
    middle = mug.pose.apply(np.array([mug.asset.mass_properties.centre_of_mass]))[0]
    browser.mouse.click(*pixel(server(studio), middle))
    until(lambda: needed(studio.bench.session).selected == "red mug")
    browser.get_by_text("asked for as").wait_for()


def test_a_drag_moves_it_and_settling_proves_it_again(studio, browser, shot, monkeypatch):
    session = needed(studio.bench.session)
    mug = session.scene["red mug"]
    before = np.array(mug.pose.position)
    scale = max(0.1, 0.8 * float(mug.asset.size.max()))
    time.sleep(2.0)
    tip = pixel(server(studio), before + (0.7 * scale, 0.0, 0.0))
    there = pixel(server(studio), before + (0.7 * scale - 0.03, 0.0, 0.0))
    browser.mouse.move(*tip)
    browser.mouse.down()
    browser.mouse.move(*there, steps=12)
    browser.mouse.up()
    until(lambda: not needed(studio.bench.session).at_rest or studio.bench.status.failed)
    assert not studio.bench.status.failed, studio.bench.status.said
    browser.get_by_text("1 edit to be settled").wait_for()
    seen, view = [], studio.page._view
    show = view.pose
    monkeypatch.setattr(view, "pose", lambda poses: (seen.append(poses["red mug"].position), show(poses)))
    browser.get_by_role("button", name="Settle").click()
    browser.get_by_text("settled and verified").wait_for()
    # It was shown on its way.
    assert len({round(position[2], 7) for position in seen}) > 1
    after = np.array(needed(studio.bench.session).scene["red mug"].pose.position)
    assert 0.01 < before[0] - after[0] < 0.06
    assert abs(before[1] - after[1]) < 0.01


def test_undo_brings_it_back_and_a_page_that_is_loaded_again_shows_the_same(studio, browser, shot):
    moved = needed(studio.bench.session).scene["red mug"].pose.position
    browser.get_by_role("button", name="Undo").click()
    browser.get_by_text("1 edit to be settled").wait_for()
    browser.reload()
    browser.get_by_text("1 edit to be settled").wait_for()
    browser.get_by_role("button", name="Undo").click()
    browser.get_by_text("it does not move").wait_for()
    back = needed(studio.bench.session).scene["red mug"].pose.position
    assert np.linalg.norm(np.subtract(back, moved)) > 0.01


def test_what_was_made_is_exported(studio, browser, shot):
    browser.get_by_text("Save and export").click()
    field(browser, "Name").fill("tray")
    # A text is told of when nobody has typed for a moment.
    until(lambda: studio.page.name == "tray")
    browser.get_by_role("button", name="Export").click()
    browser.get_by_text("exported and read back").wait_for()
    assert (studio.store.root.folder / "tray-export" / "mjcf" / "scene.xml").is_file()
    browser.get_by_role("button", name="Save").click()
    browser.get_by_text("saved:").wait_for()
    assert "red mug" in {obj.name for obj in load_scene(studio.store.root.folder / "tray").objects}


def test_work_goes_on_while_the_page_is_loaded_again_and_can_be_cancelled_there(studio, browser, shot):
    before = studio.bench.session
    field(browser, "Sentence").fill(LONG)
    browser.get_by_role("button", name="Make").click()
    browser.get_by_role("button", name="Cancel").wait_for()
    browser.reload()
    browser.get_by_role("button", name="Cancel").click()
    browser.get_by_text("was cancelled").first.wait_for()
    assert studio.bench.session is before
