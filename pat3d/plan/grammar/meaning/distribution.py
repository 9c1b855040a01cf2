"""What several things are said to have: each of them one of its own, all together one, or one for each in turn.

"Both trays hold a burger" is a burger on each, "two bricks carry a plank" one plank across the two, "three bowls
contain an apple, a pear and a fig" one of these in every bowl. A number that is said is that of all ("two baskets hold
four apples"), unless "both", "all" or "each" says it of every one.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.counting import multiply, recount
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.meaning.had import Having
from pat3d.plan.grammar.meaning.world import UNUSUAL, World
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.links import Link
from pat3d.scene.relations import SUPPORT_KINDS

Share = Literal["each", "in turn", "together", "as counted"]
_SPREAD = ("blanket", "rug", "carpet", "sheet", "tablecloth")
"""What lies over several things at once."""
_ALL = frozenset({"both", "all"})


def says_all(phrase: Phrase) -> bool:
    """Whether `phrase` speaks of every one of several: "both trays", "all three cups"."""
    return phrase.words.lower().split()[:1] in ([word] for word in _ALL)


def share(
    world: World,
    link: Link,
    owners: Sequence[Item],
    children: Sequence[Item],
    *,
    all_of: bool,
    having: bool,
    loose: bool = False,
) -> Share:
    """How the `children`, named once for all `owners`, are had by them.

    Args:
        world: what is there.
        link: what has them, or where they are at their owners.
        owners: what they are said of.
        children: what is said to be had.
        all_of: the sentence says it of "both", "all" or "each" of the owners.
        having: the owners have, hold or carry them; otherwise the children are said to be on or in them.
        loose: the owners are only said to be "with" them, and nothing else says where they are.
    """
    carriers, groups = world.tops(owners), _groups(children)
    known = any((group.phrase.definite and not group.phrase.possessive) or group.multiplied for group in groups)
    whole = not known and groups and set(children) == {item for group in groups for item in group.items}
    one_heap = any(group.heap for group in _groups(owners))
    if len(carriers) < 2 or one_heap or not whole or set(groups) & set(_groups(owners)) or link.manner == "between":
        return "as counted"
    held = link.kind == "in" or (link.kind is None and world.containment(owners[0]) == "in")
    spread = not having and world.is_a(children[0], _SPREAD)
    if link.says == "across" or (not held and len(children) == 1 and (world.is_a(children[0], lexicon.LONG) or spread)):
        return "together"
    if all_of:
        return "each"
    beside = link.manner == "place" and link.kind not in SUPPORT_KINDS
    if not beside and len(_groups(owners)) == 1 and _unnumbered(groups) and _dishes(world, owners[0]):
        # "Two plates of pizza", "three boxes with bread in them"
        return "each"
    singles = any(_single(group, filling=link.filling) for group in groups)
    few = (
        len(_groups(owners)) == 1
        and len(groups) in (1, 2, len(carriers))
        and all(_single(group, filling=False) for group in groups)
    )
    carried = loose and few and all(_lies_in(world, owners[0], child) for child in children)
    if not (having or carried) or beside or not singles:
        return "as counted"
    single = all(_single(group, filling=link.filling) for group in groups)
    return "in turn" if len(groups) == len(carriers) > 2 and single else "each"


def on_top_of_both(
    world: World, words: Sequence[str], named: Sequence[Phrase], children: Sequence[Item], parents: Sequence[Item]
) -> bool:
    """Whether one thing lies on two: "two boxes, and a tray on top of both", and no lamp on both of two tables.

    A note says how "a tray on both boxes" and "a hat on top of both boxes" are read, which may be one or two.
    """
    topped = tuple(words) in (("on", "top", "of"), ("atop",), ("atop", "of"))
    pronoun = all(one.kind == "pronoun" and one.words.lower().startswith("both") for one in named)
    pair = len(children) == 1 and len(parents) == 2 and not any(map(world.on_floor, parents))
    broad = world.flat(children[0]) or world.is_a(children[0], lexicon.THIN, lexicon.LONG)
    across = topped and pair and (pronoun or broad)
    single = pair and children[0].group.phrase.count in (None, 1)
    long = world.is_a(children[0], lexicon.LONG)
    if single and not (pronoun and topped) and (topped or (broad and tuple(words) == ("on",))) and not long:
        how = "one across the two" if across else "one on each"
        world.note(f'"{children[0].group.words}" {" ".join(words)} "{parents[0].group.words}" is read as {how}.')
    return across


def for_each(world: World, owners: Sequence[Item], children: Sequence[Item]) -> list[Item]:
    """As many of `children` for each of `owners`; of what is named by a bare plural two at least, but one lid."""
    several = len(world.tops(owners))
    for group in _groups(children):
        if group.phrase.plural and not group.counted and group.height == 1:
            one = world.is_a(group.items[0], vessels.ON_RIMS, lexicon.BENEATH_CUPS)
            recount(world, group, several * (1 if one else max(2, -(-len(group.items) // several))))
            group.multiplied = True
            world.note(f'"{group.words}": {len(group.items)} assumed.')
        else:
            multiply(world, group.items, several)
    return all_like(children)


def hand_out(relating: Having, link: Link, owners: Sequence[Item], children: Sequence[Item], how: Share) -> bool:
    """Relate `children`, had "together" or "in turn", to their `owners`; False where they are not had so."""
    world = relating.world
    if how == "together":
        relating.relate(list(children), Link(kind="on"), list(owners))
    elif how == "in turn":
        for owner, child in zip(world.tops(owners), children, strict=True):
            relating.hold(link, [owner], [child])
        listed = ", ".join(f'"{child.group.words}"' for child in children)
        world.note(f'{listed} are read as one for each of "{owners[0].group.words}".')
    return how in ("together", "in turn")


def all_like(items: Sequence[Item]) -> list[Item]:
    """All objects that were named with one of `items`."""
    return [item for group in _groups(items) for item in group.items]


def _groups(items: Sequence[Item]) -> list[Group]:
    return list(dict.fromkeys(item.group for item in items))


def _unnumbered(groups: Sequence[Group]) -> bool:
    """Whether each of `groups` is one thing named as what there is some of: "pizza"."""
    some = [not (group.phrase.determined or group.phrase.plural or group.counted) for group in groups]
    return all(len(group.items) == 1 and not group.cycle for group in groups) and all(some)


def _dishes(world: World, owner: Item) -> bool:
    return world.is_a(owner, vessels.HOLLOW, lexicon.DISHES) or world.flat(owner)


def _lies_in(world: World, owner: Item, child: Item) -> bool:
    """Whether of "two plates with a bun" one is on each for a person, and not of "two chairs with a table"."""
    if world.on_floor(child) or world.is_a(owner, lexicon.DEVICES):
        return False
    own = world.is_a(child, vessels.ON_RIMS, lexicon.BENEATH_CUPS, ("plant",))
    return own or world.likely.held(world.noun(child), world.containment(owner), world.noun(owner)) <= UNUSUAL


def _single(group: Group, *, filling: bool) -> bool:
    """Whether one thing is named: "a rose", and "filled with roses" where those are one bouquet."""
    return len(group.items) == 1 and not group.counted and (group.phrase.determined or filling)


def as_many(world: World, link: Link, parents: list[Item], children: Sequence[Item]) -> list[Item]:
    """`parents` of which the number is not said: as many as the `children`, each with its own, or no more.

    "Two cups on saucers" are on two saucers, and "two vases on shelves" on no more than two shelves.
    """
    group, wanted = parents[0].group, len(world.bases(children))
    own = world.is_a(parents[0], lexicon.BENEATH_CUPS, ("placemat",))
    fresh = group.phrase.plural and not group.counted and not group.phrase.definite and not group.modifiers.palette
    fresh = fresh and group.height == 1 and all(world.support(item) is None for item in group.items)
    if link.kind not in SUPPORT_KINDS or not fresh or len(parents) != len(group.items) or wanted < 2:
        return parents
    if wanted < len(parents) or (own and wanted > len(parents)):
        recount(world, group, wanted)
        return list(group.items)
    return parents
