"""Instructions of several steps, goals told as states, sources and targets, polite forms, ordinals and superlatives."""

from __future__ import annotations

from collections.abc import Callable

from benchmarks.composing.meaning import Thing
from benchmarks.composing.nouns import FITS, LAID, named, of_kind
from benchmarks.composing.wording import NUMBERS, ORDINALS, Draw, Group, listed, sentence, within


def steps(d: Draw) -> str:
    """What is to be done, in one step or several: "Put the lemon in the bowl, then put the bowl on the tray"."""
    way: Callable[[Draw], str] = d.random.choice(
        (_polite, _polite, _goal_state, _goal_state, _goal_state, _several, _several, _several, _from_to, _from_to,
         _ranked, _ranked, _largest, _pronoun, _pronoun)
    )  # fmt: skip
    return way(d)


def _kinds(item: Group, goal: Group) -> str:
    return "place|stack" if goal.one.noun.word in ("book", "cutting board", "box", "cube") else "place"


def _task(d: Draw, item: Group, goal: Group) -> None:
    d.meaning.task = tuple(_kinds(item, goal).split("|"))
    d.meaning.of_task = [item.one, goal.one]


def _goal(d: Draw) -> tuple[Group, Group, str]:
    """Something, where it is to go, and the preposition."""
    goal = d.holder() if d.chance(0.6) else d.carrier()
    item = d.filling(goal, 1)
    return item, goal, within(goal)


def _scene(d: Draw, *groups: Group) -> str:
    """The sentence that puts all of them on a place."""
    place = d.furniture()
    for group in groups:
        d.put(group, place)
    words, p = listed([group.new() for group in groups]), place.new()
    return sentence(
        d.random.choice(
            (f"{words} are on {p}", f"on {p} there are {words}", f"{p} holds {words}", f"there are {words} on {p}")
        )
    )


def _polite(d: Draw) -> str:
    item, goal, on = _goal(d)
    _task(d, item, goal)
    scene = f"{_scene(d, item, goal)} " if d.chance(0.5) else ""
    i, g = (item.the_noun(), goal.the_noun()) if scene else (item.the(), goal.the())
    return scene + d.random.choice((
        f"Would you mind putting {i} {on} {g}?", f"Could you please put {i} {on} {g}?",
        f"Can you put {i} {on} {g}, please?",
        f"Kindly place {i} {on} {g}.", f"I'd like you to put {i} {on} {g}.", f"I would like you to place {i} {on} {g}.",
        f"Please put {i} {on} {g} for me.", f"Would you put {i} {on} {g}?", f"I need you to put {i} {on} {g}.",
        f"Put {i} {on} {g}, please.", f"Please could you put {i} {on} {g}?", f"You should put {i} {on} {g}.",
        f"Your task is to put {i} {on} {g}.", f"Robot, put {i} {on} {g}.", f"Let's put {i} {on} {g}.",
        f"Go ahead and put {i} {on} {g}.", f"Would you be so kind as to put {i} {on} {g}?",
    ))  # fmt: skip


def _goal_state(d: Draw) -> str:
    """What is to be so in the end."""
    item, goal, on = _goal(d)
    _task(d, item, goal)
    scene = f"{_scene(d, item, goal)} "
    i, g = item.the_noun(), goal.the_noun()
    the_i = f"{i[0].upper()}{i[1:]}"
    return scene + d.random.choice((
        f"{the_i} should end up {on} {g}.", f"In the end, {i} should be {on} {g}.", f"Make sure {i} ends up {on} {g}.",
        f"{the_i} has to go {on} {g}.", f"The goal is to have {i} {on} {g}.", f"Your goal is to get {i} {on} {g}.",
        f"{the_i} belongs {on} {g}.", f"{the_i} must be put {on} {g}.", f"{the_i} needs to be {on} {g}.",
        f"Get {i} {on}to {g}." if on == "on" else f"Get {i} into {g}.", f"{the_i} should be placed {on} {g}.",
        f"{the_i} goes {on} {g}.", f"I want {i} to be {on} {g}.", f"At the end, {i} must be {on} {g}.",
        f"See to it that {i} is {on} {g} in the end.", f"{the_i} is to be put {on} {g}.",
        f"{the_i} ought to be {on} {g}.", f"Have {i} end up {on} {g}.",
        f"I want {i} {on} {g}.",
    ))  # fmt: skip


def _several(d: Draw) -> str:
    """Two steps, in the order in which they are to be done."""
    random = d.random
    goals = [d.holder(), d.holder() if d.chance(0.5) else d.carrier()]
    if d.chance(0.4):
        goals[1] = goals[0]
        d.meaning.things = [thing for thing in d.meaning.things if thing is goals[0].one]
    items = [d.filling(goal, 1) for goal in goals]
    scene = ""
    distinct = [goals[0]] if goals[0] is goals[1] else goals
    if d.chance(0.5):
        scene = f"{_scene(d, *items, *distinct)} "
    d.meaning.steps = [
        (_kinds(item, goal).split("|"), [item.one, goal.one]) for item, goal in zip(items, goals, strict=True)
    ]
    names = [group.the_noun() if scene else group.the() for group in (*items, *goals)]
    i, j, g, h = names
    a, b = (within(goal) for goal in goals)
    if goals[0] is goals[1]:
        return scene + random.choice((
            f"Put {i} {a} {g}, then {j}.",
            f"First put {i} {a} {g}, and then put {j} {a} {g} as well.", f"Put {i} and {j} {a} {g}.",
            f"Put {i} {a} {g}. Then put {j} there too.", f"Put {i} {a} {g}. Do the same with {j}.",
            f"Put both {i} and {j} {a} {g}.", f"Put {i} {a} {g} and after that {j}.",
            f"Put {i} {a} {g}. Put {j} {a} it as well.",
        ))  # fmt: skip
    return scene + random.choice((
        f"Put {i} {a} {g}, then put {j} {b} {h}.", f"First put {i} {a} {g}, then {j} {b} {h}.",
        f"Put {i} {a} {g} and {j} {b} {h}.", f"Put {i} {a} {g}. After that, put {j} {b} {h}.",
        f"Put {i} {a} {g}. Next, place {j} {b} {h}.", f"After putting {i} {a} {g}, put {j} {b} {h}.",
        f"Before you put {j} {b} {h}, put {i} {a} {g}.", f"Put {j} {b} {h} after you have put {i} {a} {g}.",
        f"1. Put {i} {a} {g}. 2. Put {j} {b} {h}.", f"Place {i} {a} {g}; finally, put {j} {b} {h}.",
        f"Pick up {i} and put it {a} {g}. Then pick up {j} and put it {b} {h}.",
        f"Once {i} is {a} {g}, put {j} {b} {h}.", f"When you have put {i} {a} {g}, put {j} {b} {h}.",
        f"Put {i} {a} {g} first and {j} {b} {h} second.",
    ))  # fmt: skip


def _from_to(d: Draw) -> str:
    """From one of two likes into the other."""
    random = d.random
    if d.chance(0.5):
        return _from_other(d)
    place = d.furniture()
    noun = d.noun([named(word) for word in ("bowl", "basket", "box", "crate", "plate", "tray")])
    two = Group((Thing(noun), Thing(noun)))
    d.meaning.things += two.things
    d.put(two, place)
    left = d.chance(0.5)
    source, target = two.things if left else two.things[::-1]
    fill = d.filling(Group((source,)), 1)
    d.put(fill, Group((source,)))
    _task(d, fill, Group((target,)))
    way, p, i, the = random.choice(("side", "colour", "one")), place.new(), fill.new(), fill.the_noun()
    on, word = within(two), noun.word
    into, out = ("into", "out of") if on == "in" else ("onto", "off")
    if way == "side":
        d.meaning.add("left_of", [two.things[0]], two.things[1])
        s, t = ("left", "right") if left else ("right", "left")
        holds, lies = sentence(f"the {s} one holds {i}"), sentence(f"{i} is {on} the {s} one")
        return f"{sentence(f'two {noun.plural} are on {p}')} " + random.choice((
            f"{holds} Move {the} from the {s} {word} {into} the {t} one.",
            f"Put the {fill.head()} from the {s} {word} {into} the {t} one.", f"{lies} Put it {into} the {t} one.",
            f"{lies} Take it {out} the {s} {word} and put it {into} the {t} one.",
            f"{holds} Transfer {the} to the other one.",
        ))  # fmt: skip
    if way == "colour" and noun.colours:
        x, y = random.sample(noun.colours, 2)
        source.colour, target.colour = x, y
        pair = listed([f"a {colour} {word}" for colour in ((x, y) if d.chance(0.5) else (y, x))])
        return f"{sentence(random.choice((f'{pair} are on {p}', f'on {p} are {pair}')))} " + random.choice((
            f"{sentence(f'{i} is {on} the {x} one')} Move it {into} the {y} one.",
            f"{sentence(f'the {x} one holds {i}')} Put {the} {into} the {y} one.",
            f"Move the {fill.head()} from the {x} {word} {into} the {y} one.",
        ))  # fmt: skip
    return f"{sentence(f'there are two {noun.plural} on {p}')} " + random.choice((
        f"{sentence(f'one holds {i}, the other is empty')} Move {the} {into} the empty one.",
        f"{sentence(f'one of them holds {i}')} Move {the} to the other {word}.",
        f"{sentence(f'one of them holds {i}')} Put {the} {into} the other one.",
    ))  # fmt: skip


def _from_other(d: Draw) -> str:
    """From one carrier into another, or onto what carries it."""
    random = d.random
    place, one, two = d.furniture(), d.holder(), d.holder()
    kinds = sorted({*FITS[one.one.noun.word]} & {*FITS[two.one.noun.word]})
    fill = d.small(1, *(kinds or FITS[one.one.noun.word]))
    d.put(one, place)
    d.put(fill, one)
    i, o, t, p = fill.new(), one.new(), two.new(), place.new()
    the_i, the_o, the_t = fill.the_noun(), one.the_noun(), two.the_noun()
    if not kinds:
        d.meaning.things.remove(two.one)
        _task(d, fill, place)
        return (
            f"{sentence(f'{o} with {i} in it is on {p}')} Take {the_i} out of {the_o} and put it on {place.the_noun()}."
        )
    d.put(two, place)
    _task(d, fill, two)
    start = random.choice((
        sentence(f"{o} with {i} in it and {t} are on {p}"),
        f"{sentence(f'{o} and {t} are on {p}')} {sentence(f'{the_o} holds {i}')}",
        f"{sentence(f'on {p} there are {o} and {t}')} {sentence(f'{i} is in {the_o}')}",
    ))  # fmt: skip
    return f"{start} " + random.choice((
        f"Move {the_i} from {the_o} to {the_t}.", f"Take {the_i} out of {the_o} and put it into {the_t}.",
        f"Transfer {the_i} from {the_o} into {the_t}.", f"Move {the_i} into {the_t}.",
        f"Remove {the_i} from {the_o} and place it in {the_t}.", f"From {the_o}, move {the_i} to {the_t}.",
        f"Pick {the_i} out of {the_o} and drop it into {the_t}.", f"Put what is in {the_o} into {the_t}.",
    ))  # fmt: skip


def _ranked(d: Draw) -> str:
    """One of a row, by its place in it."""
    random = d.random
    goal = d.holder() if d.chance(0.6) else d.carrier()
    on = within(goal)
    count = random.choice((3, 3, 4))
    noun = d.noun(of_kind(*{**FITS, **LAID}[goal.one.noun.word]))
    row = Group(tuple(Thing(noun) for _ in range(count)))
    d.meaning.things += row.things
    place = d.furniture()
    d.put(row, place)
    d.put(goal, place)
    at = random.randrange(count)
    d.meaning.rows.append((frozenset({"row"}), row.things))
    for one, two in zip(row.things, row.things[1:], strict=False):
        d.meaning.add("left_of", [one], two)
    _task(d, Group((row.things[at],)), goal)
    refs = [f"the {ORDINALS[at]} {noun.word} from the left", f"the {ORDINALS[at]} one from the left"]
    if at == 0:
        refs += ["the leftmost one", f"the leftmost {noun.word}", "the one farthest to the left"]
    elif at == count - 1:
        refs += ["the rightmost one", f"the rightmost {noun.word}", f"the {noun.word} at the right end"]
    elif count == 3:
        refs += ["the middle one", f"the {noun.word} in the middle"]
    p, g, the, r = place.new(), goal.new(), goal.the_noun(), random.choice(refs)
    start = random.choice((
        f"{NUMBERS[count]} {noun.plural} stand in a row on {p}. {sentence(f'{g} is on {place.the_noun()} too')}",
        f"on {p} there is a row of {NUMBERS[count]} {noun.plural}, and {g}.",
        f"there are {NUMBERS[count]} {noun.plural} in a row and {g} on {p}.",
    ))  # fmt: skip
    asked = random.choice((f"Put {r} {on} {the}.", f"Please move {r} {on}to {the}.", f"Take {r} and put it {on} {the}.",
                           f"Pick up {r} and place it {on} {the}."))  # fmt: skip
    return f"{start[0].upper()}{start[1:]} {asked}"


def _largest(d: Draw) -> str:
    """The larger of two or the one that is not like the others."""
    random = d.random
    goal = d.holder()
    kinds = FITS[goal.one.noun.word]
    noun = d.noun([noun for noun in of_kind(*kinds) if len(noun.colours) > 1] or list(of_kind(*kinds)))
    sizes = random.choice((("large", None), (None, "small"))) if d.chance(0.6) else ("large", "small")
    one, two = (Thing(noun, size=size) for size in sizes)
    d.meaning.things += [one, two]
    place = d.furniture()
    d.put(Group((one, two)), place)
    d.put(goal, place)
    large = d.chance(0.5)
    item = one if large else two
    _task(d, Group((item,)), goal)
    p, g, the = place.new(), goal.new(), goal.the_noun()
    refs = [f"the {'larger' if large else 'smaller'} one", f"the {'bigger' if large else 'smaller'} {noun.word}",
            f"the {'larger' if large else 'smaller'} of the two {noun.plural}"]  # fmt: skip
    if sizes == ("large", "small"):
        refs += [f"the {'large' if large else 'small'} one", f"the {'large' if large else 'small'} {noun.word}"]
        start = f"a large {noun.word}, a small {noun.word} and {g} are on {p}"
    else:
        size = "large" if sizes[0] else "small"
        pair = [f"a {size} {noun.word}", f"a {noun.word}"]
        one.size, two.size = sizes
        start = f"{pair[0]}, {pair[1]} and {g} are on {p}".replace("a apple", "an apple").replace("a egg", "an egg")
    return f"{sentence(start.replace('a eraser', 'an eraser'))} Put {random.choice(refs)} in {the}."


def _pronoun(d: Draw) -> str:
    """Steps with pronouns: pick it up, put it there; and one that is to be stacked."""
    random = d.random
    item, goal, on = _goal(d)
    _task(d, item, goal)
    other = d.small(1)
    order = random.choice(((item, goal, other), (other, item, goal), (goal, other, item)))
    scene = _scene(d, *order)
    i, g = item.the_noun(), goal.the_noun()
    return f"{scene} " + random.choice((
        f"Pick up {i}. Put it {on} {g}.", f"Pick up {i}, then place it {on} {g}.", f"Take {i} and put it {on} {g}.",
        f"Grab {i} and set it down {on} {g}." if on == "on" else f"Grab {i} and drop it {on} {g}.",
        f"Lift {i} and put it {on} {g}.", f"Pick {i} up and put it {on} {g}.",
        f"First pick up {i}; then put it {on} {g}.",
        f"Take {i}. Then place it {on} {g}.", f"Find {i} and put it {on} {g}.",
        f"Locate {i}, grasp it and place it {on} {g}.",
    ))  # fmt: skip
