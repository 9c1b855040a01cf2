"""Sentences that divide what is there: "Two of the five cups hold a pen, the other three are empty"."""

from __future__ import annotations

from collections.abc import Callable

from benchmarks.composing.meaning import Thing
from benchmarks.composing.nouns import FITS, named, of_kind
from benchmarks.composing.wording import NUMBERS, Draw, Group, sentence, within


def shares(d: Draw) -> str:
    """Shares and partitions by what is in them, by colour, by posture and by place."""
    way: Callable[[Draw], str] = d.random.choice((_filled, _filled, _coloured, _coloured, _halves, _all_but, _turned,
                                                  _three_parts, _placed))  # fmt: skip
    return way(d)


def _is(count: int) -> str:
    return "is" if count == 1 else "are"


def _rest(d: Draw, count: int) -> str:
    if count == 1:
        return d.random.choice(("the other", "the other one", "the last one", "the remaining one"))
    return d.random.choice(("the others", "the rest", f"the other {NUMBERS[count]}", f"the remaining {NUMBERS[count]}"))


def _plain(d: Draw, nouns: tuple[str, ...], count: int) -> Group:
    """Things of which nothing is said yet."""
    noun = d.noun([named(word) for word in nouns])
    things = tuple(Thing(noun) for _ in range(count))
    d.meaning.things += things
    return Group(things)


def _filled(d: Draw) -> str:
    """Some of them hold one each."""
    random = d.random
    count = random.choice((3, 4, 5, 6))
    some = random.randrange(1, count)
    holders = _plain(d, (*FITS, "plate"), count)
    place = d.furniture()
    d.put(holders, place)
    fill = d.filling(holders, some)
    for thing, holder in zip(fill.things, holders.things, strict=False):
        d.put(Group((thing,)), Group((holder,)))
    f, where = Group(fill.things[:1]).new(), within(holders)
    n, m, total, p = NUMBERS[some], count - some, NUMBERS[count], place.new()
    plural, each = holders.one.noun.plural, "" if some == 1 else random.choice((" each", ""))
    hold, have = ("holds", "has") if some == 1 else ("hold", "have")
    rest = f"{_rest(d, m)} {_is(m)} empty"
    return random.choice((
        sentence(f"{n} of the {total} {plural} on {p} {hold} {f}{each}, {rest}"),
        sentence(f"{n} of the {total} {plural} on {p} {hold} {f}{each}"),
        sentence(f"of the {total} {plural} on {p}, {n} {hold} {f}{each} and {rest}"),
        sentence(f"there are {total} {plural} on {p}, {n} of which {hold} {f}{each}"),
        f"{sentence(f'{p} holds {total} {plural}')} {sentence(f'{n} of them {have} {f} {where} {_it(some)}')}",
        f"{sentence(f'there are {total} {plural} on {p}')} {sentence(f'{n} of them {hold} {f}{each}; {rest}')}",
        sentence(f"{total} {plural} stand on {p}; {n} {hold} {f}{each} and {rest}"),
        sentence(f"on {p} are {total} {plural}; {n} {hold} {f}{each}, {rest}"),
    ))  # fmt: skip


def _it(count: int) -> str:
    return "it" if count == 1 else "them"


def _coloured(d: Draw) -> str:
    random = d.random
    count = random.choice((3, 4, 5, 6))
    some = random.randrange(1, count)
    noun = d.noun([noun for noun in of_kind("small") if len(noun.colours) > 4])
    group, place = Group(tuple(Thing(noun) for _ in range(count))), d.furniture()
    d.meaning.things += group.things
    d.put(group, place)
    first, second = random.sample(noun.colours, 2)
    both = d.chance(0.5)
    for thing in group.things[:some]:
        thing.colour = first
    for thing in group.things[some:] if both else ():
        thing.colour = second
    n, m, total, p, plural = NUMBERS[some], count - some, NUMBERS[count], place.new(), noun.plural
    end = f"{_rest(d, m)} {_is(m)} {second}" if both else ""
    is_n, comma, joined = f"{n} {_is(some)} {first}", f", {end}" if both else "", f" and {end}" if both else ""
    more = f" and {NUMBERS[m]} {second}" if both else ""
    bracket = f", {_rest(d, m)} {second}" if both else ""
    return random.choice((
        sentence(f"{total} {plural}, {n} of which {_is(some)} {first}, are on {p}") if not both else
        sentence(f"{n} of the {total} {plural} on {p} {_is(some)} {first}, {end}"),
        sentence(f"on {p} there are {total} {plural}, {n} of them {first}{more}"),
        sentence(f"{p} holds {total} {plural}. {n.capitalize()} of them {_is(some)} {first}{comma}"),
        sentence(f"{n} of the {total} {plural} on {p} {_is(some)} {first}{joined}"),
        sentence(f"of the {total} {plural} on {p}, {is_n}{joined}"),
        sentence(f"there are {total} {plural} on {p}; {is_n}{comma}"),
        sentence(f"{total} {plural} ({n} of them {first}{bracket}) are on {p}"),
    ))  # fmt: skip


def _halves(d: Draw) -> str:
    """Half, a third, all of them."""
    random = d.random
    count = random.choice((2, 4, 6, 8)) if d.chance(0.8) else 6
    noun = d.noun([noun for noun in of_kind("small") if len(noun.colours) > 4])
    group, place = Group(tuple(Thing(noun) for _ in range(count))), d.furniture()
    d.meaning.things += group.things
    d.put(group, place)
    third = count == 6 and d.chance(0.4)
    some = count // 3 if third else count // 2
    share = "a third" if third else "half"
    first, second = random.sample(noun.colours, 2)
    both = d.chance(0.6)
    for thing in group.things[:some]:
        thing.colour = first
    for thing in group.things[some:] if both else ():
        thing.colour = second
    the, p = f"the {NUMBERS[count]} {noun.plural}", place.new()
    rest = random.choice(("the rest", "the others", "the other half")) if not third else "the rest"
    end = f"{rest} {'are' if rest != 'the rest' or count > 2 else 'is'} {second}"
    only = f", and {end}" if both else ""
    if count == 2:
        return sentence(f"one of {the} on {p} is {first}" + (f" and the other is {second}" if both else ""))
    return random.choice((
        sentence(f"{share} of {the} on {p} are {first}{only}"), sentence(f"of {the} on {p}, {share} are {first}{only}"),
        f"{sentence(f'{NUMBERS[count]} {noun.plural} are on {p}')} {sentence(f'{share} of them are {first}{only}')}",
        sentence(f"there are {NUMBERS[count]} {noun.plural} on {p}, {share} of them {first}"
                 + (f" and {rest} {second}" if both else "")),
        sentence(f"on {p} there are {NUMBERS[count]} {noun.plural}, {share} of which are {first}{only}"),
    ))  # fmt: skip


def _all_but(d: Draw) -> str:
    """All but one, all except two, every one of them."""
    random = d.random
    count, few = random.choice((3, 4, 5)), random.choice((0, 1, 1, 1, 2))
    noun = d.noun([noun for noun in of_kind("small") if len(noun.colours) > 4])
    group, place = Group(tuple(Thing(noun) for _ in range(count))), d.furniture()
    d.meaning.things += group.things
    d.put(group, place)
    colour = random.choice(noun.colours)
    few = min(few, count - 1)
    for thing in group.things[few:]:
        thing.colour = colour
    total, p, n = NUMBERS[count], place.new(), NUMBERS[few]
    if not few:
        return random.choice((
            sentence(f"all of the {total} {noun.plural} on {p} are {colour}"),
            sentence(f"all {total} {noun.plural} on {p} are {colour}"),
            sentence(f"there are {total} {noun.plural} on {p}, all of them {colour}"),
            sentence(f"there are {total} {noun.plural} on {p}, all of which are {colour}"),
            f"{sentence(f'{total} {noun.plural} are on {p}')} {random.choice(('All of them', 'They all', 'All'))} "
            f"are {colour}.".replace("They all are", "They are all"),
        ))  # fmt: skip
    left = count - few
    are = f"{'is' if left == 1 else 'are'} {colour}"
    return random.choice((
        sentence(f"all but {n} of the {total} {noun.plural} on {p} are {colour}"),
        f"{sentence(f'there are {total} {noun.plural} on {p}')} {sentence(f'all but {n} of them are {colour}')}",
        f"{sentence(f'{total} {noun.plural} are on {p}')} {sentence(f'all except {n} are {colour}')}",
        sentence(f"of the {total} {noun.plural} on {p}, all but {n} are {colour}"),
        sentence(f"of the {total} {noun.plural} on {p}, {NUMBERS[left]} {are}"),
    ))  # fmt: skip


def _turned(d: Draw) -> str:
    """Some of them upside down or on their sides."""
    random = d.random
    count = random.choice((2, 3, 4, 5))
    some = random.randrange(1, count)
    group = _plain(d, ("mug", "cup", "bottle", "can", "vase", "jar"), count)
    place = d.furniture()
    d.put(group, place)
    kind, one, many = random.choice((("upside_down", "upside down", "upside down"),
                                     ("on_its_side", "on its side", "on their sides")))  # fmt: skip
    for thing in group.things[:some]:
        d.meaning.postures[thing] = kind
    how = one if some == 1 else many
    verb = _is(some) if kind == "upside_down" else ("lies" if some == 1 else "lie")
    n, total, p, plural = NUMBERS[some], NUMBERS[count], place.new(), group.one.noun.plural
    m = count - some
    rest = random.choice(
        (f"{_rest(d, m)} {_is(m)} upright", f"{_rest(d, m)} {'stands' if m == 1 else 'stand'} upright")
    )
    return random.choice((
        sentence(f"{n} of the {total} {plural} on {p} {verb} {how}"),
        sentence(f"{n} of the {total} {plural} on {p} {verb} {how}, {rest}"),
        f"{sentence(f'there are {total} {plural} on {p}')} {sentence(f'{n} of them {verb} {how}')}",
        sentence(f"{total} {plural} are on {p}, {n} of them {how}"),
        sentence(f"{total} {plural} are on {p}; {n} {verb} {how}, {rest}"),
        sentence(f"of the {total} {plural} on {p}, {n} {verb} {how} and {rest}"),
    ))  # fmt: skip


def _three_parts(d: Draw) -> str:
    """Three colours of one noun."""
    random = d.random
    noun = d.noun([noun for noun in of_kind("small") if len(noun.colours) > 4])
    parts = [random.choice((1, 1, 2)) for _ in range(3)]
    colours = random.sample(noun.colours, 3)
    place = d.furniture()
    for count, colour in zip(parts, colours, strict=True):
        things = tuple(Thing(noun, colour) for _ in range(count))
        d.meaning.things += things
        d.put(Group(things), place)
    total, p = f"{NUMBERS[sum(parts)]} {noun.plural}", place.new()
    (a, b, c), (x, y, z) = colours, (NUMBERS[count] for count in parts)
    ia, ib, ic = map(_is, parts)
    rest = _rest(d, parts[2])
    return random.choice((
        sentence(f"{p} holds {total}: {x} {ia} {a}, {y} {ib} {b} and {rest} {ic} {c}"),
        sentence(f"of the {total} on {p}, {x} {ia} {a}, {y} {b} and {z} {c}"),
        sentence(f"there are {total} on {p}, {x} {a}, {y} {b} and {z} {c}"),
        f"{sentence(f'there are {total} on {p}')} {sentence(f'{x} {ia} {a}, {y} {ib} {b}, {rest} {ic} {c}')}",
        sentence(f"on {p} are {total} ({x} {a}, {y} {b}, {z} {c})"),
        sentence(f"{x} of the {total} on {p} {ia} {a}, {y} {ib} {b} and {z} {ic} {c}"),
    ))  # fmt: skip


def _placed(d: Draw) -> str:
    """Some of them in a holder and the rest beside it or elsewhere."""
    random = d.random
    holder, place = d.holder(), d.furniture()
    d.put(holder, place)
    count = random.choice((2, 3, 4, 5))
    some = random.randrange(1, count)
    whole = d.filling(holder, count, plain=0.8)
    d.put(Group(whole.things[:some]), holder)
    m = count - some
    d.put(Group(whole.things[some:]), place)
    n, p, h = NUMBERS[some], place.new(), holder.new()
    the, on = f"the {NUMBERS[count]} {whole.head()}", place.the_noun()
    rest = _rest(d, m)
    return random.choice((
        sentence(f"{h} is on {p}. {n.capitalize()} of {the} {_is(some)} in it, {rest} {_is(m)} on {on}"),
        sentence(f"on {p} there is {h}. {n.capitalize()} of {the} {_is(some)} in {holder.the_noun()} and {rest} "
                 f"{_is(m)} on {on}"),
        sentence(f"there is {h} on {p}. Of {the}, {n} {_is(some)} in {holder.the_noun()} and {NUMBERS[m]} on {on}"),
        sentence(f"there are {whole.new()}, {n} in {h} on {p} and {NUMBERS[m]} on {on} itself"),
    ))  # fmt: skip
