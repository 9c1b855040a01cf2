"""The catalogue's register: nouns, synonyms and the recipes that make their assets."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from pat3d.assets.colours import COLOURS, find_colour
from pat3d.assets.materials import NATURAL_COLOURS
from pat3d.assets.materials import material as find_material_entry
from pat3d.assets.shapes import Shape
from pat3d.errors import AssetError, PromptError
from pat3d.scene.asset import Asset, Region

RGB = tuple[int, int, int]


@dataclass(frozen=True, kw_only=True)
class Style:
    """What varies between two objects of one noun."""

    rng: np.random.Generator
    """Seeded by the scene's seed and the object's name."""
    colours: tuple[RGB, ...]
    """Asked-for colours first, then the entry's default for what is left."""
    material: str
    adjectives: frozenset[str] = frozenset()

    def colour(self, index: int = 0) -> RGB:
        """The index-th colour, repeating the last."""
        return self.colours[min(index, len(self.colours) - 1)]

    def vary(self, value: float, spread: float = 0.06) -> float:
        """`value` times a random factor within 1 +- spread."""
        return value * float(self.rng.uniform(1 - spread, 1 + spread))

    def shade(self, colour: RGB, factor: float) -> RGB:
        """`colour` darkened (factor below 1) or lightened (above 1)."""
        return tuple(int(np.clip(channel * factor, 0, 255)) for channel in colour)  # type: ignore[return-value]


@dataclass(frozen=True, kw_only=True)
class Build:
    """What a recipe returns: coloured shapes, and where children belong."""

    parts: tuple[tuple[Shape, RGB], ...]
    regions: tuple[Region, ...] = ()
    """Empty for the top of the bounding box."""
    paint: tuple[tuple[Shape, RGB], ...] = ()
    """Volumes that recolour the surface inside them (labels, stripes, eyes) without changing the solid."""
    anchors: tuple[tuple[float, float, float], ...] = ()
    """Points of the surface from which it hangs [m]; none for its highest point."""
    mass: float | None = None
    """Mass [kg] where density times volume would be wrong (mixed materials, hidden hollows)."""


Recipe = Callable[[Style], Build]


@dataclass(frozen=True, kw_only=True)
class Entry:
    """One kind of object."""

    noun: str
    recipe: Recipe
    family: str
    synonyms: tuple[str, ...] = ()
    plurals: tuple[str, ...] = ()
    """Irregular plurals of the noun or its synonyms."""
    material: str = "plastic"
    colours: tuple[str, ...] = ("gray",)
    """Default colours, one chosen by seed."""
    accents: tuple[str, ...] = ()
    """Further colours in fixed order for details, after the main colour."""


_ENTRIES: dict[str, Entry] = {}
_NAMES: dict[str, str] = {}


def entry(
    noun: str,
    *,
    family: str,
    synonyms: Iterable[str] = (),
    plurals: Iterable[str] = (),
    material: str = "plastic",
    colours: Iterable[str] = ("gray",),
    accents: Iterable[str] = (),
) -> Callable[[Recipe], Recipe]:
    """Register the decorated recipe under `noun` and its `synonyms`."""

    def register(recipe: Recipe) -> Recipe:
        made = Entry(
            noun=noun, recipe=recipe, family=family, synonyms=tuple(synonyms), plurals=tuple(plurals),
            material=material, colours=tuple(colours), accents=tuple(accents),
        )  # fmt: skip
        for name in (noun, *made.synonyms, *made.plurals):
            if name in _NAMES:
                raise AssetError(f'catalogue name "{name}" is taken by "{_NAMES[name]}" and "{noun}".')
            _NAMES[name] = noun
        _ENTRIES[noun] = made
        return recipe

    return register


def entries() -> tuple[Entry, ...]:
    """All entries, sorted by family and noun."""
    _load_families()
    return tuple(sorted(_ENTRIES.values(), key=lambda made: (made.family, made.noun)))


def names() -> tuple[str, ...]:
    """Every noun, synonym and irregular plural."""
    _load_families()
    return tuple(sorted(_NAMES))


def find(name: str) -> Entry | None:
    """The entry whose noun, synonym or irregular plural is `name` (lower case, singular otherwise), or None."""
    _load_families()
    return _ENTRIES[_NAMES[name]] if name in _NAMES else None


def nearest(name: str, count: int = 3) -> tuple[str, ...]:
    """The known names most like `name`."""
    return tuple(difflib.get_close_matches(name, names(), n=count, cutoff=0.5))


def make(
    noun: str,
    *,
    colours: Iterable[str] = (),
    material: str | None = None,
    scale: float = 1.0,
    adjectives: Iterable[str] = (),
    seed: int = 0,
) -> Asset:
    """Make an asset of catalogue noun (or synonym) `noun`.

    Args:
        noun: see `names`.
        colours: colour names, main colour first; empty for a default chosen by seed.
        material: material name; None for the entry's own. Where it is named and no colour is, its natural colour.
        scale: uniform factor on the real dimensions.
        adjectives: other words a recipe may honour.
        seed: the same seed gives the same asset, bit for bit.

    Raises:
        PromptError: `noun` is not in the catalogue.
    """
    from pat3d.assets.catalogue.assemble import assemble

    found = find(noun)
    if found is None:
        near = ", ".join(f'"{name}"' for name in nearest(noun)) or "see `pat3d catalogue`"
        raise PromptError(f'"{noun}" is not in the catalogue. Nearest: {near}.')
    if not (np.isfinite(scale) and 0.01 <= scale <= 100.0):
        raise AssetError(f'scale of "{noun}" must be between 0.01 and 100, got {scale}.')
    rng = np.random.default_rng([seed, *noun.encode()])
    default = found.colours[int(rng.integers(len(found.colours)))]
    natural = NATURAL_COLOURS.get(material or "", (default,))
    default = default if default in natural else natural[0]
    asked = [find_colour(name) for name in colours]
    if None in asked:
        raise AssetError(f"unknown colour among {list(colours)}. Known: {', '.join(COLOURS)}.")
    main = [COLOURS[name] for name in asked if name] or [COLOURS[default]]
    accents = [COLOURS[name] for name in found.accents]
    chosen = find_material_entry(material or found.material)
    style = Style(
        rng=rng,
        colours=(*main, *accents[max(0, len(main) - 1) :]),
        material=chosen.name,
        adjectives=frozenset(adjectives),
    )
    build = found.recipe(style)
    provenance = {
        "source": "catalogue", "noun": found.noun, "seed": seed, "scale": scale,
        "colours": list(asked) or [default], "material": chosen.name,
    }  # fmt: skip
    return assemble(found.noun, build, material=chosen, scale=scale, provenance=provenance)


def _load_families() -> None:
    """Import the modules that register the entries, once."""
    from pat3d.assets.catalogue import families  # noqa: F401  (importing registers)
