"""Meshes and scenes for the picture tests, made without the catalogue."""

import numpy as np
import trimesh

from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.mass import MassProperties
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset, Material, VisualMesh
from pat3d.scene.model import Scene, SceneObject


def painted(mesh: trimesh.Trimesh, colour: tuple[int, int, int]) -> VisualMesh:
    colours = np.tile(np.array(colour, dtype=np.uint8), (len(mesh.faces), 1))
    return VisualMesh.from_face_colours(np.array(mesh.vertices), np.array(mesh.faces, dtype=np.int32), colours)


def ball(radius: float = 0.05, colour: tuple[int, int, int] = (200, 60, 40), detail: int = 4) -> VisualMesh:
    return painted(trimesh.creation.icosphere(subdivisions=detail, radius=radius), colour)


def block(size: tuple[float, float, float] = (0.1, 0.1, 0.1), colour: tuple[int, int, int] = (60, 90, 200)):
    return painted(trimesh.creation.box(size), colour)


def scene() -> Scene:
    material = Material(name="wood", density=600.0, friction=0.4)
    objects = []
    for name, mesh, start in (("red ball", ball(), (0.0, 0.0, 0.2)), ("blue block", block(), (0.2, 0.0, 0.06))):
        hull = trimesh.creation.box((0.1, 0.1, 0.1))
        part = ConvexPart(vertices=np.array(hull.vertices), faces=np.array(hull.faces, dtype=np.int32))
        mass = MassProperties(mass=1.0, volume=1e-3, centre_of_mass=(0, 0, 0), inertia=tuple(map(tuple, np.eye(3))))
        asset = Asset(noun=name, visual=mesh, parts=(part,), mass_properties=mass, material=material)
        rest = Pose(position=(start[0], start[1], 0.05))
        objects.append(SceneObject(name=name, asset=asset, pose=rest, initial_pose=Pose(position=start)))
    return Scene(objects=tuple(objects))
