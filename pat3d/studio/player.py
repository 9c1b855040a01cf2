"""A slider over the frames of a recording, and a button that plays them."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any


class Player:
    """Tells which frame of a recording is to be shown."""

    def __init__(self, gui: Any, label: str, show: Callable[[int], None], *, rate: float) -> None:
        """`show` is called with a frame, from whichever thread; playing takes `rate` frames a second."""
        self._show, self._period = show, 1.0 / rate
        self._frames = 0
        self._playing = threading.Event()
        self._slider = gui.add_slider(label, min=0, max=1, step=1, initial_value=0, disabled=True)
        self._slider.on_update(lambda _: self._moved())
        self._button = gui.add_button("Play", disabled=True)
        self._button.on_click(lambda _: self._toggle())

    @property
    def frame(self) -> int:
        """That is shown."""
        return int(self._slider.value)

    def load(self, frames: int, *, at: int = -1) -> None:
        """A recording of `frames` frames, beginning at one of them; none to play where there are less than two."""
        self.stop()
        self._frames = frames
        self._slider.max = max(1, frames - 1)
        self._slider.value = at % frames if frames else 0
        self._slider.disabled = self._button.disabled = frames < 2

    def stop(self) -> None:
        """Play no further."""
        self._playing.clear()
        self._button.label = "Play"

    def _moved(self) -> None:
        if self._frames >= 2:
            self._show(self.frame)

    def _toggle(self) -> None:
        if self._playing.is_set():
            self.stop()
            return
        self._playing.set()
        self._button.label = "Pause"
        threading.Thread(target=self._play, args=(self._frames,), daemon=True, name="pat3d studio player").start()

    def _play(self, frames: int) -> None:
        frame = 0 if self.frame >= frames - 1 else self.frame
        pause = threading.Event()
        while self._playing.is_set() and frame < frames and frames == self._frames:
            # The slider tells of its change itself.
            self._slider.value = frame
            frame += 1
            pause.wait(self._period)
        self.stop()
