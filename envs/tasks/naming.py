"""What to call an object so that an instruction means it alone: "the top book", "the cup on the tray".

Left and right are not used: they are others for the robot, for a camera and for whoever wrote the sentence.
"""

from __future__ import annotations

import re

from pat3d.scene.model import GROUND, Scene

_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth")


def called(scene: Scene, name: str) -> str | None:
    """Words that mean object `name` of `scene` alone, without an article; None where there are none.

    In this order: its name where no other is called so; its place in a stack of its kind; what it is on or in; what
    is on or in it.
    """
    return _plainly(scene, name) or _by_carrier(scene, name) or _by_load(scene, name)


def spoken(scene: Scene, name: str) -> str:
    """What to call it at best: by its name, number and all, where nothing tells it apart."""
    return called(scene, name) or name


def the(scene: Scene, name: str) -> str:
    """The same with its article."""
    return f"the {spoken(scene, name)}"


def _base(name: str) -> str:
    """A name without the number that the planner gives to one of several."""
    return re.sub(r" \d+$", "", name)


def _kin(scene: Scene, name: str) -> list[str]:
    """Objects that might be meant by the same words, in the order of the scene: a red mug is a mug."""
    own = _base(name)
    return [obj.name for obj in scene.objects if _base(obj.name) == own or _base(obj.name).endswith(f" {own}")]


def _plainly(scene: Scene, name: str) -> str | None:
    kin, base = _kin(scene, name), _base(name)
    if len(kin) == 1:
        return base
    standing = sorted(kin, key=lambda one: scene[one].pose.position[2])
    if any(scene.parent(upper) != lower for lower, upper in zip(standing, standing[1:], strict=False)):
        return None
    place = standing.index(name)
    if place in (0, len(kin) - 1):
        return f"{'top' if place else 'bottom'} {base}"
    if len(kin) == 3:
        return f"middle {base}"
    return f"{_ORDINALS[place]} {base} from the bottom" if place < len(_ORDINALS) else None


def _by_carrier(scene: Scene, name: str) -> str | None:
    places = {one: (scene.parent(one), _how(scene, one)) for one in _kin(scene, name)}
    carrier, how = places[name]
    if carrier == GROUND or list(places.values()).count(places[name]) > 1:
        return None
    words = _plainly(scene, carrier)
    return f"{_base(name)} {how} the {words}" if words else None


def _by_load(scene: Scene, name: str) -> str | None:
    kin = _kin(scene, name)
    for load in (obj.name for obj in scene.objects):
        words = _plainly(scene, load)
        if load not in kin and scene.parent(load) == name and words:
            return f"{_base(name)} with the {words} {_how(scene, load)} it"
    return None


def _how(scene: Scene, name: str) -> str:
    """In or on, as the scene says of what carries it."""
    kinds = {rel.kind for rel in scene.relations if rel.child == name and rel.supports}
    return "in" if "in" in kinds else "on"
