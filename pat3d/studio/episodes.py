"""Episodes of evaluations, those of two policies side by side, with the timelines of their states."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pat3d.studio.episode import FIGURES, Recording, recorded
from pat3d.studio.facts import plain
from pat3d.studio.gallery import ANY
from pat3d.studio.player import Player
from pat3d.studio.session import Session
from pat3d.studio.status import StatusLine
from pat3d.studio.surroundings import Surroundings, look
from pat3d.studio.workbench import Watch, Workbench
from pat3d.studio.worker import Run

if TYPE_CHECKING:
    import viser

    from pat3d.policies_eval.run.records import Evaluation

APART = 0.4
"""Between what two episodes show [m]."""
COLOURS = ("#d9480f", "#1971c2")
"""Of the lines of the first and the second policy."""
MOST = 2
"""Evaluations side by side."""


def listed(evaluations: Sequence[Evaluation], outcome: str = ANY) -> dict[int, str]:
    """Episodes that all `evaluations` did, by number, with what came of each; with `outcome`, those that ended so."""
    told: dict[int, str] = {}
    for one in evaluations[0].results:
        number = one.episode.index
        found = [result for every in evaluations for result in every.results if result.episode.index == number]
        if len(found) == len(evaluations) and outcome in (ANY, *(result.outcome for result in found)):
            outcomes = " / ".join(result.outcome.replace("_", " ") for result in found)
            told[number] = f"{number}: {one.instruction}: {outcomes}"
    return told


class Episodes:
    """The episodes of one evaluation, or of two on the same episodes."""

    def __init__(
        self,
        server: viser.ViserServer,
        bench: Workbench,
        status: StatusLine,
        run: Run,
        evaluations: Sequence[Evaluation],
    ) -> None:
        """`run` does episodes again; `bench` keeps one thing going at a time."""
        self._server, self._bench, self._run, self._evaluations = server, bench, run, tuple(evaluations)
        self._lock = threading.Lock()
        self._recordings: tuple[Recording, ...] = ()
        self._bodies: list[list[Any]] = []
        self._drawn: list[Any] = []
        self._charts: list[Any] = []
        gui: Any = server.gui
        self._gui = gui
        self._surroundings = Surroundings(server)
        bench.changed = status.show
        outcomes = sorted({one.outcome for every in evaluations for one in every.results})
        self._folder = gui.add_folder("Episodes")
        with self._folder:
            gui.add_markdown(
                "  \n".join(f"{name}: **{plain(_rate(one))}**" for name, one in zip("AB", evaluations, strict=False))
            )
            self._outcome = gui.add_dropdown("Outcome", (ANY, *outcomes))
            self._choice = gui.add_dropdown("Episode", tuple(listed(evaluations).values()) or (ANY,))
            gui.add_button("Show", color="green").on_click(lambda _: self._start())
            self._said = gui.add_markdown("")
            self._player = Player(gui, "Step", self._show, rate=20.0)
        self._outcome.on_update(lambda _: self._filter())

    def _filter(self) -> None:
        found = tuple(listed(self._evaluations, self._outcome.value).values())
        self._choice.options = found or (ANY,)

    def _start(self) -> None:
        chosen = self._choice.value
        index = next((number for number, text in listed(self._evaluations).items() if text == chosen), None)
        if index is None:
            return

        def work(now: Session | None, progress: Watch) -> tuple[Session | None, str]:
            folders = [Path(one.folder) for one in self._evaluations]
            made = tuple(self._run(recorded, folder, index, progress=progress) for folder in folders)
            self._load(made)
            return now, f"episode {index} is shown."

        self._bench.start("Replaying", work)

    def _load(self, recordings: tuple[Recording, ...]) -> None:
        with self._lock:
            for handle in (*self._drawn, *self._charts):
                handle.remove()
            self._drawn, self._charts, self._bodies, self._recordings = [], [], [], recordings
            places = _side_by_side(recordings)
            for number, (one, place) in enumerate(zip(recordings, places, strict=True)):
                self._draw(number, one, place)
            self._said.content = "  \n".join(map(_told, "AB", recordings))
            with self._folder:
                self._chart()
        self._look(recordings, places)
        self._player.load(max(map(len, recordings)), at=0)
        self._show(0)

    def _draw(self, number: int, one: Recording, place: np.ndarray) -> None:
        import trimesh
        from trimesh.visual import ColorVisuals

        scene = self._server.scene
        above = scene.add_frame(f"/episodes/{number}", show_axes=False, position=place)
        bodies = []
        for body in one.bodies:
            count = len(body.corners)
            mesh = trimesh.Trimesh(
                vertices=body.corners.reshape(-1, 3), faces=np.arange(3 * count).reshape(-1, 3), process=False
            )
            alpha = np.full((count, 1), 255, dtype=np.uint8)
            mesh.visual = ColorVisuals(mesh, face_colors=np.hstack([body.colours, alpha]))
            bodies.append(scene.add_mesh_trimesh(f"/episodes/{number}/{body.number}", mesh))
        name = "AB"[number]
        label = scene.add_label(f"/episodes/{number}/name", f"{name}: {one.outcome.replace('_', ' ')}")
        label.position = (*_bounds(one)[0][:2], 0.02)
        self._bodies.append(bodies)
        self._drawn += [above, *bodies, label]

    def _chart(self) -> None:
        frames = max(map(len, self._recordings))
        seconds = np.arange(frames) / self._recordings[0].rate
        for name, words in FIGURES.items():
            lines = [_padded(one.figures.get(name), frames) for one in self._recordings]
            if all(line is None for line in lines):
                continue
            shown = [np.full(frames, np.nan) if line is None else line for line in lines]
            series = (
                {"label": "s"},
                *(
                    {"label": "AB"[number], "stroke": COLOURS[number], "width": 2, "spanGaps": False}
                    for number in range(len(shown))
                ),
            )
            scales = {"x": {"time": False}, "y": {"auto": True}}
            self._charts.append(self._gui.add_uplot((seconds, *shown), series, scales=scales, aspect=2.2, title=words))

    def _show(self, frame: int) -> None:
        with self._lock, self._server.atomic():
            for one, bodies in zip(self._recordings, self._bodies, strict=True):
                # One that has ended stays as it ended.
                at = min(frame, len(one) - 1)
                for place, handle in enumerate(bodies):
                    handle.position, handle.wxyz = one.positions[at, place], one.quats[at, place]

    def _look(self, recordings: tuple[Recording, ...], places: Sequence[np.ndarray]) -> None:
        bounds = [np.array(_bounds(one)) + place for one, place in zip(recordings, places, strict=True)]
        low, high = np.min([one[0] for one in bounds], axis=0), np.max([one[1] for one in bounds], axis=0)
        self._surroundings.around(low, high)
        middle, size = (low + high) / 2, float(np.linalg.norm(high - low))
        # The panel covers the right side of the page.
        middle[0] += 0.15 * size
        look(self._server, middle, middle + 0.9 * size * np.array([0.0, -0.85, 0.5]))


def _rate(evaluation: Evaluation) -> str:
    from pat3d.policies_eval.analysis.summary import summarise

    found = summarise(evaluation)
    return f"{found.policy}, success {found.rate}"


def _told(name: str, one: Recording) -> str:
    same = "as recorded, bit for bit" if one.same else "**not** as recorded: another engine or machine"
    return f"{name}: {plain(one.title)}: {plain(one.outcome.replace('_', ' '))} after {len(one) - 1} steps, {same}"


def _padded(values: Any, frames: int) -> Any:
    return None if values is None else np.pad(values, (0, frames - len(values)), constant_values=np.nan)


def _bounds(one: Recording) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper corner of where the bodies are [m]."""
    points = one.positions.reshape(-1, 3)
    return points.min(axis=0) - 0.15, points.max(axis=0) + 0.15


def _side_by_side(recordings: Sequence[Recording]) -> list[np.ndarray]:
    """Where each recording's origin is put [m], so that they stand in a row along x."""
    places, right = [], 0.0
    for one in recordings:
        low, high = _bounds(one)
        places.append(np.array([right - low[0], 0.0, 0.0]))
        right += high[0] - low[0] + APART
    return places
