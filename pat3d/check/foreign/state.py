"""The state that a foreign scene starts in, and who is who in it: objects that move freely, mechanisms, the world."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import CheckError

WORLD = "the world"


@dataclass(frozen=True, kw_only=True, eq=False)
class Owners:
    """To which of the things that move as they like each body of a model belongs."""

    names: tuple[str, ...]
    """Of the free objects, in the order of their joints."""
    roots: NDArray[np.int64]
    """Body of each object, shape (objects,)."""
    of_body: NDArray[np.int64]
    """Object of each body; -1 for the world, -2 for mechanisms, which are held; shape (bodies,)."""
    mechanism: tuple[str, ...]
    """Name of the mechanism of each body, empty where there is none."""

    def label(self, body: int) -> str:
        """What a body is called in a report."""
        owner = int(self.of_body[body])
        if owner >= 0:
            return self.names[owner]
        return WORLD if owner == -1 else self.mechanism[body]


def owners(model: Any) -> Owners:
    """Sort the bodies of `model` into free objects, mechanisms (robots, drawers) and the world."""
    import mujoco

    free = np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE)
    roots = model.jnt_bodyid[free].astype(np.int64)
    place = {int(body): k for k, body in enumerate(roots)}
    of_body = np.full(model.nbody, -1, dtype=np.int64)
    mechanism = [""] * model.nbody
    for body in range(1, model.nbody):
        parent = int(model.body_parentid[body])
        if body in place:
            of_body[body] = place[body]
        elif of_body[parent] >= 0:
            of_body[body] = of_body[parent]
        elif of_body[parent] == -2 or model.body_jntnum[body]:
            of_body[body] = -2
            mechanism[body] = mechanism[parent] or body_name(model, int(model.body_rootid[body]))
    return Owners(
        names=tuple(body_name(model, int(body)) for body in roots),
        roots=roots,
        of_body=of_body,
        mechanism=tuple(mechanism),
    )


def body_name(model: Any, body: int) -> str:
    """The name of a body; where it has none, that of the mesh that it alone has, or its number."""
    return model.body(body).name or _own_mesh(model, body) or f"body {body}"


def _own_mesh(model: Any, body: int) -> str:
    import mujoco

    meshes = model.geom_type == mujoco.mjtGeom.mjGEOM_MESH
    found = set(model.geom_dataid[meshes & (model.geom_bodyid == body)].tolist())
    if len(found) != 1:
        return ""
    (mesh,) = found
    name = model.mesh(mesh).name
    taken = name in (model.body(other).name for other in range(model.nbody))
    alone = set(model.geom_bodyid[meshes & (model.geom_dataid == mesh)].tolist()) == {body}
    return name if alone and not taken else ""


def start(model: Any, keyframe: str | None = None) -> Any:
    """The mujoco.MjData of `model` in its initial state.

    Args:
        model: mujoco.MjModel.
        keyframe: name or number of a keyframe; None for the file's own poses.

    Raises:
        CheckError: there is no such keyframe.
    """
    import mujoco

    data = mujoco.MjData(model)
    if keyframe is not None:
        names = [model.key(number).name for number in range(model.nkey)]
        if keyframe in names:
            number = names.index(keyframe)
        elif keyframe.isdigit() and int(keyframe) < model.nkey:
            number = int(keyframe)
        else:
            known = ", ".join(name or str(number) for number, name in enumerate(names)) or "none"
            raise CheckError(f'there is no keyframe "{keyframe}". Known: {known}.')
        mujoco.mj_resetDataKeyframe(model, data, number)
    mujoco.mj_forward(model, data)
    return data


class Held:
    """The joints of mechanisms, which stay where they are while the objects fall: a robot's brakes, a shut drawer."""

    def __init__(self, model: Any, data: Any) -> None:
        """Hold all joints but free ones where they are in `data`."""
        import mujoco

        free = model.jnt_type == mujoco.mjtJoint.mjJNT_FREE
        self._qpos = np.ones(model.nq, dtype=bool)
        self._qvel = np.ones(model.nv, dtype=bool)
        for joint in np.flatnonzero(free):
            self._qpos[model.jnt_qposadr[joint] : model.jnt_qposadr[joint] + 7] = False
            self._qvel[model.jnt_dofadr[joint] : model.jnt_dofadr[joint] + 6] = False
        self._at = data.qpos[self._qpos].copy()

    def __bool__(self) -> bool:
        return bool(self._qvel.any())

    def put_back(self, data: Any) -> None:
        """Undo what the last step did to them."""
        data.qpos[self._qpos] = self._at
        data.qvel[self._qvel] = 0.0
