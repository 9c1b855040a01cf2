"""What other packages make of a URDF or SDF export, where they are installed: yourdfpy, PyBullet, Drake."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import CheckError
from pat3d.exporters.common.readback import BodyReadback
from pat3d.exporters.common.xml_files import MeshCorners, box_corners, common, in_body_axes
from pat3d.exporters.urdf.load_drake import load_drake, plant_config
from pat3d.exporters.urdf.load_pybullet import load_pybullet
from pat3d.exporters.urdf.mesh_paths import mesh_file
from pat3d.exporters.urdf.reader import read_manifest
from pat3d.geometry.pose import Pose


def read_with_yourdfpy(folder: str | Path) -> tuple[BodyReadback, ...]:
    """Every link of scene.urdf; a file for viewers, so all are fixed, and friction is not parsed.

    Raises:
        CheckError: yourdfpy finds errors in the file.
    """
    import yourdfpy  # type: ignore[import-not-found]

    folder = Path(folder)
    robot = yourdfpy.URDF.load(
        str(folder / "scene.urdf"), load_meshes=False, load_collision_meshes=False, build_scene_graph=True
    )
    if not robot.validate():
        raise CheckError(f"yourdfpy finds errors in {folder / 'scene.urdf'}: {robot.errors[:3]}")
    meshes = MeshCorners()
    return tuple(
        _link(link, robot.get_transform(name), folder, meshes)
        for name, link in robot.link_map.items()
        if name != "world"
    )


def _link(link: Any, transform: np.ndarray, folder: Path, meshes: MeshCorners) -> BodyReadback:
    origin = link.inertial.origin
    return BodyReadback(
        name=link.name,
        mass=float(link.inertial.mass),
        centre=origin[:3, 3],
        inertia=in_body_axes(link.inertial.inertia, origin[:3, :3]),
        friction=math.nan,
        hulls=tuple(_link_corners(collision, folder, meshes) for collision in link.collisions),
        pose=Pose.from_matrix(transform[:3, :3], transform[:3, 3]),
        fixed=True,
    )


def _link_corners(collision: Any, folder: Path, meshes: MeshCorners) -> NDArray[np.float64]:
    """Corners of a collider [m], in the frame of its link, shape (corners, 3)."""
    shape = collision.geometry
    if shape.box:
        corners = box_corners(shape.box.size)
    else:
        corners = meshes.of(mesh_file(shape.mesh.filename, folder, folder))
        if shape.mesh.scale is not None:
            corners = corners * np.asarray(shape.mesh.scale)
    place = collision.origin
    return corners if place is None else corners @ place[:3, :3].T + place[:3, 3]


def read_with_pybullet(folder: str | Path) -> tuple[BodyReadback, ...]:
    """Every body that PyBullet's loader makes; it does not tell the vertices of hulls, nor the mass of what is fixed.

    Raises:
        CheckError: PyBullet refuses a file.
    """
    import pybullet  # type: ignore[import-not-found]

    folder = Path(folder)
    manifest = read_manifest(folder)
    client = pybullet.connect(pybullet.DIRECT)
    try:
        bodies = load_pybullet(folder, client, geometric_friction=False)
        return tuple(_bullet_body(pybullet, client, entry, bodies[entry["name"]]) for entry in manifest["objects"])
    except pybullet.error as error:
        raise CheckError(f"PyBullet refuses the files of {folder}: {error}") from error
    finally:
        pybullet.disconnect(client)


def _bullet_body(pybullet: Any, client: int, entry: dict[str, Any], body: int) -> BodyReadback:
    mass, friction, moments, centre, turn = pybullet.getDynamicsInfo(body, -1, physicsClientId=client)[:5]
    placed = pybullet.getBasePositionAndOrientation(body, physicsClientId=client)
    position, quat = pybullet.multiplyTransforms(*placed, *pybullet.invertTransform(centre, turn))
    x, y, z, w = turn
    axes = Pose(quat_wxyz=(w, x, y, z)).rotation
    x, y, z, w = quat
    return BodyReadback(
        name=entry["name"],
        mass=mass,
        centre=np.array(centre),
        inertia=in_body_axes(np.diag(moments), axes),
        friction=friction,
        hulls=(),
        pose=Pose(position=position, quat_wxyz=(w, x, y, z)),
        fixed=mass == 0.0,
    )


def read_with_drake(path: str | Path) -> tuple[BodyReadback, ...]:
    """Every body that Drake's parser makes of a URDF export's folder, or of an SDF world.

    Raises:
        CheckError: Drake refuses a file.
    """
    from pydrake.multibody import parsing  # type: ignore[import-not-found]
    from pydrake.multibody import plant as plants  # type: ignore[import-not-found]
    from pydrake.systems.framework import DiagramBuilder  # type: ignore[import-not-found]

    builder = DiagramBuilder()
    path = Path(path)
    plant, graph = plants.AddMultibodyPlant(plant_config(), builder)
    try:
        if path.is_dir():
            names = load_drake(path, plant)
        else:
            models = parsing.Parser(plant).AddModels(str(path))
            names = {
                plant.GetModelInstanceName(model).split("::")[-1]: plant.GetBodyByName("link", model)
                for model in models
            }
    except RuntimeError as error:
        raise CheckError(f"Drake refuses {path}: {error}") from error
    plant.Finalize()
    context = plant.CreateDefaultContext()
    inspector = graph.model_inspector()
    return tuple(_drake_body(plant, context, inspector, name, body) for name, body in names.items() if name != "ground")


def _drake_body(plant: Any, context: Any, inspector: Any, name: str, body: Any) -> BodyReadback:
    centre = body.default_com()
    inertia = body.default_spatial_inertia().Shift(centre).CalcRotationalInertia().CopyToFullMatrix3()
    geometries = plant.GetCollisionGeometriesForBody(body)
    frictions = [
        inspector.GetProximityProperties(geometry).GetProperty("material", "coulomb_friction")
        for geometry in geometries
    ]
    transform = plant.EvalBodyPoseInWorld(context, body)
    return BodyReadback(
        name=name,
        mass=body.default_mass(),
        centre=np.array(centre),
        inertia=inertia,
        friction=common([value for one in frictions for value in (one.static_friction(), one.dynamic_friction())]),
        hulls=tuple(_drake_corners(inspector, geometry) for geometry in geometries),
        pose=Pose.from_matrix(transform.rotation().matrix(), transform.translation()),
        fixed=bool(plant.IsAnchored(body)),
    )


def _drake_corners(inspector: Any, geometry: Any) -> NDArray[np.float64]:
    """Corners [m] of a box, or of the hull that Drake computes of a convex mesh, in the frame of the body."""
    shape = inspector.GetShape(geometry)
    if hasattr(shape, "size"):
        corners = box_corners(shape.size())
    else:
        hull = shape.GetConvexHull()
        corners = np.array([hull.vertex(number) for number in range(hull.num_vertices())])
    place = inspector.GetPoseInFrame(geometry)
    return corners @ place.rotation().matrix().T + place.translation()
