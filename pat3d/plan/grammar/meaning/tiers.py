"""Which of the boards or compartments of a piece of furniture is spoken of: "the top shelf of the bookcase"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.meaning.relating import Relating
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import singulars
from pat3d.plan.grammar.words.links import Link
from pat3d.plan.holders import TIER_PARTS
from pat3d.scene.arrangements import TIERS, ArrangementKind

_MIDDLE = frozenset({"middle", "center", "centre", "central"})
_COUNTED: dict[str, ArrangementKind] = {"second": "on_second_tier", "third": "on_third_tier"}
_FEWEST, _MOST = 2, 6
"""Shelves that can be asked for."""


def tier_of(world: World, chunk: Chunk, owners: Sequence[Item]) -> ArrangementKind | None:
    """The tier of the one of `owners` that `chunk` speaks of; None without, or where the thing has no such."""
    phrase = chunk.phrase
    if phrase is None or len(owners) != 1 or not is_tier(phrase):
        return None
    if not phrase.part and len(owners[0].group.items) > 1:
        # "Two shelves: the top shelf ..." is one of the two.
        return None
    count = _count(world, owners[0].group)
    words = chunk.words
    heights = [lexicon.LEVELS[word] for word in words if word in lexicon.LEVELS]
    # "The second shelf" is one of two where nothing that it is a part of is named.
    kind: ArrangementKind | None = next((_COUNTED[word] for word in words if word in _COUNTED and phrase.part), None)
    if heights:
        kind = "on_top_tier" if heights[0] else "on_bottom_tier"
    elif _MIDDLE & {*words}:
        kind = "on_middle_tier"
    return kind if kind is not None and range(count)[TIERS[kind]] else None


def put_on_tier(
    relating: Relating, chunk: Chunk, children: Sequence[Item], owners: list[Item]
) -> Literal["", "somewhere", "told"]:
    """Put `children` on the tier of `owners` that `chunk` speaks of; or somewhere in what has no such, or nowhere."""
    world, phrase = relating.world, chunk.phrase
    kind = tier_of(world, chunk, owners)
    inside = is_tier(phrase) and len(owners) == 1 and world.houses(owners[0])
    children = [child for child in children if child not in owners]
    if phrase is None or not children or not (kind or inside):
        return ""
    relating.relate(children, Link(kind="in" if inside else "on"), owners)
    if kind is None:
        return "somewhere"
    if any(word in _COUNTED for word in chunk.words):
        world.note(f'"{phrase.words}": counted from the top.')
    # Of a stack the lowest is on it.
    world.arrange(kind, world.bases(children), owners)
    owners[0].place = ""
    said = [f'not modelled: "{word}" of "{phrase.words}"' for word in chunk.words]
    world.notes = [note for note in world.notes if note not in said]
    return "told"


def is_tier(phrase: Phrase | None) -> bool:
    """Whether `phrase` speaks of a board or a compartment of furniture."""
    if phrase is None or phrase.part:
        return phrase is not None and phrase.part in TIER_PARTS
    words = phrase.words.lower().split()
    return phrase.head in TIER_PARTS and phrase.head in words and words[0] not in ("a", "an")


def _count(world: World, group: Group) -> int:
    """How many tiers `group` has each: as is said, or as the catalogue makes it."""
    asked = (int(word[0]) for word in group.modifiers.adjectives if word.endswith("-tier") and word[0].isdigit())
    return next(asked, next((n for noun, n in lexicon.TIERS.items() if world.is_a(group.items[0], (noun,))), 0))


def has_tiers(world: World, group: Group, part: Phrase) -> bool:
    """Whether `part` says how many shelves a shelf has, which it is made with then."""
    shelves = TIER_PARTS & {part.head, *singulars(part.head)} and world.is_a(group.items[0], lexicon.STACKED)
    if not shelves or part.count is None or not _FEWEST <= part.count <= _MOST:
        return False
    group.modifiers = replace(group.modifiers, adjectives=(*group.modifiers.adjectives, f"{part.count}-tier"))
    return True
