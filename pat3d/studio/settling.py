"""The part of the panel that plays how a scene came to rest."""

from __future__ import annotations

from typing import Any

import numpy as np

from pat3d.studio.player import Player
from pat3d.studio.session import Session
from pat3d.studio.timeline import Timeline, losses, timeline_of
from pat3d.studio.view import View

RATE = 15.0
"""Frames a second."""


class SettlingFolder:
    """A slider over the frames of the settling, a chart of the motion, and one of the optimisation's loss."""

    def __init__(self, gui: Any, view: View) -> None:
        self._gui, self._view = gui, view
        self._timeline: Timeline | None = None
        self._of: Any = None
        self._charts: list[Any] = []
        self._folder = gui.add_folder("How it settled", expand_by_default=False)
        with self._folder:
            self._about = gui.add_markdown("")
            self._player = Player(gui, "Frame", self._show, rate=RATE)

    def show(self, session: Session | None) -> None:
        """The recording of `session`, at its end."""
        scene = None if session is None else session.current
        if scene is self._of and scene is not None:
            if self._timeline is not None and self._player.frame < len(self._timeline) - 1:
                # The scene was drawn again, at rest.
                self._player.load(len(self._timeline))
            return
        self._of = scene
        self._timeline = None if session is None else timeline_of(session)
        for chart in self._charts:
            chart.remove()
        self._charts = []
        frames = 0 if self._timeline is None else len(self._timeline)
        self._player.load(frames)
        self._about.content = f"{frames} frames, the rest last." if frames else "Nothing was recorded."
        with self._folder:
            if self._timeline is not None:
                away = self._timeline.farthest()
                self._chart("farthest from rest [mm]", np.arange(frames, dtype=np.float64), away)
            steps = () if session is None else losses(session)
            if len(steps) > 1:
                self._chart("loss of the layout [m^2]", *np.array(steps, dtype=np.float64).T)

    def _show(self, frame: int) -> None:
        if self._timeline is not None and frame < len(self._timeline):
            self._view.pose(self._timeline.poses(frame))

    def _chart(self, label: str, x: np.ndarray, y: np.ndarray) -> None:
        series = ({"label": "frame"}, {"label": label, "stroke": "#d9480f", "width": 2})
        scales = {"x": {"time": False}, "y": {"auto": True}}
        self._charts.append(self._gui.add_uplot((x, y), series, scales=scales, aspect=2.0, title=label))
