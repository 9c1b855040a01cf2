"""Reader of the rigid-ipc suite's scenes (Ferguson et al. 2021), where a copy of them is at hand.

The suite is y up and free in scale; scenes are turned to z up and shrunk to household size. Its rotations are
R_z R_y R_x of angles in degrees, and a body's position is that of its mesh's origin. Sheets without thickness
become slabs: fixed ones grow away from the bodies that move, cards grow evenly to both sides.
"""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.pose import Pose
from pat3d.sim.model import Model, ModelBuilder

REPOSITORY = Path(__file__).resolve().parents[2]
VARIABLE = "PAT3D_PEER_FIXTURES"
"""Environment variable that names the folder with `fixtures/` and `meshes/`."""

SLAB = 0.2
"""Thickness of a fixed sheet [fixture units]."""
CARD = 0.02
"""Thickness of a free sheet [fixture units]."""
LIFT = 0.1
"""Height of the lowest vertex above the ground [fixture units]."""
DENSITY = 1000.0
"""[kg/m^3] where a fixture names none."""

Z_UP = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
"""Takes y-up coordinates to z-up ones."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FixtureBody:
    """One body in the z-up world, placed and scaled."""

    name: str
    vertices: NDArray[np.float64]
    """In the body's frame [m], shape (vertices, 3)."""
    faces: NDArray[np.int32]
    pose: Pose
    fixed: bool
    density: float
    velocity: NDArray[np.float64]
    """[m/s], shape (3,)."""
    spin: NDArray[np.float64]
    """[rad/s], shape (3,)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Fixture:
    """A scene of the suite."""

    name: str
    bodies: tuple[FixtureBody, ...]
    friction: float

    def model(self) -> Model:
        """The scene on the processor, above the ground z = 0."""
        builder = ModelBuilder()
        for body in self.bodies:
            properties = mass_properties(body.vertices, body.faces, density=body.density)
            builder.add_body(
                [ConvexPart(vertices=body.vertices, faces=body.faces)],
                mass=properties.mass,
                volume=properties.volume,
                centre=np.array(properties.centre_of_mass),
                second_moment=properties.second_moment,
                pose=body.pose,
                fixed=body.fixed,
                label=body.name,
            )
        return builder.finalize("cpu")

    def launched(self, model: Model, time_step: float) -> NDArray[np.float64]:
        """States that the fixture's velocities would reach in one free step, shape (bodies, 4, 3)."""
        q = model.q0.copy()
        for b, body in enumerate(self.bodies):
            if not body.fixed:
                q[b, 0] += time_step * body.velocity
                q[b, 1:] += time_step * np.cross(body.spin, q[b, 1:])
        return q


def fixture_folder() -> Path | None:
    """The folder with `fixtures/` and `meshes/`, or None where there is none."""
    named = os.environ.get(VARIABLE)
    folder = Path(named) if named else REPOSITORY.parent / "shared" / "rigid-ipc"
    return folder if (folder / "fixtures").is_dir() else None


def fixture_names(under: str = "") -> list[str]:
    """Names of all fixtures under a folder, such as "unit-tests/bat"; empty where the suite is absent."""
    folder = fixture_folder()
    if folder is None:
        return []
    root = folder / "fixtures"
    return sorted(str(path.relative_to(root).with_suffix("")) for path in (root / under).rglob("*.json"))


def read_fixture(name: str, scale: float = 0.1) -> Fixture:
    """The fixture of that name.

    Args:
        name: as `fixture_names` lists it.
        scale: length of a fixture unit [m].
    """
    folder = fixture_folder()
    if folder is None:
        raise FileNotFoundError(f"no rigid-ipc fixtures; set {VARIABLE} to the folder that holds them.")
    # Some names end in a decimal number, which must not be taken for a suffix.
    problem = json.loads((folder / "fixtures" / f"{name}.json").read_text())["rigid_body_problem"]
    entries = [entry for entry in problem["rigid_bodies"] if entry.get("enabled", True)]
    moving = [np.array(entry.get("position", (0, 0, 0)), dtype=float) for entry in entries if not _is_fixed(entry)]
    target = np.mean(moving, axis=0)
    placed = [_body(folder, entry, target) for entry in entries]
    lowest = min((vertices @ rotation.T + position)[:, 2].min() for vertices, _, rotation, position in placed)
    bodies = []
    for entry, (vertices, faces, rotation, position) in zip(entries, placed, strict=True):
        position = scale * (position + [0, 0, LIFT - lowest])
        bodies.append(
            FixtureBody(
                name=f"{Path(entry['mesh']).stem} {len(bodies)}",
                vertices=scale * vertices,
                faces=faces,
                pose=Pose.from_matrix(rotation, position),
                fixed=_is_fixed(entry),
                density=float(entry.get("density", DENSITY)),
                velocity=scale * (Z_UP @ np.array(entry.get("linear_velocity", (0, 0, 0)), dtype=float)),
                spin=np.deg2rad(Z_UP @ np.array(entry.get("angular_velocity", (0, 0, 0)), dtype=float)),
            )
        )
    return Fixture(name=name, bodies=tuple(bodies), friction=float(problem.get("coefficient_friction", 0.0)))


def _is_fixed(entry: dict[str, Any]) -> bool:
    """Whether all six degrees of freedom are fixed; bodies with some fixed are read as free."""
    flags = entry.get("is_dof_fixed", False)
    return entry.get("type") == "static" or (all(flags) if isinstance(flags, list) else bool(flags))


def _body(folder: Path, entry: dict[str, Any], target: NDArray[np.float64]):
    """Vertices, faces, rotation and position in the z-up world, in fixture units."""
    vertices, faces = read_obj(folder / "meshes" / entry["mesh"])
    if "dimensions" in entry:
        extent = np.ptp(vertices, axis=0)
        size = np.array(entry["dimensions"], dtype=float)
        vertices = vertices * np.where(extent > 0, size / np.where(extent > 0, extent, 1.0), 1.0)
    vertices = vertices * np.broadcast_to(np.array(entry.get("scale", 1.0), dtype=float), 3)
    angles = np.array(entry.get("rotation", (0, 0, 0)), dtype=float)
    rotation = Rotation.from_euler("xyz", angles, degrees=True).as_matrix()
    position = np.array(entry.get("position", (0, 0, 0)), dtype=float)
    if np.ptp(vertices[:, 1]) == 0.0:
        above = (rotation.T @ (target - position))[1] >= 0
        spread = (-0.5 * CARD, 0.5 * CARD)
        if _is_fixed(entry):
            spread = (-SLAB, 0.0) if above else (0.0, SLAB)
        vertices, faces = thicken(vertices, faces, spread)
    return vertices @ Z_UP.T, faces, Z_UP @ rotation @ Z_UP.T, Z_UP @ position


def thicken(
    vertices: NDArray[np.float64], faces: NDArray[np.int32], spread: tuple[float, float]
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """The closed slab between y offsets `spread` of an open sheet in the plane y = const that faces +y."""
    count = len(vertices)
    directed = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    known = {(int(a), int(b)) for a, b in directed}
    rim = [(a, b) for a, b in known if (b, a) not in known]
    sides = [triangle for a, b in sorted(rim) for triangle in ((a, a + count, b + count), (a, b + count, b))]
    bottom, top = (vertices + [0.0, offset, 0.0] for offset in spread)
    return (
        np.vstack([top, bottom]),
        np.vstack([faces, faces[:, ::-1] + count, np.array(sides)]).astype(np.int32),
    )


def read_obj(path: Path) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Vertices and triangles of an OBJ file; polygons are fanned and unused vertices dropped."""
    vertices, faces = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
            faces += [[corners[0], corners[i], corners[i + 1]] for i in range(1, len(corners) - 1)]
    used, faces = np.unique(np.array(faces), return_inverse=True)
    return np.array(vertices)[used], faces.reshape(-1, 3).astype(np.int32)
