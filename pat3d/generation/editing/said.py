"""Edits as one line of text each, as the command line and other programs give them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from pat3d.errors import EditError
from pat3d.generation.editing.editable import EditableScene
from pat3d.generation.editing.words import halves
from pat3d.scene.history import VERBS

EXAMPLES: dict[str, str] = {
    "add": "a coffee mug on the stack of books",
    "remove": "bottom book",
    "move": "vase: 10 cm to the right",
    "turn": "laptop: 15 degrees clockwise",
    "replace": "vase: a plant pot",
    "scale": "bowl: 20 % larger",
    "set": "mug: mass=0.3, friction=0.5",
    "fix": "desk",
    "free": "desk",
}
"""A text for every verb."""


def applied(scene: EditableScene, edits: Sequence[tuple[str, str]]) -> EditableScene:
    """`scene` after `edits`, each a verb and its text, in order.

    Raises:
        EditError: an unknown verb, a text that cannot be read, or an edit that cannot be.
        PromptError: words that cannot be read.
        LayoutError: there is no room.
    """
    for verb, text in edits:
        if verb not in VERBS:
            raise EditError(f'unknown edit "{verb}". Valid: {", ".join(VERBS)}.')
        scene = _VERBS[verb](scene, text)
    return scene


def _two(verb: str, change: Callable[[EditableScene, str, str], EditableScene]):
    def edit(scene: EditableScene, text: str) -> EditableScene:
        return change(scene, *halves(text, verb, EXAMPLES[verb]))

    return edit


def _set(scene: EditableScene, what: str, said: str) -> EditableScene:
    values: dict[str, str] = {}
    for part in said.split(","):
        key, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals or not key or not value:
            raise EditError(f'"{part.strip()}" sets nothing; valid: "{EXAMPLES["set"]}".')
        if key in values:
            raise EditError(f'"{said.strip()}" sets the {key} twice.')
        values[key] = value
    return scene.set(what, **values)


_VERBS: dict[str, Callable[[EditableScene, str], EditableScene]] = {
    "add": lambda scene, text: scene.add(text),
    "remove": lambda scene, text: scene.remove(text),
    "move": _two("move", lambda scene, what, where: scene.move(what, where)),
    "turn": _two("turn", lambda scene, what, how: scene.turn(what, how)),
    "replace": _two("replace", lambda scene, what, by: scene.replace(what, by)),
    "scale": _two("scale", lambda scene, what, size: scene.scale(what, size)),
    "set": _two("set", _set),
    "fix": lambda scene, text: scene.fix(text),
    "free": lambda scene, text: scene.free(text),
}
