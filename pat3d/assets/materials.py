"""Materials by name: density, friction, and how they look.

Densities are mid-range handbook values (CRC Handbook of Chemistry and Physics, 97th ed., section 15;
Ashby, Materials Selection in Mechanical Design, 4th ed., appendix A). Foam, plush, foliage and
foods are bulk values with their air (FAO/INFOODS Density Database 2.0 for foods). Friction
coefficients are dry static values against wood or themselves (Avallone & Baumeister, Marks' Standard
Handbook for Mechanical Engineers, 11th ed., table 3.2.1), rounded down where sources spread.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from pat3d.errors import AssetError

if TYPE_CHECKING:
    from pat3d.scene.asset import Asset, Material, Surface

_TABLE: dict[str, tuple[float, float]] = {
    "wood": (650.0, 0.45),
    "bamboo": (700.0, 0.45),
    "cork": (200.0, 0.6),
    "cardboard": (250.0, 0.45),
    "paper": (800.0, 0.4),
    "ceramic": (2300.0, 0.45),
    "porcelain": (2400.0, 0.4),
    "stone": (2600.0, 0.5),
    "glass": (2500.0, 0.4),
    "metal": (7800.0, 0.4),
    "steel": (7850.0, 0.4),
    "iron": (7200.0, 0.4),
    "aluminium": (2700.0, 0.4),
    "brass": (8500.0, 0.4),
    "plastic": (1050.0, 0.4),
    "rubber": (1100.0, 0.8),
    "silicone": (1150.0, 0.8),
    "foam": (60.0, 0.6),
    "fabric": (300.0, 0.5),
    "cotton": (300.0, 0.5),
    "wool": (250.0, 0.5),
    "plush": (90.0, 0.5),
    "leather": (860.0, 0.5),
    "upholstery": (120.0, 0.5),
    "wicker": (350.0, 0.45),
    "wax": (920.0, 0.4),
    "soap": (1050.0, 0.3),
    "food": (900.0, 0.45),
    "bread": (290.0, 0.5),
    "cake": (450.0, 0.5),
    "fruit": (900.0, 0.45),
    "foliage": (150.0, 0.5),
    "electronics": (1600.0, 0.4),
}

_SURFACES: dict[str, tuple[float, float, float]] = {
    "wood": (0.6, 0.0, 1.0),
    "bamboo": (0.6, 0.0, 1.0),
    "cork": (0.9, 0.0, 1.0),
    "cardboard": (0.85, 0.0, 1.0),
    "paper": (0.8, 0.0, 1.0),
    "ceramic": (0.25, 0.0, 1.0),
    "porcelain": (0.15, 0.0, 1.0),
    "stone": (0.7, 0.0, 1.0),
    "glass": (0.05, 0.0, 0.25),
    "metal": (0.35, 1.0, 1.0),
    "steel": (0.3, 1.0, 1.0),
    "iron": (0.55, 1.0, 1.0),
    "aluminium": (0.35, 1.0, 1.0),
    "brass": (0.3, 1.0, 1.0),
    "plastic": (0.4, 0.0, 1.0),
    "rubber": (0.9, 0.0, 1.0),
    "foam": (0.95, 0.0, 1.0),
    "fabric": (0.9, 0.0, 1.0),
    "cotton": (0.9, 0.0, 1.0),
    "wool": (0.95, 0.0, 1.0),
    "plush": (1.0, 0.0, 1.0),
    "leather": (0.6, 0.0, 1.0),
    "upholstery": (0.9, 0.0, 1.0),
    "wicker": (0.8, 0.0, 1.0),
    "bread": (0.9, 0.0, 1.0),
    "cake": (0.9, 0.0, 1.0),
    "fruit": (0.4, 0.0, 1.0),
    "foliage": (0.7, 0.0, 1.0),
}
"""Roughness, metallic and opacity [-] of materials whose look says what they are."""

STAINED = 0.75
"""Opacity [-] of glass that has a colour."""

MATERIAL_WORDS: dict[str, str] = {
    "wooden": "wood", "oak": "wood", "pine": "wood", "walnut": "wood", "mahogany": "wood", "teak": "wood",
    "metallic": "metal", "steel": "steel", "stainless": "steel", "iron": "iron", "aluminum": "aluminium",
    "golden": "brass", "bronze": "brass", "copper": "brass", "rubbery": "rubber", "leathery": "leather",
    "woven": "wicker", "rattan": "wicker", "straw": "wicker", "stuffed": "plush", "marble": "stone",
    "granite": "stone", "clay": "ceramic", "terracotta": "ceramic", "earthenware": "ceramic", "crystal": "glass",
    "woollen": "wool", "woolen": "wool", "knitted": "wool", "cloth": "fabric", "linen": "fabric", "velvet": "fabric",
    "inflatable": "plastic", "acrylic": "plastic", "felt": "fabric",
}  # fmt: skip
"""Adjectives that name a material other than by its own name."""

NATURAL_COLOURS: dict[str, tuple[str, ...]] = {
    "wood": ("wood", "brown", "tan"),
    "bamboo": ("bamboo",),
    "cork": ("cork",),
    "cardboard": ("cardboard",),
    "wicker": ("wicker", "tan"),
    "metal": ("steel", "silver", "gray"),
    "steel": ("steel", "silver"),
    "iron": ("gray", "black"),
    "aluminium": ("silver", "steel"),
    "brass": ("gold", "bronze", "copper"),
    "glass": ("glass",),
    "stone": ("gray", "white"),
    "leather": ("brown", "black", "tan"),
}
"""Colours that a thing has when its material is named and its colour is not."""


def material(name: str) -> Material:
    """The material called `name`.

    Raises:
        AssetError: no such material; the message lists them.
    """
    if name not in _TABLE:
        raise AssetError(f'unknown material "{name}". Known: {", ".join(sorted(_TABLE))}.')
    # A sentence is read without numpy, which assets are made of.
    from pat3d.scene.asset import Material

    density, friction = _TABLE[name]
    return Material(name=name, density=density, friction=friction)


def surface_of(asset: Asset) -> Surface:
    """How the surface of `asset` looks beside its colour: by its file where that says, else by its material."""
    from pat3d.scene.asset import Surface

    roughness, metallic, opacity = _SURFACES.get(asset.material.name, (0.55, 0.0, 1.0))
    if opacity < 1.0 and asset.provenance.get("colours", [asset.material.name])[:1] != [asset.material.name]:
        opacity = STAINED
    said = asset.provenance.get("surface") or {}
    return Surface(
        roughness=float(said.get("roughness", roughness)),
        metallic=float(said.get("metallic", metallic)),
        opacity=float(said.get("opacity", opacity)),
    )


def material_names() -> tuple[str, ...]:
    """Every material."""
    return tuple(_TABLE)


def find_material(word: str) -> str | None:
    """Name of the material that an English `word` means ("wooden" -> "wood"), or None."""
    return word if word in _TABLE else MATERIAL_WORDS.get(word)
