"""Milliseconds a frame of libuipc (pyuipc) on a file of meshes and transforms; prints JSON.

Run in an environment of its own: python libuipc.py SCENE.npz FRAMES WORKSPACE

The file holds vertices [m], faces, transforms (bodies, 4, 4), density, dt, friction and d_hat.
"""

from __future__ import annotations

import json
import sys
import time

import numpy as np
from uipc import Engine, Logger, Scene, World, view
from uipc.constitution import AffineBodyConstitution
from uipc.geometry import ground, label_surface, trimesh


def main() -> None:
    """Simulate and print."""
    data, frames, workspace = np.load(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
    Logger.set_level(Logger.Level.Error)
    config = Scene.default_config()
    config["dt"] = float(data["dt"])
    config["gravity"] = [[0.0], [0.0], [-9.81]]
    config["contact"]["d_hat"] = float(data["d_hat"])
    config["contact"]["friction"]["enable"] = 1
    scene = Scene(config)
    scene.contact_tabular().default_model(float(data["friction"]), 1e9)
    element = scene.contact_tabular().default_element()
    mesh = trimesh(data["vertices"], data["faces"].astype(np.int32))
    label_surface(mesh)
    AffineBodyConstitution().apply_to(mesh, 1e8, float(data["density"]))
    element.apply_to(mesh)
    transforms = data["transforms"]
    slots = []
    for k, transform in enumerate(transforms):
        body = mesh.copy()
        view(body.transforms())[0] = transform
        slot, _ = scene.objects().create(f"body{k}").geometries().create(body)
        slots.append(slot)
    scene.objects().create("ground").geometries().create(ground(0.0, np.array([0.0, 0.0, 1.0])))
    engine = Engine("cuda", workspace)
    world = World(engine)
    world.init(scene)
    if not world.is_valid():
        raise SystemExit("libuipc refused the scene.")
    seconds, motion, last = [], [], transforms[:, :3, 3]
    for _ in range(frames):
        start = time.perf_counter()
        world.advance()
        world.retrieve()
        seconds.append(time.perf_counter() - start)
        now = np.array([view(slot.geometry().transforms())[0][:3, 3] for slot in slots])
        motion.append(float(np.abs(now - last).max()))
        last = now
    print(json.dumps({"seconds": seconds, "motion": motion, "lowest": float(last[:, 2].min())}))


if __name__ == "__main__":
    main()
