"""Things that are to be put beside others: "Put the fork left of the plate and the knife behind it"."""

from __future__ import annotations

from collections.abc import Callable

from benchmarks.composing.nouns import named
from benchmarks.composing.wording import SIDES, Draw, Group, listed, sentence, within

_MARKS = ("plate", "bowl", "vase", "jar", "basket", "box", "mug")
"""What stands on furniture, and things are put beside."""


def aside(d: Draw) -> str:
    """One thing or several to be put beside something, alone or with what is put elsewhere."""
    way: Callable[[Draw], str] = d.random.choice((_one, _one, _both, _each_at_its_side, _filled))
    return way(d)


def _scene(d: Draw, *groups: Group) -> str:
    """The sentence that puts all of them on a place; nothing as often."""
    if d.chance(0.5):
        return ""
    place = d.furniture()
    for group in groups:
        d.put(group, place)
    words, p = listed([group.new() for group in groups]), place.new()
    told = d.random.choice((f"{words} are on {p}", f"on {p} there are {words}", f"there are {words} on {p}"))
    return f"{sentence(told)} "


def _mark(d: Draw) -> Group:
    return d.group(d.noun([named(word) for word in _MARKS]))


def _said(group: Group, scene: str) -> str:
    return group.the_noun() if scene else group.the()


def _one(d: Draw) -> str:
    random = d.random
    mark, item, kind = _mark(d), d.small(1), random.choice(tuple(SIDES))
    d.meaning.task, d.meaning.of_task = (f"beside:{kind}",), [item.one, mark.one]
    scene = _scene(d, item, mark)
    i, m, side = _said(item, scene), _said(mark, scene), random.choice(SIDES[kind])
    return scene + random.choice((
        f"Put {i} {side} {m}.", f"Place {i} {side} {m}.", f"Move {i} {side} {m}.", f"Please put {i} {side} {m}.",
        f"Could you place {i} {side} {m}?", f"Set {i} down {side} {m}.", f"Pick up {i} and put it {side} {m}.",
        f"I want you to put {i} {side} {m}.",
    ))  # fmt: skip


def _both(d: Draw) -> str:
    """Two things at one side."""
    random = d.random
    mark, one, two, kind = _mark(d), d.small(1), d.small(1), random.choice(tuple(SIDES))
    d.meaning.steps = [([f"beside:{kind}"], [item.one, mark.one]) for item in (one, two)]
    scene = _scene(d, one, two, mark)
    i, j, m, side = _said(one, scene), _said(two, scene), _said(mark, scene), random.choice(SIDES[kind])
    return scene + random.choice((
        f"Put {i} and {j} {side} {m}.", f"Put both {i} and {j} {side} {m}.", f"Place {i} {side} {m}, then {j}.",
        f"Put {i} {side} {m}. Do the same with {j}.",
    ))  # fmt: skip


def _each_at_its_side(d: Draw) -> str:
    """Two things at two sides."""
    random = d.random
    mark, one, two = _mark(d), d.small(1), d.small(1)
    kinds = random.sample(tuple(SIDES), 2)
    d.meaning.steps = [([f"beside:{kind}"], [item.one, mark.one]) for kind, item in zip(kinds, (one, two), strict=True)]
    scene = _scene(d, one, two, mark)
    i, j, m = (_said(group, scene) for group in (one, two, mark))
    a, b = (random.choice(SIDES[kind]) for kind in kinds)
    return scene + random.choice((
        f"Put {i} {a} {m} and {j} {b} {m}.", f"Put {i} {a} {m}, then put {j} {b} {m}.",
        f"First place {i} {a} {m}, and then place {j} {b} {m}.", f"Put {i} {a} {m}. After that, put {j} {b} {m}.",
        f"Before you put {j} {b} {m}, put {i} {a} {m}.", f"1. Put {i} {a} {m}. 2. Put {j} {b} {m}.",
    ))  # fmt: skip


def _filled(d: Draw) -> str:
    """Something in a vessel and something beside it."""
    random = d.random
    holder = d.holder()
    one, two, kind = d.filling(holder, 1), d.small(1), random.choice(tuple(SIDES))
    scene = _scene(d, one, two, holder)
    i, j, h = (_said(group, scene) for group in (one, two, holder))
    into, side = within(holder), random.choice(SIDES[kind])
    put, aside = (["place"], [one.one, holder.one]), ([f"beside:{kind}"], [two.one, holder.one])
    ahead = d.chance(0.5)
    d.meaning.steps = [put, aside] if ahead else [aside, put]
    first, second = (f"{i} {into} {h}", f"{j} {side} {h}") if ahead else (f"{j} {side} {h}", f"{i} {into} {h}")
    return scene + random.choice((
        f"Put {first} and {second}.", f"Put {first}, then put {second}.", f"Put {first}. Then place {second}.",
        f"After putting {first}, put {second}.",
    ))  # fmt: skip
