"""Words for how an object is turned ("upside down", "on its side"), and which of them a scene holds.

A posture becomes one token whose text begins with "_", which no word of a prompt can.
"""

from __future__ import annotations

import re

from pat3d.plan.scene_plan import PostureKind

POSTURE = (
    r"(?:rotated|turned|tilted|spun|inclined) (?:by |at )?\d+(?:[.]\d+)? ?(?:degrees|\u00b0)"
    r"|(?:lying|laid|turned|tipped) (?:flat )?(?:on|onto) (?:its|their) (?:side|back|face|head|end)s?(?! of)"
    r"|(?:flat )?(?:on|onto) (?:its|their) (?:side|edge)s?(?! of)|on edge(?! of)|upside[ -]down"
    r"|bottom[ -]up|face[ -](?:down|up)|on end|upright|inverted|upturned"
    r"|right[ -]side[ -]up|(?:the )?right way up"
    r"|(?:lying|lies|lie|laid) down"
    r"|overturned|turned (?:over|upside down)|toppled(?: over)?|(?:tipped|knocked) over|flipped(?! open)(?: over)?"
    r"|tilted|slanted|sideways|diagonally|crosswise"
    # "Books stacked vertically" are in a stack.
    r"|(?<!stacked )(?<!arranged )(?<!aligned )(?<!up )vertically(?! (?:stacked|aligned|arranged|on top))"
    r"|facing (?:left|right|up|down|upwards?|downwards?|forwards?|away|inwards?|outwards?)"
    r"|leaning to (?:one|the|its) (?:side|left|right)|facing the (?:viewer|camera|front|left|right|wall)"
)
"""Pattern of a posture."""
_HELD = re.compile(
    r"upright|vertically|right[ -]side[ -]up|(?:the )?right way up|(?:turned )?upside[ -]down|bottom[ -]up"
    r"|inverted|upturned|flipped(?: over)?|turned over|(?:\w+ )?(?:flat )?(?:on|onto) (?:its|their) sides?"
    r"|toppled(?: over)?|(?:tipped|knocked) over"
)
"""Postures that a scene holds as they are said."""


def token_text(said: str) -> str:
    """The text of the token for `said`."""
    return f"_posture:{said.lower()}"


def is_posture(word: str) -> bool:
    """Whether `word` is the text of a posture token."""
    return word.startswith("_posture:")


def read_posture(word: str) -> str:
    """What the posture token with text `word` says."""
    return word.removeprefix("_posture:")


def is_held(posture: str, *, lies: bool) -> bool:
    """Whether a scene holds `posture` of an object that by nature lies, or else stands.

    What lies as the catalogue makes it can be turned over; its sides are not those of what stands.
    """
    held = _HELD.fullmatch(posture.lower()) is not None
    return held and (not lies or kind_of(posture) == "upside_down")


def stands_on_edge(posture: str) -> bool:
    """Whether `posture` says of what lies by nature that it stands on one of its narrow faces."""
    return re.search(r"upright|vertically|on end|edge|side", posture.lower()) is not None


def kind_of(posture: str) -> PostureKind:
    """What kind of posture `posture` is."""
    words = posture.lower()
    if re.search(r"upright|vertically|right[ -]side[ -]up|right way up", words) or words == "on end" or "edge" in words:
        return "upright"
    if re.search(r"upside|bottom|face[ -]?down|inverted|upturned|overturned|flipped|turned over|head", words):
        return "upside_down"
    if re.search(r"side|lying|laid|lies|lie |toppled|tipped|knocked", words):
        return "on_its_side"
    if words in ("open", "closed"):
        return "open" if words == "open" else "closed"
    return "tilted" if re.search(r"tilt|slant|inclin|lean", words) else "turned"
