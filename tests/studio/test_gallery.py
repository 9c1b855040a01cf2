"""The gallery shows the scenes of a suite that its filters let through."""

import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from PIL import Image

from pat3d.envs.suites.suite import Entry
from pat3d.errors import SpecError
from pat3d.studio.gallery import Gallery, chosen, values

PROMPTS = ("a red mug on a tray", "a lemon in a bowl", "a blue mug on a book")


def entry(place, split, kind, clutter, container):
    return Entry(
        place=place,
        split=split,
        kind=kind,
        task=f"{kind}:thing",
        prompt=PROMPTS[place % 3],
        instruction=f"{kind} it",
        axes={"clutter": clutter, "container": container, "objects": 3},
        checksum="",
        proven_in="",
    )


ENTRIES = (
    entry(0, "train", "pick", 2, True),
    entry(1, "val/layout", "place", 10, False),
    entry(2, "test/object", "pick", 2, False),
)


def suite(folder, entries=ENTRIES) -> Any:
    """As much of a suite as a gallery looks at."""
    return SimpleNamespace(
        entries=entries,
        request=SimpleNamespace(tasks=("pick", "place")),
        document={"axes": {"clutter": {}, "container": {}, "objects": {}}},
        folder=SimpleNamespace(path=folder, scene=lambda place: folder / "scenes" / f"{place:06d}"),
    )


@pytest.mark.parametrize(
    ("wanted", "words", "places"),
    [
        ({}, "", [0, 1, 2]),
        ({"split": "val"}, "", [1]),
        ({"split": "test/object"}, "", [2]),
        ({"task": "pick"}, "", [0, 2]),
        ({"task": "pick", "container": "true"}, "", [0]),
        ({"clutter": "2"}, "MUG", [0, 2]),
        ({}, "mug book", [2]),
        ({"clutter": "10", "task": "pick"}, "", []),
    ],
)
def test_filters_go_together(wanted, words, places):
    assert [one.place for one in chosen(ENTRIES, wanted, words)] == places


def test_what_can_be_chosen_is_what_there_is(tmp_path):
    found = values(suite(tmp_path))
    assert found["split"] == ("train", "val", "test", "val/layout", "test/object")
    assert found["task"] == ("pick", "place")
    assert found["clutter"] == ("2", "10")
    assert found["container"] == ("true", "false")


def test_the_wall_has_a_page_of_pictures_and_opens_what_is_clicked(tmp_path):
    viser = pytest.importorskip("viser")
    for place in range(2):
        folder = tmp_path / "scenes" / f"{place:06d}"
        folder.mkdir(parents=True)
        Image.fromarray(np.full((480, 640, 3), 90, dtype=np.uint8)).save(folder / "preview.png")
    (tmp_path / "scenes" / "000001" / "preview.png").write_bytes(b"no picture")
    entries = tuple(entry(place, "train" if place % 2 else "val/layout", "pick", 2, True) for place in range(20))
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    opened: list[Path] = []
    try:
        wall = Gallery(server, suite(tmp_path, entries), opened.append, lambda: None)
        assert len(pictures(server)) == 16
        wall._page.value = 2
        wait(lambda: len(pictures(server)) == 4)
        wall._filters["split"].value = "train"
        wait(lambda: sorted(pictures(server)) == sorted(range(1, 20, 2)))
        assert "10 of 20 scenes" in wall._about.content
        wall.hide()
        assert not pictures(server)
    finally:
        server.stop()


def pictures(server):
    """Numbers of the scenes whose pictures hang."""
    return [int(name.split("/")[2]) for name in server.scene._handle_from_node_name if name.endswith("/picture")]


def wait(holds):
    # viser tells of a change from another thread.
    for _ in range(600):
        if holds():
            return
        time.sleep(0.05)
    pytest.fail("the wall did not change.")


def test_folders_of_different_kinds_are_not_shown_together(tmp_path):
    pytest.importorskip("viser")
    from pat3d.studio.server import kind_of

    for name, file in (("suite", "suite.json"), ("eval", "manifest.json"), ("scene", "scene.json")):
        (tmp_path / name).mkdir()
        (tmp_path / name / file).write_text("{}")
    assert kind_of([]) == "nothing"
    assert kind_of([tmp_path / "scene"]) == "scene"
    assert kind_of([tmp_path / "suite"]) == "suite"
    assert kind_of([tmp_path / "eval"] * 2) == "evaluations"
    for wrong in (["eval"] * 3, ["scene", "eval"], ["suite", "suite"]):
        with pytest.raises(SpecError):
            kind_of([tmp_path / name for name in wrong])
