"""Every recipe of furniture, storage, room, desk, electronics, tools and basics, for what scenes rely on."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from scipy.spatial import ConvexHull

from pat3d.assets.catalogue import entries, find, make
from pat3d.assets.catalogue.joinery import padded, resting_ball, wrapped
from pat3d.assets.colours import COLOURS
from pat3d.assets.mesh.split import allowed
from pat3d.assets.shapes import convex
from pat3d.geometry.planes import face_count
from pat3d.layout.doors import CASES, DOORS
from pat3d.plan.grammar.words.lexicon import HOUSES
from pat3d.scene.asset import Asset
from tests.assets.sampling import sampled

FAMILIES = ("appliances", "basics", "desk", "electronics", "furniture", "room", "storage", "tools")
NOUNS = [made.noun for made in entries() if made.family in FAMILIES]
_CACHE: dict[tuple, Asset] = {}


def made(noun: str, seed: int = 0, **wishes) -> Asset:
    key = (noun, seed, *sorted((name, tuple(words)) for name, words in wishes.items()))
    if key not in _CACHE:
        _CACHE[key] = make(noun, seed=seed, **wishes)
    return _CACHE[key]


def planes(part) -> tuple[np.ndarray, np.ndarray]:
    """Outward normals, shape (faces, 3), and offsets [m], shape (faces,), of a convex part."""
    equations = ConvexHull(part.vertices).equations
    return equations[:, :3], -equations[:, 3]


def distance_outside(asset: Asset, points: np.ndarray) -> np.ndarray:
    """How far each point [m] is beyond the planes of the part nearest to containing it; at most 0 inside."""
    least = np.full(len(points), np.inf)
    for part in asset.parts:
        normals, offsets = planes(part)
        least = np.minimum(least, (points @ normals.T - offsets).max(axis=1))
    return least


def footing(asset: Asset) -> np.ndarray:
    """Corners of the parts on the ground [m], shape (n, 2)."""
    return np.concatenate([part.vertices[part.vertices[:, 2] < 1e-9] for part in asset.parts])[:, :2]


def samples(region) -> np.ndarray:
    """A grid over a region's floor [m], shape (n, 2), in the asset frame."""
    u, v = (axis.ravel() * 0.98 for axis in np.meshgrid(np.linspace(-1, 1, 7), np.linspace(-1, 1, 7)))
    if region.shape == "disc":
        inside = u * u + v * v <= 0.98**2
        u, v = u[inside], v[inside]
    return np.column_stack([region.floor[0] + u * region.half_size[0], region.floor[1] + v * region.half_size[1]])


def is_box_top(asset: Asset, region) -> bool:
    """Whether a region is the bounding box's top, given to every asset that has no better place."""
    return bool(np.allclose([*region.floor, *region.half_size], [0, 0, asset.size[2], *asset.size[:2] / 2]))


def test_there_are_more_than_fifty_nouns():
    assert len(NOUNS) >= 50


@pytest.mark.parametrize("noun", sampled(NOUNS))
@pytest.mark.parametrize("seed", [0, 1])
def test_surface_is_closed_and_encloses_volume(noun, seed):
    asset = made(noun, seed)
    mesh = trimesh.Trimesh(asset.visual.vertices, asset.visual.faces, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume > 0
    assert asset.mass_properties.volume == pytest.approx(mesh.volume, rel=1e-6)


@pytest.mark.parametrize("noun", sampled(NOUNS))
@pytest.mark.parametrize("seed", [0, 1])
def test_what_is_seen_lies_inside_what_is_simulated(noun, seed):
    asset = made(noun, seed)
    corners = asset.visual.vertices[asset.visual.faces]
    weights = np.random.default_rng(0).dirichlet([1, 1, 1], size=len(corners))
    inner = np.einsum("fk,fki->fi", weights, corners)
    assert distance_outside(asset, np.concatenate([asset.visual.vertices, inner])).max() < 1e-6


@pytest.mark.parametrize("noun", sampled(NOUNS))
def test_parts_are_few_small_and_at_least_a_millimetre_thick(noun):
    asset = made(noun)
    assert len(asset.parts) <= 32
    for part in asset.parts:
        assert len(part.vertices) <= 64
        assert face_count(part) <= 64
        normals, offsets = planes(part)
        width = (offsets + (-part.vertices @ normals.T).max(axis=0)).min()
        assert width > 0.99e-3


# Doors hang in their cases.
@pytest.mark.parametrize("noun", sampled([noun for noun in NOUNS if noun not in DOORS]))
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_stands_flat_with_its_weight_inside_its_base(noun, seed):
    """The lowest corners are on z = 0 to 1e-9 m, none hovers a hair above; a tilt of 4 degrees does not topple it."""
    asset = made(noun, seed)
    heights = np.concatenate([part.vertices[:, 2] for part in asset.parts])
    assert abs(heights.min()) < 1e-9
    assert not np.any((heights > 1e-9) & (heights < 1e-4))
    base = ConvexHull(footing(asset))
    centre = np.array(asset.mass_properties.centre_of_mass)
    margin = -(base.equations[:, :2] @ centre[:2] + base.equations[:, 2]).max()
    assert margin > 0
    assert np.degrees(np.arctan2(margin, centre[2])) > 4.0
    assert np.abs(asset.bounds[:, :2].sum(axis=0)).max() < 1e-9


@pytest.mark.parametrize("noun", sampled(NOUNS))
def test_same_seed_same_bits_and_other_seed_other_shape(noun):
    first, again, other = made(noun, 1), make(noun, seed=1), made(noun, 0)
    assert first.visual.vertices.tobytes() == again.visual.vertices.tobytes()
    assert first.visual.texture.tobytes() == again.visual.texture.tobytes()
    assert all(a.vertices.tobytes() == b.vertices.tobytes() for a, b in zip(first.parts, again.parts, strict=True))
    # Drawers and doors fit whatever the seed is.
    fits = noun in {"drawer", "open drawer", "drawer cabinet", *CASES, *DOORS}
    assert np.allclose(first.size, other.size, rtol=1e-4) == fits


@pytest.mark.parametrize("noun", sampled(NOUNS))
def test_regions_are_free_and_their_floors_are_solid(noun):
    asset = made(noun, 1)
    for region in asset.regions:
        if is_box_top(asset, region):
            continue
        ground = samples(region)
        below = np.column_stack([ground, np.full(len(ground), region.floor[2] - 2e-4)])
        # The parts follow what is seen, whose corners are round: by as much on either side of one.
        assert distance_outside(asset, below).max() < np.sqrt(2) * allowed(float(max(asset.size)))
        height = min(region.height, 0.3)
        for rise in np.linspace(1e-6, height - 1e-6, 7):
            above = np.column_stack([ground, np.full(len(ground), region.floor[2] + rise)])
            assert distance_outside(asset, above).min() > -1e-9
        # What opens in front has compartments under a ceiling.
        opens = noun in HOUSES.values() or noun in CASES
        assert region.enclosed == (np.isfinite(region.height) and (region.kind == "on" or opens))


@pytest.mark.parametrize("noun", sampled(NOUNS))
def test_the_colour_asked_for_is_the_most_visible_one(noun):
    """Magenta, which no default or detail is, covers a good part of every object in some shade of light."""
    asset = made(noun, colours=["magenta"])
    assert COLOURS["magenta"] in {tuple(map(int, texel)) for texel in asset.visual.texture.reshape(-1, 3)}
    rows, columns = asset.visual.texture.shape[:2]
    u, v = asset.visual.uv[:, 0].T
    seen = asset.visual.texture[((1 - v) * rows).astype(int), (u * columns).astype(int)].astype(float)
    area = trimesh.Trimesh(asset.visual.vertices, asset.visual.faces, process=False).area_faces
    # Shades of the colour count: same hue, other lightness.
    asked = np.array(COLOURS["magenta"], dtype=float)
    aligned = seen @ asked / (np.linalg.norm(seen, axis=1) * np.linalg.norm(asked) + 1e-9) > 0.985
    assert area[aligned].sum() > 0.08 * area.sum()


SIZES = {
    # noun: (width, depth, height [m], mass [kg]), as one finds them in shops
    "table": (1.2, 0.7, 0.74, 24), "coffee table": (1.0, 0.55, 0.42, 17), "side table": (0.46, 0.46, 0.55, 8.5),
    "desk": (1.25, 0.62, 0.74, 34), "chair": (0.45, 0.44, 0.88, 5.5), "stool": (0.34, 0.34, 0.46, 3.5),
    "sofa": (2.29, 0.86, 0.85, 45), "armchair": (0.96, 0.86, 0.85, 22), "bed": (1.51, 2.05, 0.98, 50),
    "bedside table": (0.48, 0.43, 0.52, 14), "bookshelf": (0.85, 0.32, 1.7, 30), "shelf": (0.95, 0.42, 1.5, 16),
    "cabinet": (0.87, 0.44, 0.85, 32), "wardrobe": (1.02, 0.57, 1.9, 70), "cart": (0.95, 0.5, 0.89, 14),
    "crate": (0.46, 0.32, 0.24, 2.8), "bin": (0.29, 0.29, 0.32, 1.1), "rug": (1.7, 1.15, 0.008, 5),
    "pillow": (0.42, 0.42, 0.13, 0.6), "floor cushion": (0.5, 0.5, 0.13, 1.6), "lamp": (0.3, 0.3, 0.44, 1.6),
    "book": (0.155, 0.22, 0.03, 0.67), "pen": (0.142, 0.011, 0.01, 0.012), "pencil": (0.172, 0.0088, 0.0076, 0.006),
    "ruler": (0.21, 0.03, 0.003, 0.018), "pen holder": (0.081, 0.081, 0.1, 0.25),
    "scissors": (0.16, 0.07, 0.0075, 0.06),
    "laptop": (0.33, 0.3, 0.22, 1.5), "phone": (0.073, 0.15, 0.009, 0.18), "radio": (0.3, 0.15, 0.19, 2.2),
    "crystal ball": (0.15, 0.15, 0.175, 3.0), "hammer": (0.3, 0.13, 0.028, 0.55), "brick": (0.215, 0.1, 0.065, 2.3),
    "cardboard sheet": (0.6, 0.51, 0.8, 0.5), "plant": (0.27, 0.27, 0.36, 1.5), "toolbox": (0.42, 0.21, 0.24, 4),
    "block": (0.07, 0.05, 0.05, 0.1), "box": (0.24, 0.17, 0.15, 0.4),
}  # fmt: skip


@pytest.mark.parametrize("noun", sorted(SIZES))
def test_sizes_and_masses_are_those_of_the_real_thing(noun):
    *size, mass = SIZES[noun]
    asset = made(noun, 2)
    assert np.all(np.abs(np.log(asset.size / size)) < np.log(1.45))
    assert abs(np.log(asset.mass_properties.mass / mass)) < np.log(1.6)


@pytest.mark.parametrize(
    "noun", ["table", "side table", "stool", "ottoman", "rug", "floor cushion", "pillow", "pen holder", "bin"]
)
def test_round_and_square_are_honoured(noun):
    for seed in range(3):
        for shape in ("round", "square"):
            asset = made(noun, seed, adjectives=[shape])
            assert abs(asset.size[0] / asset.size[1] - 1) < 0.05
        disc, square = (made(noun, seed, adjectives=[shape]) for shape in ("round", "square"))

        def filling(asset: Asset) -> float:
            upper = asset.visual.vertices[asset.visual.vertices[:, 2] > 0.45 * asset.size[2], :2]
            return ConvexHull(upper).volume / float(np.prod(np.ptp(upper, axis=0)))

        assert filling(disc) < 0.82 < 0.9 < filling(square)


def test_tall_and_low_change_the_height():
    for noun in ("table", "bookshelf", "pen holder", "lamp"):
        tall = made(noun, 0, adjectives=["tall"]).size[2]
        assert tall > 1.15 * made(noun, 0).size[2]


def test_a_named_material_brings_its_colour_unless_one_is_asked_for():
    assert make("pen holder", material="metal", seed=2).provenance["colours"][0] in ("steel", "silver", "gray")
    assert make("sofa", material="leather").provenance["colours"][0] in ("brown", "black", "tan")
    assert make("sofa", material="leather", colours=["red"]).provenance["colours"] == ["red"]


def test_the_sofa_seats_a_row_of_toys():
    """Teddies and pillows sit side by side: at least 1.7 by 0.6 m free, whatever the seed."""
    for seed in range(5):
        seat = made("sofa", seed).region("on")
        assert seat is not None
        assert 2 * seat.half_size[0] >= 1.7
        assert 2 * seat.half_size[1] >= 0.6
        assert seat.height == float("inf")


def test_pen_holder_takes_pens_to_its_floor():
    for adjectives in ([], ["square"]):
        hold = made("pen holder", 0, adjectives=adjectives).region("in")
        assert hold is not None
        assert hold.half_size[0] >= 0.034
        assert hold.height >= 0.09


def test_shelves_offer_the_board_at_hand_height_first_and_the_top_last():
    for noun in ("bookshelf", "shelf"):
        regions = made(noun).regions
        assert len(regions) >= 4
        assert all(region.enclosed and region.height > 0.25 for region in regions[:-1])
        assert abs(regions[0].floor[2] - 0.95) < 0.3
        assert regions[-1].height == float("inf")


def test_stacking_things_and_plain_furniture_are_simulated_as_boxes():
    for noun in ("box", "block", "cube", "book", "spell book", "magazine", "notebook", "brick"):
        asset = made(noun)
        assert len(asset.parts) == 1
        assert asset.parts[0].box is not None
    for noun in ("table", "bookshelf", "shelf", "chair", "crate", "cardboard sheet"):
        assert all(part.box is not None for part in made(noun).parts)


def test_round_bars_and_the_ball_lie_on_flats():
    for noun in ("pen", "pencil", "marker", "crayon", "paintbrush", "screwdriver", "flashlight", "hammer"):
        base = footing(made(noun))
        assert np.ptp(base[:, 1]) > 0.003
        assert np.ptp(base[:, 0]) > 0.3 * made(noun).size[0]
    assert len(footing(made("ball"))) >= 8


def test_names_are_found_by_their_synonyms():
    for name, noun in {
        "couch": "sofa",
        "nightstand": "bedside table",
        "bookcase": "bookshelf",
        "shelving unit": "shelf",
        "trolley": "cart",
        "wheeled cart": "cart",
        "carpet": "rug",
        "throw pillow": "pillow",
        "potted plant": "plant",
        "art piece": "sculpture",
        "smartphone": "phone",
        "pencil cup": "pen holder",
        "trash can": "bin",
        "vintage radio": "radio",
        "end table": "side table",
        "television": "tv",
        "shelves": "shelf",
    }.items():
        found = find(name)
        assert found is not None
        assert found.noun == noun


def test_wrapped_contains_a_convex_cloud_and_keeps_its_base_flat():
    points = np.random.default_rng(5).normal(size=(60, 3)) * (0.1, 0.2, 0.05)
    shape = convex(points)
    (hull,) = wrapped(shape).hulls
    equations = ConvexHull(hull).equations
    assert (points @ equations[:, :3].T + equations[:, 3]).max() < 1e-9
    assert len(hull) <= 32
    lowest = np.sort(hull[:, 2])
    assert np.ptp(lowest[:3]) < 1e-12


def test_padded_looks_rounded_and_is_one_box():
    shape = padded(0.4, 0.3, 0.2, 0.05)
    (hull,) = shape.hulls
    assert len(hull) == 8
    assert shape.solid.volume() < 0.4 * 0.3 * 0.2


def test_resting_ball_has_a_flat_on_the_ground_and_its_parts_contain_the_ball():
    shape = resting_ball(0.05)
    points = np.concatenate(shape.hulls)
    assert points[:, 2].min() == pytest.approx(0.0, abs=1e-12)
    assert np.count_nonzero(points[:, 2] < 1e-12) >= 8
    vertices = np.asarray(shape.solid.to_mesh64().vert_properties)[:, :3]
    sides = [ConvexHull(hull).equations for hull in shape.hulls]
    outside = np.min([(vertices @ side[:, :3].T + side[:, 3]).max(axis=1) for side in sides], axis=0)
    assert outside.max() < 1e-8


def test_a_cart_takes_three_potted_plants_in_a_row():
    for seed in range(4):
        deck = made("cart", seed).region("on")
        assert deck is not None
        assert sum(made("plant", seed + k).size[0] for k in range(3)) < 2 * deck.half_size[0]
