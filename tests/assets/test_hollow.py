"""Pieces of a wall are cut where they bridge a hollow, and no others."""

import numpy as np
import pytest

from pat3d.assets import shapes
from pat3d.assets.mesh.cavity import probe
from pat3d.assets.mesh.hollow import opened
from pat3d.assets.mesh.repair import solid_of
from pat3d.scene.asset import Region


def _ring_of(count):
    """A pot with a round hollow of 4 cm, and its wall and floor as `count` sectors and a disc."""
    outer, inner = shapes.cylinder(0.05, 0.1).solid, shapes.cylinder(0.04, 0.1).moved(z=0.01).solid
    pot = outer - inner
    floor = np.asarray((pot.trim_by_plane((0, 0, -1), -0.01)).to_mesh64().vert_properties)[:, :3]
    wall = pot.trim_by_plane((0, 0, 1), 0.01)
    pieces = [floor]
    for k in range(count):
        a, b = 2 * np.pi * k / count, 2 * np.pi * (k + 1) / count
        sector = wall.trim_by_plane((-np.sin(a), np.cos(a), 0), 0).trim_by_plane((np.sin(b), -np.cos(b), 0), 0)
        pieces.append(np.asarray(sector.to_mesh64().vert_properties)[:, :3])
    region = Region(kind="in", shape="disc", floor=(0, 0, 0.01), half_size=(0.04, 0.04), height=0.09)
    solid = solid_of(pot)
    return pieces, solid, probe(solid.vertices, solid.faces, region)


def _lost(pieces, seen):
    from scipy.spatial import ConvexHull

    left = np.min([seen.reach(ConvexHull(piece).equations) for piece in pieces], axis=0)
    return float(np.median(seen.loss(left)))


def test_sectors_of_a_round_wall_are_halved_until_it_stays_open():
    """A sector of 2 pi / n takes 1 - cos(pi / n) of the radius in its middle: 8 take 7.6 %, 16 take 1.9 %."""
    pieces, solid, seen = _ring_of(8)
    assert _lost(pieces, seen) > 0.04
    done = opened(pieces, solid, seen, most=64, wanted=0.01)
    assert _lost(done, seen) <= 0.01
    assert 12 <= len(done) <= 33
    np.testing.assert_array_equal(done[0], pieces[0])


def test_what_is_open_enough_or_has_no_room_stays():
    pieces, solid, seen = _ring_of(8)
    for most, wanted in ((64, 0.1), (9, 0.01)):
        done = opened(pieces, solid, seen, most=most, wanted=wanted)
        assert len(done) == len(pieces)
        assert all(one is other for one, other in zip(done, pieces, strict=True))


def test_halves_hold_what_the_whole_held():
    """Every corner of the pot is in one of the hulls, and their volumes are the pot's to what chords add."""
    from scipy.spatial import ConvexHull

    pieces, solid, seen = _ring_of(8)
    done = [ConvexHull(piece) for piece in opened(pieces, solid, seen, most=64)]
    inside = [(solid.vertices @ one.equations[:, :3].T + one.equations[:, 3]).max(axis=1) < 1e-9 for one in done]
    assert np.any(inside, axis=0).all()
    pot = np.pi * (0.05**2 * 0.1 - 0.04**2 * 0.09)
    assert sum(one.volume for one in done) == pytest.approx(pot, rel=0.05)
