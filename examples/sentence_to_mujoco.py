"""A sentence becomes a scene, and the scene loads in MuJoCo and stays still.

Shows `pat3d.generate`, the objects of a scene, and the MJCF file that every scene folder holds.

    python examples/sentence_to_mujoco.py        # writes scenes/books
"""

import mujoco
import numpy as np

import pat3d

SECONDS = 5.0

scene = pat3d.generate("A stack of three books with a red mug on top.", out="scenes/books", seed=0)
for obj in scene.objects:
    print(f"{obj.name}: on {scene.parent(obj.name)}, {obj.asset.mass_properties.mass:.2f} kg")

model = mujoco.MjModel.from_xml_path("scenes/books/mjcf/scene.xml")
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
start = data.xpos.copy()
while data.time < SECONDS:
    mujoco.mj_step(model, data)
drift = np.linalg.norm(data.xpos - start, axis=1).max()
print(f"largest drift in {SECONDS:g} s of MuJoCo: {1e3 * drift:.3f} mm")
