"""Names of the objects, where each browser's eye sees them without overlap."""

from __future__ import annotations

import asyncio
import math
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.pose import Pose
from pat3d.scene.model import Scene

if TYPE_CHECKING:
    import viser

HEIGHT, LETTER, AROUND = 16.0, 6.2, 8.0
"""Size of a name [pixels]: its height, the mean width of a letter, and what is left and right of the letters."""
FARTHEST = 6
"""How many heights above its object a name may stand; it is left out where there is no room below."""
ABOVE = 0.01
"""How far a name is above its object [m]."""
PAUSE = 0.2
"""[s] between two looks at where names are seen."""


@dataclass(frozen=True, kw_only=True)
class Eye:
    """Where a browser looks from."""

    position: NDArray[np.float64]
    """[m], shape (3,)."""
    rotation: NDArray[np.float64]
    """Columns: right, down and forward, shape (3, 3)."""
    focal: float
    """Focal length [pixels]."""

    @staticmethod
    def of(camera: viser.CameraHandle) -> Eye:
        """That of a client's camera."""
        w, x, y, z = camera.wxyz / np.linalg.norm(camera.wxyz)
        pose = Pose(position=(0.0, 0.0, 0.0), quat_wxyz=(float(w), float(x), float(y), float(z)))
        focal = camera.image_height / (2.0 * math.tan(camera.fov / 2.0))
        return Eye(position=np.array(camera.position), rotation=pose.rotation, focal=focal)

    def seen(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Right of and below the middle of the picture [pixels], and depth [m], of points [m]; shape (n, 3)."""
        right, down, depth = ((points - self.position) @ self.rotation).T
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.stack([self.focal * right / depth, self.focal * down / depth, depth], axis=1)


def arranged(eye: Eye, points: NDArray[np.float64], names: Sequence[str]) -> NDArray[np.float64]:
    """Where names stand [m], the middle of their lower edge, so that none overlaps another.

    The lowest in the picture comes first; the others stand above what they would overlap. Not a number where a
    name is behind the eye or too far above its point.

    Args:
        eye: what sees them.
        points: where they stand if nothing is in the way [m], shape (n, 3).
        names: of every point.

    Returns:
        Shape (n, 3).
    """
    seen = eye.seen(points)
    taken: list[tuple[float, float, float]] = []
    found = np.full_like(points, np.nan)
    for index in sorted(np.flatnonzero(seen[:, 2] > 0.0).tolist(), key=lambda one: -seen[one, 1]):
        x, y, depth = seen[index]
        half = (LETTER * len(names[index]) + AROUND) / 2.0
        foot = y
        # A name that is in the way is above or around the foot; those above are met from below.
        for left, right, other in sorted(taken, key=lambda one: -one[2]):
            if x - half < right and left < x + half and abs(foot - other) < HEIGHT:
                foot = other - HEIGHT
        if y - foot > FARTHEST * HEIGHT:
            continue
        taken.append((x - half, x + half, foot))
        found[index] = points[index] - eye.rotation[:, 1] * (y - foot) * depth / eye.focal
    return found


def standing(scene: Scene) -> dict[str, NDArray[np.float64]]:
    """Where the names of the objects of `scene` stand if nothing is in the way [m], shape (3,)."""
    carriers = {relation.parent for relation in scene.relations}
    found = {}
    for obj in scene.objects:
        points = np.concatenate([obj.pose.apply(part.vertices) for part in obj.parts])
        low, high = points.min(axis=0), points.max(axis=0)
        x, y, _ = (low + high) / 2.0
        # Over the middle of what carries others stand those.
        found[obj.name] = np.array([x, low[1] if obj.name in carriers else y, high[2] + ABOVE])
    return found


class Names:
    """The names that the browsers of a server show, each in places of its own."""

    def __init__(self, server: viser.ViserServer, path: Callable[[str, str], str]) -> None:
        """`path` makes a new path of a folder and a name."""
        self._lock, self._path = threading.Lock(), path
        self._points: Mapping[str, NDArray[np.float64]] = {}
        self._paths: dict[str, str] = {}
        self._shown: dict[int, tuple[Any, dict[str, Any]]] = {}
        """Client and the handles of its names, by the client's number."""
        self._looking: set[int] = set()
        server.on_client_connect(self._begin)
        server.on_client_disconnect(self._end)

    def show(self, scene: Scene | None) -> None:
        """The names of the objects of `scene`; none where it is None."""
        with self._lock:
            self._points = {} if scene is None else standing(scene)
            self._paths = {name: self._paths.get(name) or self._path("names", name) for name in self._points}
            for client, _ in self._shown.values():
                self._place(client)

    def _begin(self, client: viser.ClientHandle) -> None:
        async def seen(_: Any) -> None:
            if client.client_id in self._looking:
                return
            self._looking.add(client.client_id)
            await asyncio.sleep(PAUSE)
            self._looking.discard(client.client_id)
            with self._lock:
                self._place(client)

        with self._lock:
            self._shown[client.client_id] = client, {}
            self._place(client)
        client.camera.on_update(seen)

    def _end(self, client: viser.ClientHandle) -> None:
        with self._lock:
            self._shown.pop(client.client_id, None)

    def _place(self, client: viser.ClientHandle) -> None:
        """Bring the names of `client` up to date."""
        if client.client_id not in self._shown:
            return
        handles = self._shown[client.client_id][1]
        for name in [name for name in handles if name not in self._points]:
            handles.pop(name).remove()
        if not self._points:
            return
        points = np.stack(list(self._points.values()))
        for name, place in zip(self._points, arranged(Eye.of(client.camera), points, list(self._points)), strict=True):
            if name not in handles:
                handles[name] = client.scene.add_label(
                    self._paths[name], name, visible=False, font_screen_scale=1.0, anchor="bottom-center"
                )
            if seen := bool(np.isfinite(place[0])):
                handles[name].position = place
            handles[name].visible = seen
