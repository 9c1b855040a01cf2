"""What an instruction finds: "unstack the cups" finds them stacked, "stand it up" lying, "put it in the box" that open.

What the prompt says of the things otherwise stays.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from pat3d.plan.grammar.meaning.described import tell
from pat3d.plan.grammar.meaning.entities import Item
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.links import Link
from pat3d.plan.grammar.words.modifiers import Modifiers
from pat3d.plan.grammar.words.vocabulary import Nouns

_UNSTACKING = frozenset({"unstack", "destack"})
_STANDING = frozenset({"stand", "set", "put", "turn", "tip", "flip", "place", "straighten", "rotate", "tilt"})
_TURNED_BACK = re.compile(r"\b(?:right[- ]side[- ]up|right way up)\b")
_UPRIGHT = re.compile(r"\bupright\b")


def unstacks(world: World, verb: str, items: Sequence[Item]) -> bool:
    """Whether `items`, of which nothing is said that stands against it, are stacked before `verb` is done."""
    stands = {item for one in world.arranged for item in one.items}
    stands |= {item for edge in world.laterals for item in (edge.child, edge.parent)}
    free = all(item.group.height == 1 and item not in stands for item in items)
    among = any(world.support(item) in items for item in items)
    return verb in _UNSTACKING and len(items) > 1 and free and not among


def turn_as_found(world: World, verb: str, said: str, items: Sequence[Item]) -> None:
    """Turn `items` as they are before `said`, an instruction with `verb`, has them upright; a note says so."""
    words = said.lower()
    up = verb == "stand" and " up" in words
    found = "upside down" if _TURNED_BACK.search(words) else "on its side" if up or _UPRIGHT.search(words) else ""
    if verb not in _STANDING or not found:
        return
    for group in dict.fromkeys(item.group for item in items):
        turned = [item for item in items if item.group is group and not _told(item) and not _carries(world, item)]
        if found == "on its side" and world.is_a(group.items[0], lexicon.LYING):
            # A book lies as it is.
            continue
        for item in turned:
            tell(item, Modifiers(postures=(found,)))
        if turned:
            world.note(f'assumed: "{group.words}" {found} before "{said}"')


def open_or_shut(world: World, nouns: Nouns) -> None:
    """Make what holds something, or is to hold it, an open thing: a carton with balls in it is an open box.

    What something is to be put on is shut, though the prompt calls it open: a note says so.
    """
    holders = [edge.parent for edge in world.supports.values() if edge.kind == "in"]
    holders += [item for step in world.steps if step.link and step.link.kind == "in" for item in step.goal]
    for holder in holders:
        group = holder.group
        for closed, opened in (vessels.OPENED | (lexicon.HOUSES if world.houses(holder) else {})).items():
            noun = nouns.resolve(opened)
            if noun and nouns.own(group.noun) and group.noun == nouns.resolve(closed):
                group.noun = noun
                if closed in lexicon.HOUSES and world.steps:
                    world.note(f'"{group.words}" is made open, as what is in it is reached so.')
    onto = [item for step in world.steps for item in step.goal
            if step.link and (step.link == Link(kind="on") or step.link.said == "onto")]  # fmt: skip
    for group in dict.fromkeys(item.group for item in onto if item not in holders and not item.group.phrase.part):
        for closed in (closed for closed, opened in lexicon.HOUSES.items() if group.noun == nouns.resolve(opened)):
            group.noun = nouns.resolve(closed) or group.noun
            world.note(f'not modelled: "open" of "{group.words}"')


def _told(item: Item) -> bool:
    return bool(item.group.modifiers.postures or item.told.postures)


def _carries(world: World, item: Item) -> bool:
    return any(edge.parent is item for edge in world.supports.values())
