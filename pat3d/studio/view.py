"""The scene as browsers show it: meshes, names, convex hulls, forces, the initial layout, and a gizmo."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pat3d.geometry.pose import Pose
from pat3d.scene.model import Scene, SceneObject
from pat3d.studio import shapes
from pat3d.studio.names import Names
from pat3d.studio.session import Session
from pat3d.studio.surroundings import Surroundings, look

if TYPE_CHECKING:
    import viser

HULL_COLOURS = ((230, 120, 50), (60, 140, 220), (90, 180, 90), (200, 90, 180), (220, 190, 60), (90, 190, 190))
FORCE_COLOUR, CONTACT_COLOUR = (220, 40, 40), (255, 150, 0)
GHOST_COLOUR, BEFORE_COLOUR = (150, 160, 190), (230, 170, 60)

ARROW = 0.15
"""Length of the arrow of the largest force, as a share of the scene's size."""


@dataclass(frozen=True, kw_only=True)
class Shown:
    """What is shown beside the objects."""

    names: bool = True
    hulls: bool = False
    forces: bool = False
    ghost: bool = False
    before: bool = False
    shadows: bool = False
    """And reflections: much to draw where there is no graphics card."""


class View:
    """Draws sessions into the scene of a viser server; only what differs from the last one is sent."""

    def __init__(
        self, server: viser.ViserServer, clicked: Callable[[str], None], dragged: Callable[[Pose], None]
    ) -> None:
        """`clicked` hears the name of an object, `dragged` where the gizmo let go of the selected one."""
        self._server, self._scene = server, server.scene
        self._clicked, self._dragged = clicked, dragged
        self._objects: dict[str, tuple[Any, Any]] = {}
        """Asset and handle of every object, by name."""
        self._extras: dict[str, tuple[Any, list[Any]]] = {}
        """What was drawn of hulls, names and so on, and what it was drawn for."""
        self._gizmo: Any = None
        self._paths: set[str] = set()
        self._names = Names(server, self._path)
        self._named: Any = None
        """What the names are of."""
        self._surroundings = Surroundings(server)

    def look_at(self, scene: Scene) -> None:
        """Have everybody see all of `scene`, from the front."""
        low, high = _bounds(scene)
        middle, size = (low + high) / 2, float(np.linalg.norm(high - low))
        self._surroundings.around(low, high)
        look(self._server, middle, middle + 0.95 * size * np.array([0.35, -0.85, 0.55]))

    def begin(self, scene: Scene) -> None:
        """Show `scene`, which begins to settle, and nothing beside its objects, until the next `draw`."""
        self.look_at(scene)
        for what in tuple(self._extras):
            self._extra(what, None, (), lambda _: [])
        self._name(None, ())
        self._hold(None)
        self._put({obj.name: obj for obj in scene.objects})

    def draw(self, session: Session | None, shown: Shown) -> None:
        """Show `session`; nothing where it is None."""
        objects = {obj.name: obj for obj in session.scene.objects} if session is not None else {}
        self._put(objects)
        poses = tuple((obj.name, obj.pose, id(obj.asset)) for obj in objects.values())
        starts = tuple((obj.name, obj.initial_pose, id(obj.asset)) for obj in objects.values())
        scene = None if session is None else session.scene
        at_rest = session is not None and session.at_rest
        self._surroundings.light(shown.shadows)
        self._name(scene if shown.names else None, poses)
        self._extra("hulls", shown.hulls and scene, poses, self._hulls)
        self._extra("ghost", shown.ghost and scene, starts, self._ghost)
        before = None if session is None else session.before
        rests = () if before is None else tuple((obj.name, obj.pose, id(obj.asset)) for obj in before.objects)
        self._extra("before", shown.before and before, rests, self._before)
        self._extra("forces", shown.forces and at_rest and scene, poses, self._forces)
        self._hold(None if session is None or session.selected is None else objects[session.selected])

    def pose(self, poses: Mapping[str, Pose]) -> None:
        """Show objects elsewhere, by name, until the next `draw`."""
        for name, pose in poses.items():
            if name in self._objects:
                _put(self._objects[name][1], pose)

    def _put(self, objects: dict[str, SceneObject]) -> None:
        for name in [name for name, (asset, _) in self._objects.items() if asset is not _asset(objects, name)]:
            self._objects.pop(name)[1].remove()
        for obj in objects.values():
            self._place(obj)

    def _name(self, scene: Scene | None, poses: tuple[Any, ...]) -> None:
        wanted = poses if scene is not None else None
        if wanted != self._named:
            self._named = wanted
            self._names.show(scene)

    def _place(self, obj: SceneObject) -> None:
        if obj.name not in self._objects:
            # One instance of a batch: single meshes have no levels of detail.
            handle = self._scene.add_batched_glb(
                self._path("objects", obj.name), shapes.glb(obj.asset), ((1.0, 0.0, 0.0, 0.0),), ((0.0, 0.0, 0.0),),
                lod=shapes.levels(obj.asset) or "off",
            )  # fmt: skip
            handle.on_click(lambda _, name=obj.name: self._clicked(name))
            self._objects[obj.name] = obj.asset, handle
        _put(self._objects[obj.name][1], obj.pose)

    def _extra(self, what: str, scene: Any, of: Any, draw: Callable[[Scene], list[Any]]) -> None:
        wanted = of if scene else None
        before, handles = self._extras.get(what, (None, []))
        if wanted == before:
            return
        for handle in handles:
            handle.remove()
        self._extras[what] = wanted, draw(scene) if scene else []

    def _hulls(self, scene: Scene) -> list[Any]:
        made = []
        for number, colour in enumerate(HULL_COLOURS):
            parts = [(obj.pose, one) for obj in scene.objects for one in obj.parts[number :: len(HULL_COLOURS)]]
            if parts:
                mesh = shapes.joined((pose, one.vertices, one.faces) for pose, one in parts)
                made.append(self._see_through("convex hulls", mesh, colour, 0.45, flat_shading=True))
        return made

    def _ghost(self, scene: Scene) -> list[Any]:
        return [self._shade([(obj, obj.initial_pose) for obj in scene.objects], GHOST_COLOUR)]

    def _before(self, scene: Scene) -> list[Any]:
        return [self._shade([(obj, obj.pose) for obj in scene.objects], BEFORE_COLOUR)]

    def _shade(self, objects: list[tuple[SceneObject, Pose]], colour: tuple[int, int, int]) -> Any:
        mesh = shapes.joined((pose, obj.asset.visual.vertices, obj.asset.visual.faces) for obj, pose in objects)
        return self._see_through("shades", mesh, colour, 0.3)

    def _see_through(
        self, what: str, mesh: shapes.Mesh, colour: tuple[int, int, int], opacity: float, **more: Any
    ) -> Any:
        return self._scene.add_mesh_simple(
            self._path(what), *mesh, color=colour, opacity=opacity, cast_shadow=False, **more
        )

    def _forces(self, scene: Scene) -> list[Any]:
        from pat3d.check.forces import contact_forces

        found = contact_forces(scene)
        sizes = np.linalg.norm(found.forces, axis=1)
        if not len(sizes) or sizes.max() <= 0.0:
            return []
        low, high = _bounds(scene)
        whole = ARROW * float(np.linalg.norm(high - low))
        # Square roots: what a pen presses is seen beside what a table presses.
        scale = whole * np.sqrt(sizes / sizes.max()) / np.maximum(sizes, 1e-12)
        strong = sizes > 1e-4 * sizes.max()
        ends = found.points + found.forces * scale[:, None]
        arrows = np.stack([found.points, ends], axis=1)[strong].astype(np.float32)
        width = 0.03 * whole
        return [
            self._scene.add_arrows(
                self._path("forces"), arrows, FORCE_COLOUR, shaft_radius=width, head_radius=2.2 * width,
                head_length=5 * width,
            ),
            self._scene.add_point_cloud(
                self._path("contacts"), found.points.astype(np.float32), CONTACT_COLOUR, point_size=2 * width,
                point_shape="circle", precision="float32",
            ),
        ]  # fmt: skip

    def _hold(self, obj: SceneObject | None) -> None:
        """Put the gizmo on `obj`."""
        if self._gizmo is not None:
            self._gizmo.remove()
            self._gizmo = None
        if obj is None or obj.fixed:
            return
        gizmo = self._scene.add_transform_controls(
            self._path("gizmo"),
            scale=max(0.1, 0.8 * float(obj.asset.size.max())),
            # Level, and about the vertical: its height is found by what carries it.
            active_axes=(True, True, False),
            depth_test=False,
        )
        start, handle = obj.pose, self._objects[obj.name][1]
        gizmo.position = start.position

        @gizmo.on_update
        async def _(event: Any) -> None:
            pose = _turned(start, event.target)
            _put(handle, pose)
            if event.phase == "end":
                self._dragged(pose)

        self._gizmo = gizmo

    def _path(self, folder: str, name: str = "") -> str:
        """A path that was never used: what comes back must not meet the messages of what had gone."""
        # A slash would be another level of the tree.
        stem = f"/{folder}/{name.replace('/', '-')}" if name else f"/{folder}"
        number = 1
        while (path := stem if number == 1 else f"{stem} ({number})") in self._paths:
            number += 1
        self._paths.add(path)
        return path


def _turned(start: Pose, gizmo: Any) -> Pose:
    """Where an object at `start` is taken by a gizmo that began there without a turn."""
    w, _, _, z = map(float, gizmo.wxyz)
    yaw = Pose.from_yaw(2.0 * math.atan2(z, w), (0.0, 0.0, 0.0))
    x, y, _ = map(float, gizmo.position)
    return Pose.from_matrix(yaw.rotation @ start.rotation, np.array([x, y, start.position[2]]))


def _asset(objects: dict[str, SceneObject], name: str) -> Any:
    return objects[name].asset if name in objects else None


def _put(handle: Any, pose: Pose) -> None:
    handle.position, handle.wxyz = pose.position, pose.quat_wxyz


def _bounds(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper corner [m]."""
    points = np.concatenate([obj.pose.apply(part.vertices) for obj in scene.objects for part in obj.parts])
    return points.min(axis=0), points.max(axis=0)
