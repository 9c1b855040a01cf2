"""Sentences about two and three carriers and what is in them, told in several sentences with pronouns and names."""

from __future__ import annotations

from collections.abc import Callable

from benchmarks.composing.nouns import FITS, named
from benchmarks.composing.wording import NUMBERS, Draw, Group, listed, sentence, within


def nested(d: Draw) -> str:
    """Carriers and their contents: "A tray and a box are on a desk. The former holds a cup, the latter two balls"."""
    way: Callable[[Draw], str] = d.random.choice(
        (_told_in_turn, _told_in_turn, _former, _likes, _likes, _three_likes, _both, _deep, _deep, _along)
    )
    return way(d)


def _carriers(d: Draw, count: int) -> tuple[list[Group], Group, str]:
    """Several unlike carriers on a place, and the sentence that says so."""
    carriers = [d.holder() if d.chance(0.6) else d.carrier() for _ in range(count)]
    place = d.furniture()
    for carrier in carriers:
        d.put(carrier, place)
    words, p = listed([carrier.new() for carrier in carriers]), place.new()
    return carriers, place, sentence(d.random.choice((
        f"{words} are on {p}", f"on {p} there are {words}", f"{p} holds {words}", f"there are {words} on {p}",
        f"{words} stand on {p}", f"on {p} are {words}", f"{p} with {words} on it",
    )))  # fmt: skip


def _filled(d: Draw, carrier: Group) -> Group:
    fill = d.filling(carrier)
    d.put(fill, carrier)
    return fill


def _holds(d: Draw, name: str, carrier: Group, fill: Group) -> str:
    """A clause that says what a carrier known as `name` carries."""
    where, f = within(carrier), fill.new()
    ways = [f"{name} holds {f}", f"{name} has {f} {where} it", f"{where} {name} there {fill.be()} {f}",
            f"{where} {name} {fill.be()} {f}", f"{f} {fill.be()} {where} {name}"]  # fmt: skip
    return d.random.choice([*ways, f"{name} contains {f}"] if where == "in" else ways)


def _told_in_turn(d: Draw) -> str:
    """Each carrier by its name again, some sentences about colours of what is in it."""
    random = d.random
    carriers, _, said = _carriers(d, random.choice((2, 2, 3)))
    clauses: list[str] = []
    for carrier in carriers:
        if d.chance(0.15):
            clauses.append(f"{carrier.the_noun()} is empty")
            continue
        fill = _filled(d, carrier)
        clause = _holds(d, carrier.the_noun(), carrier, fill)
        if fill.one.noun.colours and fill.one.colour is None and d.chance(0.3):
            colour = random.choice(fill.one.noun.colours)
            for thing in fill.things:
                thing.colour = colour
            clause += random.choice((f"; {fill.the_noun()} {fill.be()} {colour}", f". {fill.the_noun().capitalize()} "
                                     f"{fill.be()} {colour}"))  # fmt: skip
        clauses.append(clause)
    if d.chance(0.4):
        return f"{said} {' '.join(map(sentence, clauses))}"
    return (
        f"{said} {sentence(random.choice((', and ', '; ', ', while ')).join((', '.join(clauses[:-1]), clauses[-1])))}"
    )


def _former(d: Draw) -> str:
    random = d.random
    (one, two), _, said = _carriers(d, 2)
    first, second = _filled(d, one), _filled(d, two)
    f, s, a, b = first.new(), second.new(), within(one), within(two)
    return f"{said} " + random.choice((
        sentence(f"the former holds {f} and the latter holds {s}"), sentence(f"the former holds {f}, the latter {s}"),
        sentence(f"{a} the former there {first.be()} {f}, {b} the latter {s}"),
        f"{sentence(f'the latter holds {s}')} {sentence(f'the former has {f} {a} it')}",
        sentence(f"{f} {first.be()} {a} the former, {s} {b} the latter"),
    ))  # fmt: skip


def _alike(d: Draw, count: int) -> tuple[Group, str]:
    """Several carriers of one kind on a place, and the sentence that says so."""
    group = d.holder(count) if d.chance(0.7) else d.carrier(count)
    place = d.furniture()
    d.put(group, place)
    g, p = group.new(), place.new()
    return group, sentence(d.random.choice((
        f"{g} {group.verb(d.random)} on {p}", f"on {p} there are {g}", f"there are {g} on {p}", f"{p} holds {g}",
    )))  # fmt: skip


def _likes(d: Draw) -> str:
    """Two of one kind: one and the other."""
    random = d.random
    two, said = _alike(d, 2)
    ones = [Group((thing,)) for thing in two.things]
    first = _filled(d, ones[0])
    f, where = first.new(), within(two)
    if d.chance(0.3):
        return f"{said} " + random.choice((
            sentence(f"one of them holds {f}, the other is empty"),
            sentence(f"one holds {f} and the other one nothing"),
            f"{sentence(f'one of them holds {f}')} The other is empty.",
            sentence(f"only one of them has anything {where} it: {f}"), sentence(f"one is empty, the other holds {f}"),
        ))  # fmt: skip
    second = _filled(d, ones[1])
    s = second.new()
    return f"{said} " + random.choice((
        sentence(f"one holds {f}, the other {s}"), sentence(f"one of them holds {f} and the other holds {s}"),
        sentence(f"{where} one of them {first.be()} {f}, {where} the other {s}"),
        f"{sentence(f'one of them has {f} {where} it')} {sentence(f'the other has {s}')}",
        f"{sentence(f'{where} the first there {first.be()} {f}')} "
        f"{sentence(f'{where} the second there {second.be()} {s}')}",
        sentence(f"the first holds {f} and the second {s}"),
        sentence(f"{f} {first.be()} {where} one of them and {s} {where} the other"),
        f"{sentence(f'one of the two holds {f}')} {sentence(f'{s} {second.be()} {where} the other one')}",
    ))  # fmt: skip


def _three_likes(d: Draw) -> str:
    """Three or four of one kind: one, another, the rest."""
    random = d.random
    count = random.choice((3, 3, 4))
    group, said = _alike(d, count)
    ones = [Group((thing,)) for thing in group.things]
    first = _filled(d, ones[0])
    f, where = first.new(), within(group)
    if d.chance(0.4):
        rest = random.choice(("the rest are", "the others are", f"the other {NUMBERS[count - 1]} are"))
        return f"{said} " + random.choice((
            sentence(f"one of them holds {f}, {rest} empty"),
            f"{sentence(f'one holds {f}')} {sentence(f'{rest} empty')}",
            sentence(f"{f} {first.be()} {where} one of them; {rest} empty"),
        ))  # fmt: skip
    second = _filled(d, ones[1])
    s = second.new()
    if count == 3 and d.chance(0.6):
        third = _filled(d, ones[2])
        t = third.new()
        return f"{said} " + random.choice((
            sentence(f"one holds {f}, another {s} and the third {t}"),
            sentence(f"the first holds {f}, the second holds {s} and the last one {t}"),
            f"{sentence(f'one of them holds {f}, another holds {s}')} {sentence(f'the third one holds {t}')}",
        ))  # fmt: skip
    end = "the last one is" if count == 3 else random.choice(("the rest are", "the other two are"))
    return f"{said} " + random.choice((
        sentence(f"one holds {f}, another holds {s} and {end} empty"),
        f"{sentence(f'one of them holds {f} and another one {s}')} {sentence(f'{end} empty')}",
    ))  # fmt: skip


def _both(d: Draw) -> str:
    """What two unlike carriers have in common, and what stands between them or beside one."""
    random = d.random
    words = random.choice((("bowl", "basket"), ("box", "crate"), ("box", "basket"), ("mug", "cup"), ("bowl", "box")))
    one, two = (d.group(named(word), plain=0.7) for word in words)
    d.used.update(words)
    place = d.furniture()
    d.put(one, place)
    d.put(two, place)
    said = sentence(random.choice((f"{one.new()} and {two.new()} are on {place.new()}",
                                   f"on {place.new()} there are {one.new()} and {two.new()}")))  # fmt: skip
    if d.chance(0.25):
        return f"{said} {random.choice(('Both are empty', 'Both of them are empty', 'They are both empty'))}."
    each = random.choice((1, 2))
    kinds = sorted({*FITS[words[0]]} & {*FITS[words[1]]})
    fill = d.small(2 * each, *kinds)
    d.put(Group(fill.things[:each]), one)
    d.put(Group(fill.things[each:]), two)
    f = Group(fill.things[:each]).new()
    return f"{said} " + sentence(random.choice((
        f"both hold {f}", f"each of them holds {f}", f"both of them contain {f}", f"they each hold {f}",
        f"in each of them there {'are' if each > 1 else 'is'} {f}", f"each holds {f}",
    )))  # fmt: skip


def _deep(d: Draw) -> str:
    """Three levels, from above or from below, each by a pronoun or its name again."""
    random = d.random
    inner = d.group(d.noun([named(word) for word in ("bowl", "plate", "mug", "cup")]))
    outer = d.group(d.noun([named(word) for word in ("tray", "box", "crate")]))
    place, fill = d.furniture(), d.filling(inner)
    d.put(outer, place)
    d.put(inner, outer)
    d.put(fill, inner)
    o, i, f, p, be = outer.new(), inner.new(), fill.new(), place.new(), fill.be()
    over, into = within(outer), within(inner)
    ways = [
        (f"{f} {be} {into} {i}", f"{inner.the_noun()} is {over} {o}", f"{outer.the_noun()} stands on {p}"),
        (f"{f} {be} {into} {i}", f"{inner.the_noun()} is {over} {o}, which is on {p}"),
        (f"{o} stands on {p}", f"it holds {i}", f"{into} {inner.the_noun()} {be} {f}"),
        (f"on {p} is {o}", f"{over} it is {i}, and {into} {inner.the_noun()} {be} {f}"),
        (f"there is {o} on {p}", f"{over} it there is {i} with {f} {into} it"),
        (f"there is {p} with {o} on it", f"{outer.the_noun()} holds {i}, which holds {f}"),
        (f"{p} holds {o}", f"{over} {outer.the_noun()} is {i}", f"{inner.the_noun()} has {f} {into} it"),
        (f"{i} {inner.verb(random)} {over} {o}", f"it holds {f}", f"{outer.the_noun()} is on {p}"),
        (f"on {p} there is {o} with {i} {over} it", f"{inner.the_noun()} holds {f}"),
        (f"{o} is on {p}, with {i} {over} it", f"{f} {be} {into} {inner.the_noun()}"),
        (f"{i} with {f} {into} it is {over} {o}", f"{outer.the_noun()}, in turn, is on {p}"),
    ]  # fmt: skip
    said = list(random.choice(ways))
    if d.chance(0.4):
        more = d.small(d.count())
        side = d.beside(more, outer)
        said.append(random.choice((f"{side} {outer.the_noun()} {more.be()} {more.new()}",
                                   f"{more.new()} {more.be()} {side} {outer.the_noun()}")))  # fmt: skip
    return " ".join(map(sentence, said))


def _along(d: Draw) -> str:
    """From one carrier to the next: "Next to it is a box; it holds two balls"."""
    random = d.random
    one, place = d.holder() if d.chance(0.5) else d.carrier(), d.furniture()
    d.put(one, place)
    first = _filled(d, one)
    two = d.holder() if d.chance(0.5) else d.carrier()
    side = d.beside(two, one)
    second = _filled(d, two)
    f, s, o, t, p = first.new(), second.new(), one.new(), two.new(), place.new()
    a, b = within(one), within(two)
    holds = random.choice((f", which holds {s}", f" with {s} {b} it", f", and {b} it {second.be()} {s}",
    f" holding {s}",
                           f". It holds {s}", f"; it holds {s}"))  # fmt: skip
    starts = (f"on {p} there is {o} with {f} {a} it", f"{o} holding {f} is on {p}", f"{o} is on {p}. It holds {f}",
              f"there is {o} on {p}, and {a} it {first.be()} {f}")  # fmt: skip
    last = random.choice((f"{side} {one.the_noun()} {two.verb(random)} {t}{holds}",
                          f"{side} {one.the_noun()} there is {t}{holds}"))  # fmt: skip
    said = f"{sentence(random.choice(starts))} {sentence(last)}"
    if d.chance(0.3):
        more = d.small(1)
        d.put(more, place)
        said += f" {sentence(f'{more.new()} {more.be()} on {place.the_noun()} too')}"
    return said
