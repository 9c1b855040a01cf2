"""What the catalogue has, and assets made of it: nouns and synonyms found, recipes run."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

import numpy as np

from pat3d.assets.catalogue.registry import ENTRIES, NAMES, Entry, Style
from pat3d.assets.colours import COLOURS, find_colour
from pat3d.assets.materials import NATURAL_COLOURS
from pat3d.assets.materials import material as find_material_entry
from pat3d.assets.variant import USUAL, Variant
from pat3d.errors import AssetError, PromptError
from pat3d.scene.asset import Asset


def entries() -> tuple[Entry, ...]:
    """All entries, sorted by family and noun."""
    _load_families()
    return tuple(sorted(ENTRIES.values(), key=lambda made: (made.family, made.noun)))


def names() -> tuple[str, ...]:
    """Every noun, synonym and irregular plural."""
    _load_families()
    return tuple(sorted(NAMES))


def find(name: str) -> Entry | None:
    """The entry whose noun, synonym or irregular plural is `name` (lower case, singular otherwise), or None."""
    _load_families()
    return ENTRIES[NAMES[name]] if name in NAMES else None


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
    words = {"colours": tuple(colours), "adjectives": tuple(adjectives)}
    return make_variant(noun, Variant(seed=seed, scale=scale, material=material, **words))


def make_variant(noun: str, variant: Variant) -> Asset:
    """Make the asset of catalogue noun (or synonym) `noun` that `variant` says.

    Raises:
        PromptError: `noun` is not in the catalogue.
    """
    found = find(noun)
    if found is None:
        near = ", ".join(f'"{name}"' for name in nearest(noun)) or "see `pat3d catalogue`"
        raise PromptError(f'"{noun}" is not in the catalogue. Nearest: {near}.')
    return make_entry(found, noun, variant)


def make_entry(found: Entry, noun: str, variant: Variant = USUAL) -> Asset:
    """Make an asset of an entry that need not be registered, which was called `noun`.

    Raises:
        AssetError: the recipe's solids do not join, or a colour or the material is not known.
    """
    from pat3d.assets.catalogue.assemble import assemble

    style, colours = style_of(found, noun, variant)
    build = found.recipe(style)
    provenance = {
        "source": "catalogue",
        "noun": found.noun,
        "seed": variant.seed,
        "scale": variant.scale,
        "colours": colours,
        "material": style.material,
    }
    material = find_material_entry(style.material)
    return assemble(found.noun, build, material=material, scale=variant.scale, provenance=provenance)


def style_of(found: Entry, noun: str, variant: Variant) -> tuple[Style, list[str]]:
    """What the recipe of an entry that was called `noun` gets, and the names of its main colours.

    Raises:
        AssetError: a colour or the material is not known.
    """
    rng = np.random.default_rng([variant.seed, *noun.encode()])
    default = found.colours[int(rng.integers(len(found.colours)))]
    natural = NATURAL_COLOURS.get(variant.material or "", (default,))
    default = default if default in natural else natural[0]
    asked = [find_colour(name) for name in variant.colours]
    if None in asked:
        raise AssetError(f"unknown colour among {list(variant.colours)}. Known: {', '.join(COLOURS)}.")
    main = [COLOURS[name] for name in asked if name] or [COLOURS[default]]
    accents = [COLOURS[name] for name in found.accents]
    chosen = find_material_entry(variant.material or found.material)
    style = Style(
        rng=rng,
        colours=(*main, *accents[max(0, len(main) - 1) :]),
        material=chosen.name,
        adjectives=frozenset(variant.adjectives),
    )
    return style, [name for name in asked if name] or [default]


def _load_families() -> None:
    """Import the modules that register the entries, once."""
    from pat3d.assets.catalogue import families  # noqa: F401  (importing registers)
