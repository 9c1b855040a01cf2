"""The scenes of a suite as a wall of pictures, chosen by split, task, difficulty and words; a click opens one."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Any

import numpy as np

from pat3d.studio.surroundings import look

if TYPE_CHECKING:
    import viser

    from pat3d.envs.suites.suite import Entry, Suite

PAGE, COLUMNS = 16, 4
"""Pictures of a page, and of a row."""
WIDTH, HEIGHT, GAP = 0.4, 0.3, 0.06
"""Of a picture and between two [m]."""
PIXELS, LABEL = 320, 30
"""Width of a picture, and length of what stands under it [characters]."""
ANY = "any"


def chosen(entries: tuple[Entry, ...], wanted: Mapping[str, str], words: str = "") -> tuple[Entry, ...]:
    """Entries that are as `wanted`, a value for "split", "task" or an axis each, and whose texts have all `words`."""
    from pat3d.envs.suites.request import in_split

    def fits(entry: Entry) -> bool:
        told = f"{entry.prompt} {entry.instruction} {entry.task}".casefold()
        return all(
            in_split(entry.split, value)
            if what == "split"
            else (entry.kind if what == "task" else _said(entry.axes.get(what))) == value
            for what, value in wanted.items()
        ) and all(word in told for word in words.casefold().split())

    return tuple(entry for entry in entries if fits(entry))


def values(suite: Suite) -> dict[str, tuple[str, ...]]:
    """What can be chosen from: the splits, the kinds of task, and what occurs along every axis."""
    from pat3d.envs.suites.request import SPLITS, in_split

    found = {
        "split": tuple(split for split in SPLITS if any(in_split(one.split, split) for one in suite.entries)),
        "task": suite.request.tasks,
    }
    for axis in suite.document["axes"]:
        seen = {_said(one.axes.get(axis)) for one in suite.entries}
        found[axis] = tuple(sorted(seen, key=lambda value: (len(value), value)))
    return found


class Gallery:
    """A wall of pictures in the scene, and the filters in the panel."""

    def __init__(
        self, server: viser.ViserServer, suite: Suite, opened: Callable[[Path], None], shown: Callable[[], None]
    ) -> None:
        """`opened` is called with the folder of a scene that somebody clicked, `shown` when the wall comes back."""
        self._server, self._suite, self._opened = server, suite, opened
        self._handles: list[Any] = []
        self._shown = False
        gui: Any = server.gui
        with gui.add_folder(f"Suite {suite.folder.path.name}"):
            self._about = gui.add_markdown("")
            self._filters = {
                what: gui.add_dropdown(what.replace("_", " ").capitalize(), (ANY, *options))
                for what, options in values(suite).items()
                if len(options) > 1
            }
            self._words = gui.add_text("With the words", "")
            self._page = gui.add_slider("Page", min=1, max=2, step=1, initial_value=1, visible=False)
            self._button = gui.add_button("Back to the gallery", visible=False)
        for control in (*self._filters.values(), self._words):
            control.on_update(lambda _: self._turned(first=True))
        self._page.on_update(lambda _: self._turned(first=False))
        self._button.on_click(lambda _: (shown(), self.show()))
        self.show()

    @property
    def entries(self) -> tuple[Entry, ...]:
        """Those that the filters let through."""
        wanted = {what: box.value for what, box in self._filters.items() if box.value != ANY}
        return chosen(self._suite.entries, wanted, self._words.value)

    def show(self) -> None:
        """Show the wall, seen from the front."""
        self._shown = True
        self._button.visible = False
        self._turned(first=False)
        rows = _rows(min(PAGE, len(self.entries)))
        # The panel covers the right side of the page.
        middle = np.array([0.25 * COLUMNS * (WIDTH + GAP), 0.0, rows * (HEIGHT + GAP) / 2])
        away = 0.85 * max(COLUMNS * (WIDTH + GAP), rows * (HEIGHT + GAP))
        look(self._server, middle, middle + np.array([0.0, -away, 0.0]))

    def hide(self) -> None:
        """Take the wall away, for a scene."""
        self._shown = False
        self._button.visible = True
        self._clear()

    def _turned(self, *, first: bool) -> None:
        found = self.entries
        pages = max(1, math.ceil(len(found) / PAGE))
        if first and self._page.value != 1:
            # The slider tells of its change itself.
            self._page.value = 1
            return
        self._page.max, self._page.visible = max(2, pages), pages > 1
        page = min(int(self._page.value), pages)
        self._about.content = f"{len(found)} of {len(self._suite.entries)} scenes. Click a picture to open one."
        if self._shown:
            self._clear()
            shown = found[(page - 1) * PAGE : page * PAGE]
            for place, entry in enumerate(shown):
                self._hang(place, entry, rows=_rows(len(shown)))

    def _clear(self) -> None:
        for handle in self._handles:
            handle.remove()
        self._handles = []

    def _hang(self, place: int, entry: Entry, *, rows: int) -> None:
        row, column = divmod(place, COLUMNS)
        x = (column - (COLUMNS - 1) / 2) * (WIDTH + GAP)
        z = (rows - row - 0.5) * (HEIGHT + GAP)
        folder = self._suite.folder.scene(entry.place)
        scene = self._server.scene
        picture = scene.add_image(
            f"/gallery/{entry.place}/picture",
            _picture(folder / "preview.png"),
            WIDTH,
            HEIGHT,
            format="jpeg",
            position=(x, 0.0, z),
            # Its own y points down the picture: turned to stand upright, facing the front.
            wxyz=(math.sqrt(0.5), -math.sqrt(0.5), 0.0, 0.0),
            cast_shadow=False,
            receive_shadow=False,
        )
        picture.on_click(lambda _, path=folder: self._opened(path))
        label = scene.add_label(
            f"/gallery/{entry.place}/label",
            f"{entry.place}: {shorten(entry.instruction, LABEL, placeholder=' ...')}",
            position=(x, 0.0, z - HEIGHT / 2),
            anchor="top-center",
            font_screen_scale=0.6,
        )
        self._handles += [picture, label]


def _rows(pictures: int) -> int:
    return max(1, math.ceil(pictures / COLUMNS))


def _picture(file: Path) -> np.ndarray:
    """The picture in `file`, shape (height, width, 3); grey where there is none."""
    from PIL import Image

    try:
        with Image.open(file) as found:
            small = found.convert("RGB")
            small.thumbnail((PIXELS, PIXELS))
            return np.asarray(small)
    except (OSError, ValueError):
        return np.full((3 * PIXELS // 4, PIXELS, 3), 220, dtype=np.uint8)


def _said(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
