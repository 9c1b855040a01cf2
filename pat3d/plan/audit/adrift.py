"""What ends on the ground beside a table that is there: nothing says so, and it is named."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.words import FLOOR
from pat3d.plan.scene_plan import PlannedObject

_BEARING = frozenset({
    "table", "desk", "coffee table", "side table", "bedside table", "shelf", "bookshelf", "counter", "cabinet",
    "dresser", "bench", "tv stand", "workbench", "kitchen island", "sofa", "bed",
})  # fmt: skip
"""Furniture on which small things are, where a sentence has both."""
_STOPS = frozenset(".;!?\n")
_VESSELS = frozenset({"tray", "box", "crate", "basket", "bin", "bowl", "plate", "cutting board", "mat", "toolbox"})
_ON_FLOORS = frozenset({
    "lamp", "floor lamp", "plant", "basket", "laundry basket", "bin", "bucket", "ball", "fire extinguisher",
    "suitcase", "backpack", "barrel", "crate", "ladder", "broom", "mop", "easel", "tire", "traffic cone",
    "watering can", "fan", "toolbox", "treasure chest", "skateboard", "drum", "tripod",
})  # fmt: skip
"""What stands on floors as often as on tables."""
_BESIDE = frozenset({"beside", "left", "right", "front", "behind", "under", "far", "between", "around", "against"})


def adrift(it: Compared, found: Sequence[str]) -> Iterator[str]:
    """Notes on the mug of "a laptop, on a desk, and a mug" where it is left on the ground and none `found` names it."""
    nouns = {obj.name: obj.noun for obj in it.plan.objects}
    tops = any(noun in _BEARING and it.support(name) is None for name, noun in nouns.items())
    asked = bool(it.tasks.strip() or it.undone)
    alone = _by_itself(it)
    if not (alone or (tops and it.said.claims)) or asked or FLOOR & {*it.said.words}:
        return
    loose = [obj for obj in it.plan.objects if _on_ground(it, obj) and not _beside_furniture(it, obj)]
    loose = [obj for obj in loose if obj.name not in alone]
    quoted = " ".join((it.quoted, *found)).lower()
    for phrase in dict.fromkeys(obj.phrase.lower() for obj in loose if obj.phrase):
        named = [mention.text for mention in it.said.mentions if phrase.endswith(mention.text)]
        if not any(f'{said}"' in quoted for said in (phrase, *named)):
            yield f'"{phrase}": where is not said; on the ground'


def _by_itself(it: Compared) -> set[str]:
    """What could carry the rest and is a sentence of its own: the tray of "5 screws, 1 wrench. Tray."."""
    words = [".", *it.said.words, "."]
    whole = [one for one in it.said.mentions if {words[one.first][0], words[one.end + 1][0]} <= _STOPS]
    named = {obj.name for one in whole for obj in it.which(one) if obj.noun in _BEARING | _VESSELS}
    return named if len(it.plan.objects) > len(named) else set()


def _on_ground(it: Compared, obj: PlannedObject) -> bool:
    """Whether `obj`, which a table could carry, is on the ground and carries none."""
    carries = any(rel.parent == obj.name and rel.supports for rel in it.plan.relations)
    if carries and obj.phrase.lower().startswith("the "):
        # "A mug is on the tray, a second one on the shelf"
        return False
    small = obj.noun not in it.furniture | _ON_FLOORS | _BEARING
    placed = any(obj.name in one.objects and one.kind in ("under", "leaning_against") for one in it.plan.arrangements)
    below = any(other.noun in _BEARING and obj.name in it.above(other.name) for other in it.plan.objects)
    return small and not placed and not below and it.support(obj.name) is None


def _beside_furniture(it: Compared, obj: PlannedObject) -> bool:
    """Whether a sentence says that `obj` is beside what stands on the floor: "a box next to the sofa"."""
    beside = {b for a, _, b in it.edges if a == obj.name and it.support(b) is None}
    return any(
        claim.of is not None and claim.place in _BESIDE and beside & {one.name for one in it.which(claim.of)}
        for claim in it.said.claims
    )
