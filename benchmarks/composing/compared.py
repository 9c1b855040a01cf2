"""Positions of several likes told by comparison: the front one, the one between, the one nearest the lamp."""

from __future__ import annotations

from collections.abc import Callable

from benchmarks.composing.meaning import Thing
from benchmarks.composing.nouns import FITS, named, of_kind
from benchmarks.composing.wording import NUMBERS, SIDES, Draw, Group, listed, sentence


def positions(d: Draw) -> str:
    """Which of several likes has which colour, contents or neighbour, by where it stands."""
    way: Callable[[Draw], str] = d.random.choice(
        (_in_row, _in_row, _front_and_back, _left_holds, _left_holds, _nearest, _order, _order, _flanked, _between)
    )
    return way(d)


def _likes(d: Draw, count: int, nouns: tuple[str, ...] = ()) -> Group:
    """Likes of which nothing is said yet."""
    choice = [named(word) for word in nouns] or [noun for noun in of_kind("small") if len(noun.colours) > 4]
    noun = d.noun(choice)
    things = tuple(Thing(noun) for _ in range(count))
    d.meaning.things += things
    return Group(things)


def _ordered(d: Draw, things: tuple[Thing, ...]) -> None:
    for one, two in zip(things, things[1:], strict=False):
        d.meaning.add("left_of", [one], two)


def _in_row(d: Draw) -> str:
    """A row of three, and the colour of each or of some."""
    random = d.random
    row, place = _likes(d, 3), d.furniture()
    d.put(row, place)
    d.meaning.rows.append((frozenset({"row"}), row.things))
    _ordered(d, row.things)
    noun, p = row.one.noun, place.new()
    start = random.choice((f"three {noun.plural} stand in a row on {p}",
    f"there is a row of three {noun.plural} on {p}",
                           f"on {p} are three {noun.plural} in a row"))  # fmt: skip
    x, y, z = colours = random.sample(noun.colours, 3)
    left, right = row.things[0], row.things[2]
    if d.chance(0.5):
        for thing, colour in zip(row.things, colours, strict=True):
            thing.colour = colour
        said = random.choice((
            f"the left one is {x}, the middle one is {y} and the right one is {z}",
            f"the left one is {x}, the middle one {y} and the right one {z}",
            f"the first is {x}, the second {y} and the third {z}", f"from left to right they are {x}, {y} and {z}",
            f"the {noun.word} on the left is {x}, the one in the middle {y} and the one on the right {z}",
            f"the one in the middle is {y}, the leftmost one {x} and the rightmost one {z}",
        ))  # fmt: skip
        return f"{sentence(start)} {sentence(said)}"
    way = random.choice(("ends", "middle", "left", "right"))
    if way == "ends":
        left.colour, row.things[1].colour, right.colour = x, y, x
        said = random.choice((f"the outer two are {x} and the middle one is {y}",
        f"the middle one is {y}, the others are "
                              f"{x}", f"the middle one is {y} and the other two are {x}"))  # fmt: skip
    elif way == "middle":
        row.things[1].colour = y
        said = random.choice((f"the middle one is {y}", f"the one in the middle is {y}",
        f"the {noun.word} in the middle is {y}",
                              f"the second one is {y}"))  # fmt: skip
    else:
        (left if way == "left" else right).colour = x
        said = random.choice((f"the {way}most one is {x}", f"the one farthest to the {way} is {x}",
                              f"the {noun.word} furthest to the {way} is {x}", f"the {way} one is {x}",
                              f"the one on the far {way} is {x}"))  # fmt: skip
    return f"{sentence(start)} {sentence(said)}"


def _front_and_back(d: Draw) -> str:
    """Two, one behind the other."""
    random = d.random
    two, place = _likes(d, 2), d.furniture()
    d.put(two, place)
    front, back = two.things
    d.meaning.add("in_front_of", [front], back)
    noun, p = front.noun, place.new()
    x, y = random.sample(noun.colours, 2)
    front.colour, back.colour = x, y
    start = random.choice((f"two {noun.plural} stand on {p}, one behind the other",
    f"on {p} there are two {noun.plural}, one "
                           f"in front of the other"))  # fmt: skip
    return f"{sentence(start)} " + sentence(random.choice((
        f"the front one is {x} and the back one is {y}", f"the one in front is {x}, the one behind it is {y}",
        f"the one in front is {x}, the one behind is {y}", f"the front {noun.word} is {x}, the rear one {y}",
        f"the one at the back is {y} and the one at the front is {x}",
    )))  # fmt: skip


def _left_holds(d: Draw) -> str:
    """The left of two holds this, the right that."""
    random = d.random
    count = random.choice((2, 2, 3))
    group, place = _likes(d, count, (*FITS, "plate")), d.furniture()
    d.put(group, place)
    _ordered(d, group.things)
    fills: list[str] = []
    verbs: list[str] = []
    for thing in group.things:
        fill = d.filling(Group((thing,)))
        d.put(fill, Group((thing,)))
        fills.append(fill.new())
        verbs.append(fill.be())
    if count == 3:
        d.meaning.rows.append((frozenset({"row"}), group.things))
    noun, p, n = group.one.noun, place.new(), NUMBERS[count]
    where = "in" if noun.word in FITS else "on"
    x, *middle, z = fills
    start = f"{n} {noun.plural} are {'in a row ' if count == 3 else random.choice(('', 'side by side '))}on {p}"
    if "side by side" in start:
        d.meaning.rows.append((frozenset({"side_by_side"}), group.things))
    if count == 3:
        return f"{sentence(start)} " + sentence(random.choice((
            f"the left one holds {x}, the middle one {middle[0]} and the right one {z}",
            f"the first holds {x}, the second {middle[0]} and the third {z}",
            f"the left one holds {x}, the one in the middle holds {middle[0]} and the one on the right holds {z}",
            f"from left to right they hold {x}, {middle[0]} and {z}",
        )))  # fmt: skip
    return random.choice((
        f"{sentence(start)} {sentence(f'the left one holds {x} and the right one holds {z}')}",
        f"{sentence(start)} {sentence(f'the left {noun.word} holds {x}, the right {noun.word} {z}')}",
        f"{sentence(start)} {sentence(f'the one on the left holds {x} and the one on the right {z}')}",
        f"{sentence(start)} {sentence(f'{where} the left one {verbs[0]} {x}, {where} the right one {z}')}",
        sentence(f"the left of the two {noun.plural} on {p} holds {x} and the right one {z}")
        if "side by side" not in start else f"{sentence(start)} {sentence(f'the left one holds {x}')}"
        f" {sentence(f'the right one holds {z}')}",
        sentence(f"{start}, the left one holding {x} and the right one holding {z}"),
    ))  # fmt: skip


def _nearest(d: Draw) -> str:
    """A landmark at the end of a row, and the one nearest to it."""
    random = d.random
    count = random.choice((2, 3, 3))
    mark, row, place = d.small(1), _likes(d, count), d.furniture()
    d.put(mark, place)
    d.put(row, place)
    left = d.chance(0.5)
    side = "left" if left else "right"
    noun, m, p = row.one.noun, mark.new(), place.new()
    d.meaning.rows.append((frozenset({"row"}), row.things))
    _ordered(d, row.things)
    for thing in row.things:
        d.meaning.add("left_of" if left else "right_of", mark.things, thing)
    near, far = (row.things[0], row.things[-1]) if left else (row.things[-1], row.things[0])
    start = random.choice((f"on {p}, {m} is to the {side} of a row of {NUMBERS[count]} {noun.plural}",
                           f"{m} stands to the {side} of a row of {NUMBERS[count]} {noun.plural} on {p}"))  # fmt: skip
    x, y = random.sample(noun.colours, 2)
    the = mark.the_noun()
    nearest = random.choice(("nearest", "closest to", "nearest to"))
    near.colour = x
    if count == 2 or d.chance(0.4):
        far.colour = y
        d.meaning.far.append((far, mark.one))
        said = f"the {random.choice((noun.word, 'one'))} {nearest} {the} is {x} and the one farthest from it is {y}"
    else:
        said = random.choice((f"the one {nearest} {the} is {x}", f"the {noun.word} {nearest} {the} is {x}"))
    return f"{sentence(start)} {sentence(said)}"


def _order(d: Draw) -> str:
    """Unlike things in order, by comparison of neighbours."""
    random = d.random
    one, two, three, place = d.small(1), d.small(1), d.small(1), d.furniture()
    for group in (one, two, three):
        d.put(group, place)
    axis = random.choice(("left", "left", "front"))
    kind = "left_of" if axis == "left" else "in_front_of"
    d.meaning.add(kind, one.things, two.one)
    d.meaning.add(kind, two.things, three.one)
    x, y, z, p = one.new(), two.new(), three.new(), place.new()
    the_x, the_y, the_z = one.the_noun(), two.the_noun(), three.the_noun()
    if axis == "left":
        return " ".join(map(sentence, random.choice((
            (f"on {p}, {x} is to the left of {y}, which is to the left of {z}",),
            (f"on {p} there is {y} with {x} to its left and {z} to its right",),
            (f"{y} on {p} has {x} on its left and {z} on its right",),
            (f"{x}, {y} and {z} are on {p}", f"{the_y} is to the right of {the_x} and to the left of {the_z}"),
            (f"{x}, {y} and {z} are on {p}", f"{the_x} is left of {the_y}, and {the_z} is right of {the_y}"),
            (f"{x} is on {p}", f"to the right of it is {y}, and to the right of that is {z}"),
            (f"{p} holds {y}", f"{x} is to the left of it, {z} to the right of it"),
            (f"{y} is on {p}", f"on its left is {x} and on its right is {z}"),
            (f"on {p} stands {y}, to the left of which is {x} and to the right of which is {z}",),
        ))))  # fmt: skip
    return " ".join(map(sentence, random.choice((
        (f"on {p}, {x} is in front of {y}, which is in front of {z}",),
        (f"on {p} there is {y} with {x} in front of it and {z} behind it",),
        (f"{x}, {y} and {z} are on {p}", f"{the_y} is behind {the_x} and in front of {the_z}"),
        (f"{y} is on {p}", f"in front of it is {x}, and behind it is {z}"),
        (f"{x} is on {p}, behind it is {y}, and behind that is {z}",),
        (f"on {p} stands {y}, in front of which is {x} and behind which is {z}",),
    ))))  # fmt: skip


def _flanked(d: Draw) -> str:
    """What has one on either side, and what is told of those by side."""
    random = d.random
    item, two, place = d.small(1), _likes(d, 2), d.furniture()
    d.put(item, place)
    d.put(two, place)
    left, right = two.things
    d.meaning.add("left_of", [left], item.one)
    d.meaning.add("right_of", [right], item.one)
    i, p, noun = item.new(), place.new(), left.noun
    d.meaning.arrangements.clear()
    x, y = random.sample(noun.colours, 2)
    if d.chance(0.5):
        left.colour, right.colour = x, y
        return " ".join(map(sentence, random.choice((
            (f"on {p} there is {i} with two {noun.plural}, one to its left and one to its right",
             f"the left one is {x} and the right one is {y}"),
            (f"{i} is on {p}, with a {x} {noun.word} to its left and a {y} one to its right",),
            (f"{i} on {p} has a {x} {noun.word} on its left and a {y} {noun.word} on its right",),
        ))))  # fmt: skip
    other = d.small(1)
    kind = random.choice(("in_front_of", "behind"))
    d.meaning.add(kind, other.things, left)
    d.put(other, place)
    side = SIDES[kind][0]
    return " ".join(map(sentence, (
        f"on {p} there is {i} with two {noun.plural}, one to its left and one to its right",
        random.choice((f"{other.new()} is {side} the left {noun.word}", f"{side} the left one is {other.new()}",
                       f"{other.new()} stands {side} the one on the left")),
    )))  # fmt: skip


def _between(d: Draw) -> str:
    """What is between the first and the second of a row."""
    random = d.random
    noun = d.noun([noun for noun in of_kind("small") if len(noun.colours) > 4])
    colours = random.sample(noun.colours, 3)
    things = tuple(Thing(noun, colour) for colour in colours)
    d.meaning.things += things
    place, item = d.furniture(), d.small(1)
    d.put(Group(things), place)
    d.put(item, place)
    x, y, z = colours
    one, two = random.sample(things, 2)
    d.meaning.arrangements.append(("between", frozenset(item.things), frozenset((one, two))))
    words, i, p = (
        listed([f"{'an' if c[0] in 'o' else 'a'} {c} {noun.word}" for c in (x, y, z)]),
        item.new(),
        place.new(),
    )
    start = random.choice((f"{words} are on {p}", f"on {p} there are {words}"))
    a, b = one.colour, two.colour
    return f"{sentence(start)} " + sentence(random.choice((
        f"between the {a} one and the {b} one is {i}",
        f"{i} {item.verb(random)} between the {a} and the {b} {noun.word}",
        f"{i} is between the {a} {noun.word} and the {b} one", f"between the {a} and {b} {noun.plural} there is {i}",
    )))  # fmt: skip
