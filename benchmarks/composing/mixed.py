"""Lists of mixed colours and materials: "A red, a green and two blue cups"."""

from __future__ import annotations

from collections.abc import Callable

from benchmarks.composing.meaning import Thing
from benchmarks.composing.nouns import Noun, of_kind
from benchmarks.composing.wording import NUMBERS, Draw, Group, a, listed, sentence


def mixed(d: Draw) -> str:
    """Things of one noun in several colours or materials, beside others."""
    random = d.random
    way: Callable[[Draw, Group], str] = random.choice((_colours, _colours, _colours, _told_after, _materials, _ones))
    place = d.furniture()
    said = way(d, place)
    others = [d.small(d.count()) for _ in range(random.choice((0, 0, 1, 1, 2)))]
    for other in others:
        d.put(other, place)
    parts = [said, *(other.new() for other in others)]
    if len(others) > 1 and d.chance(0.5):
        parts = [parts[1], parts[0], *parts[2:]]
    # A list within a list ends with its own "and".
    words = "; ".join(parts) if len(parts) > 1 and d.chance(0.1) else " and ".join(
        (", ".join(parts[:-1]), parts[-1])) if len(parts) > 1 else parts[0]  # fmt: skip
    p = place.new()
    return sentence(random.choice((
        f"{words} are on {p}", f"on {p} there are {words}", f"{p} holds {words}", f"{words} on {p}",
        f"{p} with {words} on it", f"there are {words} on {p}", f"on {p}: {words}", f"{p} has {words} on it",
    )))  # fmt: skip


def _in_colours(d: Draw, place: Group, count: int) -> tuple[Noun, list[int], list[str]]:
    noun = d.noun([noun for noun in of_kind("small") if len(noun.colours) > 4])
    counts = [d.random.choice((1, 1, 2, 2, 3)) for _ in range(count)]
    colours = d.random.sample(noun.colours, count)
    for number, colour in zip(counts, colours, strict=True):
        things = tuple(Thing(noun, colour) for _ in range(number))
        d.meaning.things += things
        d.put(Group(things), place)
    return noun, counts, colours


def _number(count: int, word: str) -> str:
    return a(word) if count == 1 else f"{NUMBERS[count]} {word}"


def _colours(d: Draw, place: Group) -> str:
    """The noun once, after the last colour."""
    noun, counts, colours = _in_colours(d, place, d.random.choice((2, 3, 3, 4)))
    if counts[-1] == 1 and max(counts) > 1:
        at = counts.index(max(counts))
        counts[at], counts[-1], colours[at], colours[-1] = counts[-1], counts[at], colours[-1], colours[at]
    parts = [_number(count, colour) for count, colour in zip(counts, colours, strict=True)]
    return f"{listed(parts)} {noun.word if counts[-1] == 1 else noun.plural}"


def _ones(d: Draw, place: Group) -> str:
    """The noun once, after the first colour, and then "one" or none."""
    noun, counts, colours = _in_colours(d, place, d.random.choice((2, 3, 3)))
    first, *rest = [_number(count, colour) for count, colour in zip(counts, colours, strict=True)]
    ones = [f"{part} {'one' if count == 1 else 'ones'}" for part, count in zip(rest, counts[1:], strict=True)]
    return listed([f"{first} {noun.word if counts[0] == 1 else noun.plural}", *ones])


def _told_after(d: Draw, place: Group) -> str:
    """The total first, and the colours in brackets or after dashes."""
    noun, counts, colours = _in_colours(d, place, d.random.choice((2, 3, 3)))
    total = f"{NUMBERS[sum(counts)] if sum(counts) < len(NUMBERS) else sum(counts)} {noun.plural}"
    parts = [f"{NUMBERS[count]} {colour}" for count, colour in zip(counts, colours, strict=True)]
    ways = [f"{total} ({listed(parts)})", f"{total} ({', '.join(parts)})", f"{total} - {listed(parts)} -",
            f"{total}, {listed(parts)},"]  # fmt: skip
    if max(counts) == 1:
        ways += [f"{total} ({listed(colours)})", f"{total} ({', '.join(colours)})", f"{total} in {listed(colours)}",
                 f"{total}, {listed([f'one {colour}' for colour in colours])},"]  # fmt: skip
    return d.random.choice(ways)


def _materials(d: Draw, place: Group) -> str:
    random = d.random
    noun = d.noun([noun for noun in of_kind("small") if len(noun.materials) > 1])
    materials = random.sample(noun.materials, 2)
    counts = [random.choice((1, 1, 2)) for _ in range(2)]
    for number, material in zip(counts, materials, strict=True):
        things = tuple(Thing(noun, material=material) for _ in range(number))
        d.meaning.things += things
        d.put(Group(things), place)
    first, second = (_number(count, material) for count, material in zip(counts, materials, strict=True))
    n, m = (noun.word if count == 1 else noun.plural for count in counts)
    ways = [f"{first} {n} and {second} {'one' if counts[1] == 1 else 'ones'}", f"{first} {n} and {second} {m}"]
    return random.choice([*ways, f"{first} and {second} {m}"] if counts[0] <= counts[1] else ways)
