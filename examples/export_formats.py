"""One scene in MJCF, USD, URDF and SDF, each read back by the parsers that are installed.

`export` writes the formats. `parity` loads a written file again and compares mass, centre of mass, inertia, friction,
convex parts and pose of every body with the scene; at most one part in a million may differ.

    python examples/export_formats.py            # writes scenes/pens and exports/pens
"""

import importlib.util
from pathlib import Path

import mujoco

import pat3d
from pat3d.exporters import export, parity

formats = ["mjcf", "urdf", "sdf"]
if importlib.util.find_spec("pxr"):
    formats.append("usd")  # pip install 'pat3d[usd]'

scene = pat3d.generate("A pen holder with two pencils.", out="scenes/pens", seed=0)
paths = export(scene, formats, "exports/pens")
for name, path in paths.items():
    found = parity(scene, path)
    readers = ", ".join(reading.reader for reading in found.readings)
    print(f"{name}: read by {readers}; largest error {found.largest:.1e}; absent: {', '.join(found.absent) or 'none'}")
    if not found.passed:
        raise SystemExit("\n".join(found.failures))

model = mujoco.MjModel.from_xml_path(str(paths["mjcf"]))
print(f"MuJoCo: {model.nbody - 1} bodies, {model.ngeom} geoms")
if "usd" in paths:
    from pxr import Usd, UsdPhysics

    stage = Usd.Stage.Open(str(paths["usd"]))
    bodies = [prim for prim in stage.Traverse() if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    print(f"OpenUSD: {len(bodies)} rigid bodies")
if importlib.util.find_spec("pybullet"):
    import pybullet

    from pat3d.exporters.urdf.load_pybullet import load_pybullet

    client = pybullet.connect(pybullet.DIRECT)
    print(f"PyBullet: {sorted(load_pybullet(Path(paths['urdf']).parent, client))}")
