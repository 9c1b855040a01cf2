"""Colour names to 8-bit sRGB, toned for rendering rather than the saturated web values."""

from __future__ import annotations

COLOURS: dict[str, tuple[int, int, int]] = {
    "white": (240, 238, 233), "black": (38, 38, 42), "gray": (140, 142, 146), "silver": (190, 193, 198),
    "red": (190, 45, 42), "crimson": (165, 28, 48), "burgundy": (118, 30, 46), "maroon": (110, 28, 32), "pink": (236, 152, 174),
    "magenta": (196, 54, 136), "orange": (232, 126, 38), "coral": (238, 120, 96), "peach": (247, 190, 150),
    "yellow": (241, 200, 58), "gold": (206, 164, 62), "golden": (206, 164, 62), "mustard": (204, 160, 44), "cream": (243, 232, 205),
    "beige": (218, 200, 168), "ecru": (212, 200, 172), "taupe": (140, 124, 110), "mauve": (160, 116, 142),
    "ochre": (198, 134, 52), "khaki": (172, 160, 116), "ivory": (244, 239, 222), "tan": (200, 165, 120), "brown": (122, 80, 50), "chocolate": (84, 52, 34),
    "green": (76, 142, 74), "olive": (122, 126, 58), "lime": (158, 200, 66), "mint": (166, 216, 186), "teal": (38, 128, 128),
    "turquoise": (72, 190, 190), "cyan": (84, 196, 214), "blue": (52, 96, 170), "navy": (34, 48, 92), "purple": (118, 70, 146),
    "violet": (134, 88, 168), "lavender": (184, 168, 214), "indigo": (70, 66, 140), "bronze": (150, 106, 62), "copper": (184, 112, 74),
    "wood": (176, 128, 82), "bamboo": (212, 182, 126), "cardboard": (184, 146, 102), "wicker": (190, 146, 92), "cork": (196, 152, 108),
    "steel": (176, 180, 186), "glass": (196, 220, 226), "terracotta": (190, 104, 70), "skin": (232, 190, 160), "bread": (206, 150, 84),
}  # fmt: skip

SYNONYMS = {"grey": "gray", "dark": "black", "scarlet": "red", "aqua": "turquoise", "blond": "cream"}

MIXED: dict[str, tuple[str, ...]] = {
    "rainbow": ("red", "orange", "yellow", "green", "blue", "purple"),
    "colorful": ("red", "blue", "yellow", "green", "orange", "purple"),
    "colourful": ("red", "blue", "yellow", "green", "orange", "purple"),
    "multicolored": ("red", "blue", "yellow", "green", "orange", "purple"),
    "pastel": ("pink", "mint", "lavender", "peach", "cream"),
}
"""Words that ask for many colours: the objects of a group take them in turn."""


def find_colour(word: str) -> str | None:
    """Name of the colour that an English `word` means, or None."""
    word = SYNONYMS.get(word, word)
    return word if word in COLOURS else None
