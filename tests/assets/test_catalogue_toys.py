"""Toys, animals, figures, clothing and outdoor things: closed, contained in their hulls, standing, plausible."""

from functools import cache

import numpy as np
import pytest
import trimesh
from scipy.spatial import ConvexHull

from pat3d.assets.catalogue import entries, make
from pat3d.assets.colours import COLOURS

FAMILIES = ("animals", "plush", "toys", "wear", "outdoor")
NOUNS = [made.noun for made in entries() if made.family in FAMILIES]


@cache
def _made(noun, seed=0):
    return make(noun, seed=seed)


def _outside(points, parts):
    """How far each point [m], shape (n, 3), lies outside the union of convex parts at most, shape (n,)."""
    distance = np.full(len(points), np.inf)
    for part in parts:
        equations = ConvexHull(part.vertices).equations
        distance = np.minimum(distance, np.max(points @ equations[:, :3].T + equations[:, 3], axis=1))
    return distance


@pytest.mark.parametrize("noun", NOUNS)
@pytest.mark.parametrize("seed", [0, 1])
def test_visual_is_closed_and_lies_inside_small_convex_parts(noun, seed):
    asset = _made(noun, seed)
    mesh = trimesh.Trimesh(asset.visual.vertices, asset.visual.faces, process=False)
    assert mesh.is_watertight
    assert mesh.volume > 0
    centres = asset.visual.vertices[asset.visual.faces].mean(axis=1)
    assert _outside(np.concatenate([asset.visual.vertices, centres]), asset.parts).max() < 1e-6
    assert len(asset.parts) <= 24
    for part in asset.parts:
        assert len(part.vertices) <= 64
        assert len(part.faces) <= 64
        # Thickness along the narrowest face normal: no slivers under a millimetre.
        equations = ConvexHull(part.vertices).equations
        assert np.ptp(part.vertices @ equations[:, :3].T, axis=0).min() > 0.99e-3


@pytest.mark.parametrize("noun", NOUNS)
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_stands_on_a_flat_base_below_its_centre_of_mass(noun, seed):
    asset = _made(noun, seed)
    points = np.concatenate([part.vertices for part in asset.parts])
    assert points[:, 2].min() == pytest.approx(0.0, abs=1e-9)
    feet = points[points[:, 2] < 1e-9][:, :2]
    support = ConvexHull(feet)
    near = points[points[:, 2] < 1e-4]
    assert near[:, 2].max() < 1e-9, "corners a hair above the base would carry load after it settles"
    centre = np.array(asset.mass_properties.centre_of_mass[:2])
    margin = -np.max(support.equations[:, :2] @ centre + support.equations[:, 2])
    assert margin > 0.1 * np.sqrt(support.volume)


@pytest.mark.parametrize("noun", NOUNS)
def test_seed_decides_every_bit_and_another_seed_another_shape(noun):
    first, same, other = _made(noun), make(noun, seed=0), _made(noun, 1)
    assert np.array_equal(first.visual.vertices, same.visual.vertices)
    assert np.array_equal(first.visual.texture, same.visual.texture)
    assert all(np.array_equal(a.vertices, b.vertices) for a, b in zip(first.parts, same.parts, strict=True))
    assert not np.allclose(first.parts[0].vertices, other.parts[0].vertices, atol=1e-6)


@pytest.mark.parametrize("noun", NOUNS)
def test_the_asked_colour_covers_a_large_part_of_the_surface(noun):
    """Teal is nobody's default, so that its texels can only come from the request."""
    visual = make(noun, colours=["teal"]).visual
    height, width = visual.texture.shape[:2]
    u, v = visual.uv.mean(axis=1).T
    texel = visual.texture[((1 - v) * height).astype(int), (u * width).astype(int)].astype(int)
    corners = visual.vertices[visual.faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    colours, index = np.unique(texel, axis=0, return_inverse=True)
    covered = np.bincount(index.reshape(-1), weights=area)
    # Shades of the colour count as it: same direction in RGB.
    teal = np.array(COLOURS["teal"], dtype=float)
    same = colours @ teal / (np.linalg.norm(colours, axis=1) * np.linalg.norm(teal)) > 0.995
    assert covered[same].sum() > 0.3 * covered.sum()


def test_plush_dog_offers_the_flat_crown_of_its_head_to_hats():
    dog = _made("plush dog")
    region = dog.region("on")
    assert region is not None
    assert region.floor[2] == pytest.approx(dog.bounds[1, 2], abs=1e-9)
    angle = np.linspace(0, 2 * np.pi, 16)
    rim = np.array(region.floor) + region.half_size[0] * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    assert _outside(rim - (0, 0, 1e-6), dog.parts).max() < 0
