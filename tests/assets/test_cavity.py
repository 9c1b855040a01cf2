import numpy as np
import pytest

from pat3d.assets import shapes
from pat3d.assets.mesh.cavity import cavity_loss
from pat3d.geometry.hulls import convex_part
from pat3d.scene.asset import Region


def slab(x, y, z):
    return convex_part(np.array([[a, b, c] for a in x for b in y for c in z]))


def crate(half_x):
    """Parts of a crate 12 cm wide whose cavity is 2 `half_x` long and 10 cm wide."""
    wide, tall = (-0.06, 0.06), (0.0, 0.1)
    return [
        slab((half_x, 0.06), wide, tall),
        slab((-0.06, -half_x), wide, tall),
        slab(wide, (0.05, 0.06), tall),
        slab(wide, (-0.06, -0.05), tall),
        slab(wide, wide, (0.0, 0.01)),
    ]


@pytest.mark.parametrize("half_x", [0.05, 0.04])
def test_walls_take_their_share_of_the_rays_that_meet_them(half_x):
    """A wall at 4 cm for one at 5 cm takes a fifth of every ray that meets it, and nothing of the others."""
    outside, inside = shapes.box(0.12, 0.12, 0.1).solid, shapes.box(0.1, 0.1, 0.1).moved(z=0.01).solid
    mesh = (outside - inside).to_mesh64()
    vertices, faces = np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64)
    region = Region(kind="in", shape="rectangle", floor=(0, 0, 0.01), half_size=(0.05, 0.05), height=0.09)
    directions = 64
    loss = cavity_loss(vertices, faces, crate(half_x), region, directions=directions, levels=1)
    angle = 2 * np.pi * (np.arange(directions) + 0.5) / directions
    before = np.minimum(0.05 / np.abs(np.cos(angle)), 0.05 / np.abs(np.sin(angle)))
    after = np.minimum(half_x / np.abs(np.cos(angle)), 0.05 / np.abs(np.sin(angle)))
    np.testing.assert_allclose(loss, 1 - after / before, atol=1e-6)
