"""What is wrong with a noun that is data, beyond its grammar: found by making it."""

from __future__ import annotations

import numpy as np

from pat3d.assets.catalogue import lookup
from pat3d.assets.catalogue.lookup import make_entry
from pat3d.assets.library.resting import resting_poses
from pat3d.assets.mesh.cover import outside, surface_points
from pat3d.assets.mesh.topology import signed_volume
from pat3d.assets.nouns.program import Program
from pat3d.assets.variant import Variant
from pat3d.errors import Pat3dError
from pat3d.geometry.planes import face_count
from pat3d.scene.asset import Asset

SEEDS = (0, 1, 2)
STICKS_OUT = 1e-4
"""By how much [m] the picture may stick out of the convex parts."""
SIZES = (0.002, 5.0)
"""Longest sides [m] of things in scenes."""
MOST_CORNERS = 64
"""Of a convex part, and of its faces, coplanar triangles as one."""


def faults_of(program: Program) -> tuple[list[str], list[str], Asset | None]:
    """What is wrong, what is only odd, and the object of the first seed, where there is one.

    Args:
        program: a valid noun.
    """
    faults, oddities, first = list[str](), list[str](), None
    for seed in SEEDS:
        try:
            made = make_entry(program.entry, program.entry.noun, Variant(seed=seed))
        except Pat3dError as error:
            faults.append(f"seed {seed}: {error}")
            continue
        first = first or made
        faults += [f"seed {seed}: {one}" for one in _faults(made)]
    if first is not None:
        oddities += _oddities(program, first)
    return list(dict.fromkeys(faults)), oddities, first


def _faults(made: Asset) -> list[str]:
    found = []
    longest = float(made.size.max())
    if not SIZES[0] <= longest <= SIZES[1]:
        found.append(f"it is {longest:.3g} m long; {SIZES[0]:g} to {SIZES[1]:g} m can be. Lengths are in metres.")
    for number, part in enumerate(made.parts):
        if max(len(part.vertices), face_count(part)) > MOST_CORNERS:
            found.append(
                f"convex part {number} has {len(part.vertices)} corners and {face_count(part)} faces; at most "
                f"{MOST_CORNERS} each. Give fewer sides or points."
            )
        if signed_volume(part.vertices, part.faces) < 1e-3 * float(np.prod(np.ptp(part.vertices, axis=0))) * 1e-2:
            found.append(f"convex part {number} is flat.")
    points = surface_points(made.visual.vertices, made.visual.faces)
    gap = float(outside(points, list(made.parts))[0].max())
    if gap > STICKS_OUT:
        found.append(
            f"its picture sticks out of its convex parts by {1e3 * gap:.1f} mm; what is unseen or a spot has to be "
            "inside another part."
        )
    rests = resting_poses(np.concatenate([part.vertices for part in made.parts]), least=0.0)
    if not any(rest.tilt < 1.0 for rest in rests):
        found.append(
            "it does not stand as it is drawn: its centre of mass is not above its base, or the base is round."
        )
    return found


def _oddities(program: Program, made: Asset) -> list[str]:
    found = []
    pieces = _pieces(made)
    if pieces > 1:
        found.append(f"it is in {pieces} pieces that do not touch; they move as one body.")
    known = [name for name in (program.entry.noun, *program.entry.synonyms) if lookup.find(name) is not None]
    if known:
        found.append(f"{', '.join(known)}: the catalogue has it too; yours comes first.")
    density = made.mass_properties.mass / made.mass_properties.volume
    if not 10.0 <= density <= 12_000.0:
        found.append(f"{made.mass_properties.mass:.3g} kg in its volume is a density of {density:.3g} kg/m^3.")
    return found


def _pieces(made: Asset) -> int:
    """Connected pieces of the picture's mesh."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    faces, count = made.visual.faces, len(made.visual.vertices)
    rows, columns = faces[:, [0, 1, 2]].ravel(), faces[:, [1, 2, 0]].ravel()
    joined = coo_matrix((np.ones(len(rows)), (rows, columns)), shape=(count, count))
    _, label = connected_components(joined, directed=False)
    return len(set(label[np.unique(faces)].tolist()))
