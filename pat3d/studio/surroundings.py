"""What is around the objects of a page: light, the lines on the ground, and the eye.

The processor draws where there is no graphics card, and then every pixel counts: light is one lamp and the sky, and the
ground is thin lines near the objects. Shadows, reflections and a ground that takes shadows are for those who ask.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import viser

LINE, METRE_LINE = (208, 208, 208, 255), (150, 150, 150, 255)
"""Colours of the lines on the ground, and of those a metre apart."""
CELLS = 60
"""Most lines in one direction."""
MARGIN = 0.6
"""How far the lines go beyond the objects, as a share of their size."""


class Surroundings:
    """The light and the ground of one server."""

    def __init__(self, server: viser.ViserServer) -> None:
        """Plain light, and no lines yet."""
        self._scene: Any = server.scene
        self._scene.set_up_direction("+z")
        self._lines: Any = None
        self._bounds: tuple[float, ...] = ()
        self._rich = False
        self._scene.configure_environment_map(None)
        self._scene.configure_default_lights(False)
        self._plain = [
            self._scene.add_light_directional("/light/lamp", intensity=2.2, position=(-0.4, -0.6, 1.0)),
            self._scene.add_light_hemisphere("/light/sky", ground_color=(150, 140, 130), intensity=2.0),
        ]
        self._ground: Any = None

    def light(self, rich: bool) -> None:
        """With shadows and reflections, or without."""
        if rich == self._rich:
            return
        self._rich = rich
        for lamp in self._plain:
            lamp.visible = not rich
        self._scene.configure_environment_map("warehouse" if rich else None)
        self._scene.configure_default_lights(rich, cast_shadow=rich)
        if rich:
            self._ground = self._scene.add_grid(
                "/ground/plane", width=20.0, height=20.0, cell_size=0.1, section_size=1.0, fade_distance=6.0,
                infinite_grid=True,
            )  # fmt: skip
        else:
            self._ground.remove()
        if self._lines is not None:
            self._lines.visible = not rich

    def around(self, low: np.ndarray, high: np.ndarray) -> None:
        """Lines on the ground below and around a box with the corners `low` and `high` [m], shape (3,)."""
        left, right, cell = extent(low, high)
        bounds = (*left, *right, cell)
        if bounds == self._bounds:
            return
        self._bounds = bounds
        if self._lines is not None:
            self._lines.remove()
        self._lines = self._scene.add_glb("/ground/lines", lines(left, right, cell), visible=not self._rich)


def look(server: viser.ViserServer, at: np.ndarray, position: np.ndarray) -> None:
    """Have everybody look from `position` to `at` [m], those who open the page later too."""
    for camera in (server.initial_camera, *(client.camera for client in server.get_clients().values())):
        camera.position = position
        camera.look_at = at


def extent(low: np.ndarray, high: np.ndarray) -> tuple[tuple[float, float], tuple[float, float], float]:
    """Corners of what the lines cover [m], on lines, and the distance between two lines [m]."""
    margin = MARGIN * max(0.5, float(np.linalg.norm(high - low)))
    width = float((high - low)[:2].max()) + 2.0 * margin
    # 0.1 m, unless these were too many.
    cell = 10.0 ** max(-1, math.ceil(math.log10(width / CELLS)))
    left = tuple(cell * math.floor((float(one) - margin) / cell) for one in low[:2])
    right = tuple(cell * math.ceil((float(one) + margin) / cell) for one in high[:2])
    return (left[0], left[1]), (right[0], right[1]), cell


def lines(left: tuple[float, float], right: tuple[float, float], cell: float) -> bytes:
    """A GLB with lines at height 0."""
    import trimesh

    scene: Any = trimesh.Scene()
    per_metre = max(1, round(1.0 / cell))
    first, last = (np.round(np.array(corner) / cell).astype(int) for corner in (left, right))
    segments: dict[bool, list[list[tuple[float, float, float]]]] = {False: [], True: []}
    for x in range(first[0], last[0] + 1):
        segments[x % per_metre == 0].append([(x * cell, left[1], 0.0), (x * cell, right[1], 0.0)])
    for y in range(first[1], last[1] + 1):
        segments[y % per_metre == 0].append([(left[0], y * cell, 0.0), (right[0], y * cell, 0.0)])
    for whole, colour in ((False, LINE), (True, METRE_LINE)):
        if segments[whole]:
            path: Any = trimesh.load_path(np.array(segments[whole]))
            path.colors = np.tile(colour, (len(path.entities), 1))
            scene.add_geometry(path)
    return scene.export(file_type="glb")
