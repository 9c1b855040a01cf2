"""Sentences of participles, passives, relative clauses, brackets, dashes and colons."""

from __future__ import annotations

from collections.abc import Callable

from benchmarks.composing.wording import NUMBERS, Draw, Group, listed, sentence, within


def clauses(d: Draw) -> str:
    """What carries what, in subordinate clauses: "A bowl filled with two eggs stands on a desk"."""
    way: Callable[[Draw], str] = d.random.choice((_one, _one, _two, _two, _listed, _beside, _set_off))
    return way(d)


def _filled(d: Draw) -> tuple[Group, Group, Group]:
    holder = d.holder() if d.chance(0.6) else d.carrier()
    place = d.furniture()
    d.put(holder, place)
    fill = d.filling(holder)
    d.put(fill, holder)
    return holder, place, fill


def _one(d: Draw) -> str:
    """A carrier, what it holds and what it stands on."""
    holder, place, fill = _filled(d)
    h, p, f, where, be = holder.new(), place.new(), fill.new(), within(holder), fill.be()
    stands, going = holder.verb(d.random), holder.going(d.random)
    ways = [
        f"placed on {p}, {h} holds {f}", f"{h} {going} on {p} holds {f}", f"{p} on which {stands} {h} holding {f}",
        f"{f} {be} placed {where} {h}, which {stands} on {p}", f"{h} that {stands} on {p} holds {f}",
        f"{h}, placed on {p}, holds {f}", f"{h}, which is on {p}, has {f} {where} it",
        f"{h} on {p} has {f} {where} it",
        f"{f} {be} {where} {h} {going} on {p}",
        f"there is {p} with {h} on it that holds {f}",
        f"{h} has been placed on {p}, with {f} {where} it", f"{h} was put on {p} and {f} {be} {where} it",
        f"{h}, {where} which there {be} {f}, {stands} on {p}", f"{h} {where} which {f} {be} placed {stands} on {p}",
        f"{p} supports {h}, {where} which {be} {f}", f"on {p} {stands} {h} holding {f}",
        f"on {p} you see {h} that holds {f}",
        f"{h} carrying {f} {stands} on {p}" if where == "on" else f"{h} containing {f} {stands} on {p}",
        f"{h} laden with {f} {stands} on {p}" if where == "on" else f"{h} filled with {f} {stands} on {p}",
        f"{f} {be} contained in {h} on {p}" if where == "in" else f"{f} {be} carried by {h} on {p}",
    ]  # fmt: skip
    return sentence(d.random.choice(ways))


def _two(d: Draw) -> str:
    """Two things in or on one carrier, or one in it and another beside it."""
    random = d.random
    holder, place, one = _filled(d)
    two = d.filling(holder)
    d.put(two, holder)
    h, p, f, s, where = holder.new(), place.new(), one.new(), two.new(), within(holder)
    return random.choice((
        sentence(f"there is {h} with {f} and {s} {where} it on {p}"), sentence(f"{h} holding {f} and {s} is on {p}"),
        sentence(f"on {p} there is {h} with {f} {where} it and {s} {where} it too"),
        sentence(f"{h} on {p} holds {f} as well as {s}"), sentence(f"{h}, holding both {f} and {s}, is on {p}"),
        f"{sentence(f'on {p} is {h} holding {f}')} {sentence(f'it also holds {s}')}",
        sentence(f"{h} on {p} holds the following: {f}, {s}"),
        sentence(f"{h} that holds {f} and {s} has been placed on {p}"),
        sentence(f"{f} and {s} are {where} {h}, and {holder.the_noun()} is on {p}"),
        sentence(f"{h} stands on {p} - {where} it are {f} and {s}") if one.many or two.many else
        sentence(f"{h} stands on {p} - it holds {f} and {s}"),
    ))  # fmt: skip


def _listed(d: Draw) -> str:
    """Colons with lists."""
    random = d.random
    place = d.furniture()
    items = [d.small(d.count()) for _ in range(random.choice((3, 3, 4)))]
    for item in items:
        d.put(item, place)
    words, p, n = listed([item.new() for item in items]), place.new(), NUMBERS[len(items)]
    few = all(not item.many for item in items)
    return sentence(random.choice((
        f"on {p}: {words}", f"{p} holds {n} things: {words}" if few else f"{p} holds several things: {words}",
        f"there are {n} objects on {p}: {words}" if few else f"there are some objects on {p}: {words}",
        f"{p} has the following on it: {words}", f"{words} - all of them are on {p}", f"{p}, and on it {words}",
        f"what is on {p}: {words}", f"{p} with the following on it: {words}",
    )))  # fmt: skip


def _beside(d: Draw) -> str:
    """A carrier with something in it and something else at its side."""
    random = d.random
    holder, place, fill = _filled(d)
    other = d.small(1)
    side = d.beside(other, holder)
    h, p, f, o, where = holder.new(), place.new(), fill.new(), other.new(), within(holder)
    return sentence(random.choice((
        f"there is {h} with {f} {where} it and {o} {side} it on {p}",
        f"{p} holds {h} with {f} {where} it and {o} {side} it",
        f"{h}, {side} which {other.verb(random)} {o}, is on {p} and holds {f}",
        f"{o} {other.verb(random)} {side} {h} that holds {f} on {p}",
        f"{h} holding {f} is on {p}, and {o} {other.verb(random)} {side} it",
        f"{o} on {p} {other.verb(random)} {side} {h} holding {f}",
        f"{h} ({side} it {o}) is on {p} and holds {f}",
        f"{h} on {p} - with {f} {where} it - has {o} {side} it",
        f"{o} has been placed {side} {h} on {p}, and {where} {holder.the_noun()} {fill.be()} {f}",
        f"on {p}, {side} {h} containing {f}, there is {o}" if where == "in" else
        f"on {p}, {side} {h} carrying {f}, there is {o}",
    )))  # fmt: skip


def _set_off(d: Draw) -> str:
    """Brackets and dashes that say what is in which."""
    random = d.random
    place = d.furniture()
    holders = [d.holder() if d.chance(0.6) else d.carrier() for _ in range(2)]
    fills: list[Group] = []
    for holder in holders:
        d.put(holder, place)
        fills.append(d.filling(holder))
        d.put(fills[-1], holder)
    (one, two), (first, second), p = holders, fills, place.new()
    o, t, f, s, a, b = one.new(), two.new(), first.new(), second.new(), within(one), within(two)
    return sentence(random.choice((
        f"on {p} there are {o} (with {f} {a} it) and {t} (with {s} {b} it)",
        f"{o} (holding {f}) and {t} (holding {s}) are on {p}",
        f"{o} - with {f} {a} it - and {t} - with {s} {b} it - are on {p}",
        f"{p} holds {o} with {f} {a} it and {t} with {s} {b} it",
        f"{o} with {f} {a} it and {t} with {s} {b} it are on {p}",
        f"on {p} are {o} that holds {f} and {t} that holds {s}",
        f"there are two things on {p}: {o} holding {f} and {t} holding {s}",
        f"{o}, which holds {f}, and {t}, which holds {s}, are on {p}",
    )))  # fmt: skip
