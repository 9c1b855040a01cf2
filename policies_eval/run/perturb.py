"""Perturbations of an episode, each off by default and drawn from the episode's seed alone.

Every axis has its own stream of random numbers, so that switching one on leaves the others as they were.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.physics.world import FLOOR, SUPPORT
from pat3d.envs.surroundings.lights import Sky
from pat3d.envs.tasks.paraphrase import politely
from pat3d.errors import EvaluationError
from pat3d.policies_eval.run.lighting import Lighting
from pat3d.scene.model import GROUND

Array = NDArray[np.float64]

TRIES = 60
"""Poses that are drawn before an object is left where it was."""

DEEPEST = 2e-4
"""A moved object may touch its support this deeply [m], and nothing else at all."""

SETTLE_STEPS = 4
"""Control steps without an action after an object was moved."""

ROOMS = {2.0: "another look of the room", 3.0: "another kind of room", 4.0: "a room unseen in training"}
"""What the strengths of "background" above 1 mean."""

BACKDROP = ("bench", "ground", "sky", "table", "room/floor", "room/walls")
"""Materials whose colours are the background's, and the sky."""

ROOM_ONLY = BACKDROP[3:]
"""Those that a bare bench has none of."""

START_TRIES = 40
"""Postures that are drawn before the robot is left where it was."""


@dataclass(frozen=True, kw_only=True)
class Perturbation:
    """Strength of every axis; 0 is off."""

    pose: float = 0.0
    """Objects of the task that carry nothing are moved by up to this in x and in y [m], and turned by up to this as a
    share of half a turn for every 0.1 m; a pose that meets something else is drawn again."""
    friction: float = 0.0
    """Sliding friction of every object is multiplied by a factor between 1 / (1 + this) and 1 + this."""
    mass: float = 0.0
    """Mass and inertia of every object are multiplied by a factor between 1 / (1 + this) and 1 + this."""
    camera: float = 0.0
    """Fixed cameras are moved by up to this along every axis [m] and turned by up to this [rad]."""
    light: float = 0.0
    """Brightness of every light is multiplied by a factor between 1 - this and 1 + this. The sun, which throws the
    shadows, goes round by up to this as a share of half a turn and stands up to this times 40 degrees higher or lower.
    The colour temperature of all light is divided or multiplied by up to 2.3 to the power of this: at 0.5 it is 4,290
    to 9,860 K, at 1 2,830 K (a filament) to 14,950 K (a blue sky)."""
    words: float = 0.0
    """Probability that the instruction is put in other words."""
    start: float = 0.0
    """Joints of the arms start up to this away from where they do otherwise [rad]; a posture that touches something is
    drawn again."""
    background: float = 0.0
    """Up to 1: by this share the colours of the table, of the floor, of the walls and of the background are mixed with
    random ones. 2: another room of the same kind, in other colours; 3: a room of another kind, of those of the suite
    where it has several; 4: a room that no scene of the suite is in."""
    noise: float = 0.0
    """Every colour of a picture gets normal noise of this deviation, as a share of full brightness, depth of a tenth of
    this as a share, and every number of the state of a tenth of this [rad, m]."""

    def __post_init__(self) -> None:
        for name, (low, high) in LIMITS.items():
            value = getattr(self, name)
            if not (isinstance(value, int | float) and math.isfinite(value) and low <= value <= high):
                raise EvaluationError(f"perturbation {name} is {low:g} to {high:g}, not {value}.")
        if self.background > 1.0 and self.background not in ROOMS:
            raise EvaluationError(
                "perturbation background is a share up to 1, or "
                f"{', '.join(f'{one:g}: {ROOMS[one]}' for one in ROOMS)}; "
                f"not {self.background}."
            )

    @property
    def active(self) -> tuple[str, ...]:
        """Axes that are on."""
        return tuple(one.name for one in fields(self) if getattr(self, one.name))

    def to_json(self) -> dict[str, float]:
        """As plain JSON data."""
        return asdict(self)


LIMITS: Mapping[str, tuple[float, float]] = {
    "pose": (0.0, 0.3),
    "friction": (0.0, 4.0),
    "mass": (0.0, 4.0),
    "camera": (0.0, 0.3),
    "light": (0.0, 1.0),
    "words": (0.0, 1.0),
    "start": (0.0, 0.5),
    "background": (0.0, 4.0),
    "noise": (0.0, 1.0),
}
"""Strengths of every axis; the order is that of the streams of random numbers."""

SEEN = ("words", "noise")
"""Axes that change what a policy is told, not the simulation."""


def parse(texts: list[str]) -> Perturbation:
    """The perturbation that `--perturb pose=0.03 friction=0.3` means.

    Raises:
        EvaluationError: an unknown axis or a strength that is not valid.
    """
    values: dict[str, float] = {}
    for text in texts:
        name, _, value = text.partition("=")
        if name not in LIMITS:
            raise EvaluationError(f'no perturbation "{name}". Axes: {", ".join(LIMITS)}; as in pose=0.03.')
        try:
            values[name] = float(value)
        except ValueError:
            raise EvaluationError(f'"{text}" is no strength; as in {name}=0.03.') from None
    return Perturbation(**values)


class Perturber:
    """Changes an environment after its reset, and changes it back."""

    def __init__(self, env: Any) -> None:
        self._env = env
        self._kept: tuple[Any, list[tuple[Any, Array]], dict[str, Any]] | None = None
        self._sky: Sky | None = None
        """Of a model whose background was changed."""

    def apply(self, perturbation: Perturbation, seed: int) -> dict[str, Any]:
        """Perturb the episode that was just reset; returns what was drawn, as plain JSON data."""
        drawn: dict[str, Any] = {}
        for name in perturbation.active:
            strength = float(getattr(perturbation, name))
            random = np.random.default_rng([seed, list(LIMITS).index(name)])
            if name in SEEN:
                continue
            if name not in ("pose", "start"):
                self._keep()
            drawn[name] = getattr(self, f"_{name}")(strength, random)
        if drawn:
            self._env.restart()
        return drawn

    def undo(self) -> None:
        """Give the model its own values back; call it before the next reset."""
        if self._kept is None:
            return
        model, values, statistics = self._kept
        if self._sky is not None:
            self._sky.restore()
            self._env.close()
            self._sky = None
        for of, value in values:
            of[...] = value
        for name, value in statistics.items():
            setattr(model.stat, name, value)
        self._kept = None

    def _keep(self) -> None:
        model = self._env.simulation.model
        if self._kept is None:
            # Derived constants change with the masses, so everything that is real is kept.
            lamp = model.vis.headlight
            arrays = [*_real_arrays(model), lamp.ambient, lamp.diffuse]
            self._kept = (model, [(one, one.copy()) for one in arrays], _statistics(model))

    def _friction(self, strength: float, random: np.random.Generator) -> dict[str, float]:
        simulation, drawn = self._env.simulation, {}
        for number, obj in enumerate(simulation.world.scene.objects):
            drawn[obj.name] = _factor(strength, random)
            simulation.model.geom_friction[simulation.world.owner == number, 0] *= drawn[obj.name]
        return drawn

    def _mass(self, strength: float, random: np.random.Generator) -> dict[str, float]:
        import mujoco

        world, model, drawn = self._env.simulation.world, self._env.simulation.model, {}
        for name in world.objects:
            drawn[name] = _factor(strength, random)
            model.body_mass[world.bodies[name]] *= drawn[name]
            model.body_inertia[world.bodies[name]] *= drawn[name]
        # Derived constants in a scratch state: the running one stays as it is.
        mujoco.mj_setConst(model, mujoco.MjData(model))
        return drawn

    def _camera(self, strength: float, random: np.random.Generator) -> dict[str, list[float]]:
        import mujoco

        model, drawn = self._env.simulation.model, {}
        for number in np.flatnonzero(model.cam_bodyid == 0).tolist():
            shift, axis = random.uniform(-strength, strength, 3), random.standard_normal(3)
            angle = float(random.uniform(-strength, strength))
            model.cam_pos[number] += shift
            turn, turned = np.zeros(4), np.zeros(4)
            mujoco.mju_axisAngle2Quat(turn, axis / np.linalg.norm(axis), angle)
            mujoco.mju_mulQuat(turned, turn, model.cam_quat[number])
            model.cam_quat[number] = turned
            drawn[model.camera(number).name] = [*shift.tolist(), angle]
        return drawn

    def _light(self, strength: float, random: np.random.Generator) -> dict[str, Any]:
        model = self._env.simulation.model
        lighting = Lighting.draw(strength, model.nlight, random)
        lighting.shine(model)
        return lighting.to_json()

    def _background(self, strength: float, random: np.random.Generator) -> dict[str, Any]:
        model, drawn = self._env.simulation.model, dict[str, Any]()
        if strength > 1.0:
            # The episode is in another room from its reset on.
            return {"room": self._env.config.room}
        self._sky = Sky(model)
        for name in BACKDROP:
            if name in ROOM_ONLY and _material(model, name) < 0:
                continue
            drawn[name] = random.uniform(size=3).tolist()
            if name == "sky":
                self._sky.paint(np.array(drawn[name]), strength)
            elif (number := _material(model, name)) >= 0:
                colour = model.mat_rgba[number, :3]
                model.mat_rgba[number, :3] = (1.0 - strength) * colour + strength * np.array(drawn[name])
        # Renderers keep colours.
        self._env.close()
        return drawn

    def _start(self, strength: float, random: np.random.Generator) -> list[float]:
        """Turn the joints of the arm that does the task; where every posture touches something, it stays."""
        import mujoco

        simulation = self._env.simulation
        model, data, where = simulation.model, simulation.data, simulation.arm_addresses
        before = data.qpos[where].copy()
        low, high = model.jnt_range[[_joint(model, int(place)) for place in where]].T
        for _ in range(START_TRIES):
            shift = random.uniform(-strength, strength, len(where))
            data.qpos[where] = np.clip(before + shift, low, high)
            mujoco.mj_forward(model, data)
            if not simulation.touching:
                return (data.qpos[where] - before).tolist()
        data.qpos[where] = before
        mujoco.mj_forward(model, data)
        return [0.0] * len(where)

    def _pose(self, strength: float, random: np.random.Generator) -> dict[str, list[float]]:
        """Move the task's objects; every one is settled for a moment and put back where that fails."""
        simulation, drawn = self._env.simulation, {}
        for name in self._env.task.needs(self._env.scene).grasp:
            if any(name in self._env.scene.carriers(obj.name) for obj in self._env.scene.objects):
                continue
            for _ in range(TRIES):
                x, y = random.uniform(-strength, strength, 2)
                yaw = float(random.uniform(-1.0, 1.0) * math.pi * min(1.0, 10.0 * strength))
                if _moved(simulation, self._env.scene, name, float(x), float(y), yaw):
                    drawn[name] = [float(x), float(y), yaw]
                    break
        return drawn


def reworded(wordings: Sequence[str], perturbation: Perturbation, seed: int, written: Sequence[str] = ()) -> str:
    """The first of several wordings of an instruction, or perhaps another one, perhaps more politely.

    Args:
        wordings: of the task.
        perturbation: how probably the words are others.
        seed: of the episode.
        written: what somebody else wrote for it, which is taken as it is.
    """
    random = np.random.default_rng([seed, list(LIMITS).index("words")])
    if random.uniform() >= perturbation.words:
        return wordings[0]
    others = [*wordings[1:], *politely(wordings[0]), *(politely(one)[0] for one in wordings[1:]), *written]
    return others[int(random.integers(len(others)))]


class Noise:
    """Noise of an episode's sensors."""

    def __init__(self, strength: float, seed: int) -> None:
        self._strength = strength
        self._random = np.random.default_rng([seed, list(LIMITS).index("noise")])

    def on(self, observation: dict[str, Any]) -> dict[str, Any]:
        """An observation as the sensors tell it; segmentations are of no sensor."""
        if not self._strength:
            return observation
        return {name: self._sensed(name, value) for name, value in observation.items()}

    def _sensed(self, name: str, value: NDArray[Any]) -> NDArray[Any]:
        if name.endswith("_segmentation"):
            return value
        normal = self._random.standard_normal(value.shape)
        if value.dtype == np.uint8:
            return np.clip(np.round(value + 255.0 * self._strength * normal), 0, 255).astype(np.uint8)
        scale = 0.1 * self._strength
        found = value * (1.0 + scale * normal) if name.endswith("_depth") else value + scale * normal
        return np.maximum(found, 0.0).astype(value.dtype) if name.endswith("_depth") else found.astype(value.dtype)


def _material(model: Any, name: str) -> int:
    """Number of a material; -1 for none of that name."""
    import mujoco

    return int(mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_MATERIAL, name))


def _joint(model: Any, place: int) -> int:
    """The joint whose position is at `place` in qpos."""
    return int(np.flatnonzero(model.jnt_qposadr == place)[0])


def _real_arrays(model: Any) -> list[Any]:
    """Every array of the model that physics or cameras may depend on."""
    found = []
    for name in dir(model):
        value = getattr(model, name) if not name.startswith("_") else None
        drawn = name.startswith(("cam_", "light_")) or name == "mat_rgba"
        if isinstance(value, np.ndarray) and value.size and (value.dtype == np.float64 or drawn):
            found.append(value)
    return found


def _statistics(model: Any) -> dict[str, Any]:
    return {name: np.copy(getattr(model.stat, name)) for name in ("meaninertia", "meanmass", "meansize", "extent")}


def _factor(strength: float, random: np.random.Generator) -> float:
    return float(math.exp(random.uniform(-1.0, 1.0) * math.log1p(strength)))


def _moved(simulation: Any, scene: Any, name: str, x: float, y: float, yaw: float) -> bool:
    """Move one object by (x, y) [m] and turn it by `yaw` [rad] about its centre; False where it does not fit there."""
    import mujoco

    world, model, data, state = simulation.world, simulation.model, simulation.data, simulation.state
    before = np.zeros(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_INTEGRATION))
    mujoco.mj_getState(model, data, before, mujoco.mjtState.mjSTATE_INTEGRATION)
    first = int(world.positions[world.objects.index(name)])
    centre, place = state.centre(name).copy(), data.qpos[first : first + 3].copy()
    turn, turned, offset = np.array([math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)]), np.zeros(4), np.zeros(3)
    mujoco.mju_mulQuat(turned, turn, data.qpos[first + 3 : first + 7])
    mujoco.mju_rotVecQuat(offset, place - centre, turn)
    data.qpos[first : first + 3] = centre + offset + [x, y, 0.0]
    data.qpos[first + 3 : first + 7] = turned
    mujoco.mj_forward(model, data)
    number = [obj.name for obj in scene.objects].index(name)
    if _fits(scene, world, data, name, number):
        height = float(state.centre(name)[2])
        for _ in range(SETTLE_STEPS):
            simulation.step(np.zeros(simulation.controller.size))
        fell = height - float(state.centre(name)[2])
        if abs(fell) < 1e-3 and state.still(name):
            return True
    mujoco.mj_setState(model, data, before, mujoco.mjtState.mjSTATE_INTEGRATION)
    mujoco.mj_forward(model, data)
    return False


def _fits(scene: Any, world: Any, data: Any, name: str, number: int) -> bool:
    """Whether an object touches its support, not deeply, and nothing else."""
    parent = scene.parent(name)
    supports = {SUPPORT, FLOOR} if parent == GROUND else {[obj.name for obj in scene.objects].index(parent)}
    carried = False
    for contact, owners in enumerate(world.owner[data.contact.geom].tolist() if data.ncon else []):
        if number not in owners or owners[0] == owners[1]:
            continue
        other = owners[0] if owners[1] == number else owners[1]
        if other not in supports or data.contact.dist[contact] < -DEEPEST:
            return False
        carried = True
    return carried
