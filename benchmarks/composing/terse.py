"""Notes in short: "desk: lamp, 2 mugs (1 red, 1 blue), pen left of lamp"."""

from __future__ import annotations

from collections.abc import Callable

from benchmarks.composing.meaning import Thing
from benchmarks.composing.nouns import of_kind
from benchmarks.composing.wording import NUMBERS, Draw, Group, a, within

_SIDES = {"left_of": ("left of", "to the left of"), "right_of": ("right of", "to the right of"),
          "behind": ("behind",), "in_front_of": ("in front of",), "next_to": ("next to", "beside")}  # fmt: skip


def terse(d: Draw) -> str:
    """A place and what is there, without articles and verbs."""
    way: Callable[[Draw], str] = d.random.choice((_place, _place, _place, _two_places, _chain))
    said = way(d)
    said = f"{said[0].upper()}{said[1:]}" if d.chance(0.5) else said
    return f"{said}." if d.chance(0.3) else said


def _bare(d: Draw, group: Group) -> str:
    """A group with a figure or none."""
    count = len(group.things)
    if count == 1:
        return d.random.choice((group.head(), group.head(), f"1 {group.head()}", a(group.head())))
    ways = [f"{count} {group.head()}", f"{NUMBERS[count]} {group.head()}"]
    return d.random.choice([*ways, f"{count}x {group.head()}"])


def _item(d: Draw, place: Group, joint: str) -> str:
    """One entry of a list that `joint` holds together."""
    random = d.random
    kind = random.choice(("plain", "plain", "plain", "colours", "full", "carrier"))
    if kind == "colours":
        noun = d.noun([noun for noun in of_kind("small") if len(noun.colours) > 4])
        counts = [random.choice((1, 1, 2)) for _ in range(2)]
        parts: list[str] = []
        for count, colour in zip(counts, random.sample(noun.colours, 2), strict=True):
            things = tuple(Thing(noun, colour) for _ in range(count))
            d.meaning.things += things
            d.put(Group(things), place)
            parts.append(f"{count} {colour}")
        return random.choice((f"{sum(counts)} {noun.plural} ({', '.join(parts)})",
                              f"{sum(counts)} {noun.plural} ({' and '.join(parts)})"))  # fmt: skip
    if kind in ("full", "carrier"):
        holder = d.holder() if kind == "full" else d.carrier()
        d.put(holder, place)
        fill = d.filling(holder)
        where = d.put(fill, holder).replace("atop", "on").replace("on top of", "on")
        h, f = _bare(d, holder), _bare(d, fill)
        inside = within(holder) == "in"
        ways = [f"{h} ({f} {where} it)", f"{f} {where} {h}", f"{h} ({f} inside)" if inside else f"{h} (with {f})"]
        if joint == "; ":
            # In a list of commas these may govern all that follows.
            ways += [f"{h} with {f}", f"{h} with {f} {where} it", f"{h} holding {f}"]
        return random.choice(ways)
    group = d.small(random.choice((1, 1, 2, 3)))
    d.put(group, place)
    return _bare(d, group)


def _place(d: Draw) -> str:
    random = d.random
    place = d.furniture()
    joint = random.choice((", ", ", ", "; "))
    parts = [_item(d, place, joint) for _ in range(random.choice((2, 2, 3)))]
    if d.chance(0.5):
        mark, other = d.small(1), d.small(1)
        d.put(mark, place)
        side = random.choice(_SIDES[_beside(d, other, mark)])
        again = random.choice((mark.one.noun.word, mark.the_noun()))
        parts += [mark.head(), f"{other.head()} {side} {again}"]
    p = place.head()
    return random.choice((
        f"{p}: {joint.join(parts)}", f"on {p}: {joint.join(parts)}", f"on {place.the_noun()}: {joint.join(parts)}"
        if p == place.one.noun.word else f"on the {p}: {joint.join(parts)}",
        f"{p} with {', '.join(parts)}" if all("(" not in part and "with" not in part for part in parts)
        and len(parts) < 4 else f"{p}: {joint.join(parts)}", f"{p} - {joint.join(parts)}",
    ))  # fmt: skip


def _beside(d: Draw, other: Group, mark: Group) -> str:
    kind = d.random.choice(tuple(_SIDES))
    d.meaning.add(kind, other.things, mark.one)
    kinds, parent = d.meaning.support(mark.one)
    d.meaning.add("|".join(kinds), other.things, parent)
    return kind


def _two_places(d: Draw) -> str:
    random = d.random
    parts: list[str] = []
    for _ in range(2):
        place = d.furniture()
        items: list[str] = []
        for _ in range(random.choice((1, 2, 3))):
            group = d.small(random.choice((1, 1, 2, 3)))
            d.put(group, place)
            items.append(_bare(d, group))
        parts.append(f"{place.head()}: {', '.join(items)}")
    return random.choice(("; ", ". ", "\n")).join(parts)


def _chain(d: Draw) -> str:
    """What is on what is on what, and something at a side."""
    random = d.random
    carrier, place = d.carrier() if d.chance(0.6) else d.holder(), d.furniture()
    d.put(carrier, place)
    item = d.filling(carrier)
    where = within(carrier)
    d.put(item, carrier)
    i, c, p = _bare(d, item), carrier.head(), place.head()
    said = random.choice((f"{i} {where} {c} on {p}", f"{i} {where} {c}, {carrier.one.noun.word} on {p}",
                          f"{c} on {p}, {i} {where} {carrier.one.noun.word}",
                          f"{p}, {c} on it, {i} {where} {c}"))  # fmt: skip
    if d.chance(0.5):
        other = d.small(1)
        side = random.choice(_SIDES[_beside(d, other, carrier)])
        said += f", {other.head()} {side} {carrier.one.noun.word}"
    return said
