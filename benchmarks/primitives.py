"""Do spheres and cylinders of the engine hold a scene as still as convex meshes do? Both ways, 5 s in MuJoCo.

python benchmarks/primitives.py FOLDER [FOLDER ...] [--seconds 60]

A copy of every scene's MJCF gets a sphere for every object of one part whose surface is one, and a cylinder for every
convex part with its vertices on two equal circles. Printed are how many that are, and the furthest that an object
strays from its pose with meshes and with primitives, first as written, then with gravity that leans towards +x by the
tilt that every verified scene stands.
"""

from __future__ import annotations

import argparse
import math
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from pat3d.check.settle import SettleReport, settle_in_mujoco
from pat3d.exporters.common.frames import text
from pat3d.exporters.common.objects import body_names
from pat3d.exporters.mjcf.writer import write_mjcf
from pat3d.scene.io import load_scene
from pat3d.scene.physics import GRAVITY, LEAST_TILT

EXACT = 1e-3
"""Error of a cylinder's radius, as a share of it."""

ROUND = 0.03
"""The same of a ball with dimples or seams."""

LEAST = 12
"""Vertices of a circle."""


def sphere(points: NDArray[np.float64]) -> dict[str, str] | None:
    """Attributes of the sphere that `points` [m], shape (n, 3), lie on; None where they do not."""
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    distances = np.linalg.norm(points - centre, axis=1)
    if len(points) < 8 * LEAST or np.ptp(distances) > ROUND * distances.max():
        return None
    # What it touches it touches where its bounds are.
    return {"type": "sphere", "pos": text(*centre), "size": text(float(np.ptp(points, axis=0).min()) / 2)}


def cylinder(points: NDArray[np.float64]) -> dict[str, str] | None:
    """Attributes of the cylinder whose rims `points` [m], shape (n, 3), lie on; None where they do not."""
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    for axis in np.linalg.svd(points - points.mean(axis=0))[2]:
        along = (points - centre) @ axis
        half = float(np.abs(along).max())
        across = points - centre - along[:, None] * axis
        radii = np.linalg.norm(across, axis=1)
        radius = float(radii.max())
        ends = np.minimum(abs(along - half), abs(along + half))
        if len(points) >= 2 * LEAST and ends.max() < EXACT * half and np.ptp(radii) < EXACT * radius:
            turn = Rotation.align_vectors([axis], [[0, 0, 1]])[0].as_quat(scalar_first=True)
            return {"type": "cylinder", "pos": text(*centre), "quat": text(*turn), "size": text(radius, half)}
    return None


def changed(mjcf: Path, shapes: dict[str, dict[str, str]], lean: float = 0.0) -> Path:
    """A copy of scene.xml with `shapes` for the geoms of their names and gravity that leans [degrees]."""
    tree = ET.parse(mjcf)
    for geom in tree.iter("geom"):
        if geom.get("name", "") in shapes:
            for key in ("mesh", "pos", "quat"):
                geom.attrib.pop(key, None)
            geom.attrib.update(shapes[geom.get("name", "")])
    option = next(tree.iter("option"))
    option.set("gravity", text(GRAVITY * math.sin(math.radians(lean)), 0, -GRAVITY * math.cos(math.radians(lean))))
    path = mjcf.with_name("changed.xml")
    tree.write(path)
    return path


def furthest(report: SettleReport) -> str:
    """The largest stray of any object, in words."""
    mm = max(max(obj.centre_mm, obj.origin_mm) for obj in report.objects)
    degrees = max(obj.degrees for obj in report.objects)
    return f"{mm:.3f} mm {degrees:.2f} degrees"


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--seconds", type=float, default=5.0)
    given = parser.parse_args()
    for folder in given.folders:
        scene = load_scene(folder)
        names = body_names(scene)
        shapes = {}
        for obj in scene.objects:
            for number, part in enumerate(obj.asset.parts):
                ball = sphere(obj.asset.visual.vertices) if len(obj.asset.parts) == 1 else None
                found = ball or cylinder(part.vertices)
                if found:
                    shapes[f"{names[obj.name]}/part_{number:03d}"] = found
        kinds = [shape["type"] for shape in shapes.values()]
        words = f"{folder.name:24} {kinds.count('sphere'):3} spheres {kinds.count('cylinder'):3} cylinders"
        if not shapes:
            print(words, flush=True)
            continue
        with tempfile.TemporaryDirectory() as scratch:
            mjcf = write_mjcf(scene, Path(scratch) / "mjcf")
            cells = []
            for lean in (0.0, LEAST_TILT):
                for name, geoms in (("meshes", {}), ("primitives", shapes)):
                    found = settle_in_mujoco(changed(mjcf, geoms, lean), given.seconds)
                    cells.append(f"{name} {furthest(found)}")
        print(f"{words}  {', '.join(cells[:2])}; leaning {', '.join(cells[2:])}", flush=True)


if __name__ == "__main__":
    main()
