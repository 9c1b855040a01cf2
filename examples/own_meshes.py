"""Your own mesh in a scene, by a specification in YAML.

A mesh file is read, repaired, weighed and split into convex parts; the layout, the settling and the checks are those
of a sentence. `pat3d build --schema` prints everything that a specification may say.

    python examples/own_meshes.py                # writes bracket.stl, scene.yaml and scenes/bracket
"""

from pathlib import Path

import trimesh

import pat3d

SPECIFICATION = """
seed: 0
objects:
  - {name: tray, noun: tray, size: 0.4}
  - {name: bracket, mesh: bracket.stl, units: mm, up: z, mass: 0.12, material: aluminium}
  - {name: mug, noun: mug, colour: blue}
relations:
  - {child: bracket, kind: "on", parent: tray}
  - {child: mug, kind: next_to, parent: tray}
"""

# An L of two blocks, in millimetres as CAD programs write it.
foot = trimesh.creation.box(bounds=[[0, 0, 0], [80, 40, 10]])
wall = trimesh.creation.box(bounds=[[0, 0, 0], [10, 40, 60]])
trimesh.boolean.union([foot, wall], engine="manifold").export("bracket.stl")
Path("scene.yaml").write_text(SPECIFICATION)

scene = pat3d.build("scene.yaml", out="scenes/bracket")
bracket = scene["bracket"].asset
print(f"bracket: {bracket.mass_properties.mass:.2f} kg, {len(bracket.parts)} convex parts, size {bracket.size} m")
print("written: scenes/bracket")
